#include "planning/photomontage/lens_view.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace parvis::photomontage {
namespace {

constexpr double max_tangent = 3.732;  ///< of 75 degrees
constexpr double max_drawn_pixels = 64e6;

/// Tangents of a direction in the camera's frame; nothing beyond 75 degrees from the axis.
std::optional<glm::dvec2> tangents_of(glm::dvec3 direction) {
  if (-direction.z <= 0.0) return std::nullopt;
  const glm::dvec2 tangents = glm::dvec2(direction) / -direction.z;
  if (glm::length(tangents) > max_tangent) return std::nullopt;
  return tangents;
}

}  // namespace

std::optional<glm::dvec2> LensView::drawn_pixel(const photographs::Lens& lens, glm::dvec2 pixel) const {
  const std::optional<glm::dvec3> direction = photographs::direction_of(lens, pixel);
  if (!direction) return std::nullopt;
  const std::optional<glm::dvec2> at = tangents_of(*direction);
  if (!at) return std::nullopt;
  const FrustumTangents& edges = *camera.off_axis;
  return glm::dvec2((at->x - double(edges.left)) / (double(edges.right) - double(edges.left)) * width,
                    (double(edges.top) - at->y) / (double(edges.top) - double(edges.bottom)) * height);
}

Result<LensView> view_of(const photographs::Photograph& photograph, int oversampling) {
  const photographs::Lens& lens = photograph.lens;
  glm::dvec2 least(1e9), most(-1e9);
  constexpr int steps = 32;  // along each edge: distortion bends it
  for (int i = 0; i <= steps; ++i) {
    const double x = double(lens.width) * i / steps, y = double(lens.height) * i / steps;
    for (const glm::dvec2 pixel : std::array{glm::dvec2(x, 0), glm::dvec2(x, lens.height), glm::dvec2(0, y),
                                             glm::dvec2(lens.width, y)}) {
      const std::optional<glm::dvec3> direction = photographs::direction_of(lens, pixel);
      const std::optional<glm::dvec2> at = direction ? tangents_of(*direction) : std::nullopt;
      if (!at)
        return error(
            "the lens sees further than 75 degrees from its axis (at pixel {:.0f},{:.0f}); montages are "
            "drawn on a "
            "plane: cut faces of the picture by parvis facade panorama, or another photograph",
            pixel.x, pixel.y);
      least = glm::min(least, *at), most = glm::max(most, *at);
    }
  }
  LensView view;
  view.camera = photographs::camera_of(photograph);
  view.camera.off_axis = FrustumTangents{float(least.x), float(most.x), float(least.y), float(most.y)};
  const glm::dvec2 size = glm::ceil((most - least) * photographs::focal_px(lens) * double(oversampling));
  if (!(size.x * size.y <= max_drawn_pixels))
    return error(
        "the photograph would be drawn in {:.0f} x {:.0f} pixels, more than {:.0f} million; give it smaller",
        size.x, size.y, max_drawn_pixels * 1e-6);
  view.width = std::max(int(size.x), 1), view.height = std::max(int(size.y), 1);
  return view;
}

}  // namespace parvis::photomontage

// Where the rays go that stand for a rough lobe.
#pragma once

#include <array>
#include <cmath>
#include <glm/glm.hpp>

#include "graphics/reference/tracer.h"

namespace parvis::reference {

/// Points of the unit square for the lobe rays of one pixel, each far from those before it: the R2 sequence
/// (Roberts 2018), begun elsewhere in each pixel and at each bounce. Its noise is a fraction of that of
/// chance.
struct LobePoints {
  std::array<glm::vec2, 2> last;  ///< by bounce; none goes on from the second

  glm::vec2 next(int bounce) {
    glm::vec2& point = last[std::size_t(bounce)];
    return point = glm::fract(point + step);
  }
  /// The points of one pixel of a drawn picture that takes `rays` of them: those of a square of `tile_px`
  /// pixels go on from each other.
  static LobePoints in_tile(const MirrorPixel& pixel, int rays, int tile_px) {
    const int turn = pixel.x % tile_px + tile_px * (pixel.y % tile_px);
    const glm::vec2 first = glm::fract(float(turn * rays) * step);
    return {{first, first}};
  }
  /// Passes over what so many samples of the pixel would take.
  void skip(int samples) {
    for (glm::vec2& point : last) point = glm::fract(point + float(samples * lobe_samples) * step);
  }

 private:
  static constexpr glm::vec2 step{0.75487767f, 0.56984029f};
};

/// A half vector of the GGX distribution about `normal`, by a point of the unit square.
inline glm::vec3 ggx_half_vector(glm::vec3 normal, float roughness, glm::vec2 point) {
  const float alpha = roughness * roughness, u = point.x, phi = 6.2831853f * point.y;
  const float cosine = std::sqrt((1.0f - u) / (1.0f + (alpha * alpha - 1.0f) * u));
  const float sine = std::sqrt(std::max(0.0f, 1.0f - cosine * cosine));
  const glm::vec3 t =
      glm::normalize(glm::cross(std::abs(normal.z) < 0.9f ? glm::vec3(0, 0, 1) : glm::vec3(1, 0, 0), normal));
  return sine * std::cos(phi) * t + sine * std::sin(phi) * glm::cross(normal, t) + cosine * normal;
}

}  // namespace parvis::reference

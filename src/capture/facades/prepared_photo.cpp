#include "capture/facades/prepared_photo.h"

#include <algorithm>
#include <cmath>

#include "base/colour.h"
#include "base/image_io.h"

namespace parvis::facades {
namespace {

/// The four pixels around a point and how far it lies between them.
struct Footprint {
  int x0, y0, x1, y1;
  float u, v;
};
Footprint footprint(int width, int height, glm::dvec2 pixel) {
  const double x = std::clamp(pixel.x - 0.5, 0.0, width - 1.0),
               y = std::clamp(pixel.y - 0.5, 0.0, height - 1.0);
  const int x0 = int(x), y0 = int(y);
  return {x0, y0, std::min(x0 + 1, width - 1), std::min(y0 + 1, height - 1), float(x - x0), float(y - y0)};
}

/// 1 where the photograph may be used, 0 elsewhere.
Result<ImageF> mask_of(const photographs::Photograph& photograph) {
  const Result<Image8> mask = read_image8(photograph.mask);
  if (!mask) return mask.errors();
  if (mask->width != photograph.lens.width || mask->height != photograph.lens.height)
    return error("photograph {}: its mask {} is {} x {}, the picture {} x {}; they must be the same",
                 photograph.name, photograph.mask.string(), mask->width, mask->height, photograph.lens.width,
                 photograph.lens.height);
  ImageF trust(mask->width, mask->height, 1);
  for (std::size_t i = 0; i < trust.pixels.size(); ++i)
    trust.pixels[i] = mask->pixels[i * std::size_t(mask->channels)] >= 128 ? 1.0f : 0.0f;
  return trust;
}

}  // namespace

Result<View> view_of(const photographs::Photograph& photograph) {
  if (!photographs::is_pinhole(photograph.lens))
    return error(
        "photograph {}: its lens has distortion; undistort the photographs first (parvis facade calibrate)",
        photograph.name);
  View view;
  view.camera_from_world = glm::dmat3(photographs::opencv_from_world(photograph));
  view.centre = photograph.position_in_world();
  const glm::dvec2 focal = photographs::focal_px(photograph.lens),
                   principal = photographs::principal_point_px(photograph.lens);
  view.fx = focal.x, view.fy = focal.y, view.cx = principal.x, view.cy = principal.y;
  view.width = photograph.lens.width, view.height = photograph.lens.height;
  return view;
}

Result<PreparedPhoto> prepared_photo(const photographs::Photograph& photograph, const LayerModel& model) {
  Result<View> view = view_of(photograph);
  if (!view) return view.errors();
  Result<ImageF> colours = read_image_float(photograph.file);
  if (!colours) return colours.errors();
  if (colours->width != view->width || colours->height != view->height)
    return error("photograph {}: the picture is {} x {}, its camera's {} x {}; they must be the same",
                 photograph.name, colours->width, colours->height, view->width, view->height);
  for (std::size_t i = 0; i < colours->pixels.size(); ++i)
    colours->pixels[i] *= float(photograph.gain[int(i % 3)]);
  ImageF trust;
  if (!photograph.mask.empty()) {
    Result<ImageF> mask = mask_of(photograph);
    if (!mask) return mask.errors();
    trust = *std::move(mask);
  }
  return PreparedPhoto{photograph.name, *view, *std::move(colours), item_buffer(model, *view).depths,
                       std::move(trust)};
}

glm::vec4 depths_around(const PreparedPhoto& photo, glm::dvec2 pixel) {
  const Footprint f = footprint(photo.view.width, photo.view.height, pixel);
  const auto at = [&](int x, int y) {
    return photo.depths[std::size_t(y) * std::size_t(photo.view.width) + std::size_t(x)];
  };
  return {at(f.x0, f.y0), at(f.x1, f.y0), at(f.x0, f.y1), at(f.x1, f.y1)};
}

float sampled(const ImageF& image, glm::dvec2 pixel, int channel) {
  const Footprint f = footprint(image.width, image.height, pixel);
  return glm::mix(glm::mix(image.at(f.x0, f.y0)[channel], image.at(f.x1, f.y0)[channel], f.u),
                  glm::mix(image.at(f.x0, f.y1)[channel], image.at(f.x1, f.y1)[channel], f.u), f.v);
}

glm::vec3 sampled_rgb(const ImageF& image, glm::dvec2 pixel) {
  const Footprint f = footprint(image.width, image.height, pixel);
  const auto at = [&](int x, int y) {
    const float* p = image.at(x, y);
    return glm::vec3(p[0], p[1], p[2]);
  };
  return glm::mix(glm::mix(at(f.x0, f.y0), at(f.x1, f.y0), f.u),
                  glm::mix(at(f.x0, f.y1), at(f.x1, f.y1), f.u), f.v);
}

}  // namespace parvis::facades

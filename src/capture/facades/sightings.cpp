#include "capture/facades/sightings.h"

#include <algorithm>

#include "base/colour.h"
#include "base/parallel.h"
#include "capture/facades/blend.h"

namespace parvis::facades {
namespace {

ImageF encoded(const ImageF& linear) {
  ImageF srgb = linear;
  for (float& value : srgb.pixels) value = srgb_from_linear(std::max(value, 0.0f));
  return srgb;
}

/// Mean over (2 radius + 1)^2 pixels.
ImageF blurred(const ImageF& image, int radius) {
  ImageF across(image.width, image.height, image.channels), down = across;
  parallel_for(std::size_t(image.height), [&](std::size_t row) {
    const int y = int(row);
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < image.channels; ++c) {
        float sum = 0.0f;
        for (int d = -radius; d <= radius; ++d) sum += image.at(std::clamp(x + d, 0, image.width - 1), y)[c];
        across.at(x, y)[c] = sum / float(2 * radius + 1);
      }
  });
  parallel_for(std::size_t(image.height), [&](std::size_t row) {
    const int y = int(row);
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < image.channels; ++c) {
        float sum = 0.0f;
        for (int d = -radius; d <= radius; ++d)
          sum += across.at(x, std::clamp(y + d, 0, image.height - 1))[c];
        down.at(x, y)[c] = sum / float(2 * radius + 1);
      }
  });
  return down;
}

}  // namespace

std::vector<ImageF> blurred_srgb(std::span<const PreparedPhoto> photos) {
  std::vector<ImageF> images;
  for (const PreparedPhoto& photo : photos) images.push_back(blurred(encoded(photo.colours), 2));
  return images;
}

Sightings sightings(std::span<const PreparedPhoto> photos, std::span<const ImageF> srgb, glm::dvec3 point) {
  Sightings found;
  for (std::uint32_t i = 0; i < photos.size(); ++i) {
    const View& view = photos[i].view;
    const glm::dvec3 p = view.to_camera(point);
    if (p.z <= 0.0) continue;
    const glm::dvec2 pixel = view.to_pixel(p);
    if (pixel.x < 1.0 || pixel.y < 1.0 || pixel.x > view.width - 1.0 || pixel.y > view.height - 1.0) continue;
    const std::size_t index = std::size_t(pixel.y) * std::size_t(view.width) + std::size_t(pixel.x);
    if (not_hidden(float(p.z), photos[i].depths[index], depth_tolerance) < 0.5f) continue;
    if (!photos[i].trust.empty() && photos[i].trust.pixels[index] < 0.5f) continue;  // masked
    found.push_back({i, sampled_rgb(srgb[i], pixel)});
  }
  return found;
}

}  // namespace parvis::facades

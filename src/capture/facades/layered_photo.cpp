#include "capture/facades/layered_photo.h"

#include <algorithm>
#include <span>

#include "base/colour.h"
#include "base/parallel.h"
#include "capture/facades/blend.h"

namespace parvis::facades {
namespace {

/// A bilinear lookup in the atlas: linear colour, alpha, and how much of it the photograph saw.
struct Texel {
  glm::vec3 colour{0.0f};
  float alpha = 0.0f, seen = 0.0f;
};

Texel looked_up(const LayeredPhoto& photo, const Balance& balance, std::uint32_t layer, glm::dvec2 pixel) {
  const PixelBox& box = photo.boxes[layer];
  const glm::dvec2 at = pixel - glm::dvec2(box.x, box.y) + glm::dvec2(photo.atlas.offsets[layer]) - 0.5;
  const glm::ivec2 low(glm::floor(at));
  const glm::vec2 f(at - glm::dvec2(low));
  Texel sum;
  for (int k = 0; k < 4; ++k) {
    const int x = std::clamp(low.x + (k & 1), 0, photo.atlas.colours.width - 1);
    const int y = std::clamp(low.y + (k >> 1), 0, photo.atlas.colours.height - 1);
    const float weight = (k & 1 ? f.x : 1.0f - f.x) * (k >> 1 ? f.y : 1.0f - f.y);
    const std::uint8_t* p = photo.atlas.colours.at(x, y);
    for (int c = 0; c < 3; ++c) {
      const double srgb =
          balance.scale[std::size_t(c)] * double(p[c]) / 255.0 + balance.offset[std::size_t(c)];
      sum.colour[c] += weight * linear_from_srgb(float(std::clamp(srgb, 0.0, 1.0)));
    }
    sum.alpha += weight * float(p[3]) / 255.0f;
    sum.seen += weight * float(*photo.atlas.seen.at(x, y)) / 255.0f;
  }
  return sum;
}

/// The layer's pixel behind a point of a triangle; false where the photograph has none.
bool find_pixel(const LayeredPhoto& photo, std::uint32_t triangle, glm::dvec3 point, glm::dvec3& in_camera,
                glm::dvec2& pixel, std::uint32_t& layer) {
  layer = photo.layer_of_triangle[triangle];
  if (layer == no_item) return false;
  in_camera = photo.view.to_camera(point);
  if (in_camera.z <= 0.0) return false;
  pixel = photo.view.to_pixel(in_camera);
  const PixelBox& box = photo.boxes[layer];
  return pixel.x >= box.x - 1.0 && pixel.y >= box.y - 1.0 && pixel.x <= box.x + box.width + 1.0 &&
         pixel.y <= box.y + box.height + 1.0;
}

template <class Colour>
ImageF drawn(const LayerModel& model, const View& view, Colour colour_of) {
  const ItemBuffer seen = item_buffer(model, view);
  ImageF picture(view.width, view.height, 4);
  parallel_for(std::size_t(view.height), [&](std::size_t row) {
    const int y = int(row);
    for (int x = 0; x < view.width; ++x) {
      const std::uint32_t triangle = seen.triangles[seen.index(x, y)];
      if (triangle == no_triangle_seen) continue;
      const double depth = seen.depths[seen.index(x, y)];
      const glm::vec4 colour = colour_of(triangle, view.to_world({x + 0.5, y + 0.5}, depth), depth);
      for (int c = 0; c < 4; ++c) picture.at(x, y)[c] = colour[c];
    }
  });
  return picture;
}

}  // namespace

LayeredPhoto layered_photo(const std::string& name, const LayersOfModel& layers, const LayerPixels& pixels) {
  LayeredPhoto photo{name, layers.view, {}, {}, layer_atlas(layers.layered, pixels), {}};
  for (const std::uint32_t item : item_of_triangle(layers.model, layers.visibility.items))
    photo.layer_of_triangle.push_back(item == no_item ? no_item : layers.layered.layer_of_item[item]);
  for (const ImageLayer& layer : layers.layered.layers) photo.boxes.push_back(layer.box);
  return photo;
}

void distrust(const ImageF& trust, LayeredView& layered) {
  for (std::size_t l = 0; l < layered.layers.size(); ++l) {
    const PixelBox& box = layered.layers[l].box;
    for (int y = 0; y < box.height; ++y)
      for (int x = 0; x < box.width; ++x)
        if (*trust.at(x + box.x, y + box.y) < 0.5f) layered.masks[l].at(x, y)[1] = 0;
  }
}

std::vector<Opinion> opinions(std::span<const LayeredPhoto> photos, const BlendSettings& settings,
                              std::uint32_t triangle, glm::dvec3 point, glm::dvec3 eye, double pixel_size) {
  std::vector<Opinion> found;
  for (std::uint32_t i = 0; i < photos.size(); ++i) {
    const LayeredPhoto& photo = photos[i];
    glm::dvec3 in_camera;
    glm::dvec2 pixel;
    std::uint32_t layer = no_item;
    if (!find_pixel(photo, triangle, point, in_camera, pixel, layer)) continue;
    const glm::vec2 size(float(photo.view.width), float(photo.view.height));
    const Texel texel = looked_up(photo, photo.balance, layer, pixel);
    // A filled pixel mixed into the footprint of a seen one: it is as uncertain as the occluder's rim.
    const float seen = glm::smoothstep(0.75f, 1.0f, texel.seen);
    const float confidence = border_feather(glm::vec2(pixel), size, settings.feather * size.x) * texel.alpha *
                             glm::mix(filled_confidence, 1.0f, seen);
    if (confidence <= 0.0f) continue;
    found.push_back(
        {i,
         view_penalty(glm::vec3(glm::normalize(eye - point)),
                      glm::vec3(glm::normalize(photo.view.centre - point)),
                      float(in_camera.z / photo.view.fx / pixel_size), settings.resolution_weight),
         confidence, texel.colour});
  }
  // What was seen comes before what was filled.
  std::ranges::sort(found, {}, [](const Opinion& o) {
    return std::pair(o.confidence <= 2.0f * filled_confidence, o.penalty);
  });
  return found;
}

ImageF novel_view(const LayerModel& model, const View& view, std::span<const LayeredPhoto> photos,
                  const BlendSettings& settings) {
  return drawn(model, view, [&](std::uint32_t triangle, glm::dvec3 point, double depth) {
    return blended(opinions(photos, settings, triangle, point, view.centre, depth / view.fx), settings.best,
                   settings.max_contradiction);
  });
}

ImageF own_view(const LayerModel& model, const LayeredPhoto& photo) {
  return drawn(model, photo.view, [&](std::uint32_t triangle, glm::dvec3 point, double) {
    glm::dvec3 in_camera;
    glm::dvec2 pixel;
    std::uint32_t layer = no_item;
    if (!find_pixel(photo, triangle, point, in_camera, pixel, layer)) return glm::vec4(0.0f);
    const Texel texel = looked_up(photo, Balance{}, layer, pixel);
    return glm::vec4(texel.colour, texel.alpha);
  });
}

}  // namespace parvis::facades

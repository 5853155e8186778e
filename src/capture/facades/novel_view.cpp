#include "capture/facades/novel_view.h"

#include <algorithm>
#include <span>

#include "base/parallel.h"
#include "capture/facades/blend.h"

namespace parvis::facades {

std::vector<Opinion> opinions(std::span<const PreparedPhoto> photos, const BlendSettings& settings,
                              glm::dvec3 point, glm::dvec3 eye, double pixel_size) {
  std::vector<Opinion> found;
  for (std::uint32_t i = 0; i < photos.size(); ++i) {
    const PreparedPhoto& photo = photos[i];
    const glm::dvec3 p = photo.view.to_camera(point);
    if (p.z <= 0.0) continue;
    const glm::dvec2 pixel = photo.view.to_pixel(p);
    const glm::vec2 size(float(photo.view.width), float(photo.view.height));
    float confidence = border_feather(glm::vec2(pixel), size, settings.feather * size.x);
    if (confidence <= 0.0f) continue;
    const int x = std::clamp(int(pixel.x), 0, photo.view.width - 1),
              y = std::clamp(int(pixel.y), 0, photo.view.height - 1);
    const std::size_t index = std::size_t(y) * std::size_t(photo.view.width) + std::size_t(x);
    confidence *= not_hidden(float(p.z), photo.depths[index], settings.depth_tolerance);
    confidence *= not_mixed(float(p.z), depths_around(photo, pixel), settings.depth_tolerance);
    if (settings.uses_trust && !photo.trust.empty()) confidence *= sampled(photo.trust, pixel, 0);
    if (confidence <= 0.0f) continue;
    const double ratio = p.z / photo.view.fx / pixel_size;
    found.push_back({i,
                     view_penalty(glm::vec3(glm::normalize(eye - point)),
                                  glm::vec3(glm::normalize(photo.view.centre - point)), float(ratio),
                                  settings.resolution_weight),
                     confidence, sampled_rgb(photo.colours, pixel)});
  }
  std::ranges::sort(found, {}, &Opinion::penalty);
  return found;
}

glm::vec4 blended(std::span<const Opinion> sorted, int best, float max_contradiction) {
  if (sorted.empty()) return glm::vec4(0.0f);
  const std::size_t count = std::min(sorted.size(), std::size_t(best));
  const float max_penalty = count < sorted.size() ? sorted[count].penalty : MAX_PENALTY;
  glm::vec3 sum(0.0f), sum_perceived(0.0f), sum_squares(0.0f);
  float weights = 0.0f;
  for (std::size_t i = 0; i < count; ++i) {
    // All of the best may tie with the next one, whose penalty then takes all weights away.
    const float weight = sorted[i].confidence * std::max(blend_weight(sorted[i].penalty, max_penalty), 1e-6f);
    const glm::vec3 perceived_colour = perceived(sorted[i].colour);
    sum += weight * sorted[i].colour, weights += weight;
    sum_perceived += weight * perceived_colour, sum_squares += weight * perceived_colour * perceived_colour;
  }
  const bool is_surface = contradiction(sum_squares / weights, sum_perceived / weights) <= max_contradiction;
  return glm::vec4(sum / weights, is_surface ? 1.0f : 0.0f);
}

ImageF novel_view(const LayerModel& model, const View& view, std::span<const PreparedPhoto> photos,
                  const BlendSettings& settings) {
  const ItemBuffer seen = item_buffer(model, view);
  ImageF picture(view.width, view.height, 4);
  parallel_for(std::size_t(view.height), [&](std::size_t row) {
    const int y = int(row);
    for (int x = 0; x < view.width; ++x) {
      if (seen.triangles[seen.index(x, y)] == no_triangle_seen) continue;
      const double depth = seen.depths[seen.index(x, y)];
      const glm::dvec3 point = view.to_world({x + 0.5, y + 0.5}, depth);
      const glm::vec4 colour = blended(opinions(photos, settings, point, view.centre, depth / view.fx),
                                       settings.best, settings.max_contradiction);
      for (int c = 0; c < 4; ++c) picture.at(x, y)[c] = colour[c];
    }
  });
  return picture;
}

}  // namespace parvis::facades

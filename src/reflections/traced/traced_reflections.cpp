#include "reflections/traced/traced_reflections.h"

#include <algorithm>
#include <array>

#include "base/colour.h"
#include "base/parallel.h"
#include "graphics/shading/tone_curve.h"
#include "reflections/methods/bindings.h"
#include "reflections/methods/settings.h"

namespace parvis::traced {
namespace {

constexpr float rough_from = 0.1f;  // roughness: below it one ray stands for the lobe
// That a pixel shares with those alike, where its rough base reflects little.
constexpr int weak_lobe_rays = 48;
constexpr std::size_t pixels_per_task = 64;
constexpr float edge_contrast = 0.05f;  // of displayed light, between neighbours
// Beside the middle of the pixel, in pixels.
constexpr std::array<glm::vec2, 3> edge_samples{glm::vec2(0.35f, 0.1f), glm::vec2(-0.1f, -0.35f),
                                                glm::vec2(-0.3f, 0.3f)};

/// The height of a pixel at one metre from the eye; of an off-axis frustum, too.
float pixel_height_at_1m(const render::View& view) {
  const glm::mat4 rows = glm::transpose(view.clip_from_world);
  const glm::vec3 ahead(rows[3]), upward(rows[1]);
  return 2.0f / glm::length(upward - glm::dot(upward, ahead) * ahead) / float(view.height);
}

}  // namespace

Result<std::unique_ptr<TracedReflections>> TracedReflections::create(const scene::Scene& scene,
                                                                     render::Renderer& renderer) {
  Result<methods::MirrorPicture> picture = methods::MirrorPicture::create(renderer);
  if (!picture) return picture.errors();
  return std::unique_ptr<TracedReflections>(new TracedReflections(scene, *std::move(picture)));
}

void TracedReflections::update_maps(render::Renderer& renderer, const scene::Scene& scene,
                                    const std::vector<methods::VisibleReflector>& reflectors) {
  if (reflectors.empty()) return;
  rays_.update(scene);
  picture_.draw_rays(renderer);
  picture_.read_rays(renderer, reflectors, drawn_);
  gather_pixels();

  const shading::DrawnLight drawn_light = renderer.drawn_light_without_shadows();
  reference::TraceOptions options;
  options.drawn_light = &drawn_light;
  options.mirror_bounces = methods::settings(scene).bounces;
  const render::View& view = renderer.main_view();
  const auto trace = [&](const std::vector<reference::MirrorPixel>& pixels,
                         std::vector<std::optional<reference::MirrorLight>>& light) {
    light.resize(pixels.size());
    reference::trace_mirrors(rays_, scene, renderer.sky(), view.position_in_world, pixel_height_at_1m(view),
                             pixels, options, light);
  };
  trace(pixels_, light_);
  gather_edges(scene.exposure);
  trace(edge_pixels_, edge_light_);
  add_edge_samples(scene.exposure);

  base_.assign(drawn_.directions.size(), glm::vec4(0.0f));
  coat_.assign(drawn_.directions.size(), glm::vec3(0.0f));
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    const auto& light = light_[i];
    if (!light) continue;
    base_[places_[i]] = glm::vec4(light->base, 1.0f);
    coat_[places_[i]] = light->coat;
  }
  smooth_rough_light();
  picture_.put_light(renderer, reflectors, drawn_, smoothed_, coat_);
}

/// Whether the mirror images of two pixels differ by more than an eye overlooks.
bool TracedReflections::differs(std::size_t pixel, std::size_t other, float exposure) const {
  const auto &one = light_[pixel], &two = light_[other];
  if (!one || !two) return false;
  const float share = exposure * std::max(one->sharp_share, two->sharp_share);
  const float a = share * luminance(one->coat), b = share * luminance(two->coat);
  return std::abs(a - b) > edge_contrast * (1.0f + std::max(a, b));
}

/// Finds the pixels that mirror something else than the one beside or above them, and the one beside or above
/// as well: they get more samples.
void TracedReflections::gather_edges(float exposure) {
  is_edge_.assign(pixels_.size(), 0);
  const auto width = std::size_t(drawn_.pixels.z);
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    const std::size_t here = places_[i];
    const bool is_last = here % width + 1 == width;
    for (const std::size_t there : {is_last ? here : here + 1, here + width}) {
      if (there >= pixel_at_.size() || pixel_at_[there] < 0) continue;
      const auto other = std::size_t(pixel_at_[there]);
      if (pixels_[other].object == pixels_[i].object && differs(i, other, exposure))
        is_edge_[i] = is_edge_[other] = 1;
    }
  }
  edges_.clear(), edge_pixels_.clear();
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    if (is_edge_[i] == 0) continue;
    edges_.push_back(i);
    for (const glm::vec2 offset_px : edge_samples) {
      reference::MirrorPixel pixel = pixels_[i];
      pixel.offset_px = offset_px, pixel.base_rays = pixel.weak_base_rays = 0;
      edge_pixels_.push_back(pixel);
    }
  }
}

/// Makes the mirror image of each edge the mean of its samples, as the ray tracer weighs them.
void TracedReflections::add_edge_samples(float exposure) {
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    auto& found = light_[edges_[e]];
    if (!found) continue;
    reference::MirrorLight& light = *found;
    float weights = shading::sample_weight(exposure * light.coat);
    glm::vec3 sum = weights * light.coat;
    for (std::size_t k = 0; k < edge_samples.size(); ++k) {
      const std::optional<reference::MirrorLight>& sample = edge_light_[edge_samples.size() * e + k];
      if (!sample) continue;
      const float weight = shading::sample_weight(exposure * sample->coat);
      sum += weight * sample->coat, weights += weight;
    }
    const bool is_base = light.base == light.coat;
    light.coat = sum / weights;
    if (is_base) light.base = light.coat;
  }
}

/// Calls `visit` with the place of each pixel of the tile about one that shows the same object with the same
/// roughness and mirrors nearly the same direction, itself included.
template <typename Visit>
void TracedReflections::for_each_alike(std::size_t here, int tile_px, const Visit& visit) const {
  const int radius = tile_px / 2;
  constexpr float turn_per_pixel = 0.02f;  // of the octahedral direction
  constexpr float alike_roughness = 0.05f;
  const int width = drawn_.pixels.z, height = drawn_.pixels.w;
  const int x = int(here % std::size_t(width)), y = int(here / std::size_t(width));
  for (int v = std::max(y - radius, 0); v <= std::min(y + radius, height - 1); ++v)
    for (int u = std::max(x - radius, 0); u <= std::min(x + radius, width - 1); ++u) {
      const std::size_t there = std::size_t(v) * std::size_t(width) + std::size_t(u);
      const glm::vec2 turn(drawn_.directions[there] - drawn_.directions[here]);
      if (drawn_.directions[there].w == drawn_.directions[here].w &&
          std::abs(drawn_.starts[there].w - drawn_.starts[here].w) < alike_roughness &&
          glm::length(turn) < float(radius) * turn_per_pixel)
        visit(there);
    }
}

/// Averages what rough base layers mirror over neighbours of the same object that mirror nearly the same
/// direction: the few rays of a pixel leave noise, and a wide lobe hardly changes between them.
void TracedReflections::smooth_rough_light() {
  smoothed_ = base_;
  parallel_for(
      places_.size(),
      [&](std::size_t i) {
        const std::size_t here = places_[i];
        if (base_[here].w == 0.0f || drawn_.starts[here].w <= rough_from) return;
        glm::vec4 sum(0.0f);
        const bool is_weak = light_[i]->has_weak_base;
        for_each_alike(here, is_weak ? reference::weak_mirror_tile_px : reference::mirror_tile_px,
                       [&](std::size_t there) { sum += base_[there]; });
        smoothed_[here] = sum / sum.w;
      },
      pixels_per_task);
}

/// The pixels that show a mirror-like surface, row by row: rays of neighbours run alike.
void TracedReflections::gather_pixels() {
  places_.clear(), pixels_.clear();
  pixel_at_.assign(drawn_.directions.size(), -1);
  for (std::size_t i = 0; i < drawn_.directions.size(); ++i) {
    const int object = int(drawn_.directions[i].w) - 1;
    if (object < 0) continue;
    const int x = drawn_.pixels.x + int(i % std::size_t(drawn_.pixels.z));
    const int y = drawn_.pixels.y + int(i / std::size_t(drawn_.pixels.z));
    pixel_at_[i] = std::int32_t(pixels_.size());
    places_.push_back(i);
    pixels_.push_back({x, y, object, glm::vec3(drawn_.starts[i])});
  }
  parallel_for(
      places_.size(),
      [&](std::size_t i) {
        if (drawn_.starts[places_[i]].w <= rough_from) return;
        int alike = 0;
        for_each_alike(places_[i], reference::weak_mirror_tile_px, [&](std::size_t) { ++alike; });
        pixels_[i].weak_base_rays = std::clamp(weak_lobe_rays / alike, 1, reference::lobe_samples);
      },
      pixels_per_task);
}

void TracedReflections::bind(const gl::Program& program, int) {
  picture_.bind(program, methods::first_method_unit);
}

}  // namespace parvis::traced

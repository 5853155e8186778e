#include "reflections/traced/traced_reflections.h"

#include <algorithm>

#include "base/parallel.h"
#include "reflections/methods/bindings.h"
#include "reflections/methods/settings.h"

namespace parvis::traced {
namespace {

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
  light_.resize(pixels_.size());
  reference::trace_mirrors(rays_, scene, renderer.sky(), view.position_in_world, pixel_height_at_1m(view),
                           pixels_, options, light_);

  base_.assign(drawn_.directions.size(), glm::vec4(0.0f));
  coat_.assign(drawn_.directions.size(), glm::vec3(0.0f));
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    if (!light_[i]) continue;
    base_[places_[i]] = glm::vec4(light_[i]->base, 1.0f);
    coat_[places_[i]] = light_[i]->coat;
  }
  smooth_rough_light();
  picture_.put_light(renderer, reflectors, drawn_, smoothed_, coat_);
}

/// Averages what rough base layers mirror over neighbours of the same object that mirror nearly the same
/// direction: the few rays of a pixel leave noise, and a wide lobe hardly changes between them.
void TracedReflections::smooth_rough_light() {
  constexpr int radius = 2;
  constexpr float rough_from = 0.1f;       // below it one ray stands for the lobe
  constexpr float turn_per_pixel = 0.02f;  // of the octahedral direction
  const int width = drawn_.pixels.z, height = drawn_.pixels.w;
  smoothed_ = base_;
  parallel_for(std::size_t(height), [&](std::size_t row) {
    const int y = int(row);
    for (int x = 0; x < width; ++x) {
      const std::size_t here = row * std::size_t(width) + std::size_t(x);
      if (base_[here].w == 0.0f || drawn_.starts[here].w <= rough_from) continue;
      glm::vec4 sum(0.0f);
      for (int v = std::max(y - radius, 0); v <= std::min(y + radius, height - 1); ++v)
        for (int u = std::max(x - radius, 0); u <= std::min(x + radius, width - 1); ++u) {
          const std::size_t there = std::size_t(v) * std::size_t(width) + std::size_t(u);
          const glm::vec2 turn(drawn_.directions[there] - drawn_.directions[here]);
          if (drawn_.directions[there].w == drawn_.directions[here].w &&
              glm::length(turn) < float(radius) * turn_per_pixel)
            sum += base_[there];  // alpha counts them
        }
      smoothed_[here] = sum / sum.w;
    }
  });
}

/// The pixels that show a mirror-like surface, row by row: rays of neighbours run alike.
void TracedReflections::gather_pixels() {
  places_.clear(), pixels_.clear();
  for (std::size_t i = 0; i < drawn_.directions.size(); ++i) {
    const int object = int(drawn_.directions[i].w) - 1;
    if (object < 0) continue;
    const int x = drawn_.pixels.x + int(i % std::size_t(drawn_.pixels.z));
    const int y = drawn_.pixels.y + int(i / std::size_t(drawn_.pixels.z));
    places_.push_back(i);
    pixels_.push_back({x, y, object, glm::vec3(drawn_.starts[i])});
  }
}

void TracedReflections::bind(const gl::Program& program, int) {
  picture_.bind(program, methods::first_method_unit);
}

}  // namespace parvis::traced

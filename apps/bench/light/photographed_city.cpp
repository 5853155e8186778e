#include "bench/light/photographed_city.h"

#include "base/reduction.h"
#include "graphics/reference/metrics.h"
#include "graphics/reference/photograph.h"
#include "graphics/render/frame_views.h"
#include "graphics/shading/tone_curve.h"

namespace parvis::bench {
namespace {

constexpr int supersample = 4;  // of the renderer's pictures, across and down

}  // namespace

Result<ImageF> drawn_as_photographed(render::Renderer& renderer, const scene::Scene& scene,
                                     const Camera& camera) {
  if (Status status = render::draw_frame(
          renderer, scene, {camera, supersample * photograph_size.x, supersample * photograph_size.y});
      !status)
    return status.errors();
  return reduced(renderer.read_radiance(), supersample);
}

Result<ImageF> photograph_of(const scene::Scene& scene, const render::Renderer& renderer,
                             const Camera& camera, int samples_per_pixel, std::uint64_t seed) {
  const reference::RayScene rays(scene);
  reference::PhotographOptions options;
  options.samples_per_pixel = samples_per_pixel, options.seed = seed;
  auto photograph = reference::take_photograph(rays, scene, renderer.sky(), camera, photograph_size.x,
                                               photograph_size.y, options);
  if (!photograph) return photograph.errors();
  return std::move(photograph->radiance);
}

Result<double> flip_to(const Image8& photograph, const ImageF& radiance, float exposure) {
  const auto difference = reference::compare(shading::tone_mapped_picture(radiance, exposure), photograph);
  if (!difference) return difference.errors();
  return difference->flip;
}

}  // namespace parvis::bench

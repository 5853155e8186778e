// Small path-traced photographs of a city, and pictures of the renderer that are fit to be compared with
// them.
#pragma once

#include <cstdint>

#include "base/camera.h"
#include "base/image.h"
#include "graphics/render/renderer.h"

namespace parvis::bench {

/// Pixels of all of these pictures, across and down.
inline constexpr glm::ivec2 photograph_size{192, 108};

/// Radiance by the renderer whose pixels are the mean of many samples, as those of a photograph are: what is
/// compared is light, not edges. Fails as render::draw_frame.
Result<ImageF> drawn_as_photographed(render::Renderer& renderer, const scene::Scene& scene,
                                     const Camera& camera);

/// Radiance of the same view by the path tracer, under the renderer's present sky. Another seed gives other
/// noise.
Result<ImageF> photograph_of(const scene::Scene& scene, const render::Renderer& renderer,
                             const Camera& camera, int samples_per_pixel, std::uint64_t seed = 1);

/// FLIP between a picture at an exposure and a tone-mapped photograph.
Result<double> flip_to(const Image8& photograph, const ImageF& radiance, float exposure);

}  // namespace parvis::bench

// Exact reflections: for each pixel of the main view that shows a mirror-like surface, mirror rays through
// the whole scene on the CPU, shaded by the functions that the renderer and the ray tracer share, with exact
// shadow rays. What is traced is what `reference` traces at one sample per pixel; the rest of the picture is
// drawn.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "graphics/reference/ray_scene.h"
#include "graphics/reference/tracer.h"
#include "reflections/methods/mirror_picture.h"
#include "reflections/methods/reflections.h"

namespace parvis::traced {

/// The method `traced`. More than one bounce is traced where the scene asks for it
/// (methods::Settings::bounces).
class TracedReflections final : public methods::Reflections {
 public:
  /// Builds the hierarchies of all visible meshes, which takes some seconds in a city. Fails only if a shader
  /// does.
  static Result<std::unique_ptr<TracedReflections>> create(const scene::Scene& scene,
                                                           render::Renderer& renderer);

  render::SurfaceSource source() const override {
    return {.fragment = "reflections/methods/mirror_picture.frag"};
  }
  void bind(const gl::Program& program, int object) override;

 private:
  TracedReflections(const scene::Scene& scene, methods::MirrorPicture picture)
      : picture_(std::move(picture)), rays_(scene) {}
  void update_maps(render::Renderer& renderer, const scene::Scene& scene,
                   const std::vector<methods::VisibleReflector>& reflectors) override;
  void gather_pixels();
  bool differs(std::size_t pixel, std::size_t other, float exposure) const;
  void gather_edges(float exposure);
  void add_edge_samples(float exposure);
  template <typename Visit>
  void for_each_alike(std::size_t here, int tile_px, const Visit& visit) const;
  void smooth_rough_light();

  methods::MirrorPicture picture_;
  reference::RayScene rays_;
  // Of the last frame, kept for their memory.
  methods::MirrorRays drawn_;
  std::vector<std::size_t> places_;  ///< of each traced pixel in `drawn_`
  std::vector<reference::MirrorPixel> pixels_;
  std::vector<std::int32_t> pixel_at_;  ///< of each place in `drawn_`; -1: none
  std::vector<std::optional<reference::MirrorLight>> light_;
  std::vector<std::uint8_t> is_edge_;                ///< of each pixel
  std::vector<std::size_t> edges_;                   ///< pixels that mirror an edge
  std::vector<reference::MirrorPixel> edge_pixels_;  ///< their further samples
  std::vector<std::optional<reference::MirrorLight>> edge_light_;
  std::vector<glm::vec4> base_, smoothed_;
  std::vector<glm::vec3> coat_;
};

}  // namespace parvis::traced

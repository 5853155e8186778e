// Reflections as peers make them: each method draws cube maps at other places and times. The scene's
// attribute reflection(method=...) names one.
#pragma once

#include <memory>
#include <vector>

#include "probes/cube_map.h"
#include "render/renderer.h"
#include "scene/scene.h"

namespace parvis::probes {

/// What a method knows of a frame.
struct Reflector {
  int object;        ///< index in the scene
  glm::vec3 centre;  ///< of its bounds, in the world
  float size_px;     ///< diameter on the screen
};

/// One method of reflection. Made for a renderer and a scene, both of which outlive it.
class Reflections : public render::ReflectionSource {
 public:
  /// Makes the method that the scene names and hands it to the renderer.
  static Result<std::unique_ptr<Reflections>> create(const scene::Scene& scene, render::Renderer& renderer);

  /// Draws what maps the method wants for the reflectors that the prepared main view shows.
  void update(render::Renderer& renderer, const scene::Scene& scene, const Camera& camera);

  /// Faces drawn by the last update.
  int faces_drawn() const { return faces_drawn_; }
  std::string fragment_shader() const override { return "probes/cube_map.frag"; }

 protected:
  /// `reflectors` are ordered from the largest on the screen to the smallest.
  virtual void update_maps(render::Renderer& renderer, const std::vector<Reflector>& reflectors) = 0;
  void draw_whole(CubeMap& map, render::Renderer& renderer, glm::vec3 centre, int excluded);
  static void bind_map(const gl::Program& program, const CubeMap& map);

  /// The fixed surroundings are others now.
  virtual void forget_surroundings() {}

  int faces_drawn_ = 0;

 private:
  int fixed_changes_ = 0;  ///< of the renderer, that the maps know of
  std::vector<Reflector> reflectors_;
};

/// Reflectors that the main view shows, the largest first.
void find_reflectors(const render::Renderer& renderer, const scene::Scene& scene, const Camera& camera,
                     std::vector<Reflector>& reflectors);

}  // namespace parvis::probes

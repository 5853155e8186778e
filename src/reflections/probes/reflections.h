// Reflections as peers make them: each method draws cube maps at other places and times. The scene's
// attribute reflection(method=...) names one.
#pragma once

#include <memory>

#include "graphics/render/cube_map.h"
#include "graphics/render/reflections.h"
#include "scene/scene.h"

namespace parvis::probes {

/// The method that the scene names, one of this room's.
std::unique_ptr<render::Reflections> make_reflections(const scene::Scene& scene);

/// What curved mirrors show where virtual objects show nothing: a cube map for each, drawn whole when it is
/// first seen and then a face a frame. For a method that lies over it.
std::unique_ptr<render::Reflections> make_surroundings(const scene::Scene& scene);

/// A method that looks cube maps up.
class CubeMapReflections : public render::Reflections {
 public:
  std::string fragment_shader() const override { return "reflections/probes/cube_map.frag"; }

 protected:
  void draw_whole(render::CubeMap& map, render::Renderer& renderer, const render::Reflector& reflector);
  static void bind_map(const gl::Program& program, const render::CubeMap& map);
};

}  // namespace parvis::probes

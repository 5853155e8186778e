// The surface shader in the variants that a scene's materials need: a texture that a material lacks is not
// looked up.
#pragma once

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "graphics/gl/program.h"
#include "graphics/render/drawable_shader.h"
#include "graphics/render/gpu_scene.h"

namespace parvis::render {

/// What a surface shader is compiled from. Rooms above contribute files, defines and expressions of their
/// own.
struct SurfaceSource {
  /// Includes render/surface_body.glsl and defines `look_along` and `reflected_radiance`.
  std::string fragment = "graphics/render/surface.frag";
  std::string vertex = "graphics/render/surface.vert";
  gl::Defines defines = {};
  gl::Defines mesh_defines = {};  ///< of the scene's meshes alone: rooms that draw by themselves lack them
  std::vector<std::string> includes = {};  ///< before `fragment`: files that define what the expressions call
  /// GLSL over `radiance`, which `reflected_radiance` has found for a layer of that `roughness`: what
  /// overlays make of it.
  std::string reflection = "radiance";
  /// GLSL over `radiance`, the sky straight through solid glass: what overlays show through it.
  std::string transmission = "radiance";
};

class SurfacePrograms {
 public:
  /// Links the shaders for each combination of features among `materials`, for views of many samples per
  /// pixel and of one.
  static Result<SurfacePrograms> create(const SurfaceSource& source,
                                        const std::vector<GpuMaterial>& materials);

  /// For a material that was among them.
  const gl::Program& of(const GpuMaterial& material, bool is_multisampled) const {
    const bool discards = (material.features & surface_has_holes) && !is_multisampled;
    return (discards ? one_sample_ : programs_)[material.features];
  }

  /// The same shaders for a surface that a room draws by itself, for views of many samples per pixel; linked
  /// when it is asked for first. Null, with a message on standard error, where it does not link.
  const gl::Program* of(const DrawableShader& shader);

 private:
  SurfaceSource source_;
  std::map<std::pair<std::string, std::string>, gl::Program> of_rooms_;  ///< by the room's two files
  using Variants = std::array<gl::Program, surface_feature_combinations>;
  Variants programs_;
  Variants one_sample_;  ///< of materials with holes, whose other programs need coverage by alpha
};

}  // namespace parvis::render

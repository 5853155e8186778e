// Permutations of the surface shader for a scene's materials: a texture that a material lacks is not sampled.
#pragma once

#include <map>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "graphics/gl/program.h"
#include "graphics/render/drawable_shader.h"
#include "graphics/render/gpu_scene.h"

namespace parvis::render {

/// Sources of a surface shader. Rooms above contribute files, defines and expressions.
struct SurfaceSource {
  /// Includes render/surface_body.glsl and defines `look_along` and `reflected_radiance`.
  std::string fragment = "graphics/render/surface.frag";
  std::string vertex = "graphics/render/surface.vert";
  gl::Defines defines = {};
  gl::Defines mesh_defines = {};           ///< for the scene's meshes only, not for surfaces that rooms draw
  std::vector<std::string> includes = {};  ///< before `fragment`: files that define what the expressions call
  /// GLSL expression over `radiance`, the result of `reflected_radiance` for a layer of that `roughness`: how
  /// overlays modify it.
  std::string reflection = "radiance";
  /// GLSL expression over `radiance`, the sky straight through solid glass: what overlays show instead.
  std::string transmission = "radiance";
};

/// Linked surface programs by material features, and those of surfaces that rooms draw themselves.
class SurfacePrograms {
 public:
  /// Links a program for each combination of features among `materials`; for materials with holes two: for
  /// multisampled views and for views with one sample per pixel. Others are linked when they are asked for.
  static Result<SurfacePrograms> create(const SurfaceSource& source,
                                        const std::vector<GpuMaterial>& materials);

  /// The program of a material.
  const gl::Program& of(const GpuMaterial& material, bool is_multisampled) const {
    const bool discards = (material.features & surface_has_holes) && !is_multisampled;
    const Variants& variants = discards ? one_sample_ : programs_;
    const auto known = variants.find(material.features);
    return known != variants.end() ? known->second : linked(material.features, discards);
  }

  /// The program of a surface that a room draws itself, for multisampled views; linked on first use. Null,
  /// with a message on standard error, if it does not link.
  const gl::Program* of(const DrawableShader& shader);

  /// Sets a uniform of all programs of the scene's materials, as gl::Program::set.
  void set(const char* uniform, int value);

 private:
  const gl::Program& linked(std::uint16_t features, bool discards) const;
  Status link_of(std::uint16_t features, bool discards) const;

  SurfaceSource source_;
  std::map<std::pair<std::string, std::string>, gl::Program> of_rooms_;  ///< by the room's two files
  using Variants = std::unordered_map<std::uint16_t, gl::Program>;
  std::vector<std::pair<std::string, int>> uniforms_;  ///< that were set
  mutable Variants programs_;
  mutable Variants one_sample_;  ///< of materials with holes, whose other programs need coverage by alpha
};

}  // namespace parvis::render

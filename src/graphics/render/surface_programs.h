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

class SurfacePrograms {
 public:
  /// Links both shaders for each combination of features among `materials`, for views of many samples a pixel
  /// and of one. `defines` are those of all.
  static Result<SurfacePrograms> create(const std::string& fragment_path,
                                        const std::vector<GpuMaterial>& materials,
                                        const std::string& vertex_path = "graphics/render/surface.vert",
                                        const gl::Defines& defines = {});

  /// For a material that was among them.
  const gl::Program& of(const GpuMaterial& material, bool is_multisampled) const {
    const bool discards = (material.features & surface_has_holes) && !is_multisampled;
    return (discards ? one_sample_ : programs_)[material.features];
  }

  /// The same shaders for a surface that a room draws by itself, for views of many samples per pixel; linked
  /// when it is asked for first. Null, with a message on standard error, where it does not link.
  const gl::Program* of(const DrawableShader& shader);

 private:
  std::string vertex_path_, fragment_path_;
  gl::Defines defines_;
  std::map<std::pair<std::string, std::string>, gl::Program> of_rooms_;  ///< by the room's two files
  using Variants = std::array<gl::Program, surface_feature_combinations>;
  Variants programs_;
  Variants one_sample_;  ///< of materials with holes, whose other programs need coverage by alpha
};

}  // namespace parvis::render

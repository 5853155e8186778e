// A reflector's maps and shapes on the GPU.
#pragma once

#include "graphics/gl/objects.h"
#include "graphics/gl/program.h"
#include "reflections/reflector_maps/patch_bounds.h"
#include "reflections/reflector_maps/reflector_map.h"

namespace parvis::reflector_maps {

class GpuReflector {
 public:
  explicit GpuReflector(const Reflector& reflector);

  struct Patch {
    gl::Texture texels;
    PatchBounds bounds;
    MapWindow window;
    bool is_convex, is_whole_body, shows_once;
    std::array<glm::vec3, layer_start_count> start_positions, start_normals, start_axes, start_curvatures;
    GLsizei first_index, index_count;  ///< of its own triangles
  };
  const std::vector<Patch>& patches() const { return patches_; }
  /// Hands a patch's map to a program that has patch_uniforms.glsl, its texture to `unit`: as the first
  /// mirror (0) there or the second. `layer`: of what may show a vertex several times.
  static void bind(const gl::Program& program, const Patch& patch, const glm::mat4& world_from_reflector,
                   GLuint unit, int layer = -1, int mirror = 0);
  /// Draws a patch's triangles; attribute 0 is the position.
  void draw(const Patch& patch) const;

 private:
  std::vector<Patch> patches_;
  gl::Buffer vertices_, indices_;
  gl::VertexArray vertex_array_;
};

}  // namespace parvis::reflector_maps

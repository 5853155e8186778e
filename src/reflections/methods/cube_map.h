// A cube map of the surroundings of a point: six views by the renderer, and mipmaps for glossy reflections.
#pragma once

#include "graphics/gl/objects.h"
#include "graphics/render/renderer.h"
#include "reflections/methods/lobe_filter.h"

namespace parvis::methods {

inline constexpr float cube_near_m = 0.02f, cube_far_m = 4000.0f;
inline constexpr int cube_faces = 6;

/// Colour texture with mipmaps, and a depth buffer shared by the faces.
class CubeMap {
 public:
  /// `resolution`: texels per side of a face.
  explicit CubeMap(int resolution);

  /// Renders one face (0..5 in OpenGL's order) from `centre`, without the object `excluded` (-1: none);
  /// `shown`: see render::View.
  void draw_face(render::Renderer& renderer, int face, glm::vec3 centre, int excluded,
                 render::Subjects subjects = render::Subjects::all,
                 const std::vector<std::uint8_t>* shown = nullptr);
  /// Computes the mipmaps; call it after faces have changed.
  void update_levels();
  /// The same, blurred for the lobes of rough mirrors: for cube_map_lookup.glsl.
  void update_levels(const LobeFilter& filter);

  /// Replaces `points` by the world positions visible in the face drawn last, without the sky. Reads back
  /// from the GPU: for baking, not for frames.
  void read_points(int face, glm::vec3 centre, std::vector<glm::vec3>& points) const;

  int resolution() const { return resolution_; }      ///< texels per side of a face
  GLuint texture() const { return texture_.name(); }  ///< linear radiance; OpenGL's name
  /// Depth of the face drawn last, reversed: 1 at cube_near_m, 0 at cube_far_m.
  GLuint depth_texture() const { return depth_.name(); }

 private:
  int resolution_;
  gl::Texture texture_, depth_;
  gl::Framebuffer framebuffer_;
};

/// The view of one face (0..5 in OpenGL's order) from `centre`, in the world.
render::View face_view(int face, glm::vec3 centre, int resolution, GLuint framebuffer);

}  // namespace parvis::methods

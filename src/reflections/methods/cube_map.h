// A cube map of the surroundings of a point: six views drawn by the renderer, and mipmaps for glossy
// reflections.
#pragma once

#include "graphics/gl/objects.h"
#include "graphics/render/renderer.h"

namespace parvis::methods {

inline constexpr float cube_near_m = 0.02f, cube_far_m = 4000.0f;

class CubeMap {
 public:
  explicit CubeMap(int resolution);

  /// Draws one face (0..5 in OpenGL's order), seen from `centre`, without the object `excluded` (-1: all);
  /// `shown`: as in render::View.
  void draw_face(render::Renderer& renderer, int face, glm::vec3 centre, int excluded,
                 render::Subjects subjects = render::Subjects::all,
                 const std::vector<std::uint8_t>* shown = nullptr);
  /// To be called when faces have changed.
  void update_levels();

  /// The points in the world that the face drawn last shows, sky left out. Reads back: for baking, not for
  /// frames.
  void read_points(int face, glm::vec3 centre, std::vector<glm::vec3>& points) const;

  int resolution() const { return resolution_; }
  GLuint texture() const { return texture_.name(); }
  /// Of the face drawn last; reversed: 1 at cube_near_m, 0 at cube_far_m.
  GLuint depth_texture() const { return depth_.name(); }

 private:
  int resolution_;
  gl::Texture texture_, depth_;
  gl::Framebuffer framebuffer_;
};

/// The view of a face from `centre`.
render::View face_view(int face, glm::vec3 centre, int resolution, GLuint framebuffer);

}  // namespace parvis::methods

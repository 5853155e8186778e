// The pictures of a display's eyes and what its projectors show of them: warped onto curved surfaces, both
// eyes in one picture, light blended where projectors overlap.
#pragma once

#include "base/image.h"
#include "graphics/display/frusta.h"
#include "graphics/gl/program.h"

namespace parvis::display {

/// Needs a current OpenGL context for as long as it lives.
class Screens {
 public:
  /// Makes room for all pictures of the display; it must not change but for its eye. Errors: the driver
  /// refuses the size, or a shader.
  static Result<Screens> create(const Display& display, std::span<const WallPicture> pictures);

  /// The framebuffer into which a picture is to be drawn, display values, by its place in the list.
  GLuint framebuffer_of(std::size_t picture) const { return pictures_[picture].framebuffer.name(); }
  /// Puts a picture that was made elsewhere, top row first, in its place.
  void put(std::size_t picture, const Image8& image);
  /// Makes what each projector shows of the pictures; `pictures` are as drawn, in the same order.
  void compose(const Display& display, std::span<const WallPicture> pictures);

  /// The texture of a wall as its projector shows it. Of stereo by two buffers: of that eye.
  GLuint texture_of(std::size_t wall, Eye eye = Eye::both) const { return output(wall, eye).texture.name(); }
  /// The same as an image, top row first; waits for the GPU.
  Image8 read(std::size_t wall, Eye eye = Eye::both) const;
  /// The picture of an eye as it was drawn; waits for the GPU.
  Image8 read_picture(std::size_t picture) const { return read(pictures_[picture]); }

 private:
  struct Target {
    glm::ivec2 size{0};
    gl::Texture texture;
    gl::Framebuffer framebuffer;
  };
  /// Triangles of a wall.
  struct Surface {
    gl::VertexArray vertex_array;
    gl::Buffer vertices, indices;
    int count = 0;
  };
  explicit Screens(gl::Program program) : program_(std::move(program)) {}
  static Target target(glm::ivec2 size);
  static Image8 read(const Target& target);
  const Target& output(std::size_t wall, Eye eye) const {
    return outputs_[2 * wall + (eye == Eye::right && outputs_[2 * wall + 1].texture ? 1 : 0)];
  }

  gl::Program program_;
  std::vector<Target> pictures_,
      outputs_;  ///< outputs: two of each wall, the second of the right eye's buffer
  std::vector<Surface> surfaces_;
};

}  // namespace parvis::display

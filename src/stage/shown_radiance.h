// A picture of radiance that is shown in place of the drawn one.
#pragma once

#include "base/image.h"
#include "base/result.h"
#include "graphics/gl/program.h"
#include "graphics/render/whole_screen.h"

namespace parvis::stage {

/// Needs a current OpenGL context.
class ShownRadiance {
 public:
  /// Fails only if a shader does.
  static Result<ShownRadiance> create();

  /// Takes a picture over: linear RGB, top row first.
  void put(ImageF radiance);
  /// Tone-maps it into the first pixels of a framebuffer (0: the window's), one to one.
  void display(GLuint framebuffer, float exposure) const;
  const ImageF& radiance() const { return radiance_; }  ///< as put last

 private:
  explicit ShownRadiance(gl::Program display) : display_(std::move(display)) {}

  ImageF radiance_;
  gl::Program display_;
  gl::Texture texture_;
  glm::ivec2 size_{0};  ///< of the texture
  render::WholeScreen screen_;
};

}  // namespace parvis::stage

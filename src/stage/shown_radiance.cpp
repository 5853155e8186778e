#include "stage/shown_radiance.h"

#include "graphics/render/picture_target.h"

namespace parvis::stage {

Result<ShownRadiance> ShownRadiance::create() {
  Result<gl::Program> display =
      gl::Program::create("graphics/render/whole_screen.vert", "graphics/render/display.frag");
  if (!display) return display.errors();
  return ShownRadiance(*std::move(display));
}

void ShownRadiance::put(ImageF radiance) {
  radiance_ = std::move(radiance);
  if (size_ != glm::ivec2(radiance_.width, radiance_.height)) {
    size_ = {radiance_.width, radiance_.height};
    texture_ = gl::texture_2d(GL_RGBA32F, size_.x, size_.y);
  }
  ImageF upward = radiance_;
  render::flip_rows(upward);
  glTextureSubImage2D(texture_.name(), 0, 0, 0, size_.x, size_.y, GL_RGB, GL_FLOAT, upward.pixels.data());
}

void ShownRadiance::display(GLuint framebuffer, float exposure) const {
  display_.set("exposure", exposure);
  display_.set("drawn", glm::vec2(size_));
  screen_.draw(display_, framebuffer, size_, texture_.name());
}

}  // namespace parvis::stage

#include "graphics/render/picture_target.h"

#include "graphics/shading/realism.h"

namespace parvis::render {
namespace {

gl::Texture multisampled_texture(GLenum format, int width, int height) {
  gl::Texture texture = gl::Texture::create(GLenum(GL_TEXTURE_2D_MULTISAMPLE));
  glTextureStorage2DMultisample(texture.name(), samples_per_pixel, format, width, height, GL_TRUE);
  return texture;
}

gl::Framebuffer framebuffer_of(const gl::Texture& colour) {
  gl::Framebuffer framebuffer = gl::Framebuffer::create();
  glNamedFramebufferTexture(framebuffer.name(), GL_COLOR_ATTACHMENT0, colour.name(), 0);
  return framebuffer;
}

}  // namespace

Result<PictureTarget> PictureTarget::create() {
  Result<gl::Program> resolve =
      gl::Program::create("graphics/render/whole_screen.vert", "graphics/render/resolve.frag");
  if (!resolve) return resolve.errors();
  Result<gl::Program> display =
      gl::Program::create("graphics/render/whole_screen.vert", "graphics/render/display.frag");
  if (!display) return display.errors();
  return PictureTarget(*std::move(resolve), *std::move(display));
}

PictureTarget::PictureTarget(gl::Program resolve, gl::Program display)
    : resolve_(std::move(resolve)), display_(std::move(display)) {}

void PictureTarget::resize(int width, int height) {
  width_ = width, height_ = height;
  if (width <= room_.x && height <= room_.y) return;
  room_ = glm::max(room_, glm::ivec2(width, height));
  samples_ = multisampled_texture(GL_RGBA16F, room_.x, room_.y);
  sample_depth_ = multisampled_texture(GL_DEPTH_COMPONENT32F, room_.x, room_.y);
  radiance_ = gl::texture_2d(GL_RGBA16F, room_.x, room_.y);
  picture_ = gl::texture_2d(GL_RGBA8, room_.x, room_.y);
  multisampled_ = framebuffer_of(samples_);
  glNamedFramebufferTexture(multisampled_.name(), GL_DEPTH_ATTACHMENT, sample_depth_.name(), 0);
  resolved_ = framebuffer_of(radiance_);
  displayed_ = framebuffer_of(picture_);
}

void PictureTarget::keep() {
  if (kept_room_ != room_) {
    kept_room_ = room_;
    kept_samples_ = multisampled_texture(GL_RGBA16F, room_.x, room_.y);
    kept_depth_ = multisampled_texture(GL_DEPTH_COMPONENT32F, room_.x, room_.y);
  }
  copy(samples_, kept_samples_);
  copy(sample_depth_, kept_depth_);
}

void PictureTarget::restore() {
  copy(kept_samples_, samples_);
  copy(kept_depth_, sample_depth_);
}

void PictureTarget::copy(const gl::Texture& from, const gl::Texture& to) const {
  constexpr GLenum kind = GL_TEXTURE_2D_MULTISAMPLE;
  glCopyImageSubData(from.name(), kind, 0, 0, 0, 0, to.name(), kind, 0, 0, 0, 0, width_, height_, 1);
}

void PictureTarget::set_realism(float level) {
  resolve_.set("has_ink", int(shading::ink_at(level) > 0.0f));
  display_.set("paper_share", shading::realism_at(level).w);
}

void PictureTarget::resolve(float exposure) {
  resolve_.set("exposure", exposure);
  screen_.draw(resolve_, resolved_.name(), {width_, height_}, samples_.name());
}

void PictureTarget::display(GLuint framebuffer, glm::ivec2 size, float exposure) const {
  display_.set("exposure", exposure);
  display_.set("drawn", glm::vec2(float(width_), float(height_)));
  screen_.draw(display_, framebuffer, size, radiance_.name());
}

void PictureTarget::start_reading(float exposure, GLsizeiptr bytes) const {
  display(displayed_.name(), {width_, height_}, exposure);
  glGetTextureSubImage(picture_.name(), 0, 0, 0, 0, width_, height_, 1, GL_RGBA, GL_UNSIGNED_BYTE,
                       GLsizei(bytes), nullptr);
}

Image8 PictureTarget::read_picture(float exposure) const {
  display(displayed_.name(), {width_, height_}, exposure);
  Image8 picture(width_, height_, 4);
  glGetTextureSubImage(picture_.name(), 0, 0, 0, 0, width_, height_, 1, GL_RGBA, GL_UNSIGNED_BYTE,
                       GLsizei(picture.pixels.size()), picture.pixels.data());
  flip_rows(picture);
  return picture;
}

ImageF PictureTarget::read_radiance() const {
  ImageF radiance(width_, height_, 4);
  glGetTextureSubImage(radiance_.name(), 0, 0, 0, 0, width_, height_, 1, GL_RGBA, GL_FLOAT,
                       GLsizei(radiance.pixels.size() * sizeof(float)), radiance.pixels.data());
  flip_rows(radiance);
  return radiance;
}

}  // namespace parvis::render

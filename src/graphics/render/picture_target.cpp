#include "graphics/render/picture_target.h"

#include <array>
#include <cassert>
#include <glm/vector_relational.hpp>

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
  std::array<gl::Program, 3> programs;
  for (std::size_t i = 0; const char* const shader : {"resolve", "smooth_edges", "display"}) {
    Result<gl::Program> program = gl::Program::create("graphics/render/whole_screen.vert",
                                                      fmt::format("graphics/render/{}.frag", shader));
    if (!program) return program.errors();
    programs[i++] = *std::move(program);
  }
  return PictureTarget(std::move(programs[0]), std::move(programs[1]), std::move(programs[2]));
}

PictureTarget::PictureTarget(gl::Program resolve, gl::Program smooth, gl::Program display)
    : resolve_(std::move(resolve)), smooth_(std::move(smooth)), display_(std::move(display)) {}

void PictureTarget::resize(int width, int height, bool has_one_sample) {
  width_ = width, height_ = height, has_one_sample_ = has_one_sample;
  const glm::ivec2 size(width, height);
  if (glm::any(glm::greaterThan(size, room_))) {
    room_ = glm::max(room_, size);
    radiance_ = gl::texture_2d(GL_RGBA16F, room_.x, room_.y);
    picture_ = gl::texture_2d(GL_RGBA8, room_.x, room_.y);
    resolved_ = framebuffer_of(radiance_);
    displayed_ = framebuffer_of(picture_);
  }
  Samples& drawn = has_one_sample ? single_ : multiple_;
  if (glm::any(glm::greaterThan(size, drawn.room))) {
    const auto texture = has_one_sample
                             ? [](GLenum format, int w, int h) { return gl::texture_2d(format, w, h); }
                             : multisampled_texture;
    drawn.room = glm::max(drawn.room, size);
    drawn.colour = texture(GL_RGBA16F, drawn.room.x, drawn.room.y);
    drawn.depth = texture(GL_DEPTH_COMPONENT32F, drawn.room.x, drawn.room.y);
    drawn.framebuffer = framebuffer_of(drawn.colour);
    glNamedFramebufferTexture(drawn.framebuffer.name(), GL_DEPTH_ATTACHMENT, drawn.depth.name(), 0);
  }
}

void PictureTarget::keep() {
  assert(!has_one_sample_);
  if (kept_.room != multiple_.room) {
    kept_.room = multiple_.room;
    kept_.colour = multisampled_texture(GL_RGBA16F, kept_.room.x, kept_.room.y);
    kept_.depth = multisampled_texture(GL_DEPTH_COMPONENT32F, kept_.room.x, kept_.room.y);
  }
  copy(multiple_.colour, kept_.colour);
  copy(multiple_.depth, kept_.depth);
}

void PictureTarget::restore() {
  copy(kept_.colour, multiple_.colour);
  copy(kept_.depth, multiple_.depth);
}

void PictureTarget::copy(const gl::Texture& from, const gl::Texture& to) const {
  constexpr GLenum kind = GL_TEXTURE_2D_MULTISAMPLE;
  glCopyImageSubData(from.name(), kind, 0, 0, 0, 0, to.name(), kind, 0, 0, 0, 0, width_, height_, 1);
}

void PictureTarget::set_realism(float level) {
  for (gl::Program* program : {&resolve_, &smooth_})
    program->set("has_ink", int(shading::ink_at(level) > 0.0f));
  display_.set("paper_share", shading::realism_at(level).w);
}

void PictureTarget::resolve(float exposure) {
  gl::Program& program = has_one_sample_ ? smooth_ : resolve_;
  program.set("exposure", exposure);
  if (has_one_sample_) program.set("drawn", glm::vec2(float(width_), float(height_)));
  screen_.draw(program, resolved_.name(), {width_, height_}, samples().colour.name());
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

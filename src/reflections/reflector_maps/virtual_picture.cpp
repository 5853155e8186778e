#include "reflections/reflector_maps/virtual_picture.h"

#include "graphics/render/picture_target.h"

namespace parvis::reflector_maps {
namespace {

gl::Texture multisampled(GLenum format, int width, int height) {
  gl::Texture texture = gl::Texture::create(GLenum(GL_TEXTURE_2D_MULTISAMPLE));
  glTextureStorage2DMultisample(texture.name(), render::samples_per_pixel, format, width, height, GL_TRUE);
  return texture;
}

}  // namespace

Result<VirtualPicture> VirtualPicture::create() {
  Result<gl::Program> resolve = gl::Program::create("graphics/render/whole_screen.vert",
                                                    "reflections/reflector_maps/virtual_picture.frag");
  if (!resolve) return resolve.errors();
  return VirtualPicture(*std::move(resolve));
}

void VirtualPicture::resize(int width, int height) {
  width_ = width, height_ = height;
  if (width <= room_.x && height <= room_.y) return;
  room_ = glm::max(room_, glm::ivec2(width, height));
  samples_ = multisampled(GL_RGBA16F, room_.x, room_.y);
  depth_stencil_ = multisampled(GL_DEPTH32F_STENCIL8, room_.x, room_.y);
  picture_ = gl::texture_2d(GL_RGBA16F, room_.x, room_.y);
  drawn_ = gl::Framebuffer::create();
  glNamedFramebufferTexture(drawn_.name(), GL_COLOR_ATTACHMENT0, samples_.name(), 0);
  glNamedFramebufferTexture(drawn_.name(), GL_DEPTH_STENCIL_ATTACHMENT, depth_stencil_.name(), 0);
  resolved_ = gl::Framebuffer::create();
  glNamedFramebufferTexture(resolved_.name(), GL_COLOR_ATTACHMENT0, picture_.name(), 0);
}

render::View VirtualPicture::begin(const render::Renderer& renderer, render::VirtualVertices& vertices) {
  resize(renderer.width(), renderer.height());
  clear_colour();
  glClearNamedFramebufferfi(drawn_.name(), GL_DEPTH_STENCIL, 0, 1.0f, 0);
  render::View view = renderer.main_view();
  view.kind = render::ViewKind::mirrored;
  view.virtual_vertices = &vertices;
  view.framebuffer = drawn_.name();
  view.culls_hidden = false;
  view.subjects = render::Subjects::all;
  return view;
}

void VirtualPicture::clear_colour() const {
  constexpr GLfloat unmarked[4]{0.0f, 0.0f, 0.0f, -1.0f};  // virtual_picture.frag
  glClearNamedFramebufferfv(drawn_.name(), GL_COLOR, 0, unmarked);
}

void VirtualPicture::clear_depth() const {
  constexpr GLfloat farthest = 1.0f;
  glClearNamedFramebufferfv(drawn_.name(), GL_DEPTH, 0, &farthest);
}

void VirtualPicture::resolve(const render::Renderer& renderer) const {
  resolve_.set("exposure", renderer.exposure());
  screen_.draw(resolve_, resolved_.name(), {width_, height_}, samples_.name());
}

}  // namespace parvis::reflector_maps

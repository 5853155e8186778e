#include "render/renderer.h"

#include <algorithm>

namespace parvis::render {
namespace {

constexpr int samples_a_pixel = 4;

/// The uniform block of render/frame.glsl, std140.
struct FrameBlock {
  glm::mat4 clip_from_world;
  glm::vec4 viewer_position, to_sun, sun_irradiance, haze;
  glm::vec4 sky_sh[9];
  glm::mat4 uvz_from_world[3];
  glm::vec4 texel_m, texel_uv, size;
};

gl::Texture multisampled_texture(GLenum format, int width, int height) {
  gl::Texture texture = gl::Texture::create(GLenum(GL_TEXTURE_2D_MULTISAMPLE));
  glTextureStorage2DMultisample(texture.name(), samples_a_pixel, format, width, height, GL_TRUE);
  return texture;
}

void flip_rows(auto& image) {
  const std::ptrdiff_t row = std::ptrdiff_t(image.width) * image.channels;
  for (int y = 0; y < image.height / 2; ++y)
    std::swap_ranges(image.pixels.begin() + y * row, image.pixels.begin() + (y + 1) * row,
                     image.pixels.begin() + (image.height - 1 - y) * row);
}

}  // namespace

Result<std::unique_ptr<Renderer>> Renderer::create(const scene::Scene& scene) {
  Result<SceneDrawable> drawable = SceneDrawable::create(scene);
  if (!drawable) return drawable.errors();
  Result<gl::Program> sky = gl::Program::create("render/whole_screen.vert", "render/sky.frag");
  if (!sky) return sky.errors();
  assign_bindings(*sky);
  Result<gl::Program> display = gl::Program::create("render/whole_screen.vert", "render/display.frag");
  if (!display) return display.errors();
  return std::unique_ptr<Renderer>(
      new Renderer(scene, *std::move(drawable), {*std::move(sky), *std::move(display)}));
}

Renderer::Renderer(const scene::Scene& scene, SceneDrawable drawable, Programs programs)
    : sky_(shading::make_sky_light(scene.sky.picture, scene.sky.intensity, scene.sky.heading)),
      sun_(scene.sun),
      haze_per_m_(scene.haze_per_m),
      scene_(std::move(drawable)),
      programs_(std::move(programs)),
      shadows_(scene.sun.direction_to_sun, scene_.gpu().fixed_bounds()),
      drawables_{&scene_},
      frame_blocks_(1 << 18),
      no_attributes_(gl::VertexArray::create()) {
  upload_sky();
}

void Renderer::upload_sky() {
  const ImageF& picture = sky_.levels.front();
  sky_texture_ = gl::texture_2d(GL_RGB16F, picture.width, picture.height, int(sky_.levels.size()));
  for (std::size_t level = 0; level < sky_.levels.size(); ++level) {
    const ImageF& image = sky_.levels[level];
    glTextureSubImage2D(sky_texture_.name(), GLint(level), 0, 0, image.width, image.height, GL_RGB, GL_FLOAT,
                        image.pixels.data());
  }
  glTextureParameteri(sky_texture_.name(), GL_TEXTURE_WRAP_S, GL_REPEAT);
}

void Renderer::resize(int width, int height) {
  if (width == target_.width && height == target_.height) return;
  target_ = {};
  target_.width = width, target_.height = height;
  target_.samples = multisampled_texture(GL_RGBA16F, width, height);
  target_.sample_depth = multisampled_texture(GL_DEPTH_COMPONENT32F, width, height);
  target_.radiance = gl::texture_2d(GL_RGBA16F, width, height);
  target_.picture = gl::texture_2d(GL_RGBA8, width, height);
  target_.multisampled = gl::Framebuffer::create();
  glNamedFramebufferTexture(target_.multisampled.name(), GL_COLOR_ATTACHMENT0, target_.samples.name(), 0);
  glNamedFramebufferTexture(target_.multisampled.name(), GL_DEPTH_ATTACHMENT, target_.sample_depth.name(), 0);
  target_.resolved = gl::Framebuffer::create();
  glNamedFramebufferTexture(target_.resolved.name(), GL_COLOR_ATTACHMENT0, target_.radiance.name(), 0);
  target_.displayed = gl::Framebuffer::create();
  glNamedFramebufferTexture(target_.displayed.name(), GL_COLOR_ATTACHMENT0, target_.picture.name(), 0);
}

void Renderer::bind_frame(const View& view) {
  FrameBlock block{};
  block.clip_from_world = view.clip_from_world;
  block.viewer_position = glm::vec4(view.position_in_world, 1.0f);
  block.to_sun = glm::vec4(glm::normalize(sun_.direction_to_sun), haze_per_m_);
  block.sun_irradiance = glm::vec4(sun_.irradiance, 0.0f);
  block.haze = glm::vec4(sky_.haze_radiance, sky_.heading);
  for (std::size_t i = 0; i < 9; ++i) block.sky_sh[i] = glm::vec4(sky_.irradiance_sh[i], 0.0f);
  for (int i = 0; i < 3; ++i) block.uvz_from_world[i] = shadows_.maps().uvz_from_world[i];
  block.texel_m = glm::vec4(shadows_.maps().texel_m, 0.0f);
  block.texel_uv = glm::vec4(shadows_.texel_uv(), 0.0f);
  block.size = {float(view.width), float(view.height), float(sky_.levels.size()), 0.0f};
  const GLintptr offset = frame_blocks_.append(std::span<const FrameBlock>(&block, 1), 256);
  glBindBufferRange(GL_UNIFORM_BUFFER, 0, frame_blocks_.name(), offset, sizeof(FrameBlock));
}

void Renderer::begin_view(const View& view) {
  glBindFramebuffer(GL_FRAMEBUFFER, view.framebuffer);
  glViewport(0, 0, view.width, view.height);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LEQUAL);
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
  glFrontFace(GL_CCW);
  glCullFace(GL_BACK);
  bind_frame(view);
}

void Renderer::draw_prepared(const View& view) {
  begin_view(view);
  const bool has_colour = view.kind != ViewKind::shadow && view.kind != ViewKind::picking;
  if (view.kind == ViewKind::picking) {
    constexpr GLuint nothing[4]{};
    glClearBufferuiv(GL_COLOR, 0, nothing);
  }
  glClear(GL_DEPTH_BUFFER_BIT);
  if (has_colour) {
    glBindTextureUnit(sky_unit, sky_texture_.name());
    shadows_.bind();
  }
  for (Drawable* drawable : drawables_) drawable->draw(view, Pass::opaque);
  if (has_colour) glEnable(GL_SAMPLE_ALPHA_TO_COVERAGE);
  for (Drawable* drawable : drawables_) drawable->draw(view, Pass::cutout);
  glDisable(GL_SAMPLE_ALPHA_TO_COVERAGE);
  if (!has_colour) return;

  programs_.sky.use();
  programs_.sky.set("world_from_clip", glm::inverse(view.clip_from_world));
  glBindVertexArray(no_attributes_.name());
  glDepthMask(GL_FALSE);
  glDisable(GL_CULL_FACE);
  glDrawArrays(GL_TRIANGLES, 0, 3);

  glEnable(GL_BLEND);
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
  for (Drawable* drawable : drawables_) drawable->draw(view, Pass::blend);
  glDisable(GL_BLEND);
  glDepthMask(GL_TRUE);
}

void Renderer::draw_view(const View& view) {
  for (Drawable* drawable : drawables_) drawable->prepare(view);
  draw_prepared(view);
}

void Renderer::begin_frame(const scene::Scene& scene, const Camera& camera) {
  scene_.update(scene);
  glEnable(GL_DEPTH_CLAMP);  // a caster in front of the sun's near plane still throws its shadow
  shadows_.update(camera.position_in_world(), [this](const View& view) { draw_view(view); });
  glDisable(GL_DEPTH_CLAMP);
}

void Renderer::prepare_main_view(const Camera& camera, int width, int height) {
  resize(width, height);
  main_view_ = camera_view(camera, target_.multisampled.name(), width, height);
  main_view_.culls_hidden = true;
  for (Drawable* drawable : drawables_) drawable->prepare(main_view_);
}

void Renderer::draw_main_view() {
  draw_prepared(main_view_);
  glBlitNamedFramebuffer(target_.multisampled.name(), target_.resolved.name(), 0, 0, target_.width,
                         target_.height, 0, 0, target_.width, target_.height, GL_COLOR_BUFFER_BIT,
                         GL_NEAREST);
}

std::vector<std::uint32_t> Renderer::pick(const Camera& camera, int width, int height, bool culls_hidden) {
  gl::Texture objects = gl::texture_2d(GL_R32UI, width, height);
  gl::Texture depth = gl::texture_2d(GL_DEPTH_COMPONENT32F, width, height);
  gl::Framebuffer framebuffer = gl::Framebuffer::create();
  glNamedFramebufferTexture(framebuffer.name(), GL_COLOR_ATTACHMENT0, objects.name(), 0);
  glNamedFramebufferTexture(framebuffer.name(), GL_DEPTH_ATTACHMENT, depth.name(), 0);
  View view = camera_view(camera, framebuffer.name(), width, height);
  view.kind = ViewKind::picking;
  view.culls_hidden = culls_hidden;
  draw_view(view);

  struct {
    int width, height, channels;
    std::vector<std::uint32_t> pixels;
  } picture{width, height, 1, {}};
  picture.pixels.resize(std::size_t(width) * std::size_t(height));
  glGetTextureImage(objects.name(), 0, GL_RED_INTEGER, GL_UNSIGNED_INT, GLsizei(4 * picture.pixels.size()),
                    picture.pixels.data());
  flip_rows(picture);
  return std::move(picture.pixels);
}

void Renderer::display(GLuint framebuffer, float exposure) {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glViewport(0, 0, target_.width, target_.height);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  programs_.display.use();
  programs_.display.set("exposure", exposure);
  glBindTextureUnit(0, target_.radiance.name());
  glBindVertexArray(no_attributes_.name());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

Image8 Renderer::read_picture(float exposure) {
  display(target_.displayed.name(), exposure);
  Image8 picture(target_.width, target_.height, 4);
  glGetTextureImage(target_.picture.name(), 0, GL_RGBA, GL_UNSIGNED_BYTE, GLsizei(picture.pixels.size()),
                    picture.pixels.data());
  flip_rows(picture);
  return picture;
}

ImageF Renderer::read_radiance() const {
  ImageF radiance(target_.width, target_.height, 4);
  glGetTextureImage(target_.radiance.name(), 0, GL_RGBA, GL_FLOAT,
                    GLsizei(radiance.pixels.size() * sizeof(float)), radiance.pixels.data());
  flip_rows(radiance);
  return radiance;
}

}  // namespace parvis::render

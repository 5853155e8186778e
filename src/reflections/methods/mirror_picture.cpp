#include "reflections/methods/mirror_picture.h"

#include "graphics/gl/sampled_textures.h"
#include "reflections/methods/bindings.h"

namespace parvis::methods {
namespace {

constexpr GLuint starts_unit = 0, directions_unit = 1;  // of materials, which come later
// Beside the middle of a pixel, in pixels: where the four samples of the main view lie with most drivers.
constexpr std::array<glm::vec2, 4> edge_samples{glm::vec2(-0.125f, -0.375f), glm::vec2(0.375f, -0.125f),
                                                glm::vec2(-0.375f, 0.125f), glm::vec2(0.125f, 0.375f)};

constexpr const char* whole_screen = "graphics/render/whole_screen.vert";
constexpr float far_plane = -1.0f;         // farther than any ray, of which the nearest has depth 1
constexpr float max_sample_offset = 0.5f;  // of the sum in x and y

gl::Texture layered(GLenum format, glm::ivec2 size, int layers) {
  gl::Texture texture = gl::Texture::create(GL_TEXTURE_2D_ARRAY);
  glTextureStorage3D(texture.name(), 1, format, size.x, size.y, layers);
  glTextureParameteri(texture.name(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTextureParameteri(texture.name(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  return texture;
}

}  // namespace

glm::ivec4 pixels_of(const render::View& view, const Bounds& bounds) {
  const glm::vec2 size(float(view.width), float(view.height));
  glm::vec2 low = size, high(0.0f);
  for (int corner = 0; corner < 8; ++corner) {
    const glm::vec3 at((corner & 1) ? bounds.max.x : bounds.min.x, (corner & 2) ? bounds.max.y : bounds.min.y,
                       (corner & 4) ? bounds.max.z : bounds.min.z);
    const glm::vec4 clip = view.clip_from_world * glm::vec4(at, 1.0f);
    if (clip.w <= 1e-3f) return {0, 0, view.width, view.height};  // beside or behind the eye
    const glm::vec2 pixel = (glm::vec2(clip) / clip.w * 0.5f + 0.5f) * size;
    low = glm::min(low, pixel), high = glm::max(high, pixel);
  }
  const glm::ivec2 first =
      glm::max(glm::ivec2(glm::floor(glm::clamp(low, glm::vec2(0.0f), size))) - 1, glm::ivec2(0));
  const glm::ivec2 end = glm::min(glm::ivec2(glm::ceil(glm::min(high, size))) + 1, glm::ivec2(size));
  return {first, glm::max(end - first, glm::ivec2(0))};
}

Result<MirrorPicture> MirrorPicture::create(const render::Renderer& renderer, RayCount count) {
  const std::vector<render::GpuMaterial> materials = renderer.gpu().mirror_materials();
  const render::SurfaceSource source{.fragment = "reflections/methods/mirror_rays.frag"};
  Result<render::SurfacePrograms> rays = render::SurfacePrograms::create(source, materials);
  if (!rays) return rays.errors();
  std::optional<EdgePrograms> edges;
  if (count == RayCount::and_edges) {
    Result<EdgePrograms> made = EdgePrograms::create(source, materials);
    if (!made) return made.errors();
    edges = *std::move(made);
  }
  Result<gl::Program> spread =
      gl::Program::create(whole_screen, "reflections/methods/mirror_picture_spread.frag");
  if (!spread) return spread.errors();
  return MirrorPicture(*std::move(rays), std::move(edges), *std::move(spread));
}

Result<MirrorPicture::EdgePrograms> MirrorPicture::EdgePrograms::create(
    render::SurfaceSource source, const std::vector<render::GpuMaterial>& materials) {
  source.defines.emplace_back("HAS_RAYS", "");
  Result<render::SurfacePrograms> rays = render::SurfacePrograms::create(source, materials);
  if (!rays) return rays.errors();
  rays->set("ray_starts", int(first_method_unit));
  rays->set("ray_directions", int(first_method_unit + 1));
  Result<gl::Program> outlines =
      gl::Program::create(whole_screen, "reflections/methods/mirror_outlines.frag");
  if (!outlines) return outlines.errors();
  Result<gl::Program> others = gl::Program::create(whole_screen, "reflections/methods/no_second_ray.frag");
  if (!others) return others.errors();
  return EdgePrograms{*std::move(rays), *std::move(outlines), *std::move(others)};
}

MirrorPicture::MirrorPicture(render::SurfacePrograms ray_programs, std::optional<EdgePrograms> edge_programs,
                             gl::Program spread)
    : ray_programs_(std::move(ray_programs)),
      edge_programs_(std::move(edge_programs)),
      spread_(std::move(spread)),
      no_attributes_(gl::VertexArray::create()) {}

void MirrorPicture::resize(int width, int height) {
  width_ = width, height_ = height;
  if (width <= room_.x && height <= room_.y) return;
  room_ = glm::max(room_, glm::ivec2(width, height));
  starts_ = layered(GL_RGBA32F, room_, layers());
  directions_ = layered(GL_RGBA32F, room_, layers());
  depth_ = layered(GL_DEPTH_COMPONENT32F, room_, layers());
  base_light_ = layered(GL_RGBA16F, room_, layers());
  coat_light_ = layered(GL_R11F_G11F_B10F, room_, layers());
  const auto framebuffer_of = [&](const gl::Texture& first, const gl::Texture& second, int layer) {
    gl::Framebuffer framebuffer = gl::Framebuffer::create();
    glNamedFramebufferTextureLayer(framebuffer.name(), GL_COLOR_ATTACHMENT0, first.name(), 0, layer);
    glNamedFramebufferTextureLayer(framebuffer.name(), GL_COLOR_ATTACHMENT1, second.name(), 0, layer);
    glNamedFramebufferTextureLayer(framebuffer.name(), GL_DEPTH_ATTACHMENT, depth_.name(), 0, layer);
    constexpr GLenum both[]{GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
    glNamedFramebufferDrawBuffers(framebuffer.name(), 2, both);
    return framebuffer;
  };
  for (int layer = 0; layer < layers(); ++layer) {
    rays_[std::size_t(layer)] = framebuffer_of(starts_, directions_, layer);
    light_[std::size_t(layer)] = framebuffer_of(base_light_, coat_light_, layer);
  }
  if (layers() == 1) return;
  second_depth_ = gl::Framebuffer::create();
  glNamedFramebufferTextureLayer(second_depth_.name(), GL_DEPTH_ATTACHMENT, depth_.name(), 0, 1);
}

void MirrorPicture::draw_rays(render::Renderer& renderer,
                              std::span<const VisibleReflector> with_second_rays) {
  has_second_rays_ = edge_programs_ && !with_second_rays.empty();
  are_seconded_.assign(renderer.gpu().object_bounds().size(), 0);
  if (has_second_rays_)
    for (const VisibleReflector& reflector : with_second_rays)
      are_seconded_[std::size_t(reflector.object)] = 1;
  resize(renderer.width(), renderer.height());
  constexpr GLfloat nothing[4]{};
  glClearNamedFramebufferfv(rays_[0].name(), GL_COLOR, 1, nothing);
  render::View view = renderer.main_view();
  view.kind = render::ViewKind::mirrors;
  view.surface_programs = &ray_programs_;
  view.framebuffer = rays_[0].name();
  renderer.draw_view(view);
  if (has_second_rays_) draw_edge_rays(renderer);
}

/// Surfaces that cover samples of pixels without covering their middles, wipers and outlines: the nearest at
/// any of the samples that no ray of the first layer fits.
void MirrorPicture::draw_edge_rays(render::Renderer& renderer) {
  constexpr GLfloat nothing[4]{};
  glClearNamedFramebufferfv(rays_[1].name(), GL_COLOR, 1, nothing);
  glCopyImageSubData(depth_.name(), GL_TEXTURE_2D_ARRAY, 0, 0, 0, 0, depth_.name(), GL_TEXTURE_2D_ARRAY, 0, 0,
                     0, 1, width_, height_, 1);
  clear_second_depth(edge_programs_->outlines);
  glBindTextureUnit(first_method_unit, starts_.name());
  glBindTextureUnit(first_method_unit + 1, directions_.name());
  render::View view = renderer.main_view();
  view.kind = render::ViewKind::mirrors;
  view.surface_programs = &edge_programs_->rays;
  view.framebuffer = rays_[1].name();
  view.shown_objects = &are_seconded_;
  view.clears = false;
  const glm::mat4 clip_from_world = view.clip_from_world;
  const glm::vec2 pixels(float(view.width), float(view.height));
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(-max_sample_offset, 0.0f);  // to what the surface's depth is at most at the pixel's middle
  for (const glm::vec2 sample : edge_samples) {
    view.clip_from_world =
        glm::translate(glm::mat4(1.0f), glm::vec3(-2.0f * sample / pixels, 0.0f)) * clip_from_world;
    renderer.draw_view(view);
  }
  glDisable(GL_POLYGON_OFFSET_FILL);
  clear_second_depth(edge_programs_->no_second_ray);
}

/// Takes the depth of the second layer away where the program does not discard it.
void MirrorPicture::clear_second_depth(const gl::Program& program) const {
  glTextureBarrier();  // what is read has been written above
  glBindFramebuffer(GL_FRAMEBUFFER, second_depth_.name());
  glViewport(0, 0, width_, height_);
  glEnable(GL_DEPTH_TEST);
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_LESS);
  glDisable(GL_CULL_FACE);
  program.use();
  bind_rays(program);
  program.set("screen_depth", far_plane);
  glBindVertexArray(no_attributes_.name());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

void MirrorPicture::bind_rays(const gl::Program& program) const {
  if (program.declares("ray_starts"))
    gl::bind_textures(program, {{"ray_starts", starts_unit, starts_.name()}});
  gl::bind_textures(program, {{"ray_directions", directions_unit, directions_.name()}});
}

void MirrorPicture::begin_light(int layer) const {
  glBindFramebuffer(GL_FRAMEBUFFER, light_[std::size_t(layer)].name());
  glViewport(0, 0, width_, height_);
  glEnable(GL_DEPTH_TEST);
  glDepthMask(GL_FALSE);
  glDisable(GL_CULL_FACE);
  glDisable(GL_BLEND);
  glScissor(0, 0, width_, height_);
  glEnable(GL_SCISSOR_TEST);
}

void MirrorPicture::draw_over(const render::Renderer& renderer, const gl::Program& program,
                              const VisibleReflector& reflector) const {
  bind_rays(program);
  program.set("screen_depth", far_plane);
  const glm::ivec4 pixels =
      pixels_of(renderer.main_view(), renderer.gpu().object_bounds()[std::size_t(reflector.object)]);
  glScissor(pixels.x, pixels.y, pixels.z, pixels.w);
  glBindVertexArray(no_attributes_.name());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

/// The depth test separates pixels with a ray from others before any shader runs.
void MirrorPicture::draw_light(
    const render::Renderer& renderer, const std::vector<VisibleReflector>& reflectors,
    const std::function<const gl::Program&(const VisibleReflector&)>& use_program) const {
  constexpr GLfloat nothing[4]{};
  for (int layer = 0; layer <= int(has_second_rays_); ++layer) {
    begin_light(layer);
    if (has_second_rays_) glClearBufferfv(GL_COLOR, 0, nothing);  // not to all pixels is light spread
    glDepthFunc(GL_LESS);
    for (const VisibleReflector& reflector : reflectors) {
      if (layer == 1 && !are_seconded_[std::size_t(reflector.object)]) continue;
      const gl::Program& program = use_program(reflector);
      program.set("ray_layer", layer);
      draw_over(renderer, program, reflector);
    }
  }
  end_light();
  spread_light(renderer, reflectors);
}

/// Used without second rays: beside pixels with a ray, where a surface covers less than the pixel's middle,
/// the light of neighbours stands in.
void MirrorPicture::spread_light(const render::Renderer& renderer,
                                 const std::vector<VisibleReflector>& reflectors) const {
  begin_light(0);
  glTextureBarrier();  // what is read below has been written above
  glDepthFunc(GL_EQUAL);
  spread_.use();
  bind(spread_, first_method_unit);
  for (const VisibleReflector& reflector : reflectors)
    if (!are_seconded_[std::size_t(reflector.object)]) draw_over(renderer, spread_, reflector);
  end_light();
}

void MirrorPicture::end_light() {
  glDisable(GL_SCISSOR_TEST);
  glDepthMask(GL_TRUE);
}

void MirrorPicture::read_rays(const render::Renderer& renderer,
                              const std::vector<VisibleReflector>& reflectors, MirrorRays& rays) const {
  glm::ivec2 low(width_, height_), high(0);
  for (const VisibleReflector& reflector : reflectors) {
    const glm::ivec4 pixels =
        pixels_of(renderer.main_view(), renderer.gpu().object_bounds()[std::size_t(reflector.object)]);
    if (pixels.z == 0 || pixels.w == 0) continue;
    low = glm::min(low, glm::ivec2(pixels.x, pixels.y));
    high = glm::max(high, glm::ivec2(pixels.x + pixels.z, pixels.y + pixels.w));
  }
  rays.pixels = {low, glm::max(high - low, glm::ivec2(0))};
  const std::size_t count = std::size_t(rays.pixels.z) * std::size_t(rays.pixels.w);
  rays.starts.resize(count), rays.directions.resize(count);
  const auto read = [&](const gl::Texture& texture, std::vector<glm::vec4>& values) {
    glGetTextureSubImage(texture.name(), 0, rays.pixels.x, rays.pixels.y, 0, rays.pixels.z, rays.pixels.w, 1,
                         GL_RGBA, GL_FLOAT, GLsizei(values.size() * sizeof(glm::vec4)), values.data());
  };
  if (count == 0) return;
  read(starts_, rays.starts);
  read(directions_, rays.directions);
}

void MirrorPicture::put_light(const render::Renderer& renderer,
                              const std::vector<VisibleReflector>& reflectors, const MirrorRays& rays,
                              std::span<const glm::vec4> base, std::span<const glm::vec3> coat) const {
  const auto put = [&](const gl::Texture& texture, GLenum format, const void* values) {
    glTextureSubImage3D(texture.name(), 0, rays.pixels.x, rays.pixels.y, 0, rays.pixels.z, rays.pixels.w, 1,
                        format, GL_FLOAT, values);
  };
  put(base_light_, GL_RGBA, base.data());
  put(coat_light_, GL_RGB, coat.data());
  spread_light(renderer, reflectors);
}

void MirrorPicture::bind(const gl::Program& program, GLuint first_unit) const {
  if (program.declares("has_second_rays")) program.set("has_second_rays", int(has_second_rays_));
  gl::bind_textures(program, {{"base_light", first_unit, base_light_.name()},
                              {"coat_light", first_unit + 1, coat_light_.name()}});
  if (program.declares("ray_starts"))
    gl::bind_textures(program, {{"ray_starts", first_unit + 2, starts_.name()},
                                {"ray_directions", first_unit + 3, directions_.name()}});
}

}  // namespace parvis::methods

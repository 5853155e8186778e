#include "bench/light/sunlit_city.h"

#include "graphics/shadows/chosen_light.h"
#include "scene/data/sun_shadows.h"

namespace parvis::bench {
namespace {

constexpr int width = sunlit_pixels.width, height = sunlit_pixels.height;
/// Of an irradiance of 1: what is darker without shadows does not face the sun.
constexpr float min_light = 1e-3f;

SunShares shares_of(const ImageF& with, const ImageF& without) {
  return judged_shares(sunlit_pixels, [&](std::size_t x, std::size_t y) {
    const std::size_t pixel = y * std::size_t(width) + x;
    const float maximum = without.pixels[pixel * std::size_t(without.channels)];
    return maximum > min_light ? with.pixels[pixel * std::size_t(with.channels)] / maximum : 1.0f;
  });
}

}  // namespace

MiddleTarget::MiddleTarget()
    : colour_(gl::texture_2d(GL_RGBA32F, width, height)),
      depth_(gl::texture_2d(GL_DEPTH_COMPONENT32F, width, height)),
      framebuffer_(gl::Framebuffer::create()) {
  glNamedFramebufferTexture(framebuffer_.name(), GL_COLOR_ATTACHMENT0, colour_.name(), 0);
  glNamedFramebufferTexture(framebuffer_.name(), GL_DEPTH_ATTACHMENT, depth_.name(), 0);
}

ImageF MiddleTarget::drawn(render::Renderer& renderer) const {
  render::View view = renderer.main_view();
  view.framebuffer = framebuffer_.name();
  renderer.draw_view(view);
  ImageF picture(width, height, 4);
  glGetTextureImage(colour_.name(), 0, GL_RGBA, GL_FLOAT, GLsizei(picture.pixels.size() * sizeof(float)),
                    picture.pixels.data());
  render::flip_rows(picture);
  return picture;
}

Result<std::unique_ptr<SunlitCity>> SunlitCity::create(const scene::Scene& twin) {
  auto city = std::make_unique<SunlitCity>();
  city->shaded_ = twin, city->open_ = twin;
  for (scene::Scene* scene : {&city->shaded_, &city->open_})
    scene->sky.intensity = 0.0f, scene->haze_per_m = 0.0f, scene->sun.irradiance = glm::vec3(1.0f);
  city->open_.data<scene::SunShadows>().casts_none.assign(twin.objects.size(), true);
  for (auto [scene, renderer] :
       {std::pair{&city->shaded_, &city->renderer_}, {&city->open_, &city->open_renderer_}}) {
    auto made = render::Renderer::create(*scene, {}, shadows::ChosenLight::create);
    if (!made) return made.errors();
    *renderer = *std::move(made);
  }
  city->renderer_->add(&city->map_views_);
  return city;
}

void SunlitCity::set_sun(glm::vec3 to_sun) {
  for (scene::Scene* scene : {&shaded_, &open_}) scene->sun.direction_to_sun = to_sun;
}

Status SunlitCity::look(const Camera& camera) {
  camera_ = camera;
  return draw(*open_renderer_, open_, unshaded_);
}

void SunlitCity::set_technique(light::ShadowTechnique technique) {
  light::ShadowSettings& settings = shaded_.data<light::ShadowSettings>();
  settings.technique = technique, settings.sun_samples = 1;
}

bool SunlitCity::draws_maps(const Camera& camera, light::ShadowTechnique technique) {
  set_technique(technique);
  const int before = map_views();
  renderer_->begin_frame(shaded_, camera);
  return map_views() > before;
}

Result<DrawnSun> SunlitCity::sun(light::ShadowTechnique technique) {
  set_technique(technique);
  Pictures shaded;
  if (Status status = draw(*renderer_, shaded_, shaded); !status) return status.errors();
  return DrawnSun{shares_of(shaded.resolved, unshaded_.resolved), shares_of(shaded.middle, unshaded_.middle)};
}

Status SunlitCity::draw(render::Renderer& renderer, const scene::Scene& scene, Pictures& pictures) const {
  if (Status status = render::draw_frame(renderer, scene, {camera_, width, height}); !status) return status;
  pictures = {renderer.read_radiance(), middles_.drawn(renderer)};
  return Done{};
}

}  // namespace parvis::bench

#include "graphics/bounced_light/bounced_over.h"

#include <algorithm>

#include "graphics/bounced_light/transfer_cache.h"
#include "graphics/reference/scene_lamps.h"
#include "graphics/render/bindings.h"
#include "scene/data/sun_shadows.h"

namespace parvis::bounced_light {

/// Static things that rays cannot pass; glass, leaves and lit windows come and go without another trace.
std::vector<BouncedOver::Standing> BouncedOver::standing_in(const scene::Scene& scene) {
  std::vector<Standing> standing;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const scene::Object& object = scene.objects[i];
    if (object.is_dynamic || !object.is_visible) continue;
    const bool is_solid = std::ranges::any_of(object.model->parts, [&](const scene::Part& part) {
      return object.model->materials[std::size_t(part.material)].alpha_mode == scene::Alpha::opaque;
    });
    if (is_solid) standing.push_back({int(i), object.world_from_model});
  }
  return standing;
}

bool BouncedOver::update(const scene::Scene& scene) {
  const bool has_new_light = LightOver::update(scene);
  std::vector<Standing> standing = standing_in(scene);
  const bool is_other = !is_traced_ || standing != standing_;
  if (is_other) {
    std::optional<Transfer> kept = TransferCache(scene).read();
    transfer_ = kept ? *std::move(kept) : trace_transfer(scene);
    standing_ = std::move(standing), is_traced_ = true;
    lamp_shares_ = {};
  }
  if (!is_other && !has_new_light && sun_ == scene.sun) return false;
  sun_ = scene.sun;
  scene::Sun sun = scene.sun;
  if (scene.data<scene::SunShadows>().spot) sun.irradiance = glm::vec3(0.0f);  // a lamp stands in its place
  const std::vector<shading::Lamp> lamps = reference::lit_lamps(scene, reference::LampKind::still);
  light_ = transfer_.light(sun, sky(), lamp_shares_.irradiance(transfer_, lamps, scene));
  upload();
  return true;
}

void BouncedOver::upload() {
  if (light_.empty()) return;
  const glm::ivec3 cells = light_.cells;
  std::vector<glm::vec4> texels = light_.lobes;
  texels.reserve(3 * texels.size());
  for (const glm::vec3 colour : light_.colours) texels.emplace_back(colour, 0.0f);
  for (const glm::vec3 sky : light_.skies) texels.emplace_back(sky, 0.0f);
  texture_ = gl::Texture::create(GLenum(GL_TEXTURE_3D));
  glTextureStorage3D(texture_.name(), 1, GL_RGBA16F, cells.x, cells.y, 3 * cells.z);
  glTextureSubImage3D(texture_.name(), 0, 0, 0, 0, cells.x, cells.y, 3 * cells.z, GL_RGBA, GL_FLOAT,
                      texels.data());
  glTextureParameteri(texture_.name(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
    glTextureParameteri(texture_.name(), axis, GL_CLAMP_TO_EDGE);
}

void BouncedOver::bind() const {
  LightOver::bind();
  if (texture_) glBindTextureUnit(render::bounced_light_unit, texture_.name());
}

void BouncedOver::fill(render::Frame& frame) const {
  LightOver::fill(frame);
  if (light_.empty()) return;
  frame.frame_bounced_origin = glm::vec4(light_.grid.origin, light_.grid.lift_m);
  frame.frame_bounced_size = glm::vec4(light_.grid.size_m, light_.grid.layers);
}

render::MakeLight with_bounced_light(render::MakeLight below) {
  return [below = std::move(below)](const scene::Scene& scene,
                                    const Bounds& fixed) -> Result<std::unique_ptr<render::LightSource>> {
    Result<std::unique_ptr<render::LightSource>> light = below(scene, fixed);
    if (!light || !scene.data<scene::BouncedSettings>().is_on) return light;
    return std::unique_ptr<render::LightSource>(std::make_unique<BouncedOver>(*std::move(light)));
  };
}

}  // namespace parvis::bounced_light

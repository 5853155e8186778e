#include "graphics/light/sky_textures.h"

#include <algorithm>

#include "graphics/render/bindings.h"
#include "graphics/render/fixed_parts.h"
#include "graphics/render/regions.h"
#include "scene/data/bounced_settings.h"

namespace parvis::light {
namespace {

shading::WallLight wall_light(const scene::Scene& scene) {
  return scene.data<scene::BouncedSettings>().is_on ? shading::WallLight::none : shading::WallLight::constant;
}

/// Heights of the visible static geometry. The bounds hold hidden objects, too: the grid stays when they
/// appear.
shading::Heightfield visible_heights(const scene::Scene& scene) {
  shading::Heightfield heights(render::bounds_of_fixed_parts(scene, true));
  render::add_fixed_parts(scene, heights);
  return heights;
}

/// Adds objects that have come to the heights, and rebuilds the heights where one has gone. No room's own
/// drawable has changed.
void renew_heights(const scene::Scene& scene, const render::GpuScene& gpu, shading::Heightfield& heights) {
  const std::vector<Bounds> places_left = render::united(gpu.fixed_change().gone, 0.0f);
  for (const Bounds& place : places_left) heights.clear(place);
  render::for_each_fixed_opaque_part(scene, [&](const render::FixedPart& part) {
    if (!part.is_visible) return;
    const bool is_object = std::size_t(part.object) < scene.objects.size();
    if (is_object && gpu.is_newcomer(part.object)) return heights.add(part.mesh, part.world_from_mesh);
    for (const Bounds& place : places_left)
      if (!is_object || render::overlap_from_above(place, gpu.object_bounds()[std::size_t(part.object)]))
        heights.add(part.mesh, part.world_from_mesh, &place);
  });
}

gl::Texture upload(const shading::SkyLight& sky) {
  const ImageF& sharpest = sky.levels.front();
  gl::Texture texture = gl::texture_2d(GL_RGB32F, sharpest.width, sharpest.height, int(sky.levels.size()));
  for (std::size_t level = 0; level < sky.levels.size(); ++level) {
    const ImageF& image = sky.levels[level];
    glTextureSubImage2D(texture.name(), GLint(level), 0, 0, image.width, image.height, GL_RGB, GL_FLOAT,
                        image.pixels.data());
  }
  glTextureParameteri(texture.name(), GL_TEXTURE_WRAP_S, GL_REPEAT);
  return texture;
}

gl::Texture upload(const shading::SkyVisibility& visibility) {
  const glm::ivec3 cells = visibility.cells;
  gl::Texture texture = gl::Texture::create(GLenum(GL_TEXTURE_3D));
  glTextureStorage3D(texture.name(), 1, GL_RGBA8, cells.x, cells.y, cells.z);
  glTextureSubImage3D(texture.name(), 0, 0, 0, 0, cells.x, cells.y, cells.z, GL_RGBA, GL_UNSIGNED_BYTE,
                      visibility.values.data());
  glTextureParameteri(texture.name(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
    glTextureParameteri(texture.name(), axis, GL_CLAMP_TO_EDGE);
  return texture;
}

}  // namespace

Result<SkyTextures> SkyTextures::create(const scene::Scene& scene) {
  Result<gl::Program> program =
      gl::Program::create("graphics/render/whole_screen.vert", "graphics/light/sky.frag");
  if (!program) return program.errors();
  render::assign_bindings(*program);
  return SkyTextures(scene, *std::move(program));
}

SkyTextures::SkyTextures(const scene::Scene& scene, gl::Program program)
    : source_(source_of(scene.sky)),
      light_(shading::make_sky_light(scene.sky.picture, scene.sky.intensity, scene.sky.heading)),
      heights_(visible_heights(scene)),
      visibility_(shading::make_sky_visibility(heights_, wall_light(scene))),
      program_(std::move(program)),
      picture_(upload(light_)),
      cells_(upload(visibility_)),
      no_attributes_(gl::VertexArray::create()) {
  program_.set("screen_depth", 0.0f);  // depth is reversed: the farthest
}

bool SkyTextures::renew_light(const scene::Sky& sky) {
  if (source_of(sky) == source_) return false;
  source_ = source_of(sky);
  light_ = shading::make_sky_light(sky.picture, sky.intensity, sky.heading);
  picture_ = upload(light_);
  return true;
}

void SkyTextures::renew_visibility(const scene::Scene& scene, const render::GpuScene& gpu,
                                   const render::FixedChange& change) {
  const Bounds& place = heights_.bounds();
  const auto reaches_out = [&](const Bounds& box) {
    return glm::any(glm::lessThan(box.min, place.min)) || glm::any(glm::greaterThan(box.max, place.max));
  };
  if (change.has_moved || std::ranges::any_of(change.come, reaches_out))
    heights_ = visible_heights(scene);
  else
    renew_heights(scene, gpu, heights_);
  std::vector<Bounds> changed = change.gone;
  changed.insert(changed.end(), change.come.begin(), change.come.end());
  for (const Bounds& region : render::united(std::move(changed), shading::sky_visibility_reach_m))
    shading::renew_sky_visibility(visibility_, heights_, region, wall_light(scene));
  cells_ = upload(visibility_);
}

void SkyTextures::bind() const {
  glBindTextureUnit(render::sky_unit, picture_.name());
  glBindTextureUnit(render::sky_visibility_unit, cells_.name());
}

void SkyTextures::draw(const render::View& view) const {
  program_.use();
  program_.set("world_from_clip", glm::inverse(view.clip_from_world));
  program_.set("shows_sun", view.kind == render::ViewKind::main ? 1.0f : 0.0f);
  glBindVertexArray(no_attributes_.name());
  glDepthMask(GL_FALSE);
  glDisable(GL_CULL_FACE);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glDepthMask(GL_TRUE);
}

}  // namespace parvis::light

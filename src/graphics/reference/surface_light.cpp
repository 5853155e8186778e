#include "graphics/reference/surface_light.h"

#include <cmath>
#include <utility>

#include "graphics/reference/scene_lamps.h"
#include "graphics/shading/recorded_shadow.h"
#include "graphics/shading/sky.h"

namespace parvis::shading {
#include "graphics/shading/beyond_land.glsl"
}

namespace parvis::reference {

using glm::vec3, glm::vec4;
using shading::Surface;

namespace {

/// Irradiance on the viewer's side of a surface that is lit at its vertices, and on the other side.
std::pair<vec3, vec3> vertex_light(const scene::LitVertices& lit, const Hit& hit, bool is_back) {
  const scene::LitVertices::PartLight& part = lit.parts[std::size_t(hit.place->part)];
  const std::uint32_t* corner = hit.place->mesh->indices.data() + 3 * std::size_t(hit.triangle);
  const auto at = [&](const std::vector<vec3>& light) {
    return (1.0f - hit.u - hit.v) * light[corner[0]] + hit.u * light[corner[1]] + hit.v * light[corner[2]];
  };
  const vec3 front = at(part.front), behind = part.behind.empty() ? front : at(part.behind);
  return is_back ? std::pair(behind, front) : std::pair(front, behind);
}

}  // namespace

SurfaceLight::SurfaceLight(const RayScene& rays, const scene::Scene& scene, const shading::SkyLight& sky,
                           const shading::DrawnLight* drawn_light)
    : rays_(rays), sky_(sky), drawn_light_(drawn_light), sun_disc_(scene.sun) {
  light_.to_sun = glm::normalize(scene.sun.direction_to_sun);
  light_.sun_irradiance = scene.sun.irradiance;
  spot_ = scene.data<scene::SunShadows>().spot;
  lit_ = &scene.data<scene::VertexIrradiance>();
  for (std::size_t i = 0; i < 9; ++i) light_.sky_sh[i] = sky.irradiance_sh[i];
  light_.haze_radiance = sky.haze_radiance;
  light_.haze_per_m = scene.haze_per_m;
  if (!drawn_light_) own_lamps_ = shading::make_lamp_table(lit_lamps(scene));
  lamps_ = drawn_light_ ? drawn_light_->lamps : &own_lamps_;
}

vec3 SurfaceLight::behind_all(vec3 direction, bool is_direct) const {
  const bool sees_sun = is_direct && !spot_ && sun_disc_.contains(direction);
  const vec3 sky = sky_radiance(sky_, direction, 0.0f);
  return shading::beyond_land(sky, direction.z, light_.haze_per_m, light_.haze_radiance) +
         (sees_sun ? sun_disc_.radiance() : vec3(0.0f));
}

vec3 SurfaceLight::through_haze(vec3 radiance, float distance_m) const {
  return shading::through_haze(radiance, distance_m, light_.haze_per_m, light_.haze_radiance);
}

SunRay SurfaceLight::ray_to_sun(const ShadingPoint& point, const Hit& hit) const {
  const vec3 to_sun = to_sun_at(point.position);
  const Surface& s = point.surface;
  if (glm::dot(s.normal, to_sun) <= 0.0f && s.translucency <= 0.0f) return {0.0f, {}};
  float let_in = point.relief.light_from(to_sun);
  if (spot_) let_in *= shading::spot_share(glm::dot(to_sun, light_.to_sun), std::cos(spot_->half_angle));
  if (!hit.place->receives_shadow || let_in <= 0.0f) return {let_in, {}};
  if (drawn_light_ && !drawn_light_->has_exact_shadows)
    return {let_in *
                shading::sun_visibility(drawn_light_->shadow, point.position, point.geometric_normal, to_sun),
            {}};
  return {let_in, ray_to_sun_from(point, to_sun)};
}

float SurfaceLight::sun_visible(const ShadingPoint& point, const Hit& hit, std::uint64_t& ray_count) const {
  const SunRay sun = ray_to_sun(point, hit);
  if (!sun.ray) return sun.let_in;
  ++ray_count;
  return rays_.is_blocked(*sun.ray) ? 0.0f : sun.let_in;
}

/// Unit; of a spot light in the sun's place it differs from point to point.
vec3 SurfaceLight::to_sun_at(vec3 position) const {
  return spot_ ? glm::normalize(spot_->position - position) : light_.to_sun;
}

/// No farther than a spot light in the sun's place.
Ray SurfaceLight::ray_to_sun_from(const ShadingPoint& point, vec3 to_sun) const {
  Ray ray{point.position + 1e-3f * point.geometric_normal, to_sun};
  if (spot_) ray.max_m = glm::distance(spot_->position, ray.origin);
  return ray;
}

Surroundings SurfaceLight::surroundings_at(const ShadingPoint& point, int object) const {
  Surroundings around;
  if (!drawn_light_) return around;
  const shading::SkyVisibility& visibility = *drawn_light_->sky_visibility;
  const vec4 cell = visibility.at(
      shading::sky_visibility_coordinates(visibility.grid, point.position, point.geometric_normal));
  around.sky_cell =
      shading::shaded_cell(cell, shading::sky_share_beside_bodies(*drawn_light_->body_shade, point.position,
                                                                  point.geometric_normal, object));
  if (drawn_light_->bounced)
    around.bounced = drawn_light_->bounced->cell(point.position, point.geometric_normal);
  return around;
}

vec3 SurfaceLight::unmapped_radiance(const Surroundings& around, vec3 direction, float roughness) const {
  return shading::sky_share_of_direction(around.sky_cell, direction) *
             sky_radiance(sky_, direction, shading::sky_level(roughness, float(sky_.levels.size()))) +
         bounced_radiance(around.bounced, direction);
}

MirrorLight SurfaceLight::unmapped_light(const Surface& s, vec3 direction, const Surroundings& around,
                                         float openness) const {
  const vec3 mirrored = glm::reflect(direction, s.normal);
  const auto seen = [&](float roughness) {
    return openness * unmapped_radiance(around, mirrored, roughness);
  };
  return {seen(s.roughness), s.clear_coat > 0.0f ? seen(s.clear_coat_roughness) : vec3(0.0f)};
}

/// The share of a photograph's light that shadows of what it does not show leave.
float SurfaceLight::kept_of_recorded(const ShadingPoint& point, std::uint64_t& ray_count) const {
  const vec3 to_sun = to_sun_at(point.position);
  const float facing = glm::dot(point.geometric_normal, to_sun);
  if (facing <= 0.0f || light_.sun_irradiance == vec3(0.0f)) return 1.0f;
  const auto visible = [&] {
    if (drawn_light_ && !drawn_light_->has_exact_shadows)
      return shading::sun_visibility(drawn_light_->inserted_shadow, point.position, point.geometric_normal,
                                     to_sun);
    ++ray_count;
    return rays_.is_blocked_by_inserted(ray_to_sun_from(point, to_sun)) ? 0.0f : 1.0f;
  };
  return shading::kept_recorded_light(point.kept_in_shadow, facing, visible());
}

/// Radiance by lamps: by their depth maps, or by exact rays where those replace maps.
vec3 SurfaceLight::lamp_radiance_at(const ShadingPoint& point, const Surface& s, vec3 to_viewer,
                                    std::uint64_t& ray_count) const {
  if (!lamps_ || lamps_->empty()) return vec3(0.0f);
  const bool reads_maps = drawn_light_ && !drawn_light_->has_exact_shadows;
  const auto visible = [&](const shading::Lamp& lamp, vec3 position, vec3 normal) {
    if (reads_maps) return lamps_->visible(lamp, position, normal);
    ++ray_count;
    return rays_.is_blocked(ray_to_lamp(lamp, position, normal)) ? 0.0f : 1.0f;
  };
  shading::LampLookup lookup{*lamps_, visible};
  return shading::lamp_radiance(s, to_viewer,
                                lookup.lamp_light(s, point.position, point.geometric_normal, to_viewer));
}

vec3 SurfaceLight::radiance(const ShadingPoint& point, const Hit& hit, Surface s, vec3 to_viewer, float sun,
                            const Surroundings& around, const MirrorLight& mirrored,
                            std::uint64_t& ray_count) const {
  if (point.kept_in_shadow < 1.0f) s.emission *= kept_of_recorded(point, ray_count);
  shading::SceneLight light = light_;
  light.to_sun = to_sun_at(point.position);
  for (vec3& coefficient : light.sky_sh) coefficient *= around.bounced.sky;
  light.bounced = bounced_irradiance(around.bounced, s.normal);
  light.bounced_behind = bounced_irradiance(around.bounced, -s.normal);
  const vec3 by_lamps = lamp_radiance_at(point, s, to_viewer, ray_count);
  if (const scene::LitVertices* lit = lit_vertices(hit)) {
    const auto [before, behind] = vertex_light(*lit, hit, point.is_back);
    return by_lamps +
           vertex_lit_radiance(s, light, before, behind, to_viewer, sun, mirrored.base, mirrored.coat);
  }
  return by_lamps + lit_radiance(s, light, to_viewer, sun,
                                 shading::sky_share_of_normal(around.sky_cell, s.normal), mirrored.base,
                                 mirrored.coat);
}

}  // namespace parvis::reference

#include "graphics/reference/path_tracer.h"

#include <algorithm>
#include <cmath>

#include "base/colour.h"
#include "graphics/shading/glass.h"
#include "graphics/shading/recorded_shadow.h"

namespace parvis::reference {
namespace {

using glm::vec3;

constexpr float off_surface_m = 1e-3f;  // where rays begin, so that they do not meet where they come from
constexpr float max_survival = 0.95f;   // of a path at each bounce: even in a white room paths end
constexpr float min_cosine = 1e-3f;

/// Keeps a vector on the side of `normal`, where interpolated or mapped normals would turn it away.
vec3 clamped_above(vec3 vector, vec3 normal) {
  const float height = glm::dot(vector, normal);
  return height >= min_cosine ? vector : glm::normalize(vector + (min_cosine - height) * normal);
}

vec3 clamped(vec3 radiance, float maximum) {
  const float light = luminance(radiance);
  return light > maximum ? radiance * (maximum / light) : radiance;
}

}  // namespace

struct PathTracer::Path {
  Ray ray;
  float width_m = 0.0f, spread;
  SampleSequence& numbers;
  Passage passage;
  vec3 throughput{1.0f};
  float density = 0.0f;  // with which the ray's direction was chosen; 0: it is the camera's, or a mirror's
  std::uint64_t ray_count = 0;
  bool meets_scene = false;
};

PathTracer::PathTracer(const RayScene& rays, const scene::Scene& scene, const shading::SkyLight& sky,
                       const PathOptions& options)
    : rays_(rays),
      sky_(sky),
      sun_(scene.sun),
      sky_sampler_(sky),
      lamps_(shading::make_lamp_table(lit_lamps(scene))),
      haze_per_m_(scene.haze_per_m),
      options_(options) {}

/// The weight of light found by one strategy, where another finds it with `other_density`.
float PathTracer::weight(float density, float other_density, bool is_chosen_light) const {
  if (options_.strategy == LightStrategy::chosen_lights) return is_chosen_light ? 1.0f : 0.0f;
  if (options_.strategy == LightStrategy::scattered_rays) return is_chosen_light ? 0.0f : 1.0f;
  const float ratio = other_density / density;
  return 1.0f / (1.0f + ratio * ratio);
}

/// The radiance along a ray that hits nothing: sun and sky.
vec3 PathTracer::surroundings(const Path& path) const {
  const vec3 direction = path.ray.direction;
  const bool is_shared = path.density > 0.0f;  // chosen lights find it, too
  vec3 light(0.0f);
  if (sky_sampler_.shines()) {
    const glm::vec2 uv = shading::equirect_uv(direction, sky_.heading);
    light += shading::sky_picture_at(sky_, uv) *
             (is_shared ? weight(path.density, sky_sampler_.density(uv), false) : 1.0f);
  }
  if (sun_.shines() && sun_.contains(direction))
    light += sun_.radiance() * (is_shared ? weight(path.density, SunDisc::density(), false) : 1.0f);
  return light;
}

/// Light from a direction that was chosen with `density`, if nothing stands in the way.
vec3 PathTracer::light_from(vec3 direction, vec3 radiance, float density, const ShadingPoint& point,
                            const Scatter& scatter, Path& path) const {
  const float side = glm::dot(point.geometric_normal, direction);
  if (side * glm::dot(point.surface.normal, direction) <= 0.0f) return vec3(0.0f);
  const vec3 contribution =
      scatter.share(direction) * radiance *
      (point.relief.light_from(direction) * weight(density, scatter.pdf(direction), true) / density);
  if (!(contribution.x + contribution.y + contribution.z > 0.0f)) return vec3(0.0f);
  ++path.ray_count;
  const vec3 origin = point.position + std::copysign(off_surface_m, side) * point.geometric_normal;
  return rays_.is_blocked({origin, direction}, path.passage) ? vec3(0.0f) : contribution;
}

/// Sun and sky at a surface, each by one ray.
vec3 PathTracer::light_at(const ShadingPoint& point, const Scatter& scatter, Path& path) const {
  vec3 light(0.0f);
  const glm::vec2 on_sun = path.numbers.next_2d(), on_sky = path.numbers.next_2d();
  if (sun_.shines())
    light += light_from(sun_.direction(on_sun), sun_.radiance(), SunDisc::density(), point, scatter, path);
  if (sky_sampler_.shines()) {
    const SkySampler::Choice chosen = sky_sampler_.choose(on_sky);
    light += light_from(chosen.direction, shading::sky_picture_at(sky_, chosen.uv), chosen.density, point,
                        scatter, path);
  }
  return light;
}

/// Every lamp that reaches a surface, by one ray each; and the glass of those that it belongs to, where the
/// path could not have found that light at the surface before.
vec3 PathTracer::lamps_at(const ShadingPoint& point, const Scatter& scatter, Path& path) const {
  vec3 light(0.0f);
  lamps_.for_each_near(point.position, [&](std::size_t number) {
    const shading::Lamp& lamp = lamps_.lamps[number];
    const vec3 away = vec3(lamp.place) - point.position;
    const float distance_m = std::max(glm::length(away), 1e-3f);
    const vec3 to_lamp = away / distance_m;
    if (path.density == 0.0f) light += shading::lamp_glow(lamp, distance_m);
    const float side = glm::dot(point.geometric_normal, to_lamp);
    if (side * glm::dot(point.surface.normal, to_lamp) <= 0.0f) return;
    const vec3 contribution = scatter.share(to_lamp) * shading::lamp_irradiance(lamp, to_lamp, distance_m);
    if (!(contribution.x + contribution.y + contribution.z > 0.0f)) return;
    ++path.ray_count;
    const Ray ray = ray_to_lamp(lamp, point.position, std::copysign(1.0f, side) * point.geometric_normal);
    if (!rays_.is_blocked(ray, path.passage)) light += contribution;
  });
  return light;
}

/// The share of a photograph's light that shadows of what it does not show leave: as the renderer has it, but
/// with the sun's disc in place of its middle.
float PathTracer::kept_of_recorded(const ShadingPoint& point, Path& path) const {
  if (!sun_.shines()) return 1.0f;
  const vec3 to_sun = sun_.direction(path.numbers.next_2d());
  const float facing = glm::dot(point.geometric_normal, to_sun);
  if (facing <= 0.0f) return 1.0f;
  ++path.ray_count;
  const vec3 origin = point.position + off_surface_m * point.geometric_normal;
  const float visible = rays_.is_blocked_by_inserted({origin, to_sun}, path.passage) ? 0.0f : 1.0f;
  return shading::kept_recorded_light(point.kept_in_shadow, facing, visible);
}

/// Chooses where the path goes on; false where it ends.
bool PathTracer::extend_path(const ShadingPoint& point, const Scatter& scatter, float width_m,
                             Path& path) const {
  const glm::vec2 choices = path.numbers.next_2d();
  std::optional<Scatter::BsdfSample> sample = scatter.sample(choices.x, path.numbers.next_2d());
  if (!sample) return false;
  const bool is_mirror = sample->pdf == 0.0f;
  if (is_mirror) sample->direction = clamped_above(sample->direction, point.geometric_normal);
  const float side = glm::dot(point.geometric_normal, sample->direction);
  if (side * glm::dot(point.surface.normal, sample->direction) <= 0.0f) return false;
  path.throughput *= sample->weight * point.relief.light_from(sample->direction);
  const float survival =
      std::min(max_survival, std::max({path.throughput.x, path.throughput.y, path.throughput.z}));
  if (!(choices.y < survival)) return false;
  path.throughput /= survival;
  path.ray = {point.position + std::copysign(off_surface_m, side) * point.geometric_normal,
              sample->direction};
  path.density = sample->pdf;
  path.width_m = width_m;
  path.spread += sample->spread + (is_mirror ? 2.0f * point.curvature_per_m * width_m : 0.0f);
  path.passage.sees_backs = true;
  path.passage.passes_backdrops = !is_mirror;  // as the rays that chosen lights send: both find the same
  return true;
}

/// Reflects or refracts the path at solid glass, at random in proportion to the light; false where it
/// ends.
bool PathTracer::passes_glass(const ShadingPoint& point, float ior, float width_m, Path& path) const {
  const vec3 normal = point.surface.normal, before = path.ray.direction;
  const vec3 refracted = shading::refracted(before, normal, point.is_back ? ior : 1.0f / ior);
  const vec3 outside = point.is_back ? refracted : before;
  const float reflected =
      refracted == vec3(0.0f) ? 1.0f : shading::inner_reflectance(ior, -glm::dot(outside, normal));
  const glm::vec2 choices = path.numbers.next_2d();
  if (!(choices.y < max_survival)) return false;
  path.throughput /= max_survival;
  const bool reflects = choices.x < reflected;
  const vec3 after =
      reflects ? clamped_above(glm::reflect(before, normal), point.geometric_normal) : refracted;
  path.ray = {point.position + (reflects ? off_surface_m : -off_surface_m) * point.geometric_normal, after};
  path.density = 0.0f;  // as a mirror's
  path.width_m = width_m;
  path.passage.sees_backs = true;
  path.passage.passes_backdrops = false;
  return true;
}

PathTracer::Sample PathTracer::sample(const Ray& ray, float spread, SampleSequence& numbers,
                                      std::uint64_t chance_seed) const {
  Path path{.ray = ray, .spread = spread, .numbers = numbers, .passage = {Random(chance_seed), false}};
  vec3 first_light(0.0f), later_light(0.0f);  // up to the first surface, with what it scatters; from beyond
  int bounce = 0;
  for (;; ++bounce) {
    vec3& light = bounce == 0 ? first_light : later_light;
    ++path.ray_count;
    const std::optional<Hit> hit = rays_.nearest_hit(path.ray, path.passage);
    if (!hit) {
      light += path.throughput * surroundings(path);
      break;
    }
    path.meets_scene = true;
    const vec3 black(0.0f);
    light += path.throughput * shading::through_haze(black, hit->distance_m, haze_per_m_, sky_.haze_radiance);
    path.throughput *= std::exp(-haze_per_m_ * hit->distance_m);

    const float width_m = path.width_m + path.spread * hit->distance_m;
    ShadingPoint point = shading_point(*hit, path.ray.direction, width_m);
    point.surface.normal = clamped_above(point.surface.normal, -path.ray.direction);
    if (point.kept_in_shadow < 1.0f) point.surface.emission *= kept_of_recorded(point, path);
    light += path.throughput * point.surface.emission;
    if (options_.bounces && bounce >= *options_.bounces) break;
    if (const scene::Material& glass = *hit->place->material; glass.refracts()) {
      if (point.is_back) path.throughput *= glm::exp(-hit->distance_m * glass.absorption_per_m);
      if (!passes_glass(point, glass.ior, width_m, path)) break;
      continue;
    }
    const Scatter scatter(point.surface, -path.ray.direction);
    if (!lamps_.empty()) light += path.throughput * lamps_at(point, scatter, path);
    if (scatter.spreads()) light += path.throughput * light_at(point, scatter, path);
    if (!extend_path(point, scatter, width_m, path)) break;
  }
  if (options_.clamp) later_light = clamped(later_light, *options_.clamp);
  return {first_light + later_light, path.meets_scene, path.ray_count};
}

}  // namespace parvis::reference

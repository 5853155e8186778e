#include "graphics/reference/pixel_tracer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/colour.h"
#include "scene/data/realism.h"

namespace parvis::reference {

using glm::vec3;
using shading::Surface;

namespace {

constexpr float sharp_roughness = 0.1f;   // below it one mirror ray stands for the lobe
constexpr float weak_reflectance = 0.1f;  // of a base: below it noise in what it mirrors hardly shows
constexpr int max_blended_layers = 8;
constexpr float drawn_error_m = 0.02f, drawn_error_px = 3.0f;  // of coarser meshes that are drawn far away

/// Keeps a reflected ray above the surface, where interpolated normals would send it below.
vec3 clamped_above(vec3 direction, vec3 normal) {
  const float height = glm::dot(direction, normal);
  return height > 1e-3f ? direction : glm::normalize(direction + (1e-3f - height) * normal);
}

/// A unit direction turned by small tangents across it.
vec3 beside(vec3 direction, glm::vec2 tangents) {
  const vec3 right =
      glm::normalize(glm::cross(direction, std::abs(direction.z) < 0.9f ? vec3(0, 0, 1) : vec3(1, 0, 0)));
  return glm::normalize(direction + tangents.x * right + tangents.y * glm::cross(right, direction));
}

/// Where a ray goes on behind a hit.
float past(float distance_m) { return distance_m * (1.0f + 1e-5f) + 1e-4f; }

/// A ray to a drawn pixel, no longer than where it was drawn or a finer mesh may lie.
Ray ray_to(const MirrorPixel& pixel, vec3 eye, float spread) {
  const float distance_m = glm::distance(eye, pixel.position);
  const float within_m = drawn_error_m + drawn_error_px * spread * distance_m;
  Ray ray{eye, beside((pixel.position - eye) / distance_m, spread * pixel.offset_px)};
  ray.min_m = std::max(distance_m - within_m, ray.min_m), ray.max_m = distance_m + within_m;
  return ray;
}

}  // namespace

/// The first hit of a ray of a packet, made ready for shading.
struct PixelTracer::FirstHit {
  bool is_known = false;
  std::optional<Hit> hit;  ///< none: the sky
  ShadingPoint point = {};
  float sun = 0.0f;  ///< share of it that is seen at the point
};

/// A mirror-like surface that a cone sees, and what it shows.
struct PixelTracer::MirrorPoint {
  ShadingPoint point;
  Hit hit;
  Cone cone;  ///< widened to the hit
  LobePoints* lobe_points;
  int base_rays = lobe_samples;
  MirrorLight light = {};

  bool is_sharp() const { return point.surface.roughness <= sharp_roughness; }
};

/// A mirror ray.
struct PixelTracer::MirrorRay {
  MirrorPoint* mirror;
  Cone cone;
};

PixelTracer::PixelTracer(const RayScene& rays, const scene::Scene& scene, const shading::SkyLight& sky,
                         const TraceOptions& options)
    : rays_(rays),
      light_(rays, scene, sky, options.drawn_light),
      mirror_bounces_(options.mirror_bounces),
      mirrors_see_themselves_(options.mirrors_see_themselves),
      realism_(shading::realism_at(scene.data<scene::Realism>().level)) {}

vec3 PixelTracer::radiance(const Cone& cone, LobePoints& lobe_points, std::uint64_t& ray_count,
                           bool& is_mirror) const {
  return followed(cone, 0, -1, lobe_points, ray_count, &is_mirror, {});
}

/// Light that comes along a cone; `hidden_object` (or -1) is passed through. `first`: what the cone's ray
/// hits first, where that is known.
vec3 PixelTracer::followed(Cone cone, int bounce, int hidden_object, LobePoints& lobe_points,
                           std::uint64_t& ray_count, bool* is_mirror, const FirstHit& first) const {
  vec3 sum(0.0f);
  float left = 1.0f;  // what blended layers in front let through
  for (int layer = 0; layer < max_blended_layers; ++layer) {
    ++ray_count;
    const bool is_known = layer == 0 && first.is_known;
    const std::optional<Hit> hit = is_known ? first.hit : nearest_hit_but(cone.ray, hidden_object);
    if (!hit) return sum + left * light_.behind_all(cone.ray.direction, bounce == 0);
    const Cone seen = widened(cone, hit->distance_m);
    const ShadingPoint point =
        is_known ? first.point : shading_point(*hit, cone.ray.direction, seen.width_m, realism_);
    const bool blends = hit->place->material->alpha_mode == scene::Alpha::blend;
    const float alpha = blends && layer + 1 < max_blended_layers ? point.alpha : 1.0f;
    if (is_mirror && layer == 0) *is_mirror = hit->place->is_mirror;
    const float sun = is_known ? first.sun : light_.sun_visible(point, *hit, ray_count);
    const vec3 shaded = shade(point, *hit, seen, bounce, sun, lobe_points, ray_count);
    sum += left * alpha * light_.through_haze(shaded, hit->distance_m);
    left *= 1.0f - alpha;
    if (left < 1e-3f) break;
    cone.ray.min_m = past(hit->distance_m);
  }
  return sum;
}

/// `sun`: share of it that is seen.
vec3 PixelTracer::shade(const ShadingPoint& point, const Hit& hit, const Cone& cone, int bounce, float sun,
                        LobePoints& lobe_points, std::uint64_t& ray_count) const {
  Surface s = point.surface;
  if (!light_.lit_vertices(hit)) s.occlusion *= point.openness;  // light of vertices has it already
  const vec3 to_viewer = -cone.ray.direction;
  const bool traces = hit.place->is_mirror && bounce < mirror_bounces_;
  const Surroundings around = light_.surroundings_at(point, hit.place->object);
  const MirrorLight mirrored = traces ? mirror_light(point, hit, cone, bounce, lobe_points, ray_count)
                                      : light_.unmapped_light(s, cone.ray.direction, around, point.openness);
  if (hit.place->material->refracts()) {
    const vec3 ahead = cone.ray.direction;
    const vec3 through = traces ? light_through(point, hit, cone, bounce, lobe_points, ray_count)
                                : light_.unmapped_radiance(around, ahead, 0.0f);
    s.emission +=
        (vec3(1.0f) - base_reflectance(s, std::clamp(glm::dot(s.normal, to_viewer), 1e-4f, 1.0f))) * through;
  }
  return light_.radiance(point, hit, s, to_viewer, sun, around, mirrored, ray_count);
}

/// Light that enters the eye through solid glass at a point of its surface.
vec3 PixelTracer::light_through(const ShadingPoint& point, const Hit& hit, const Cone& cone, int bounce,
                                LobePoints& lobe_points, std::uint64_t& ray_count) const {
  vec3 sum(0.0f);
  for (const GlassExit& exit : glass_exits(rays_, hit, point, cone)) {
    ++ray_count;
    sum +=
        exit.share * followed(exit.cone, bounce + 1, hidden_from(hit), lobe_points, ray_count, nullptr, {});
  }
  return sum;
}

/// Traces a mirror ray of each mirror for which `direction_of` names a direction, and has `take` take what
/// it shows.
template <class DirectionOf, class Take>
void PixelTracer::trace_from(std::span<MirrorPoint> mirrors, int bounce, std::uint64_t& ray_count,
                             const DirectionOf& direction_of, const Take& take) const {
  std::array<MirrorRay, RayScene::packet_size> rays;
  std::size_t count = 0;
  for (MirrorPoint& mirror : mirrors)
    if (const std::optional<vec3> direction = direction_of(mirror))
      rays[count++] = {&mirror, mirrored_cone(mirror, *direction)};
  const auto follow = [&](const MirrorRay& ray, const FirstHit& first) {
    MirrorPoint& mirror = *ray.mirror;
    take(mirror, followed(ray.cone, bounce + 1, hidden_from(mirror.hit), *mirror.lobe_points, ray_count,
                          nullptr, first));
  };
  if (count == 1) return follow(rays[0], {});
  std::array<FirstHit, RayScene::packet_size> first;
  look_ahead(std::span<const MirrorRay>(rays.data(), count), first, ray_count);
  for (std::size_t i = 0; i < count; ++i) follow(rays[i], first[i]);
}

/// Finds the light of base and coat of mirror-like surfaces by mirror rays: those of a packet of surfaces
/// that lie side by side run alike.
void PixelTracer::find_mirror_light(std::span<MirrorPoint> mirrors, int bounce,
                                    std::uint64_t& ray_count) const {
  int max_base_rays = 0;
  trace_from(
      mirrors, bounce, ray_count,
      [&](MirrorPoint& m) -> std::optional<vec3> {
        const Surface& s = m.point.surface;
        if (!m.is_sharp()) max_base_rays = std::max(max_base_rays, m.base_rays);
        if (s.clear_coat <= 0.0f && !m.is_sharp()) return std::nullopt;
        return glm::reflect(m.cone.ray.direction, s.normal);
      },
      [](MirrorPoint& m, vec3 light) { m.light.coat = light; });
  for (MirrorPoint& m : mirrors) m.light.base = m.is_sharp() || m.base_rays == 0 ? m.light.coat : vec3(0.0f);
  for (int i = 0; i < max_base_rays; ++i)
    trace_from(
        mirrors, bounce, ray_count,
        [&](MirrorPoint& m) -> std::optional<vec3> {
          const Surface& s = m.point.surface;
          if (m.is_sharp() || i >= m.base_rays) return std::nullopt;
          return glm::reflect(m.cone.ray.direction,
                              ggx_half_vector(s.normal, s.roughness, m.lobe_points->next(bounce)));
        },
        [](MirrorPoint& m, vec3 light) { m.light.base += light / float(m.base_rays); });
}

/// The light of one mirror-like surface.
MirrorLight PixelTracer::mirror_light(const ShadingPoint& point, const Hit& hit, const Cone& cone, int bounce,
                                      LobePoints& lobe_points, std::uint64_t& ray_count) const {
  MirrorPoint mirror{point, hit, cone, &lobe_points};
  find_mirror_light(std::span(&mirror, 1), bounce, ray_count);
  return mirror.light;
}

/// Finds what a packet of mirror rays hits first, and whether the sun shines there.
void PixelTracer::look_ahead(std::span<const MirrorRay> mirror_rays, std::span<FirstHit> first,
                             std::uint64_t& ray_count) const {
  std::array<Ray, RayScene::packet_size> rays, to_sun;
  std::array<std::optional<Hit>, RayScene::packet_size> hits;
  std::array<FirstHit*, RayScene::packet_size> lit;
  const std::size_t count = mirror_rays.size();
  for (std::size_t i = 0; i < count; ++i) rays[i] = mirror_rays[i].cone.ray;
  rays_.nearest_hits(std::span<const Ray>(rays.data(), count), {}, hits);
  std::size_t sun_rays = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::optional<Hit>& hit = hits[i];
    if (hit && hit->place->object == hidden_from(mirror_rays[i].mirror->hit)) continue;  // goes on behind it
    first[i].is_known = true, first[i].hit = hit;
    if (!hit) continue;
    const Cone seen = widened(mirror_rays[i].cone, hit->distance_m);
    first[i].point = shading_point(*hit, seen.ray.direction, seen.width_m, realism_);
    const SunRay sun = light_.ray_to_sun(first[i].point, *hit);
    first[i].sun = sun.let_in;
    if (sun.ray) to_sun[sun_rays] = *sun.ray, lit[sun_rays++] = &first[i];
  }
  ray_count += sun_rays;
  const std::uint32_t blocked = rays_.are_blocked(std::span<const Ray>(to_sun.data(), sun_rays), {});
  for (std::size_t k = 0; k < sun_rays; ++k)
    if ((blocked >> k & 1u) != 0) lit[k]->sun = 0.0f;
}

/// The mirror that a drawn pixel shows, with its sharp share.
PixelTracer::MirrorPoint PixelTracer::mirror_in(const MirrorPixel& pixel, const Cone& cone,
                                                const Hit& hit) const {
  const Cone seen = widened(cone, hit.distance_m);
  MirrorPoint mirror{shading_point(hit, cone.ray.direction, seen.width_m, realism_), hit, seen, nullptr};
  const Surface& s = mirror.point.surface;
  const float n_dot_v = std::clamp(-glm::dot(s.normal, cone.ray.direction), 1e-4f, 1.0f);
  const float base = luminance(base_reflectance(s, n_dot_v)), coat = fresnel_of_coat(s, n_dot_v);
  mirror.light.has_weak_base = base < weak_reflectance;
  mirror.base_rays = mirror.light.has_weak_base ? pixel.weak_base_rays : pixel.base_rays;
  mirror.light.sharp_share = coat + (mirror.is_sharp() ? (1.0f - coat) * base : 0.0f);
  return mirror;
}

/// The cone of a mirror ray in this direction.
Cone PixelTracer::mirrored_cone(const MirrorPoint& mirror, vec3 direction) {
  const ShadingPoint& point = mirror.point;
  const vec3 away = clamped_above(direction, point.geometric_normal);
  // A curved mirror turns the two sides of a cone apart by twice the angle between their normals.
  const float spread = mirror.cone.spread + 2.0f * point.curvature_per_m * mirror.cone.width_m;
  return {{point.position + 1e-3f * point.geometric_normal, away}, mirror.cone.width_m, spread};
}

void PixelTracer::find_light_of_mirrors(std::span<const MirrorPixel> pixels, vec3 eye, float spread,
                                        std::span<std::optional<MirrorLight>> light) const {
  std::array<Ray, RayScene::packet_size> rays;
  std::array<std::optional<Hit>, RayScene::packet_size> hits;
  for (std::size_t i = 0; i < pixels.size(); ++i) rays[i] = ray_to(pixels[i], eye, spread);
  rays_.nearest_hits(std::span<const Ray>(rays.data(), pixels.size()), {}, hits);
  std::vector<MirrorPoint> mirrors;
  std::array<LobePoints, RayScene::packet_size> lobe_points;
  std::array<std::size_t, RayScene::packet_size> pixel_of;
  mirrors.reserve(pixels.size());
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    light[i].reset();
    const std::optional<Hit> hit = mirror_near(rays[i], hits[i], pixels[i].object);
    if (!hit) continue;
    MirrorPoint& mirror = mirrors.emplace_back(mirror_in(pixels[i], {rays[i], 0.0f, spread}, *hit));
    const std::size_t number = mirrors.size() - 1;
    lobe_points[number] = LobePoints::in_tile(
        pixels[i], mirror.base_rays, mirror.light.has_weak_base ? weak_mirror_tile_px : mirror_tile_px);
    mirror.lobe_points = &lobe_points[number];
    pixel_of[number] = i;
  }
  std::uint64_t ray_count = 0;
  find_mirror_light(mirrors, 0, ray_count);
  for (std::size_t k = 0; k < mirrors.size(); ++k) light[pixel_of[k]] = mirrors[k].light;
}

/// The first mirror-like surface of `object` along a ray; `hit`: the first of all surfaces.
std::optional<Hit> PixelTracer::mirror_near(Ray ray, std::optional<Hit> hit, int object) const {
  while (hit && (hit->place->object != object || !hit->place->is_mirror)) {
    ray.min_m = past(hit->distance_m);
    if (ray.min_m >= ray.max_m) return std::nullopt;
    hit = rays_.nearest_hit(ray);
  }
  return hit;
}

std::optional<Hit> PixelTracer::nearest_hit_but(Ray ray, int hidden_object) const {
  std::optional<Hit> hit = rays_.nearest_hit(ray);
  while (hit && hit->place->object == hidden_object) {
    ray.min_m = past(hit->distance_m);
    hit = rays_.nearest_hit(ray);
  }
  return hit;
}

}  // namespace parvis::reference

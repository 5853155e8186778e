#include "graphics/reference/tracer.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <chrono>
#include <cmath>
#include <numeric>

#include "base/colour.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "base/random.h"
#include "base/sealed_file.h"
#include "graphics/reference/camera_ray.h"
#include "graphics/reference/glass_walk.h"
#include "graphics/reference/scene_lamps.h"
#include "graphics/reference/shading_point.h"
#include "graphics/reference/sun_disc.h"
#include "graphics/shading/lighting.h"
#include "graphics/shading/recorded_shadow.h"
#include "graphics/shading/tone_curve.h"
#include "machines/divided_work.h"
#include "scene/data/sun_shadows.h"
#include "scene/data/vertex_irradiance.h"

namespace parvis::reference {
namespace {

using glm::vec3, glm::vec4;
using shading::Surface;

constexpr float sharp_roughness = 0.1f;   // below it one mirror ray stands for the lobe
constexpr float weak_reflectance = 0.1f;  // of a base: below it noise in what it mirrors hardly shows
constexpr int max_blended_layers = 8;
constexpr float drawn_error_m = 0.02f, drawn_error_px = 3.0f;  // of coarser meshes that are drawn far away

/// Keeps a reflected ray above the surface, where interpolated normals would send it below.
vec3 kept_above(vec3 direction, vec3 normal) {
  const float height = glm::dot(direction, normal);
  return height > 1e-3f ? direction : glm::normalize(direction + (1e-3f - height) * normal);
}

/// Points of the unit square for the lobe rays of one pixel, each far from those before it: the R2 sequence
/// (Roberts 2018), begun elsewhere in each pixel and at each bounce. Its noise is a fraction of that of
/// chance.
struct LobePoints {
  std::array<glm::vec2, 2> last;  ///< by bounce; none goes on from the second

  glm::vec2 next(int bounce) {
    glm::vec2& point = last[std::size_t(bounce)];
    return point = glm::fract(point + step);
  }
  /// The points of one pixel of a drawn picture that takes `rays` of them: those of a square of `tile_px`
  /// pixels go on from each other.
  static LobePoints in_tile(const MirrorPixel& pixel, int rays, int tile_px) {
    const int turn = pixel.x % tile_px + tile_px * (pixel.y % tile_px);
    const glm::vec2 first = glm::fract(float(turn * rays) * step);
    return {{first, first}};
  }
  /// Passes over what so many samples of the pixel would take.
  void skip(int samples) {
    for (glm::vec2& point : last) point = glm::fract(point + float(samples * lobe_samples) * step);
  }

 private:
  static constexpr glm::vec2 step{0.75487767f, 0.56984029f};
};

/// A half vector of the GGX distribution about `normal`, by a point of the unit square.
vec3 ggx_half_vector(vec3 normal, float roughness, glm::vec2 point) {
  const float alpha = roughness * roughness, u = point.x, phi = 6.2831853f * point.y;
  const float cosine = std::sqrt((1.0f - u) / (1.0f + (alpha * alpha - 1.0f) * u));
  const float sine = std::sqrt(std::max(0.0f, 1.0f - cosine * cosine));
  const vec3 t =
      glm::normalize(glm::cross(std::abs(normal.z) < 0.9f ? vec3(0, 0, 1) : vec3(1, 0, 0), normal));
  return sine * std::cos(phi) * t + sine * std::sin(phi) * glm::cross(normal, t) + cosine * normal;
}

/// A unit direction turned by small tangents across it.
vec3 beside(vec3 direction, glm::vec2 tangents) {
  const vec3 right =
      glm::normalize(glm::cross(direction, std::abs(direction.z) < 0.9f ? vec3(0, 0, 1) : vec3(1, 0, 0)));
  return glm::normalize(direction + tangents.x * right + tangents.y * glm::cross(right, direction));
}

/// Where a ray goes on behind a hit.
float past(float distance_m) { return distance_m * (1.0f + 1e-5f) + 1e-4f; }

/// Light about a place, where no ray is traced for it: by default an open sky alone.
struct Surroundings {
  vec4 sky_cell{0.5f, 0.5f, 0.5f, 1.0f};  ///< shading/sky_visibility.glsl
  shading::BouncedCell bounced{vec4(0.0f), vec3(0.0f)};
};

/// A ray toward the sun, where one decides whether it is seen.
struct SunRay {
  float let_in;  ///< of the sun, where nothing blocks the ray; where there is none, all that is known
  std::optional<Ray> ray;
};

/// What a ray of a packet hits first, made ready for shading.
struct FirstHit {
  bool is_known = false;
  std::optional<Hit> hit;  ///< none: the sky
  ShadingPoint point = {};
  float sun = 0.0f;  ///< share of it that is seen at the point
};

/// A mirror-like surface that a cone sees, and what it shows.
struct MirrorPoint {
  ShadingPoint point;
  Hit hit;
  Cone cone;  ///< widened to the hit
  LobePoints* lobe_points;
  int base_rays = lobe_samples;
  MirrorLight light = {};

  bool is_sharp() const { return point.surface.roughness <= sharp_roughness; }
};

/// A mirror ray.
struct MirrorRay {
  MirrorPoint* mirror;
  Cone cone;
};

/// Follows the rays of one pixel, or of a packet of pixels.
class Tracer {
 public:
  Tracer(const RayScene& rays, const scene::Scene& scene, const shading::SkyLight& sky,
         const TraceOptions& options)
      : rays_(rays),
        sky_(sky),
        drawn_light_(options.drawn_light),
        sun_disc_(scene.sun),
        mirror_bounces_(options.mirror_bounces),
        mirrors_see_themselves_(options.mirrors_see_themselves) {
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

  /// Light that comes along a cone; `hidden_object` (or -1) is passed through.
  /// `first`: what the cone's ray hits first, where that is known.
  vec3 radiance(Cone cone, int bounce, int hidden_object, LobePoints& lobe_points, std::uint64_t& ray_count,
                bool* is_mirror, const FirstHit& first = {}) const {
    vec3 sum(0.0f);
    float left = 1.0f;  // what blended layers in front let through
    for (int layer = 0; layer < max_blended_layers; ++layer) {
      ++ray_count;
      const bool is_known = layer == 0 && first.is_known;
      const std::optional<Hit> hit = is_known ? first.hit : nearest_hit_but(cone.ray, hidden_object);
      if (!hit) {
        const bool sees_sun = bounce == 0 && !spot_ && sun_disc_.contains(cone.ray.direction);
        return sum + left * (sky_radiance(sky_, cone.ray.direction, 0.0f) +
                             (sees_sun ? sun_disc_.radiance() : vec3(0.0f)));
      }
      const Cone seen = widened(cone, hit->distance_m);
      const ShadingPoint point =
          is_known ? first.point : shading_point(*hit, cone.ray.direction, seen.width_m);
      const bool blends = hit->place->material->alpha_mode == scene::Alpha::blend;
      const float alpha = blends && layer + 1 < max_blended_layers ? point.alpha : 1.0f;
      if (is_mirror && layer == 0) *is_mirror = hit->place->is_mirror;
      const float sun = is_known ? first.sun : sun_visible(point, *hit, ray_count);
      const vec3 shaded = shade(point, *hit, seen, bounce, sun, lobe_points, ray_count);
      sum += left * alpha *
             shading::through_haze(shaded, hit->distance_m, light_.haze_per_m, light_.haze_radiance);
      left *= 1.0f - alpha;
      if (left < 1e-3f) break;
      cone.ray.min_m = past(hit->distance_m);
    }
    return sum;
  }

  /// What the base and the coat of mirror-like surfaces show, by mirror rays: those of a packet of surfaces
  /// that lie side by side run alike.
  void find_mirror_light(std::span<MirrorPoint> mirrors, int bounce, std::uint64_t& ray_count) const {
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
    for (MirrorPoint& m : mirrors)
      m.light.base = m.is_sharp() || m.base_rays == 0 ? m.light.coat : vec3(0.0f);
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

  /// What mirrors show in drawn pixels that lie side by side, at most RayScene::packet_size of them.
  void find_light_of_mirrors(std::span<const MirrorPixel> pixels, vec3 eye, float spread,
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

 private:
  /// What one mirror-like surface shows.
  MirrorLight mirror_light(const ShadingPoint& point, const Hit& hit, const Cone& cone, int bounce,
                           LobePoints& lobe_points, std::uint64_t& ray_count) const {
    MirrorPoint mirror{point, hit, cone, &lobe_points};
    find_mirror_light(std::span(&mirror, 1), bounce, ray_count);
    return mirror.light;
  }

  /// To a drawn pixel, no longer than where it was drawn or a finer mesh may lie.
  static Ray ray_to(const MirrorPixel& pixel, vec3 eye, float spread) {
    const float distance_m = glm::distance(eye, pixel.position);
    const float within_m = drawn_error_m + drawn_error_px * spread * distance_m;
    Ray ray{eye, beside((pixel.position - eye) / distance_m, spread * pixel.offset_px)};
    ray.min_m = std::max(distance_m - within_m, ray.min_m), ray.max_m = distance_m + within_m;
    return ray;
  }

  /// The mirror that a drawn pixel shows, with its sharp share.
  static MirrorPoint mirror_in(const MirrorPixel& pixel, const Cone& cone, const Hit& hit) {
    const Cone seen = widened(cone, hit.distance_m);
    MirrorPoint mirror{shading_point(hit, cone.ray.direction, seen.width_m), hit, seen, nullptr};
    const Surface& s = mirror.point.surface;
    const float n_dot_v = std::clamp(-glm::dot(s.normal, cone.ray.direction), 1e-4f, 1.0f);
    const float base = luminance(base_reflectance(s, n_dot_v)), coat = fresnel_of_coat(s, n_dot_v);
    mirror.light.has_weak_base = base < weak_reflectance;
    mirror.base_rays = mirror.light.has_weak_base ? pixel.weak_base_rays : pixel.base_rays;
    mirror.light.sharp_share = coat + (mirror.is_sharp() ? (1.0f - coat) * base : 0.0f);
    return mirror;
  }

  /// Of a mirror ray in this direction.
  static Cone mirrored_cone(const MirrorPoint& mirror, vec3 direction) {
    const ShadingPoint& point = mirror.point;
    const vec3 away = kept_above(direction, point.geometric_normal);
    // A curved mirror turns the two sides of a cone apart by twice the angle between their normals.
    const float spread = mirror.cone.spread + 2.0f * point.curvature_per_m * mirror.cone.width_m;
    return {{point.position + 1e-3f * point.geometric_normal, away}, mirror.cone.width_m, spread};
  }

  int hidden_from(const MirrorPoint& mirror) const {
    return mirrors_see_themselves_ ? -1 : mirror.hit.place->object;
  }

  /// Traces a mirror ray of each mirror for which `direction_of` names a direction, and has `take` take what
  /// it shows.
  template <class DirectionOf, class Take>
  void trace_from(std::span<MirrorPoint> mirrors, int bounce, std::uint64_t& ray_count,
                  const DirectionOf& direction_of, const Take& take) const {
    std::array<MirrorRay, RayScene::packet_size> rays;
    std::size_t count = 0;
    for (MirrorPoint& mirror : mirrors)
      if (const std::optional<vec3> direction = direction_of(mirror))
        rays[count++] = {&mirror, mirrored_cone(mirror, *direction)};
    const auto follow = [&](const MirrorRay& ray, const FirstHit& first) {
      MirrorPoint& mirror = *ray.mirror;
      take(mirror, radiance(ray.cone, bounce + 1, hidden_from(mirror), *mirror.lobe_points, ray_count,
                            nullptr, first));
    };
    if (count == 1) return follow(rays[0], {});
    std::array<FirstHit, RayScene::packet_size> first;
    look_ahead(std::span<const MirrorRay>(rays.data(), count), first, ray_count);
    for (std::size_t i = 0; i < count; ++i) follow(rays[i], first[i]);
  }

  /// Finds what a packet of mirror rays hits first, and whether the sun shines there.
  void look_ahead(std::span<const MirrorRay> mirror_rays, std::span<FirstHit> first,
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
      if (hit && hit->place->object == hidden_from(*mirror_rays[i].mirror)) continue;  // goes on behind it
      first[i].is_known = true, first[i].hit = hit;
      if (!hit) continue;
      const Cone seen = widened(mirror_rays[i].cone, hit->distance_m);
      first[i].point = shading_point(*hit, seen.ray.direction, seen.width_m);
      const SunRay sun = ray_to_sun(first[i].point, *hit);
      first[i].sun = sun.let_in;
      if (sun.ray) to_sun[sun_rays] = *sun.ray, lit[sun_rays++] = &first[i];
    }
    ray_count += sun_rays;
    const std::uint32_t blocked = rays_.are_blocked(std::span<const Ray>(to_sun.data(), sun_rays), {});
    for (std::size_t k = 0; k < sun_rays; ++k)
      if ((blocked >> k & 1u) != 0) lit[k]->sun = 0.0f;
  }

  /// The first mirror-like surface of `object` along a ray; `hit`: the first of all surfaces.
  std::optional<Hit> mirror_near(Ray ray, std::optional<Hit> hit, int object) const {
    while (hit && (hit->place->object != object || !hit->place->is_mirror)) {
      ray.min_m = past(hit->distance_m);
      if (ray.min_m >= ray.max_m) return std::nullopt;
      hit = rays_.nearest_hit(ray);
    }
    return hit;
  }

  std::optional<Hit> nearest_hit_but(Ray ray, int hidden_object) const {
    std::optional<Hit> hit = rays_.nearest_hit(ray);
    while (hit && hit->place->object == hidden_object) {
      ray.min_m = past(hit->distance_m);
      hit = rays_.nearest_hit(ray);
    }
    return hit;
  }

  /// `sun`: share of it that is seen.
  vec3 shade(const ShadingPoint& point, const Hit& hit, const Cone& cone, int bounce, float sun,
             LobePoints& lobe_points, std::uint64_t& ray_count) const {
    Surface s = point.surface;
    const vec3 to_viewer = -cone.ray.direction;
    const bool traces = hit.place->is_mirror && bounce < mirror_bounces_;
    const Surroundings around = surroundings_at(point, hit.place->object);
    const MirrorLight mirrored = traces ? mirror_light(point, hit, cone, bounce, lobe_points, ray_count)
                                        : unmapped_light(s, cone.ray.direction, around);
    if (hit.place->material->refracts()) {
      const vec3 ahead = cone.ray.direction;
      const vec3 through = traces ? light_through(point, hit, cone, bounce, lobe_points, ray_count)
                                  : unmapped_radiance(around, ahead, 0.0f);
      s.emission +=
          (vec3(1.0f) - base_reflectance(s, std::clamp(glm::dot(s.normal, to_viewer), 1e-4f, 1.0f))) *
          through;
    }
    if (point.kept_in_shadow < 1.0f) s.emission *= kept_of_recorded(point, ray_count);
    shading::SceneLight light = light_;
    light.to_sun = to_sun_at(point.position);
    light.bounced = bounced_irradiance(around.bounced, s.normal);
    light.bounced_behind = bounced_irradiance(around.bounced, -s.normal);
    const vec3 by_lamps = lamp_radiance_at(point, s, to_viewer, ray_count);
    if (const scene::LitVertices* lit = lit_->of(std::size_t(hit.place->object))) {
      const auto [before, behind] = vertex_light(*lit, hit, point.is_back);
      return by_lamps +
             vertex_lit_radiance(s, light, before, behind, to_viewer, sun, mirrored.base, mirrored.coat);
    }
    return by_lamps + lit_radiance(s, light, to_viewer, sun,
                                   shading::sky_share_of_normal(around.sky_cell, s.normal), mirrored.base,
                                   mirrored.coat);
  }

  /// Irradiance on the viewer's side of a surface that is lit at its vertices, and on the other side.
  static std::pair<vec3, vec3> vertex_light(const scene::LitVertices& lit, const Hit& hit, bool is_back) {
    const scene::LitVertices::PartLight& part = lit.parts[std::size_t(hit.place->part)];
    const std::uint32_t* corner = hit.place->mesh->indices.data() + 3 * std::size_t(hit.triangle);
    const auto at = [&](const std::vector<vec3>& light) {
      return (1.0f - hit.u - hit.v) * light[corner[0]] + hit.u * light[corner[1]] + hit.v * light[corner[2]];
    };
    const vec3 front = at(part.front), behind = part.behind.empty() ? front : at(part.behind);
    return is_back ? std::pair(behind, front) : std::pair(front, behind);
  }

  /// What lamps do: by their depth maps, or by exact rays where those replace maps.
  vec3 lamp_radiance_at(const ShadingPoint& point, const Surface& s, vec3 to_viewer,
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

  /// What a surface sees in one direction that no ray is traced for: the sky where it is open, and what
  /// stands before it as bright as the light that it gives.
  vec3 unmapped_radiance(const Surroundings& around, vec3 direction, float roughness) const {
    return shading::sky_share_of_direction(around.sky_cell, direction) *
               sky_radiance(sky_, direction, shading::sky_level(roughness, float(sky_.levels.size()))) +
           bounced_radiance(around.bounced, direction);
  }

  /// What a surface mirrors that no ray is traced for.
  MirrorLight unmapped_light(const Surface& s, vec3 direction, const Surroundings& around) const {
    const vec3 mirrored = glm::reflect(direction, s.normal);
    return {unmapped_radiance(around, mirrored, s.roughness),
            s.clear_coat > 0.0f ? unmapped_radiance(around, mirrored, s.clear_coat_roughness) : vec3(0.0f)};
  }

  /// What enters the eye through solid glass at a point of its surface.
  vec3 light_through(const ShadingPoint& point, const Hit& hit, const Cone& cone, int bounce,
                     LobePoints& lobe_points, std::uint64_t& ray_count) const {
    vec3 sum(0.0f);
    const int hidden_object = mirrors_see_themselves_ ? -1 : hit.place->object;
    for (const GlassExit& exit : glass_exits(rays_, hit, point, cone)) {
      ++ray_count;
      sum += exit.share * radiance(exit.cone, bounce + 1, hidden_object, lobe_points, ray_count, nullptr);
    }
    return sum;
  }

  /// What the renderer knows of a place.
  Surroundings surroundings_at(const ShadingPoint& point, int object) const {
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

  /// The share of a photograph's light that shadows of what it does not show leave.
  float kept_of_recorded(const ShadingPoint& point, std::uint64_t& ray_count) const {
    const vec3 to_sun = to_sun_at(point.position);
    const float facing = glm::dot(point.geometric_normal, to_sun);
    if (facing <= 0.0f || light_.sun_irradiance == vec3(0.0f)) return 1.0f;
    const auto visible = [&] {
      if (drawn_light_ && !drawn_light_->has_exact_shadows)
        return shading::sun_visibility(drawn_light_->inserted_shadow, point.position, point.geometric_normal,
                                       to_sun);
      ++ray_count;
      Ray ray{point.position + 1e-3f * point.geometric_normal, to_sun};
      if (spot_) ray.max_m = glm::distance(spot_->position, ray.origin);
      return rays_.is_blocked_by_inserted(ray) ? 0.0f : 1.0f;
    };
    return shading::kept_recorded_light(point.kept_in_shadow, facing, visible());
  }

  /// Unit; of a spot light in the sun's place it differs from point to point.
  vec3 to_sun_at(vec3 position) const {
    return spot_ ? glm::normalize(spot_->position - position) : light_.to_sun;
  }

  /// How much of the sun a surface that `hit` has found sees. None is asked for where it shows nothing of it.
  SunRay ray_to_sun(const ShadingPoint& point, const Hit& hit) const {
    const vec3 to_sun = to_sun_at(point.position);
    const Surface& s = point.surface;
    if (glm::dot(s.normal, to_sun) <= 0.0f && s.translucency <= 0.0f) return {0.0f, {}};
    float let_in = point.relief.light_from(to_sun);
    if (spot_) let_in *= shading::spot_share(glm::dot(to_sun, light_.to_sun), std::cos(spot_->half_angle));
    if (!hit.place->receives_shadow || let_in <= 0.0f) return {let_in, {}};
    if (drawn_light_ && !drawn_light_->has_exact_shadows)
      return {let_in * shading::sun_visibility(drawn_light_->shadow, point.position, point.geometric_normal,
                                               to_sun),
              {}};
    Ray ray{point.position + 1e-3f * point.geometric_normal, to_sun};
    if (spot_) ray.max_m = glm::distance(spot_->position, ray.origin);
    return {let_in, ray};
  }

  float sun_visible(const ShadingPoint& point, const Hit& hit, std::uint64_t& ray_count) const {
    const SunRay sun = ray_to_sun(point, hit);
    if (!sun.ray) return sun.let_in;
    ++ray_count;
    return rays_.is_blocked(*sun.ray) ? 0.0f : sun.let_in;
  }

  const RayScene& rays_;
  const shading::SkyLight& sky_;
  const shading::DrawnLight* drawn_light_;
  shading::LampTable own_lamps_;  ///< where nothing was drawn
  const shading::LampTable* lamps_ = nullptr;
  SunDisc sun_disc_;
  int mirror_bounces_;
  bool mirrors_see_themselves_;
  shading::SceneLight light_;
  std::optional<scene::Spot> spot_;
  const scene::VertexIrradiance* lit_ = nullptr;
};

}  // namespace

ObjectPicture trace_objects(const RayScene& rays, const Camera& camera, int width, int height) {
  ObjectPicture objects(width, height, 1);
  parallel_for(std::size_t(height), [&](std::size_t row) {
    for (int x = 0; x < width; ++x) {
      const auto hit =
          rays.nearest_hit(camera_ray(camera, width, height, {float(x) + 0.5f, float(row) + 0.5f}));
      *objects.at(x, int(row)) = hit ? std::uint32_t(hit->place->object) + 1 : 0;
    }
  });
  return objects;
}

namespace {

/// A row of a picture as it travels between processes.
struct TracedRow {
  std::uint64_t rays = 0;
  std::vector<float> radiance;             ///< linear RGB
  std::vector<std::uint8_t> mirror_share;  ///< of each pixel, 0..255
};

std::string bytes_of(const TracedRow& row) {
  std::string bytes;
  append_value(bytes, row.rays);
  append_values(bytes, row.radiance);
  append_values(bytes, row.mirror_share);
  return bytes;
}

TracedRow row_of(std::string_view bytes) {
  Taker taker(bytes);
  TracedRow row;
  row.rays = taker.take<std::uint64_t>();
  row.radiance = taker.take_values<float>();
  row.mirror_share = taker.take_values<std::uint8_t>();
  return row;
}

/// Traces one row of the window. Random numbers belong to the pixel of the whole picture.
TracedRow trace_row(const Tracer& tracer, const Camera& camera, int width, int height,
                    const TraceOptions& options, const PixelWindow& window, int row, float exposure) {
  const int side = int(std::ceil(std::sqrt(float(options.samples_per_pixel)))), samples = side * side;
  const float spread =  // of a sample's share of the pixel
      camera.height_at_1m() / float(height) / float(side);
  TracedRow traced;
  for (int column = 0; column < window.width; ++column) {
    const int x = window.x + column, y = window.y + row;
    Random random(options.seed, std::size_t(y) * std::size_t(width) + std::size_t(x));
    LobePoints lobe_points{
        {glm::vec2(random.uniform(), random.uniform()), glm::vec2(random.uniform(), random.uniform())}};
    vec3 sum(0.0f);
    float weights = 0.0f;
    int mirrors = 0, counted = 0;
    if (options.only_sample) lobe_points.skip(*options.only_sample);
    for (int i = 0; i < samples; ++i) {
      const int column_in_pixel = i % side, row_in_pixel = i / side;
      const float px = float(x) + (float(column_in_pixel) + random.uniform()) / float(side);
      const float py = float(y) + (float(row_in_pixel) + random.uniform()) / float(side);
      if (options.only_sample && *options.only_sample != i) continue;
      const Ray ray = camera_ray(camera, width, height, {px, py});
      bool is_mirror = false;
      const vec3 sample = tracer.radiance({ray, 0.0f, spread}, 0, -1, lobe_points, traced.rays, &is_mirror);
      const float weight = shading::sample_weight(exposure * sample);
      sum += weight * sample;
      weights += weight;
      mirrors += is_mirror;
      ++counted;
    }
    for (int c = 0; c < 3; ++c) traced.radiance.push_back(sum[c] / weights);
    traced.mirror_share.push_back(std::uint8_t(255 * mirrors / std::max(counted, 1)));
  }
  return traced;
}

}  // namespace

TracedPicture trace_picture(const RayScene& rays, const scene::Scene& scene, const shading::SkyLight& sky,
                            const Camera& camera, int width, int height, const TraceOptions& options) {
  const Tracer tracer(rays, scene, sky, options);
  const PixelWindow window = options.window.width > 0 ? options.window : PixelWindow{0, 0, width, height};
  TracedPicture picture;
  picture.radiance = ImageF(window.width, window.height, 3);
  picture.mirror_mask = Image8(window.width, window.height, 1);
  const auto start = std::chrono::steady_clock::now();
  std::optional<Progress> progress;
  if (!options.progress.empty()) progress.emplace(options.progress, std::size_t(window.height));
  machines::DividedWork work;
  work.run = [&](std::uint32_t row) -> Result<std::string> {
    return bytes_of(trace_row(tracer, camera, width, height, options, window, int(row), scene.exposure));
  };
  work.keep = [&](std::uint32_t row, std::string_view bytes) -> Status {
    const TracedRow traced = row_of(bytes);
    std::ranges::copy(traced.radiance, picture.radiance.at(0, int(row)));
    std::ranges::copy(traced.mirror_share, picture.mirror_mask.at(0, int(row)));
    picture.rays += traced.rays;
    if (progress) progress->advance();
    return Done{};
  };
  work.is_interrupted = options.is_interrupted;
  machines::Tasks rows(std::size_t(window.height));
  std::iota(rows.begin(), rows.end(), 0u);
  const Result<std::size_t> kept =
      machines::divide(options.processes ? *options.processes : machines::Processes(), rows, work);
  assert(kept && "rows are traced without errors");
  picture.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return picture;
}

void trace_mirrors(const RayScene& rays, const scene::Scene& scene, const shading::SkyLight& sky, vec3 eye,
                   float spread, std::span<const MirrorPixel> pixels, const TraceOptions& options,
                   std::span<std::optional<MirrorLight>> light) {
  constexpr std::size_t packet = RayScene::packet_size, packets_per_task = 4;
  const Tracer tracer(rays, scene, sky, options);
  parallel_for((pixels.size() + packet - 1) / packet,
               [&](std::size_t i) {
                 const std::size_t first = i * packet, count = std::min(packet, pixels.size() - first);
                 tracer.find_light_of_mirrors(pixels.subspan(first, count), eye, spread,
                                              light.subspan(first, count));
               },
               packets_per_task);
}

}  // namespace parvis::reference

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
  /// The points of one pixel of a drawn picture that takes `rays` of them: those of a square of
  /// mirror_tile_px pixels go on from each other.
  static LobePoints in_tile(const MirrorPixel& pixel, int rays) {
    const int turn = pixel.x % mirror_tile_px + mirror_tile_px * (pixel.y % mirror_tile_px);
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

/// Follows the rays of one pixel.
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
  vec3 radiance(Cone cone, int bounce, int hidden_object, LobePoints& lobe_points, std::uint64_t& ray_count,
                bool* is_mirror) const {
    vec3 sum(0.0f);
    float left = 1.0f;  // what blended layers in front let through
    for (int layer = 0; layer < max_blended_layers; ++layer) {
      ++ray_count;
      const std::optional<Hit> hit = nearest_hit_but(cone.ray, hidden_object);
      if (!hit) {
        const bool sees_sun = bounce == 0 && !spot_ && sun_disc_.contains(cone.ray.direction);
        return sum + left * (sky_radiance(sky_, cone.ray.direction, 0.0f) +
                             (sees_sun ? sun_disc_.radiance() : vec3(0.0f)));
      }
      const Cone seen = widened(cone, hit->distance_m);
      const ShadingPoint point = shading_point(*hit, cone.ray.direction, seen.width_m);
      const bool blends = hit->place->material->alpha_mode == scene::Alpha::blend;
      const float alpha = blends && layer + 1 < max_blended_layers ? point.alpha : 1.0f;
      if (is_mirror && layer == 0) *is_mirror = hit->place->is_mirror;
      const vec3 shaded = shade(point, *hit, seen, bounce, lobe_points, ray_count);
      sum += left * alpha *
             shading::through_haze(shaded, hit->distance_m, light_.haze_per_m, light_.haze_radiance);
      left *= 1.0f - alpha;
      if (left < 1e-3f) break;
      cone.ray.min_m = past(hit->distance_m);
    }
    return sum;
  }

  /// What the base and the coat of a mirror-like surface show, by mirror rays.
  MirrorLight mirror_light(const ShadingPoint& point, const Hit& hit, const Cone& cone, int bounce,
                           LobePoints& lobe_points, std::uint64_t& ray_count,
                           int base_rays = lobe_samples) const {
    const Surface& s = point.surface;
    const auto traced = [&](vec3 direction) {
      const vec3 away = kept_above(direction, point.geometric_normal);
      // A curved mirror turns the two sides of a cone apart by twice the angle between their normals.
      const float spread = cone.spread + 2.0f * point.curvature_per_m * cone.width_m;
      const Cone next{{point.position + 1e-3f * point.geometric_normal, away}, cone.width_m, spread};
      const int hidden_object = mirrors_see_themselves_ ? -1 : hit.place->object;
      return radiance(next, bounce + 1, hidden_object, lobe_points, ray_count, nullptr);
    };
    const bool needs_sharp = s.clear_coat > 0.0f || s.roughness <= sharp_roughness;
    const vec3 sharp = needs_sharp ? traced(glm::reflect(cone.ray.direction, s.normal)) : vec3(0.0f);
    if (s.roughness <= sharp_roughness) return {sharp, sharp};
    if (base_rays == 0) return {sharp, sharp};
    vec3 sum(0.0f);
    for (int i = 0; i < base_rays; ++i)
      sum += traced(
          glm::reflect(cone.ray.direction, ggx_half_vector(s.normal, s.roughness, lobe_points.next(bounce))));
    return {sum / float(base_rays), sharp};
  }

  /// What the mirror shows in a drawn pixel.
  std::optional<MirrorLight> light_of_mirror(const MirrorPixel& pixel, vec3 eye, float spread) const {
    const float distance_m = glm::distance(eye, pixel.position);
    const Cone cone{
        {eye, beside((pixel.position - eye) / distance_m, spread * pixel.offset_px)}, 0.0f, spread};
    const float within_m = drawn_error_m + drawn_error_px * spread * distance_m;
    const std::optional<Hit> hit = mirror_near(cone, distance_m, within_m, pixel.object);
    if (!hit) return std::nullopt;
    const Cone seen = widened(cone, hit->distance_m);
    std::uint64_t ray_count = 0;
    const ShadingPoint point = shading_point(*hit, cone.ray.direction, seen.width_m);
    const Surface& s = point.surface;
    const float n_dot_v = std::clamp(-glm::dot(s.normal, cone.ray.direction), 1e-4f, 1.0f);
    const float base = luminance(base_reflectance(s, n_dot_v)), coat = fresnel_of_coat(s, n_dot_v);
    const int base_rays = base < weak_reflectance ? pixel.weak_base_rays : pixel.base_rays;
    LobePoints lobe_points = LobePoints::in_tile(pixel, base_rays);
    MirrorLight light = mirror_light(point, *hit, seen, 0, lobe_points, ray_count, base_rays);
    light.sharp_share = coat + (s.roughness <= sharp_roughness ? (1.0f - coat) * base : 0.0f);
    return light;
  }

 private:
  /// The mirror-like surface of `object` near a point that the renderer has drawn, seen along the cone.
  std::optional<Hit> mirror_near(const Cone& cone, float distance_m, float within_m, int object) const {
    Ray ray = cone.ray;
    ray.min_m = std::max(distance_m - within_m, ray.min_m), ray.max_m = distance_m + within_m;
    std::optional<Hit> hit = rays_.nearest_hit(ray);
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

  vec3 shade(const ShadingPoint& point, const Hit& hit, const Cone& cone, int bounce, LobePoints& lobe_points,
             std::uint64_t& ray_count) const {
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
    if (spot_) light.to_sun = glm::normalize(spot_->position - point.position);
    light.bounced = bounced_irradiance(around.bounced, s.normal);
    light.bounced_behind = bounced_irradiance(around.bounced, -s.normal);
    const float sun = sun_visible(point, light.to_sun, hit.place->receives_shadow, ray_count);
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
    const vec3 to_sun = spot_ ? glm::normalize(spot_->position - point.position) : light_.to_sun;
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

  float sun_visible(const ShadingPoint& point, vec3 to_sun, bool receives_shadow,
                    std::uint64_t& ray_count) const {
    float let_in = point.relief.light_from(to_sun);
    if (spot_) let_in *= shading::spot_share(glm::dot(to_sun, light_.to_sun), std::cos(spot_->half_angle));
    if (!receives_shadow || let_in <= 0.0f) return let_in;
    if (drawn_light_ && !drawn_light_->has_exact_shadows)
      return let_in *
             shading::sun_visibility(drawn_light_->shadow, point.position, point.geometric_normal, to_sun);
    ++ray_count;
    Ray ray{point.position + 1e-3f * point.geometric_normal, to_sun};
    if (spot_) ray.max_m = glm::distance(spot_->position, ray.origin);
    return rays_.is_blocked(ray) ? 0.0f : let_in;
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
  constexpr std::size_t pixels_per_task = 64;
  const Tracer tracer(rays, scene, sky, options);
  parallel_for(
      pixels.size(), [&](std::size_t i) { light[i] = tracer.light_of_mirror(pixels[i], eye, spread); },
      pixels_per_task);
}

}  // namespace parvis::reference

#include "reference/tracer.h"

#include <atomic>
#include <chrono>
#include <cmath>

#include "base/parallel.h"
#include "base/progress.h"
#include "base/random.h"
#include "shading/lighting.h"
#include "shading/tone_curve.h"

namespace parvis::reference {
namespace {

using glm::vec2, glm::vec3, glm::vec4;
using shading::Surface;

constexpr int mirror_bounces = 1;        // what is mirrored reflects the sky: cube maps show no more
constexpr float sharp_roughness = 0.1f;  // below it one mirror ray stands for the lobe
constexpr int lobe_samples = 4;          // rays for a rough base layer, for each sample of the pixel
constexpr int most_blended_layers = 8;

/// A ray with the width of what its pixel sees: `width_m` at its origin, growing by `spread` a metre.
struct Cone {
  Ray ray;
  float width_m, spread;
};

/// A hit made ready for shading.
struct ShadingPoint {
  Surface surface;
  vec3 position, geometric_normal;  ///< on the viewer's side, interpolated
  float alpha;
};

/// The tangent frame of a triangle's texture gradients, as render/surface_body.glsl has it.
vec3 mapped_normal(vec3 normal, const vec3 (&p)[3], const vec2 (&t)[3], vec3 sampled, float scale) {
  const vec3 p1 = p[1] - p[0], p2 = p[2] - p[0];
  const vec2 t1 = t[1] - t[0], t2 = t[2] - t[0];
  const float determinant = t1.x * t2.y - t1.y * t2.x;
  if (determinant == 0.0f) return normal;
  const float sign = determinant > 0.0f ? 1.0f : -1.0f;
  const vec3 along_u = (p1 * t2.y - p2 * t1.y) * sign, along_v = (p2 * t1.x - p1 * t2.x) * sign;
  vec3 tangent = along_u - normal * glm::dot(normal, along_u);
  const float size = glm::dot(tangent, tangent);
  if (size < 1e-20f) return normal;
  tangent /= std::sqrt(size);
  vec3 bitangent = glm::cross(normal, tangent);
  if (glm::dot(bitangent, along_v) > 0.0f) bitangent = -bitangent;
  const vec3 n = sampled * 2.0f - 1.0f;
  return glm::normalize((tangent * n.x + bitangent * n.y) * scale + normal * std::max(n.z, 0.01f));
}

ShadingPoint shading_point(const Hit& hit, vec3 direction, float width_m) {
  const PlacedPart& place = *hit.place;
  const scene::Material& material = *place.material;
  const Mesh& mesh = place.part->mesh;
  const std::uint32_t* corner = mesh.indices.data() + 3 * std::size_t(hit.triangle);
  const float weights[3]{1.0f - hit.u - hit.v, hit.u, hit.v};
  vec3 p[3], normal(0.0f), position(0.0f);
  vec2 t[3], uv(0.0f);
  for (int k = 0; k < 3; ++k) {
    p[k] = vec3(place.world_from_mesh * vec4(mesh.positions[corner[k]], 1.0f));
    t[k] = vec2(material.texture_from_mesh_uv * vec3(mesh.uvs[corner[k]], 1.0f));
    position += weights[k] * p[k];
    normal += weights[k] * mesh.normals[corner[k]];
    uv += weights[k] * t[k];
  }
  const vec3 facet = glm::cross(p[1] - p[0], p[2] - p[0]);
  normal = glm::normalize(place.world_from_normal * normal);
  if (glm::dot(facet, direction) > 0.0f) normal = -normal;  // seen from behind

  const float area_of_uv =
      std::abs((t[1].x - t[0].x) * (t[2].y - t[0].y) - (t[1].y - t[0].y) * (t[2].x - t[0].x));
  const float uv_per_m = std::sqrt(area_of_uv / std::max(glm::length(facet), 1e-12f));
  const auto sampled = [&](int texture, vec4 plain) {
    if (texture == scene::no_index) return plain;
    const MipTexture& mips = (*place.textures)[std::size_t(texture)];
    return mips.sample(uv, width_m * uv_per_m * std::sqrt(mips.size().x * mips.size().y));
  };
  const vec4 white(1.0f);
  const vec4 base = sampled(material.base_colour_texture, white),
             detail = sampled(material.surface_texture, white);
  const vec4 bump = sampled(material.normal_texture, vec4(0.5f, 0.5f, 1.0f, 1.0f));

  ShadingPoint point;
  point.position = position;
  point.geometric_normal = normal;
  point.alpha = base.w * material.alpha;
  Surface& s = point.surface;
  s.normal = material.normal_texture == scene::no_index
                 ? normal
                 : mapped_normal(normal, p, t, vec3(bump), material.normal_scale);
  s.base_colour = vec3(base) * material.base_colour;
  s.metallic = material.metallic * detail.z;
  s.roughness = material.roughness * detail.y;
  s.clear_coat = material.clear_coat;
  s.clear_coat_roughness = material.clear_coat_roughness;
  s.translucency = material.translucency;
  s.occlusion = detail.x;
  s.emission = material.emission * vec3(sampled(material.emission_texture, white));
  return point;
}

/// Keeps a reflected ray above the surface, where interpolated normals would send it below.
vec3 kept_above(vec3 direction, vec3 normal) {
  const float height = glm::dot(direction, normal);
  return height > 1e-3f ? direction : glm::normalize(direction + (1e-3f - height) * normal);
}

/// A half vector of the GGX distribution about `normal`.
vec3 ggx_half_vector(vec3 normal, float roughness, Random& random) {
  const float alpha = roughness * roughness, u = random.uniform(), phi = 6.2831853f * random.uniform();
  const float cosine = std::sqrt((1.0f - u) / (1.0f + (alpha * alpha - 1.0f) * u));
  const float sine = std::sqrt(std::max(0.0f, 1.0f - cosine * cosine));
  const vec3 t =
      glm::normalize(glm::cross(std::abs(normal.z) < 0.9f ? vec3(0, 0, 1) : vec3(1, 0, 0), normal));
  return sine * std::cos(phi) * t + sine * std::sin(phi) * glm::cross(normal, t) + cosine * normal;
}

/// Follows the rays of one pixel.
class Tracer {
 public:
  Tracer(const RayScene& rays, const scene::Scene& scene, const shading::SkyLight& sky,
         const TraceOptions& options)
      : rays_(rays), sky_(sky), shadow_(options.shadow), sky_visibility_(options.sky_visibility) {
    light_.to_sun = glm::normalize(scene.sun.direction_to_sun);
    light_.sun_irradiance = scene.sun.irradiance;
    for (std::size_t i = 0; i < 9; ++i) light_.sky_sh[i] = sky.irradiance_sh[i];
    light_.haze_radiance = sky.haze_radiance;
    light_.haze_per_m = scene.haze_per_m;
  }

  vec3 radiance(Cone cone, int bounce, Random& random, std::uint64_t& ray_count, bool* is_mirror) const {
    vec3 sum(0.0f);
    float left = 1.0f;  // what blended layers in front let through
    for (int layer = 0; layer < most_blended_layers; ++layer) {
      ++ray_count;
      const std::optional<Hit> hit = rays_.nearest_hit(cone.ray);
      if (!hit) return sum + left * sky_radiance(sky_, cone.ray.direction, 0.0f);
      const float width_m = cone.width_m + cone.spread * hit->distance_m;
      const ShadingPoint point = shading_point(*hit, cone.ray.direction, width_m);
      const bool blends = hit->place->material->alpha_mode == scene::Alpha::blend;
      const float alpha = blends ? point.alpha : 1.0f;
      if (is_mirror && layer == 0) *is_mirror = hit->place->is_mirror;
      const vec3 shaded = shade(point, *hit, cone, width_m, bounce, random, ray_count);
      sum += left * alpha *
             shading::through_haze(shaded, hit->distance_m, light_.haze_per_m, light_.haze_radiance);
      left *= 1.0f - alpha;
      if (left < 1e-3f) break;
      cone.ray.least_m = hit->distance_m * (1.0f + 1e-5f) + 1e-4f;
    }
    return sum;
  }

 private:
  vec3 shade(const ShadingPoint& point, const Hit& hit, const Cone& cone, float width_m, int bounce,
             Random& random, std::uint64_t& ray_count) const {
    const Surface& s = point.surface;
    const vec3 to_viewer = -cone.ray.direction;
    const vec3 mirrored = glm::reflect(cone.ray.direction, s.normal);
    const bool traces = hit.place->is_mirror && bounce < mirror_bounces;
    const vec4 sky_cell = sky_cell_at(point);
    const auto sky_reflection = [&](float roughness) {
      return shading::sky_share_of_direction(sky_cell, mirrored) *
             sky_radiance(sky_, mirrored, shading::sky_level(roughness, float(sky_.levels.size())));
    };
    const auto traced = [&](vec3 direction) {
      const vec3 away = kept_above(direction, point.geometric_normal);
      const Cone next{{point.position + 1e-3f * point.geometric_normal, away}, width_m, 2.0f * cone.spread};
      return radiance(next, bounce + 1, random, ray_count, nullptr);
    };

    vec3 base_reflection(0.0f), coat_reflection(0.0f);
    if (!traces) {
      base_reflection = sky_reflection(s.roughness);
      if (s.clear_coat > 0.0f) coat_reflection = sky_reflection(s.clear_coat_roughness);
    } else {
      const bool needs_sharp = s.clear_coat > 0.0f || s.roughness <= sharp_roughness;
      const vec3 sharp = needs_sharp ? traced(mirrored) : vec3(0.0f);
      coat_reflection = sharp;
      base_reflection = sharp;
      if (s.roughness > sharp_roughness) {
        base_reflection = vec3(0.0f);
        for (int i = 0; i < lobe_samples; ++i)
          base_reflection +=
              traced(glm::reflect(cone.ray.direction, ggx_half_vector(s.normal, s.roughness, random)));
        base_reflection /= float(lobe_samples);
      }
    }
    return lit_radiance(s, light_, to_viewer, sun_visible(point, ray_count),
                        shading::sky_share_of_normal(sky_cell, s.normal), base_reflection, coat_reflection);
  }

  /// What the place sees of the sky.
  vec4 sky_cell_at(const ShadingPoint& point) const {
    if (!sky_visibility_) return vec4(0.5f, 0.5f, 0.5f, 1.0f);
    return sky_visibility_->at(
        shading::sky_visibility_coordinates(sky_visibility_->grid, point.position, point.geometric_normal));
  }

  float sun_visible(const ShadingPoint& point, std::uint64_t& ray_count) const {
    if (shadow_)
      return shading::sun_visibility(*shadow_, point.position, point.geometric_normal, light_.to_sun);
    ++ray_count;
    return rays_.is_blocked({point.position + 1e-3f * point.geometric_normal, light_.to_sun}) ? 0.0f : 1.0f;
  }

  const RayScene& rays_;
  const shading::SkyLight& sky_;
  const shading::SunShadow* shadow_;
  const shading::SkyVisibility* sky_visibility_;
  shading::SceneLight light_;
};

}  // namespace

TracedPicture trace_picture(const RayScene& rays, const scene::Scene& scene, const shading::SkyLight& sky,
                            const Camera& camera, int width, int height, const TraceOptions& options) {
  const Tracer tracer(rays, scene, sky, options);
  const int side = int(std::ceil(std::sqrt(float(options.samples_a_pixel)))), samples = side * side;
  const float tangent = std::tan(0.5f * camera.vertical_fov), aspect = float(width) / float(height);
  const float spread = 2.0f * tangent / float(height) / float(side);  // of a sample's share of the pixel
  const vec3 eye = camera.position_in_world();

  TracedPicture picture;
  picture.radiance = ImageF(width, height, 3);
  picture.mirror_mask = Image8(width, height, 1);
  std::atomic<std::uint64_t> all_rays = 0;
  const auto start = std::chrono::steady_clock::now();
  Progress progress(options.progress, std::size_t(height));
  parallel_for(std::size_t(height), [&](std::size_t row) {
    std::uint64_t ray_count = 0;
    for (int x = 0; x < width; ++x) {
      Random random(options.seed, row * std::size_t(width) + std::size_t(x));
      vec3 sum(0.0f);
      float weights = 0.0f;
      int mirrors = 0;
      for (int i = 0; i < samples; ++i) {
        const float px = (float(x) + (float(i % side) + random.uniform()) / float(side)) / float(width);
        const float py = (float(row) + (float(i / side) + random.uniform()) / float(side)) / float(height);
        const vec3 in_camera((2.0f * px - 1.0f) * tangent * aspect, (1.0f - 2.0f * py) * tangent, -1.0f);
        const vec3 direction = glm::normalize(glm::mat3(camera.world_from_camera) * in_camera);
        bool is_mirror = false;
        const vec3 sample = tracer.radiance({{eye, direction, camera.near_m}, 0.0f, spread}, 0, random,
                                            ray_count, &is_mirror);
        const float weight = shading::sample_weight(scene.exposure * sample);
        sum += weight * sample;
        weights += weight;
        mirrors += is_mirror;
      }
      for (int c = 0; c < 3; ++c) picture.radiance.at(x, int(row))[c] = sum[c] / weights;
      *picture.mirror_mask.at(x, int(row)) = std::uint8_t(255 * mirrors / samples);
    }
    all_rays += ray_count;
    progress.advance();
  });
  picture.rays = all_rays;
  picture.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return picture;
}

}  // namespace parvis::reference

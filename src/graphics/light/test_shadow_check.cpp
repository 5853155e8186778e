#include "graphics/light/test_shadow_check.h"

#include <algorithm>

#include "base/parallel.h"
#include "graphics/reference/camera_ray.h"

namespace parvis::light {
namespace {

constexpr float checked_lift_m = 2e-3f;
constexpr double max_offset_m = 0.5;

struct Pixel {
  glm::vec3 position, normal;
  float depth_m;
};

/// The surfaces that the pixels' middles show and that face the sun; all surfaces go into `seen`.
std::vector<Pixel> lit_pixels(const reference::RayScene& scene, const Camera& camera, int width, int height,
                              glm::vec3 to_sun, SeenSurfaces& seen) {
  std::vector<Pixel> all(std::size_t(width) * std::size_t(height), {{}, {}, -1.0f});
  const glm::vec3 eye = camera.position_in_world(), forward = camera.forward_in_world();
  parallel_for(
      all.size(),
      [&](std::size_t i) {
        const glm::vec2 at(float(int(i) % width) + 0.5f, float(int(i) / width) + 0.5f);
        const reference::Ray ray = reference::camera_ray(camera, width, height, at);
        const auto hit = scene.nearest_hit(ray);
        if (!hit) return;
        const Mesh& mesh = *hit->place->mesh;
        const auto corner = [&](int k) {
          return glm::vec3(
              hit->place->world_from_mesh *
              glm::vec4(mesh.positions[mesh.indices[3 * hit->triangle + std::uint32_t(k)]], 1.0f));
        };
        const glm::vec3 position = ray.origin + hit->distance_m * ray.direction;
        glm::vec3 normal = glm::normalize(glm::cross(corner(1) - corner(0), corner(2) - corner(0)));
        if (glm::dot(normal, ray.direction) > 0.0f) normal = -normal;
        all[i] = {position, normal, glm::dot(position - eye, forward)};
      },
      64);
  std::vector<Pixel> lit;
  for (const Pixel& pixel : all) {
    if (!(pixel.depth_m > 0.0f)) continue;
    seen.positions.push_back(pixel.position), seen.depths_m.push_back(pixel.depth_m);
    if (glm::dot(pixel.normal, to_sun) > 0.02f) lit.push_back(pixel);
  }
  return lit;
}

bool is_shaded(const reference::RayScene& scene, glm::vec3 from, glm::vec3 to_sun) {
  reference::Passage passage{Random(1)};
  return scene.is_blocked({from, to_sun, 1e-4f, 1e30f}, passage);
}

}  // namespace

void ShadowErrors::add(const ShadowErrors& other) {
  pixels += other.pixels;
  for (std::size_t i = 0; i < wrong.size(); ++i) wrong[i] += other.wrong[i];
}

ShadowErrors check_shadows(const reference::RayScene& scene, const Bounds& casters, const Camera& camera,
                           int width, int height, glm::vec3 to_sun, int resolution) {
  SeenSurfaces seen;
  const std::vector<Pixel> pixels = lit_pixels(scene, camera, width, height, to_sun, seen);
  ShadowErrors errors;
  errors.pixels = long(pixels.size());
  std::vector<char> truth(pixels.size());
  parallel_for(
      pixels.size(),
      [&](std::size_t i) {
        truth[i] = is_shaded(scene, pixels[i].position + checked_lift_m * pixels[i].normal, to_sun) ? 1 : 0;
      },
      64);
  for (std::size_t m = 0; m < shadow_method_names.size(); ++m) {
    const std::vector<ShadowMap> maps = fit_shadow_maps(ShadowMethod(m), camera, to_sun, seen, casters);
    std::vector<char> is_wrong(pixels.size());
    parallel_for(
        pixels.size(),
        [&](std::size_t i) {
          const Pixel& pixel = pixels[i];
          const ShadowMap& map = map_for_depth(maps, double(pixel.depth_m));
          const double texel_m = texel_point(map, resolution, glm::dvec3(pixel.position)).size_m;
          const float offset_m = checked_lift_m + float(std::min(texel_m, max_offset_m));
          const TexelPoint compared =
              texel_point(map, resolution, glm::dvec3(pixel.position + offset_m * pixel.normal));
          is_wrong[i] = is_shaded(scene, glm::vec3(compared.position), to_sun) != (truth[i] != 0) ? 1 : 0;
        },
        64);
    errors.wrong[m] = std::count(is_wrong.begin(), is_wrong.end(), 1);
  }
  return errors;
}

}  // namespace parvis::light

#include "graphics/lamps/lamp_maps.h"

#include <algorithm>

namespace parvis::lamps {
namespace {

/// The nearest static shadow caster; the reach where there is none.
float seen_distance(const scene::Scene& scene, const reference::RayScene& rays, reference::Ray ray) {
  for (;;) {
    const std::optional<reference::Hit> hit = rays.nearest_hit(ray);
    if (!hit) return ray.max_m;
    const int object = hit->place->object;
    const bool is_dynamic =
        object < int(scene.objects.size()) && scene.objects[std::size_t(object)].is_dynamic;
    if (hit->place->casts_shadow && !is_dynamic) return hit->distance_m;
    ray.min_m = hit->distance_m * (1.0f + 1e-5f) + 1e-4f;
    if (ray.min_m >= ray.max_m) return ray.max_m;
  }
}

}  // namespace

void trace_map(const scene::Scene& scene, const reference::RayScene& rays, const shading::Lamp& lamp,
               std::span<std::uint16_t> depths) {
  constexpr int side = shading::lamp_map_px;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const glm::vec2 uv = (glm::vec2(x, y) + 0.5f) / float(side);
      reference::Ray ray{glm::vec3(lamp.place),
                         shading::layer_direction(uv, float(side), float(shading::lamp_map_border))};
      ray.min_m = std::max(1.3f * lamp.body.w, 1e-3f), ray.max_m = std::max(lamp.place.w, 2.0f * ray.min_m);
      const float share = seen_distance(scene, rays, ray) / lamp.place.w;
      depths[std::size_t(y * side + x)] = std::uint16_t(65535.0f * std::clamp(share, 0.0f, 1.0f) + 0.5f);
    }
}

}  // namespace parvis::lamps

#include "stage/probe.h"

#include "graphics/reference/camera_ray.h"
#include "graphics/reference/ray_scene.h"

namespace parvis::stage {
namespace {

/// Name of an object of the scene, or of a drawable of a room.
std::string name_of(const scene::Scene& scene, int object) {
  if (std::size_t(object) < scene.objects.size()) return scene.objects[std::size_t(object)].name;
  std::string name;
  scene::for_each_traced_kind(scene, [&](const scene::TracedKind& kind, int first_thing) {
    if (first_thing <= object) name = kind.name;
  });
  return name;
}

}  // namespace

std::optional<ProbedPoint> probe(const scene::Scene& scene, const Camera& camera, glm::ivec2 size,
                                 glm::ivec2 pixel) {
  if (pixel.x < 0 || pixel.y < 0 || pixel.x >= size.x || pixel.y >= size.y) return std::nullopt;
  const reference::RayScene rays(scene);
  const reference::Ray ray = reference::camera_ray(camera, size.x, size.y, glm::vec2(pixel) + 0.5f);
  const std::optional<reference::Hit> hit = rays.nearest_hit(ray);
  if (!hit) return std::nullopt;
  const glm::vec3 position = ray.origin + hit->distance_m * ray.direction;
  return ProbedPoint{position, glm::distance(position, camera.position_in_world()), hit->place->object,
                     name_of(scene, hit->place->object),
                     hit->place->material != nullptr ? hit->place->material->name : ""};
}

std::string to_string(const std::optional<ProbedPoint>& point, const scene::Scene& scene) {
  if (!point) return "the sky";
  const glm::vec3 p = point->position_in_world;
  std::string text = fmt::format("{:.2f} {:.2f} {:.2f} m, \"{}\"", p.x, p.y, p.z, point->name);
  if (!point->kind.empty()) text += fmt::format(", {}", point->kind);
  text += fmt::format(", {:.1f} m away", point->distance_m);
  if (scene.origin != glm::dvec3(0.0)) {
    const glm::dvec3 on_map = scene.origin + glm::dvec3(p);
    text += fmt::format("; on the map {:.2f} {:.2f} {:.2f}", on_map.x, on_map.y, on_map.z);
  }
  return text;
}

}  // namespace parvis::stage

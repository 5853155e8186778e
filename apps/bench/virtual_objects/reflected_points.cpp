#include "bench/virtual_objects/reflected_points.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

#include "graphics/reference/camera_ray.h"
#include "reflections/reflection_search/test_exact_reflection.h"
#include "reflections/reflector_maps/reflector_cache.h"

namespace parvis::bench {
namespace {

using namespace reflection_search;
using namespace reflector_maps;

constexpr std::size_t max_tries = 400;  // for each pixel that is wanted
constexpr float off_surface_m = 1e-4f;
constexpr double wrong_rad = 0.0175;  // a degree between bisector and normal: the mirror shows something else
constexpr float seen_share = 0.999f;  // of the way to a point that is seen

glm::vec2 pixel_of(const glm::mat4& pixel_from_world, glm::vec3 point) {
  const glm::vec4 p = pixel_from_world * glm::vec4(point, 1.0f);
  return glm::vec2(p) / p.w;
}

}  // namespace

Result<ReflectedPoints> ReflectedPoints::make(const scene::Scene& scene) {
  ReflectedPoints made;
  made.scene_ = &scene;
  made.rays_ = std::make_unique<reference::RayScene>(scene);
  const ReflectorCache cache(scene);
  for (const scene::Object& object : scene.objects) {
    if (!object.takes_reflection || made.mirrors_.contains(object.model.get())) continue;
    Result<Reflector> reflector = cache.reflector(mirror_source(scene, object));
    if (!reflector) return reflector.errors();
    Mirror& mirror = made.mirrors_[object.model.get()];
    mirror.reflector = *std::move(reflector);
    for (const ReflectorPatch& patch : mirror.reflector.patches)
      mirror.patches.push_back(std::make_unique<SurfaceRays>(mirror.reflector.mesh, patch.triangles));
  }
  return made;
}

bool ReflectedPoints::is_extra(const Mirror& mirror, std::size_t patch,
                               const MapSearch::ReflectionPoint& point,
                               const MapSearch::ReflectionTask& task) {
  const std::optional<MetSurface> met = mirror.patches[patch]->along(task.centre, point.direction);
  if (!met || glm::dot(task.viewer - met->position, met->normal) <= 0.0f ||
      glm::dot(task.vertex - met->position, met->normal) <= 0.0f ||
      bisector_angle(met->position, met->normal, task.viewer, task.vertex) < wrong_rad)
    return false;
  const float away = seen_share * glm::distance(met->position, task.viewer);
  return std::ranges::none_of(mirror.patches, [&](const auto& before) {
    const std::optional<MetSurface> first = before->along(task.viewer, met->position - task.viewer);
    return first && glm::distance(first->position, task.viewer) < away;
  });
}

void ReflectedPoints::judge(const Mirror& mirror, const scene::Object& object, const Camera& camera,
                            const glm::mat4& pixel_from_world, glm::vec3 direction,
                            const PatchSearch& search_patch, ReflectedPointErrors& errors) const {
  const glm::mat4 world_from_reflector = object.world_from_model,
                  reflector_from_world = glm::inverse(world_from_reflector);
  const glm::vec3 eye = reflector_from_world * glm::vec4(camera.position_in_world(), 1.0f),
                  along = glm::normalize(glm::vec3(reflector_from_world * glm::vec4(direction, 0.0f)));
  std::optional<MetSurface> at;
  std::size_t patch = 0;
  for (std::size_t i = 0; i < mirror.patches.size(); ++i)
    if (const auto met = mirror.patches[i]->along(eye, along);
        met && (!at || glm::distance(met->position, eye) < glm::distance(at->position, eye)))
      at = met, patch = i;
  if (!at || glm::dot(at->normal, along) >= 0.0f) return;
  const glm::vec3 mirrored = glm::mat3(world_from_reflector) * glm::reflect(along, at->normal);
  const glm::vec3 from = world_from_reflector * glm::vec4(at->position + off_surface_m * at->normal, 1.0f);
  const glm::vec3 unit = glm::normalize(mirrored);
  const auto hit = rays_->nearest_hit({from, unit});
  if (!hit || &scene_->objects[std::size_t(hit->place->object)] == &object) return;
  const auto add = [&](double px) {
    errors.px.push_back(px);
    errors.missed += px >= missed_px;
  };
  if (patch >= mirror.reflector.maps.size()) return add(missed_px);

  const ReflectorMap& map = mirror.reflector.maps[patch];
  MapSearch search{map};
  const glm::vec3 vertex = reflector_from_world * glm::vec4(from + hit->distance_m * unit, 1.0f);
  const MapSearch::ReflectionTask task{eye, vertex, map.window.centre};
  const auto on_screen = [&](glm::vec3 point) {
    return pixel_of(pixel_from_world, world_from_reflector * glm::vec4(point, 1.0f));
  };
  double nearest_px = missed_px;
  bool has_extra = false;
  const int first = map.shows_once ? -1 : 0, end = map.shows_once ? 0 : search.layer_count;
  for (int layer = first; layer < end; ++layer) {
    const MapSearch::PatchPoint found = search_patch(search, task, layer);
    if (!search.is_found(found)) continue;
    nearest_px =
        std::min(nearest_px, double(glm::distance(on_screen(found.point.position), on_screen(at->position))));
    has_extra = has_extra || is_extra(mirror, patch, found.point, task);
  }
  add(nearest_px);
  if (!has_extra) return;
  errors.px.push_back(missed_px);
  ++errors.extra;
}

ReflectedPointErrors ReflectedPoints::errors(const Camera& camera, int width, int height, std::size_t count,
                                             const PatchSearch& search) const {
  const glm::mat4 clip_from_world =
      camera.clip_from_camera(float(width) / float(height)) * camera.camera_from_world();
  const glm::mat4 pixel_from_world =
      glm::scale(glm::mat4(1.0f), {0.5f * float(width), 0.5f * float(height), 1.0f}) * clip_from_world;
  Random random(3);
  ReflectedPointErrors errors;
  for (std::size_t i = 0; errors.px.size() < count + errors.extra && i < max_tries * count; ++i) {
    const glm::vec2 pixel(random.uniform(0.0f, float(width)), random.uniform(0.0f, float(height)));
    const reference::Ray ray = reference::camera_ray(camera, width, height, pixel);
    const auto hit = rays_->nearest_hit(ray);
    if (!hit || !hit->place->is_mirror) continue;
    const scene::Object& object = scene_->objects[std::size_t(hit->place->object)];
    judge(mirrors_.at(object.model.get()), object, camera, pixel_from_world, ray.direction, search, errors);
  }
  return errors;
}

}  // namespace parvis::bench

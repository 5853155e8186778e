#include "planning/design/scene_surfaces.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace parvis::design {
namespace {

bool is_named(const scene::Scene& scene, int object, const Names& names) {
  return std::size_t(object) < scene.objects.size() &&
         std::ranges::find(names, scene.objects[std::size_t(object)].name) != names.end();
}

}  // namespace

const reference::RayScene& SceneSurfaces::rays() {
  if (!rays_)
    rays_ = std::make_unique<reference::RayScene>(scene_);
  else
    rays_->update(scene_);
  asked_ = 0;
  return *rays_;
}

std::optional<SceneSurfaces::Place> SceneSurfaces::first_along(reference::Ray ray, const Names& without) {
  return first(rays(), ray, without);
}

std::optional<SceneSurfaces::Place> SceneSurfaces::first_along_lately(const reference::Ray& ray) {
  constexpr int kept_questions = 200;
  return first(rays_ && ++asked_ < kept_questions ? *rays_ : rays(), ray, {});
}

std::optional<SceneSurfaces::Place> SceneSurfaces::first(const reference::RayScene& now, reference::Ray ray,
                                                         const Names& without) const {
  constexpr int max_passed = 64;
  for (int passed = 0; passed < max_passed; ++passed) {
    const std::optional<reference::Hit> hit = now.nearest_hit(ray);
    if (!hit) return std::nullopt;
    ray.min_m = hit->distance_m + 1e-3f;
    if (is_named(scene_, hit->place->object, without)) continue;
    glm::vec3 normal = glm::normalize(reference::facet_normal(*hit->place, hit->triangle));
    if (glm::dot(normal, ray.direction) > 0.0f) normal = -normal;
    return Place{glm::dvec3(ray.origin) + double(hit->distance_m) * glm::dvec3(ray.direction), normal,
                 hit->place->object};
  }
  return std::nullopt;
}

double SceneSurfaces::resting_height(glm::dvec2 at, const Names& without) {
  constexpr float above_m = 2000.0f, max_rise_m = 1.2f, min_up = 0.5f;
  const reference::RayScene& now = rays();
  std::vector<float> heights;
  reference::Ray ray{glm::vec3(glm::vec2(at), above_m), glm::vec3(0.0f, 0.0f, -1.0f)};
  for (int hits = 0; hits < 64; ++hits) {
    const std::optional<reference::Hit> hit = now.nearest_hit(ray);
    if (!hit) break;
    const glm::vec3 normal = glm::normalize(reference::facet_normal(*hit->place, hit->triangle));
    const bool counts = std::size_t(hit->place->object) < scene_.objects.size() && !hit->place->is_backdrop &&
                        !is_named(scene_, hit->place->object, without);
    if (counts && std::abs(normal.z) > min_up) heights.push_back(above_m - hit->distance_m);
    ray.min_m = hit->distance_m + 1e-3f;
  }
  if (heights.empty()) return 0.0;
  const float lowest = heights.back();
  const auto rest = std::ranges::find_if(heights, [&](float height) { return height < lowest + max_rise_m; });
  return std::round(double(*rest) * 1e4) * 1e-4;
}

Session::Heights resting_heights(const scene::Scene& scene) {
  return [surfaces = std::make_shared<SceneSurfaces>(scene)](glm::dvec2 at, const Names& without) {
    return surfaces->resting_height(at, without);
  };
}

}  // namespace parvis::design

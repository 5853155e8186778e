#include "graphics/reference/glass_walk.h"

#include <algorithm>
#include <cmath>

#include "graphics/shading/glass.h"

namespace parvis::reference {
namespace {

using glm::vec3;

constexpr int max_inner_bounces = 8;
constexpr float min_share = 2e-3f;    // of the light, that is followed
constexpr float off_glass_m = 1e-4f;  // where rays begin, so that they do not meet where they come from

/// A cone whose spread a surface changes by `turn_per_m` of its width.
Cone refracted_cone(Ray ray, const Cone& before, float ratio, float turn_per_m) {
  return {ray, before.width_m, ratio * before.spread - turn_per_m * before.width_m};
}

}  // namespace

Cone widened(Cone cone, float distance_m) {
  cone.width_m += cone.spread * distance_m;
  if (cone.width_m < 0.0f) cone.width_m = -cone.width_m, cone.spread = -cone.spread;
  return cone;
}

std::vector<GlassExit> glass_exits(const RayScene& rays, const Hit& hit, const ShadingPoint& entry,
                                   const Cone& seen) {
  const scene::Material& glass = *hit.place->material;
  std::vector<GlassExit> exits;
  const float into = 1.0f / glass.ior;  // ratio of the indices
  Cone cone = refracted_cone({entry.position - off_glass_m * entry.geometric_normal,
                              shading::refracted(seen.ray.direction, entry.surface.normal, into)},
                             seen, into, (1.0f - into) * entry.curvature_per_m);
  vec3 share(1.0f);
  Passage passage{Random(0), true};
  for (int bounce = 0; bounce <= max_inner_bounces; ++bounce) {
    const std::optional<Hit> met = rays.nearest_hit(cone.ray, passage);
    if (!met || met->place->object != hit.place->object || !met->place->material->refracts()) {
      exits.push_back({cone, share});
      break;
    }
    cone = widened(cone, met->distance_m);
    share *= glm::exp(-met->distance_m * glass.absorption_per_m);
    const ShadingPoint point = shading_point(*met, cone.ray.direction, cone.width_m);
    const vec3 normal = point.surface.normal;
    const vec3 out = shading::refracted(cone.ray.direction, normal, glass.ior);
    const bool leaves = out != vec3(0.0f) && glm::dot(out, point.geometric_normal) < 0.0f;
    const float kept = leaves ? shading::inner_reflectance(glass.ior, -glm::dot(out, normal)) : 1.0f;
    if (leaves)
      exits.push_back({refracted_cone({point.position - off_glass_m * point.geometric_normal, out}, cone,
                                      glass.ior, (glass.ior - 1.0f) * point.curvature_per_m),
                       (1.0f - kept) * share});
    share *= kept;
    if (std::max({share.x, share.y, share.z}) < min_share) break;
    cone = refracted_cone(
        {point.position + off_glass_m * point.geometric_normal, glm::reflect(cone.ray.direction, normal)},
        cone, 1.0f, 2.0f * point.curvature_per_m);
  }
  return exits;
}

}  // namespace parvis::reference

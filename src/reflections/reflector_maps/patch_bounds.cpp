#include "reflections/reflector_maps/patch_bounds.h"

#include <algorithm>
#include <cmath>

namespace parvis::reflector_maps {
namespace {

constexpr float map_slack = 0.02f;  // radians that a map's normals may be off (reflector_map.cpp, creases)
constexpr float all_around = 4.0f;  // more than any two directions are apart

float angle_between(glm::vec3 a, glm::vec3 b) {
  return std::acos(std::clamp(glm::dot(glm::normalize(a), glm::normalize(b)), -1.0f, 1.0f));
}

/// How far directions between two balls may lie off that between their middles.
float widest_turn(float radius, float distance) {
  return radius < distance ? std::asin(radius / distance) : all_around;
}

}  // namespace

bool PatchBounds::may_be_seen(glm::vec3 viewer) const {
  const glm::vec3 to_viewer = viewer - box.centre();
  constexpr float right_angle = 1.5707964f;
  const float off = spread + widest_turn(box.radius(), glm::length(to_viewer));
  return off >= right_angle || angle_between(axis, to_viewer) <= right_angle + off;
}

// Mirrored in a normal n, a direction ends up within twice the angle between n and the axis of where the axis
// mirrors it.
bool PatchBounds::may_show(glm::vec3 viewer, glm::vec3 centre, float radius) const {
  const glm::vec3 to_viewer = viewer - box.centre(), to_mesh = centre - box.centre();
  const float off = 2.0f * spread + widest_turn(box.radius(), glm::length(to_viewer)) +
                    widest_turn(box.radius() + radius, glm::length(to_mesh));
  return off >= all_around || angle_between(glm::reflect(-to_viewer, axis), to_mesh) <= off;
}

// The image in a ball of radius r of what stands at distance d above it lies at d r / (2 d + r) below, and is
// smaller by as much. A concave patch may show anything as wide as itself.
float PatchBounds::image_width(glm::vec3 viewer, glm::vec3 centre, float radius, bool is_convex) const {
  const auto distance_to_box = [&](glm::vec3 from) {
    return glm::distance(from, glm::clamp(from, box.min, box.max));
  };
  const float viewer_distance = std::max(distance_to_box(viewer), 1e-6f);
  const float patch_width = 2.0f * box.radius() / viewer_distance;
  if (!is_convex) return patch_width;
  const float curvature_radius = box.radius() / std::max(std::sin(std::min(spread, 1.5707964f)), 1e-6f);
  const float distance = std::max(distance_to_box(centre) - radius, 0.0f);
  const float share = curvature_radius / (2.0f * distance + curvature_radius);
  return std::min(patch_width, 2.0f * radius * share / (viewer_distance + distance * share));
}

PatchBounds patch_bounds(const ReflectorMesh& mesh, const ReflectorPatch& patch) {
  PatchBounds bounds;
  glm::vec3 sum(0.0f);
  for (const std::uint32_t t : patch.triangles) {
    for (const glm::vec3& corner : mesh.corners(t)) bounds.box.add(corner);
    for (const glm::vec3& normal : mesh.normals(t)) sum += normal;
  }
  if (!(glm::length(sum) > 0.0f)) return bounds;
  bounds.axis = glm::normalize(sum);
  bounds.spread = 0.0f;
  for (const std::uint32_t t : patch.triangles)
    for (const glm::vec3& normal : mesh.normals(t))
      bounds.spread = std::max(bounds.spread, angle_between(normal, bounds.axis));
  bounds.spread += map_slack;
  return bounds;
}

}  // namespace parvis::reflector_maps

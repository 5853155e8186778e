#include "graphics/reference/scene_lamps.h"

#include <algorithm>
#include <cmath>

#include "scene/data/lamp.h"
#include "scene/data/name_pattern.h"

namespace parvis::reference {
namespace {

using glm::vec3, glm::vec4;

/// Luminance of the glass is held to this, so that what glows is white, and what it lights is not lost.
constexpr float max_glass_radiance = 0.6f;
constexpr float pair_m = 0.6f;  // a part that is wider is a pair: a lamp on the left and one on the right

/// The middles of a part of an object, in the object's frame.
std::vector<vec3> middles_of(const scene::Object& object, const std::string& part_name) {
  std::vector<vec3> middles;
  const scene::Model& model = *object.model;
  const std::vector<glm::mat4> pose = object.pose.empty() ? scene::rest_pose(model) : object.pose;
  for (const scene::Part& part : model.parts) {
    if (part.object != part_name || part.mesh.positions.empty()) continue;
    const glm::mat4& model_from_part = pose[std::size_t(part.node)];
    const Bounds bounds = transformed(model_from_part, part.mesh.bounds());
    const vec3 centre = bounds.centre();
    if (bounds.size().y <= pair_m) {
      middles.push_back(centre);
      continue;
    }
    for (const float side : {1.0f, -1.0f}) {
      Bounds half;
      for (const vec3& p : part.mesh.positions) {
        const vec3 at(model_from_part * vec4(p, 1.0f));
        if (side * (at.y - centre.y) > 0.0f) half.add(at);
      }
      if (!half.empty()) middles.push_back(half.centre());
    }
  }
  return middles;
}

void add(std::vector<shading::Lamp>& lamps, const scene::Lamp& lamp, const glm::mat4& world_from_object,
         vec3 position) {
  shading::Lamp lit{};
  lit.place = vec4(vec3(world_from_object * vec4(position, 1.0f)), lamp.reach_m);
  lit.power = vec4(lamp.intensity, 0.0f);
  const vec3 axis = glm::mat3(world_from_object) * lamp.axis;
  const float length = glm::length(axis);
  const bool is_cone = lamp.half_angle < 3.14f && length > 0.0f;
  lit.axis = is_cone ? vec4(axis / length, std::cos(lamp.half_angle)) : vec4(0.0f, 0.0f, -1.0f, -2.0f);
  const float face_m2 = 3.1415927f * std::max(lamp.radius_m * lamp.radius_m, 1e-4f);
  const float brightest = std::max({lamp.intensity.x, lamp.intensity.y, lamp.intensity.z}) / face_m2;
  const float share = brightest > max_glass_radiance ? max_glass_radiance / brightest : 1.0f;
  lit.body = vec4(share / face_m2 * lamp.intensity, lamp.radius_m);
  lamps.push_back(lit);
}

}  // namespace

std::vector<shading::Lamp> lit_lamps(const scene::Scene& scene, LampKind kind) {
  std::vector<shading::Lamp> lamps;
  for (const scene::Lamp& lamp : scene.items<scene::Lamp>()) {
    if (!burns(scene, lamp)) continue;
    if (lamp.of.empty()) {
      if (kind != LampKind::moving) add(lamps, lamp, glm::mat4(1.0f), lamp.position);
      continue;
    }
    for (const scene::Object& object : scene.objects) {
      const bool counts = kind == LampKind::all || object.is_dynamic == (kind == LampKind::moving);
      if (!counts || !object.is_visible || !scene::matches(lamp.of, object.name)) continue;
      if (lamp.part.empty()) {
        add(lamps, lamp, object.world_from_model, lamp.position);
        continue;
      }
      for (const vec3 middle : middles_of(object, lamp.part))
        add(lamps, lamp, object.world_from_model, middle + lamp.position);
    }
  }
  return lamps;
}

Ray ray_to_lamp(const shading::Lamp& lamp, vec3 position, vec3 geometric_normal) {
  Ray ray;
  ray.origin = position + 1e-3f * geometric_normal;
  const vec3 to_lamp = vec3(lamp.place) - ray.origin;
  const float distance_m = std::max(glm::length(to_lamp), 1e-3f);
  ray.direction = to_lamp / distance_m;
  ray.max_m = std::max(distance_m - lamp.body.w, ray.min_m);
  return ray;
}

}  // namespace parvis::reference

#include "stage/place_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

#include "graphics/render/fixed_parts.h"

namespace parvis::stage {
namespace {

constexpr int min_backs = 4;         // of six directions: a camera under a bridge or in an arcade sees fewer
constexpr float max_wall_m = 60.0f;  // half of the largest hall

/// The nearest face in one of six directions.
struct Hit {
  float distance_m = max_wall_m;
  int object = -1;
  bool is_back = false;
};
using Hits = std::array<Hit, 6>;  // +x, -x, +y, -y, +z, -z

/// Where a line through `eye` along an axis meets a triangle, if it does, signed; and the side that it meets.
void meet(std::array<glm::vec3, 3> corners, glm::vec3 eye, int axis, int object, Hits& hits) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  for (glm::vec3& corner : corners) corner -= eye;
  const auto cross = [&](const glm::vec3& a, const glm::vec3& b) { return a[u] * b[v] - a[v] * b[u]; };
  const float a = cross(corners[1], corners[2]), b = cross(corners[2], corners[0]),
              c = cross(corners[0], corners[1]);
  if (!((a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0))) return;
  const float sum = a + b + c;  // its sign: whether the triangle faces along the axis
  if (sum == 0.0f) return;
  const float along = (a * corners[0][axis] + b * corners[1][axis] + c * corners[2][axis]) / sum;
  Hit& hit = hits[2 * std::size_t(axis) + (along < 0.0f ? 1 : 0)];
  if (std::abs(along) >= hit.distance_m) return;
  hit = {std::abs(along), object, (sum > 0.0f) == (along > 0.0f)};
}

/// True if a line through `eye` along the axis passes the box.
bool passes(const Bounds& box, glm::vec3 eye, int axis) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  return box.min[u] <= eye[u] && eye[u] <= box.max[u] && box.min[v] <= eye[v] && eye[v] <= box.max[v] &&
         box.min[axis] - max_wall_m <= eye[axis] && eye[axis] <= box.max[axis] + max_wall_m;
}

using Parts = std::vector<std::pair<render::FixedPart, Bounds>>;

Hits look_around(const Parts& parts, glm::vec3 eye) {
  Hits hits;
  for (const auto& [part, box] : parts) {
    std::array<bool, 3> is_passed{};
    for (int axis = 0; axis < 3; ++axis) is_passed[std::size_t(axis)] = passes(box, eye, axis);
    if (!is_passed[0] && !is_passed[1] && !is_passed[2]) continue;
    const std::vector<std::uint32_t>& indices = part.mesh.indices;
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
      std::array<glm::vec3, 3> corners;
      for (std::size_t k = 0; k < 3; ++k)
        corners[k] = glm::vec3(part.world_from_mesh * glm::vec4(part.mesh.positions[indices[i + k]], 1.0f));
      for (int axis = 0; axis < 3; ++axis)
        if (is_passed[std::size_t(axis)]) meet(corners, eye, axis, part.object, hits);
    }
  }
  return hits;
}

/// The opaque parts of what a camera follows, as it stands now: of other things that move none stays there.
Parts parts_of(const scene::Scene& scene, const std::string& name) {
  Parts parts;
  const auto object = std::ranges::find_if(
      scene.objects, [&](const scene::Object& each) { return each.is_visible && each.name == name; });
  if (object == scene.objects.end()) return parts;
  const std::vector<glm::mat4> pose = object->pose.empty() ? scene::rest_pose(*object->model) : object->pose;
  for (const scene::Part& part : object->model->parts) {
    const scene::Material& material = object->model->materials[std::size_t(part.material)];
    if (material.alpha_mode != scene::Alpha::opaque || material.refracts()) continue;
    const glm::mat4 world_from_mesh = object->world_from_model * pose[std::size_t(part.node)];
    parts.emplace_back(render::FixedPart{part.mesh, world_from_mesh, int(object - scene.objects.begin()),
                                         true, material.is_double_sided},
                       transformed(world_from_mesh, part.mesh.bounds()));
  }
  return parts;
}

/// False where nothing lies below any lane, as far as some of them tell.
bool have_ground(const std::vector<scene::Lane>& lanes, const Parts& parts) {
  constexpr std::size_t max_tried = 64, down = 5;
  constexpr float above_m = 1.0f, max_below_m = 5.0f;
  const std::size_t step = lanes.size() / max_tried + 1;
  for (std::size_t i = 0; i < lanes.size(); i += step) {
    const glm::vec3 middle = lanes[i].points[lanes[i].points.size() / 2];
    if (look_around(parts, middle + glm::vec3(0, 0, above_m))[down].distance_m < max_below_m) return true;
  }
  return lanes.empty();
}

/// Median of the objects' middles along each axis: one that is far off does not move
/// it.
glm::vec2 middle_of(std::vector<glm::vec2> middles) {
  glm::vec2 middle(0.0f);
  for (int axis = 0; axis < 2; ++axis) {
    const auto half = middles.begin() + std::ptrdiff_t(middles.size() / 2);
    std::ranges::nth_element(middles, half, {}, [&](const glm::vec2& each) { return each[axis]; });
    middle[axis] = (*half)[axis];
  }
  return middle;
}

/// Warns of objects, few against all, that no view of the place shows.
void check_distances(const scene::Scene& scene, Errors& warnings) {
  constexpr float far_m = 30'000.0f;
  std::unordered_map<const scene::Model*, Bounds> bounds;
  std::vector<std::size_t> objects;
  std::vector<Bounds> boxes;
  std::vector<glm::vec2> middles;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const scene::Object& object = scene.objects[i];
    const auto [box, is_new] = bounds.try_emplace(object.model.get());
    if (is_new) box->second = scene::bounds(*object.model);
    if (!object.is_visible || box->second.empty()) continue;
    objects.push_back(i), boxes.push_back(transformed(object.world_from_model, box->second));
    middles.emplace_back(boxes.back().centre());
  }
  if (objects.size() < 2) return;
  const glm::vec2 middle = middle_of(middles);
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const glm::vec2 nearest = glm::clamp(middle, glm::vec2(boxes[i].min), glm::vec2(boxes[i].max));
    if (const float away_m = glm::distance(nearest, middle); away_m > far_m)
      warnings.push_back(
          error("\"{}\" lies {:.0f} km from the middle of the scene: its coordinates may be those of "
                "another place or system; check position= and the model's file",
                scene.objects[objects[i]].name, away_m / 1000.0f));
  }
}

}  // namespace

Errors check_place(const scene::Scene& scene) {
  Errors warnings;
  check_distances(scene, warnings);
  if (scene.cameras.empty()) return warnings;
  Parts parts;
  render::for_each_fixed_object_part(scene, [&](const render::FixedPart& part) {
    if (part.is_visible) parts.emplace_back(part, transformed(part.world_from_mesh, part.mesh.bounds()));
  });
  if (!have_ground(scene.roads.lanes, parts))
    warnings.push_back(
        error("nothing lies below the roads: add terrain_plane() for the ground, and paving() for "
              "their surfaces"));
  for (const scene::NamedCamera& camera : scene.cameras) {
    const Result<Camera> now = scene.camera_now(camera);
    if (!now) continue;  // it follows what is hidden
    const Hits hits = look_around(camera.follows.empty() ? parts : parts_of(scene, camera.follows),
                                  now->position_in_world());
    if (std::ranges::count_if(hits, &Hit::is_back) < min_backs) continue;
    const Hit& wall = *std::ranges::find_if(hits, &Hit::is_back);
    warnings.push_back(
        {fmt::format("camera \"{}\" stands inside \"{}\": it sees the backs of its faces; move it out{}, or "
                     "show both sides of the object's material",
                     camera.name, scene.objects[std::size_t(wall.object)].name,
                     camera.follows.empty() ? "" : " by offset="),
         {}});
  }
  return warnings;
}

}  // namespace parvis::stage

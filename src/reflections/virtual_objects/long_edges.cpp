#include "reflections/virtual_objects/long_edges.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <unordered_map>

#include "scene/data/glass_pieces.h"

namespace parvis::virtual_objects {
namespace {

constexpr float longest_angle = 0.18f;  // radians under which a reflector may see an edge
constexpr float longest_angle_in_glass = 0.05f;
constexpr float focal_reach = 2.5f;  // radii: what is farther, glass makes smaller
constexpr float min_reach = 1.1f;    // radii: what is nearer is treated as if it stood there
constexpr int max_rounds = 16;
constexpr std::size_t max_triangles_of_a_part = 200000;

float distance_to_segment(glm::vec3 point, glm::vec3 a, glm::vec3 b) {
  const glm::vec3 along = b - a;
  const float size = glm::dot(along, along);
  const float part = size > 0.0f ? std::clamp(glm::dot(point - a, along) / size, 0.0f, 1.0f) : 0.0f;
  return glm::distance(point, a + part * along);
}

/// Its image in a ball strays from a straight line by about the square of the angle.
bool is_long(glm::vec3 a, glm::vec3 b, std::span<const ReflectorBall> balls) {
  if (std::tie(b.x, b.y, b.z) < std::tie(a.x, a.y, a.z)) std::swap(a, b);  // rounded alike from both sides
  return std::any_of(balls.begin(), balls.end(), [&](const ReflectorBall& ball) {
    const float reach = std::max(distance_to_segment(ball.centre, a, b), min_reach * ball.radius);
    const bool is_enlarged = ball.is_glass && reach < focal_reach * ball.radius;
    return glm::distance(a, b) > (is_enlarged ? longest_angle_in_glass : longest_angle) * reach;
  });
}

/// One round of halving. Each triangle falls into as many pieces as it has long edges, and one.
class Halving {
 public:
  Halving(const Mesh& mesh, const glm::mat4& world_from_mesh, std::span<const ReflectorBall> balls)
      : mesh_(mesh), balls_(balls) {
    for (const glm::vec3& p : mesh.positions) in_world_.emplace_back(world_from_mesh * glm::vec4(p, 1.0f));
  }

  Mesh halved() {
    Mesh made = mesh_;
    made.indices.clear();
    for (std::size_t i = 0; i < mesh_.indices.size(); i += 3) divide(&mesh_.indices[i], made);
    return made;
  }

 private:
  static constexpr std::uint32_t none = ~0u;

  /// The new vertex in the middle of an edge, or `none` if it is short.
  std::uint32_t middle(std::uint32_t a, std::uint32_t b, Mesh& made) {
    const std::uint64_t key = (std::uint64_t(std::min(a, b)) << 32) | std::max(a, b);
    const auto [known, is_new] = middles_.try_emplace(key, none);
    if (is_new && is_long(in_world_[a], in_world_[b], balls_)) {
      known->second = std::uint32_t(made.positions.size());
      made.positions.push_back(0.5f * (made.positions[a] + made.positions[b]));
      made.uvs.push_back(0.5f * (made.uvs[a] + made.uvs[b]));
      if (!made.second_uvs.empty())
        made.second_uvs.push_back(0.5f * (made.second_uvs[a] + made.second_uvs[b]));
      if (!made.colours.empty()) made.colours.push_back(0.5f * (made.colours[a] + made.colours[b]));
      const glm::vec3 normal = made.normals[a] + made.normals[b];
      const float size = glm::length(normal);
      made.normals.push_back(size > 0.0f ? normal / size : made.normals[a]);
    }
    return known->second;
  }

  void divide(const std::uint32_t* corner, Mesh& made) {
    std::array<std::uint32_t, 3> m{};
    for (std::size_t k = 0; k < 3; ++k) m[k] = middle(corner[k], corner[(k + 1) % 3], made);
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      for (const std::uint32_t v : {a, b, c}) made.indices.push_back(v);
    };
    const auto count = 3 - std::count(m.begin(), m.end(), none);
    if (count == 0) return add(corner[0], corner[1], corner[2]);
    if (count == 3) {
      for (std::size_t k = 0; k < 3; ++k) add(corner[k], m[k], m[(k + 2) % 3]);
      return add(m[0], m[1], m[2]);
    }
    // Turned so that the first edge is long, and of two the third.
    std::size_t first = 0;
    while (m[first] == none || (count == 2 && m[(first + 2) % 3] == none)) ++first;
    const std::uint32_t a = corner[first], b = corner[(first + 1) % 3], c = corner[(first + 2) % 3];
    const std::uint32_t ab = m[first], ca = m[(first + 2) % 3];
    if (count == 1) {
      add(a, ab, c);
      return add(ab, b, c);
    }
    add(a, ab, ca);
    add(ab, b, c);
    add(ab, c, ca);
  }

  const Mesh& mesh_;
  std::span<const ReflectorBall> balls_;
  std::vector<glm::vec3> in_world_;
  std::unordered_map<std::uint64_t, std::uint32_t> middles_;
};

std::vector<ReflectorBall> reflector_balls(const scene::Scene& scene) {
  std::vector<ReflectorBall> balls;
  for (const scene::Object& object : scene.objects) {
    if (!object.takes_reflection || !object.is_visible) continue;
    const scene::Model& model = *object.model;
    const auto add = [&](const Bounds& bounds, bool is_glass) {
      // Half the greatest side: a box's corners are beyond what it encloses.
      const glm::vec3 size = bounds.size();
      if (!bounds.empty())
        balls.push_back({bounds.centre(), 0.5f * std::max({size.x, size.y, size.z}), is_glass});
    };
    const std::vector<glm::mat4> pose = scene::rest_pose(model);
    Bounds mirrors;
    for (const scene::Part& part : model.parts)
      if (const scene::Material& material = model.materials[std::size_t(part.material)];
          material.is_mirror_like && !material.refracts())
        mirrors.add(transformed(object.world_from_model * pose[std::size_t(part.node)], part.mesh.bounds()));
    add(mirrors, false);
    for (const scene::GlassPiece& body : scene::glass_pieces(model))
      if (model.materials[std::size_t(body.material)].is_mirror_like)
        add(transformed(object.world_from_model, body.mesh.bounds()), true);
  }
  return balls;
}

}  // namespace

Mesh with_short_edges(const Mesh& mesh, const glm::mat4& world_from_mesh,
                      std::span<const ReflectorBall> balls, std::size_t max_triangles) {
  Mesh divided = mesh;
  for (int round = 0; round < max_rounds; ++round) {
    Mesh next = Halving(divided, world_from_mesh, balls).halved();
    if (next.indices.size() == divided.indices.size() || next.indices.size() > 3 * max_triangles) break;
    divided = std::move(next);
  }
  return divided;
}

void divide_long_edges(scene::Scene& scene) {
  const std::vector<ReflectorBall> balls = reflector_balls(scene);
  if (balls.empty()) return;
  std::unordered_map<const scene::Model*, std::shared_ptr<scene::Model>> divided;
  for (const scene::Object& object : scene.objects) {
    if (!object.deformed_meshes.empty() || object.takes_reflection) continue;
    std::shared_ptr<scene::Model>& model = divided[object.model.get()];
    if (!model) model = std::make_shared<scene::Model>(*object.model);
    const std::vector<glm::mat4> pose = scene::rest_pose(*model);
    for (scene::Part& part : model->parts)
      if (!part.deformation)
        part.mesh = with_short_edges(part.mesh, object.world_from_model * pose[std::size_t(part.node)], balls,
                                     max_triangles_of_a_part);
  }
  for (scene::Object& object : scene.objects)
    if (const auto found = divided.find(object.model.get());
        found != divided.end() && object.deformed_meshes.empty() && !object.takes_reflection)
      object.model = found->second;
}

}  // namespace parvis::virtual_objects

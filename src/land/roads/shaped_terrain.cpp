#include "land/roads/shaped_terrain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <tuple>
#include <unordered_map>

#include "base/memory_budget.h"
#include "land/roads/road_beds.h"

namespace parvis::scene {
namespace {

constexpr float surface_tolerance_m = 0.01f;  // of the surface, off what the works say
constexpr float shortest_m = 1.0f;            // of edges that are divided
constexpr float edge_step_m = 1.0f;           // between places of an edge that are looked at
constexpr int max_edge_steps = 256;           // on an edge across a whole town
constexpr float inner_step_m = 6.0f;          // the same inside a triangle: dead ends cross no edge
constexpr int max_inner_steps = 150;
constexpr int max_depth = 40;
constexpr float slope_step_m = 0.5f;         // for normals
constexpr float steepest_normal = 0.2f;      // z of normals whose slope is not taken for a plane's
constexpr std::uint64_t bytes_per_m = 4000;  // of road: 40 triangles with their edges while they are divided

class Shaping {
 public:
  Shaping(const Mesh& mesh, const glm::mat4& world_from_mesh, const Earthworks& works)
      : works_(works), world_from_mesh_(world_from_mesh), mesh_from_world_(glm::inverse(world_from_mesh)) {
    result_ = mesh, result_.indices.clear();
    if (result_.normals.size() != mesh.positions.size()) {
      result_.indices = mesh.indices;
      fill_normals(result_);
      result_.indices.clear();
    }
    result_.indices.reserve(mesh.indices.size());
    bare_.reserve(mesh.positions.size()), shaped_m_.reserve(mesh.positions.size());
    for (const glm::vec3& position : mesh.positions)
      add_bare(glm::vec3(world_from_mesh * glm::vec4(position, 1.0f)));
    first_new_ = bare_.size();
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
      divide({mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]}, 0);
    for (std::size_t i = 0; i < bare_.size(); ++i) settle(i);
  }

  Mesh take() && { return std::move(result_); }

 private:
  using Triangle = std::array<std::uint32_t, 3>;
  static constexpr std::uint32_t none = ~0u;

  template <class T>
  static T mean_of(const std::vector<T>& values, std::span<const std::uint32_t> corners) {
    T sum(0.0f);
    for (const std::uint32_t corner : corners) sum += values[corner];
    return sum / float(corners.size());
  }

  std::uint32_t add_bare(glm::vec3 point) {
    bare_.push_back(point);
    shaped_m_.push_back(works_.at(glm::vec2(point), point.z));
    return std::uint32_t(bare_.size() - 1);
  }

  /// A vertex between others, on the bare ground.
  std::uint32_t add_between(std::span<const std::uint32_t> corners) {
    glm::vec3 point(0.0f), position(0.0f), normal(0.0f);
    glm::vec2 uv(0.0f);
    const float weight = 1.0f / float(corners.size());
    for (const std::uint32_t corner : corners) {
      point += weight * bare_[corner], position += weight * result_.positions[corner];
      normal += result_.normals[corner];
      if (!result_.uvs.empty()) uv += weight * result_.uvs[corner];
    }
    result_.positions.push_back(position);
    result_.normals.push_back(glm::length(normal) > 0.0f ? glm::normalize(normal)
                                                         : result_.normals[corners.front()]);
    if (!result_.uvs.empty()) result_.uvs.push_back(uv);
    if (!result_.second_uvs.empty()) result_.second_uvs.push_back(mean_of(result_.second_uvs, corners));
    if (!result_.colours.empty()) result_.colours.push_back(mean_of(result_.colours, corners));
    return add_bare(point);
  }

  /// How far the works are off a plane surface at a place in it, whose corners have these weights.
  float error_m(std::span<const std::uint32_t> corners, std::span<const float> weights) const {
    glm::vec3 point(0.0f);
    float height_m = 0.0f;
    for (std::size_t i = 0; i < corners.size(); ++i)
      point += weights[i] * bare_[corners[i]], height_m += weights[i] * shaped_m_[corners[i]];
    return std::abs(works_.at(glm::vec2(point), point.z) - height_m);
  }

  bool is_bent(std::uint32_t a, std::uint32_t b) const {
    const float length_m = glm::distance(glm::vec2(bare_[a]), glm::vec2(bare_[b]));
    if (length_m < shortest_m) return false;
    // The same from both sides, to the last bit: meshes side by side share their edges.
    const auto order = [](glm::vec3 p) { return std::tuple(p.x, p.y, p.z); };
    if (order(bare_[b]) < order(bare_[a])) std::swap(a, b);
    const int steps = std::clamp(int(std::ceil(length_m / edge_step_m)), 2, max_edge_steps);
    for (int k = 1; k < steps; ++k) {
      const float fraction = float(k) / float(steps);
      if (error_m(std::array{a, b}, std::array{1.0f - fraction, fraction}) > surface_tolerance_m) return true;
    }
    return false;
  }

  /// The vertex in the middle of an edge that is divided, else `none`.
  std::uint32_t middle_of(std::uint32_t a, std::uint32_t b) {
    const std::uint64_t key = std::uint64_t(std::min(a, b)) << 32u | std::max(a, b);
    const auto [known, is_new] = middles_.try_emplace(key, none);
    if (is_new && is_bent(a, b)) {
      const std::uint32_t middle = add_between(std::array{a, b});
      middles_[key] = middle;
      return middle;
    }
    return known->second;
  }

  /// Whether the works bend a triangle inside, though its edges are straight.
  bool is_bent_inside(const Triangle& t) const {
    float longest_m = 0.0f;
    for (std::size_t k = 0; k < 3; ++k)
      longest_m =
          std::max(longest_m, glm::distance(glm::vec2(bare_[t[k]]), glm::vec2(bare_[t[(k + 1) % 3]])));
    const int steps = std::min(int(longest_m / inner_step_m), max_inner_steps);
    for (int i = 1; i < steps; ++i)
      for (int k = 1; i + k < steps; ++k) {
        const float u = float(i) / float(steps), v = float(k) / float(steps);
        if (error_m(t, std::array{1.0f - u - v, u, v}) > surface_tolerance_m) return true;
      }
    return false;
  }

  bool is_touched(const Triangle& t) const {
    const glm::vec2 a(bare_[t[0]]), b(bare_[t[1]]), c(bare_[t[2]]);
    return works_.may_change(glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c)));
  }

  void divide(const Triangle& t, int depth) {
    if (depth == max_depth || !is_touched(t)) {
      result_.indices.insert(result_.indices.end(), t.begin(), t.end());
      return;
    }
    const Triangle middle{middle_of(t[0], t[1]), middle_of(t[1], t[2]), middle_of(t[2], t[0])};
    const auto divided = std::ranges::count_if(middle, [](std::uint32_t m) { return m != none; });
    if (divided == 3) {
      divide(middle, depth + 1);
      for (std::size_t k = 0; k < 3; ++k) divide({t[k], middle[k], middle[(k + 2) % 3]}, depth + 1);
    } else if (divided == 2) {
      std::size_t k = 0;  // the corner between the two edges that are divided
      while (middle[k] == none || middle[(k + 2) % 3] == none) ++k;
      const std::uint32_t before = middle[(k + 2) % 3], after = middle[k], b = t[(k + 1) % 3],
                          c = t[(k + 2) % 3];
      divide({t[k], after, before}, depth + 1);
      divide({after, b, c}, depth + 1);
      divide({after, c, before}, depth + 1);
    } else if (divided == 1) {
      std::size_t k = 0;
      while (middle[k] == none) ++k;
      divide({t[k], middle[k], t[(k + 2) % 3]}, depth + 1);
      divide({middle[k], t[(k + 1) % 3], t[(k + 2) % 3]}, depth + 1);
    } else if (is_bent_inside(t)) {
      const std::uint32_t inside = add_between(t);
      for (std::size_t k = 0; k < 3; ++k) divide({t[k], t[(k + 1) % 3], inside}, depth + 1);
    } else {
      result_.indices.insert(result_.indices.end(), t.begin(), t.end());
    }
  }

  /// Moves a vertex to where the works want it, with the normal that the ground has there.
  void settle(std::size_t i) {
    if (i < first_new_ && !works_.may_change(glm::vec2(bare_[i]), glm::vec2(bare_[i]))) return;
    const float raised_m = shaped_m_[i] - bare_[i].z;
    result_.positions[i] += glm::vec3(mesh_from_world_ * glm::vec4(0.0f, 0.0f, raised_m, 0.0f));
    const glm::mat3 turned(world_from_mesh_);
    const glm::vec3 normal = glm::normalize(glm::transpose(glm::inverse(turned)) * result_.normals[i]);
    if (!(normal.z > steepest_normal)) return;
    const glm::vec2 rise = -glm::vec2(normal) / normal.z;  // of the bare ground, per metre
    const auto height_m = [&](glm::vec2 away) {
      return works_.at(glm::vec2(bare_[i]) + away, bare_[i].z + glm::dot(rise, away));
    };
    const glm::vec2 x(slope_step_m, 0.0f), y(0.0f, slope_step_m);
    const glm::vec3 shaped_normal(height_m(-x) - height_m(x), height_m(-y) - height_m(y),
                                  2.0f * slope_step_m);
    result_.normals[i] = glm::normalize(glm::transpose(turned) * glm::normalize(shaped_normal));
  }

  const Earthworks& works_;
  glm::mat4 world_from_mesh_, mesh_from_world_;
  Mesh result_;
  std::vector<glm::vec3> bare_;  ///< vertices in the world, before the works
  std::vector<float> shaped_m_;  ///< their heights after them
  std::size_t first_new_ = 0;
  std::unordered_map<std::uint64_t, std::uint32_t> middles_;  ///< by the ends of an edge
};

/// Metres of beds that change terrain.
double length_m(std::span<const RoadBed> beds) {
  double sum_m = 0.0;
  for (const RoadBed& bed : beds)
    for (std::size_t i = 0; i + 1 < bed.points.size(); ++i)
      if (std::min(bed.points[i].kind, bed.points[i + 1].kind) != Bed::none)
        sum_m += double(glm::distance(bed.points[i].position, bed.points[i + 1].position));
  return sum_m;
}

/// Replaces the object's model where works change terrain of it.
void shape(Object& object, Terrain terrain, const Earthworks& works) {
  const std::vector<glm::mat4> pose = object.pose.empty() ? rest_pose(*object.model) : object.pose;
  const auto world_from_mesh = [&](const Part& part) {
    return object.world_from_model * pose[std::size_t(part.node)];
  };
  const auto is_changed = [&](const Part& part) {
    if (terrain_of(part.object) != terrain || part.mesh.indices.empty()) return false;
    const Bounds box = transformed(world_from_mesh(part), part.mesh.bounds());
    return works.may_change(glm::vec2(box.min), glm::vec2(box.max));
  };
  if (std::ranges::none_of(object.model->parts, is_changed)) return;
  auto model = std::make_shared<Model>(*object.model);
  for (Part& part : model->parts)
    if (is_changed(part)) part.mesh = shaped(part.mesh, world_from_mesh(part), works);
  object.model = std::move(model);
}

}  // namespace

Mesh shaped(const Mesh& mesh, const glm::mat4& world_from_mesh, const Earthworks& works) {
  return Shaping(mesh, world_from_mesh, works).take();
}

Status shape_terrain(Scene& scene, std::span<const Road> roads) {
  std::vector<Road> shaping(roads.begin(), roads.end());
  std::ranges::move(right_turns(scene.roads), std::back_inserter(shaping));
  for (const Terrain terrain : {Terrain::surveyed, Terrain::generated}) {
    const auto has_terrain = [&](const Object& object) {
      return std::ranges::any_of(object.model->parts,
                                 [&](const Part& part) { return terrain_of(part.object) == terrain; });
    };
    if (std::ranges::none_of(scene.objects, has_terrain)) continue;
    std::vector<RoadBed> beds = road_beds(scene, shaping, terrain);
    for (std::size_t i = roads.size(); i < beds.size(); ++i) beds[i].is_turn = true;
    const double shaped_m = length_m(beds);
    if (shaped_m <= 0.0) continue;
    if (Status enough = check_memory(std::uint64_t(shaped_m) * bytes_per_m,
                                     fmt::format("terrain shaped for {:.0f} m of roads", shaped_m));
        !enough)
      return enough;
    const Earthworks works(beds);
    for (Object& object : scene.objects)
      if (has_ground(scene, object)) shape(object, terrain, works);
  }
  return Ok{};
}

}  // namespace parvis::scene

#include "reflections/local_maps/local_map_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "reflections/local_maps/local_map_faces.h"

namespace parvis::local_maps {
namespace {

constexpr int max_splits = 5;  // a quad of 32 texels down to one
constexpr float not_traced = -1.0f;
constexpr std::uint32_t no_vertex = std::numeric_limits<std::uint32_t>::max();

/// How often a quad may be split in four until it would be smaller than allowed.
int splits_of(const FaceTask& task) {
  const float quad_texels = float(task.tile) / float(task.rule.quads);
  const float halvings = std::log2(quad_texels / std::max(task.rule.smallest_texels, 1e-3f));
  return std::clamp(int(std::floor(halvings + 1e-4f)), 0, max_splits);
}

/// A face's points on the finest lattice that its quads can have; those that are needed are traced, once.
class FaceMesher {
 public:
  FaceMesher(const HeightPyramid& heights, const FaceTask& task, FaceMesh& mesh)
      : heights_(heights), task_(task), mesh_(mesh), quad_size_(1 << splits_of(task)) {
    side_ = task.rule.quads * quad_size_ + 1;
    const std::size_t points = std::size_t(side_) * std::size_t(side_);
    scratch().distances.assign(points, not_traced);
    scratch().vertices.assign(points, no_vertex);
    scratch().leaves.clear();
    mesh_.vertices.clear();
    mesh_.indices.clear();
    mesh_.nearest_m = sky_distance_m;
  }

  void make() {
    for (int y = 0; y + 1 < side_; y += quad_size_)
      for (int x = 0; x + 1 < side_; x += quad_size_) split({x, y, quad_size_});
    for (const Quad& quad : scratch().leaves) cover(quad);
  }

 private:
  struct Quad {
    int x, y, size;  ///< on the lattice
  };
  struct Scratch {
    std::vector<float> distances;         ///< of each lattice point from the centre, metres
    std::vector<std::uint32_t> vertices;  ///< of each lattice point: its index in the mesh
    std::vector<Quad> leaves;
  };
  /// One for each thread, kept: a face needs no memory of its own.
  static Scratch& scratch() {
    static thread_local Scratch kept;
    return kept;
  }

  std::size_t index(int x, int y) const { return std::size_t(y) * std::size_t(side_) + std::size_t(x); }
  glm::vec2 texel(int x, int y) const { return glm::vec2(x, y) * (float(task_.tile) / float(side_ - 1)); }
  glm::vec3 direction(int x, int y) const {
    return direction_on_face(place_of_texel(texel(x, y), float(task_.tile), float(local_map_border)),
                             task_.face);
  }

  /// The exact walk, not the paper's entry into the first higher cell: that one ends at once where a body's
  /// own cell holds a lamp, an awning or the foot of a wall, and its map is black there.
  float distance_m(int x, int y) {
    float& distance = scratch().distances[index(x, y)];
    if (distance == not_traced) {
      const HeightHit hit =
          heights_.walk_by_levels(task_.centre, glm::normalize(direction(x, y)), sky_distance_m);
      distance = std::max(hit.distance_m, 1e-2f);
      mesh_.nearest_m = std::min(mesh_.nearest_m, distance);
    }
    return distance;
  }

  std::uint32_t vertex(int x, int y) {
    std::uint32_t& vertex = scratch().vertices[index(x, y)];
    if (vertex == no_vertex) {
      vertex = std::uint32_t(mesh_.vertices.size());
      const glm::vec3 ray = direction(x, y);
      const float ahead_m = distance_m(x, y) / glm::length(ray);
      mesh_.vertices.push_back({task_.corner + texel(x, y), ahead_m,
                                2.0f / float(task_.tile - 2 * local_map_border), task_.centre + ahead_m * ray,
                                task_.map_pair});
    }
    return vertex;
  }

  /// The paper's criterion: |Zi - Zj| / min(Zi, Zj) > R for any two corners.
  bool spans_depths(const Quad& quad) {
    const std::array<float, 4> depths{distance_m(quad.x, quad.y), distance_m(quad.x + quad.size, quad.y),
                                      distance_m(quad.x, quad.y + quad.size),
                                      distance_m(quad.x + quad.size, quad.y + quad.size)};
    const auto [nearest, farthest] = std::ranges::minmax(depths);
    return farthest - nearest > task_.rule.depth_ratio * nearest;
  }

  void split(const Quad& quad) {
    if (quad.size == 1 || !spans_depths(quad)) {
      for (const int y : {quad.y, quad.y + quad.size})
        for (const int x : {quad.x, quad.x + quad.size}) vertex(x, y);
      scratch().leaves.push_back(quad);
      return;
    }
    const int half = quad.size / 2;
    for (const int y : {quad.y, quad.y + half})
      for (const int x : {quad.x, quad.x + half}) split({x, y, half});
  }

  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    mesh_.indices.insert(mesh_.indices.end(), {a, b, c});
  }

  /// Two triangles; or, where smaller neighbours have corners on its sides, a fan about its middle that goes
  /// through all of them: no gap opens between sides that are the same.
  void cover(const Quad& quad) {
    std::array<std::uint32_t, 4 << max_splits> around;
    std::size_t count = 0;
    const std::array<glm::ivec2, 4> corners{{{quad.x, quad.y},
                                             {quad.x + quad.size, quad.y},
                                             {quad.x + quad.size, quad.y + quad.size},
                                             {quad.x, quad.y + quad.size}}};
    constexpr std::array<glm::ivec2, 4> steps{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
    for (std::size_t side = 0; side < 4; ++side)
      for (int i = 0; i < quad.size; ++i) {
        const glm::ivec2 point = corners[side] + i * steps[side];
        const std::uint32_t there = scratch().vertices[index(point.x, point.y)];
        if (there != no_vertex) around[count++] = there;
      }
    if (count == 4) {
      triangle(around[0], around[1], around[2]);
      triangle(around[0], around[2], around[3]);
      return;
    }
    const std::uint32_t middle = vertex(quad.x + quad.size / 2, quad.y + quad.size / 2);
    for (std::size_t i = 0; i < count; ++i) triangle(middle, around[i], around[(i + 1) % count]);
  }

  const HeightPyramid& heights_;
  const FaceTask& task_;
  FaceMesh& mesh_;
  int quad_size_;  ///< of an unsplit quad, on the lattice
  int side_;       ///< lattice points
};

}  // namespace

void make_face_mesh(const HeightPyramid& heights, const FaceTask& task, FaceMesh& mesh) {
  FaceMesher(heights, task, mesh).make();
}

}  // namespace parvis::local_maps

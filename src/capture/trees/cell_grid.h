// The recursive grid of the thesis (003_d5b01da2d2f805f6, sections 4.3 and 4.5.1), stored flat: the cells of
// the deepest level in bricks, so that a ray passes empty space in large steps.
//
// Departure: the hierarchy is not kept as a tree of pointers. Coarser levels are the cells' indices divided
// by the branching, which is all that levels of detail need.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <vector>

#include "base/bounds.h"
#include "capture/trees/tree_view.h"

namespace parvis::trees {

inline constexpr int no_cell = -1;
inline constexpr int max_grid_side = 729;

/// Cells of a box that is divided `side` times along each axis. Only cells that are not known to be empty are
/// stored; data per cell lies in arrays beside the grid, in the order of `cells`.
class CellGrid {
 public:
  CellGrid() = default;
  /// `cells` are distinct, each component in [0, side). `branching` is 3 (the thesis) or 2 (an octree);
  /// `side` is a power of it, at most max_grid_side.
  CellGrid(const Bounds& box, int branching, int side, std::vector<glm::u16vec3> cells);

  const Bounds& box() const { return box_; }                         ///< in the world, metres
  int side() const { return side_; }                                 ///< cells along each axis
  int branching() const { return branching_; }                       ///< 2 or 3
  std::size_t size() const { return cells_.size(); }                 ///< stored cells
  const std::vector<glm::u16vec3>& cells() const { return cells_; }  ///< integer coordinates
  /// Extents of a cell, metres.
  glm::vec3 cell_size_m() const { return box_.size() / float(side_); }
  /// The cell's middle in the world, metres.
  glm::vec3 centre(std::size_t cell) const {
    return box_.min + (glm::vec3(cells_[cell]) + 0.5f) * cell_size_m();
  }
  /// The cell's box in the world, metres.
  Bounds bounds(std::size_t cell) const;
  /// Index of the cell at integer coordinates, or no_cell.
  int cell_at(glm::ivec3 place) const;

  /// Calls visit(cell, enter_m, leave_m) for the stored cells that a ray passes, front to back, with its
  /// distances from the ray's origin in metres (exact to rounding); ends early when `visit` returns false.
  template <class Visit>
  void walk(const ViewRay& ray, Visit&& visit) const;

 private:
  struct Steps;  // of the traversal of one level
  std::size_t brick_index(glm::ivec3 brick) const {
    return (std::size_t(brick.z) * std::size_t(bricks_) + std::size_t(brick.y)) * std::size_t(bricks_) +
           std::size_t(brick.x);
  }
  // Into cell_at_, of a brick whose first index is known.
  std::size_t index_in_brick(std::int32_t first, glm::ivec3 within) const {
    const std::int32_t index = first + (within.z * brick_side_ + within.y) * brick_side_ + within.x;
    return std::size_t(index);
  }

  Bounds box_;
  int branching_ = 3, side_ = 0, brick_side_ = 1, bricks_ = 0;
  std::vector<std::int32_t> brick_at_;  // first index into cell_at_ of a brick; -1: it holds no cell
  std::vector<std::int32_t> cell_at_;   // bricks of brick_side^3 cell indices
  std::vector<glm::u16vec3> cells_;
};

/// Traversal of a regular subdivision by Amanatides and Woo 1987.
struct CellGrid::Steps {
  glm::ivec3 place, step;
  glm::vec3 next, delta;  // distance to the next face along each axis, and between faces

  /// Enters at distance t a box subdivided into cells of `cell_m`, `count` along each axis.
  Steps(glm::vec3 origin_in_box, glm::vec3 direction, glm::vec3 inverse, glm::vec3 cell_m, int count,
        float t) {
    const glm::vec3 at = (origin_in_box + t * direction) / cell_m;
    place = glm::clamp(glm::ivec3(glm::floor(at)), glm::ivec3(0), glm::ivec3(count - 1));
    for (int a = 0; a < 3; ++a) {
      step[a] = direction[a] > 0.0f ? 1 : -1;
      delta[a] = std::abs(cell_m[a] * inverse[a]);
      next[a] = ((float(place[a]) + (direction[a] > 0.0f ? 1.0f : 0.0f)) * cell_m[a] - origin_in_box[a]) *
                inverse[a];
    }
  }
  /// Distance at which the ray leaves the present cell.
  float leave() const { return std::min(std::min(next.x, next.y), next.z); }
  /// Goes on to the next cell.
  void advance() {
    const int a = next.x <= next.y ? (next.x <= next.z ? 0 : 2) : (next.y <= next.z ? 1 : 2);
    place[a] += step[a], next[a] += delta[a];
  }
  /// Is the present cell one of the box?
  bool inside(int count) const {
    return unsigned(place.x) < unsigned(count) && unsigned(place.y) < unsigned(count) &&
           unsigned(place.z) < unsigned(count);
  }
};

/// Distances at which a ray enters and leaves a box; enter >= leave where it misses. Behind the origin counts
/// as missed.
inline glm::vec2 box_distances(const Bounds& box, glm::vec3 origin, glm::vec3 inverse_direction) {
  const glm::vec3 a = (box.min - origin) * inverse_direction, b = (box.max - origin) * inverse_direction;
  const glm::vec3 low = glm::min(a, b), high = glm::max(a, b);
  return {std::max(std::max(low.x, low.y), std::max(low.z, 0.0f)),
          std::min(std::min(high.x, high.y), high.z)};
}

/// 1 / direction without infinities: components that vanish are replaced by tiny ones.
inline glm::vec3 inverse_of(glm::vec3& direction) {
  for (int a = 0; a < 3; ++a)
    if (std::abs(direction[a]) < 1e-9f) direction[a] = direction[a] < 0.0f ? -1e-9f : 1e-9f;
  return 1.0f / direction;
}

template <class Visit>
void CellGrid::walk(const ViewRay& ray, Visit&& visit) const {
  glm::vec3 direction = ray.direction;
  const glm::vec3 inverse = inverse_of(direction);
  const glm::vec2 span = box_distances(box_, ray.origin, inverse);
  if (span.x >= span.y) return;
  const glm::vec3 origin = ray.origin - box_.min, cell_m = cell_size_m(),
                  brick_m = cell_m * float(brick_side_);
  float t = span.x;
  for (Steps outer(origin, direction, inverse, brick_m, bricks_, t); outer.inside(bricks_); outer.advance()) {
    const float brick_leave = std::min(outer.leave(), span.y);
    const std::int32_t first = brick_at_[brick_index(outer.place)];
    if (first >= 0) {
      const glm::vec3 brick_origin = origin - glm::vec3(outer.place) * brick_m;
      for (Steps inner(brick_origin, direction, inverse, cell_m, brick_side_, t); inner.inside(brick_side_);
           inner.advance()) {
        const float leave = std::min(inner.leave(), brick_leave);
        const std::int32_t cell = cell_at_[index_in_brick(first, inner.place)];
        if (cell >= 0 && leave > t && !visit(std::size_t(cell), t, leave)) return;
        t = std::max(t, leave);
        if (inner.leave() >= brick_leave) break;
      }
    }
    t = std::max(t, brick_leave);
    if (brick_leave >= span.y) return;
  }
}

}  // namespace parvis::trees

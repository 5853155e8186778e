// Sets that are joined pair by pair, and triangles that hang together at their corners.
#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <map>
#include <numeric>
#include <vector>

namespace parvis {

/// A union-find forest over numbers from 0.
class DisjointSets {
 public:
  /// Each number is a set of its own.
  explicit DisjointSets(std::size_t count = 0) : parents_(count) {
    std::iota(parents_.begin(), parents_.end(), std::size_t(0));
  }
  /// Adds a set of one number, which it returns.
  std::size_t add() {
    parents_.push_back(parents_.size());
    return parents_.back();
  }
  /// The representative of the set of `i`. Halves the path on its way, so that long chains are walked
  /// once.
  std::size_t root(std::size_t i) {
    while (parents_[i] != i) i = parents_[i] = parents_[parents_[i]];
    return i;
  }
  /// Makes one set of two; the root of `b` stands for it.
  void join(std::size_t a, std::size_t b) { parents_[root(a)] = root(b); }

 private:
  std::vector<std::size_t> parents_;
};

/// Triangles that share a corner, whatever mesh it is of, belong together.
class TrianglesAtCorners {
 public:
  /// Corners that round to one multiple of `same_point` are one.
  explicit TrianglesAtCorners(float same_point) : same_point_(same_point) {}

  /// Adds a triangle; they are numbered from 0.
  void add(const std::array<glm::vec3, 3>& corners) {
    const std::size_t triangle = sets_.add();
    for (const glm::vec3& corner : corners) {
      const glm::dvec3 key = glm::round(glm::dvec3(corner) / double(same_point_));
      const auto [known, is_new] = triangle_at_.try_emplace({key.x, key.y, key.z}, triangle);
      if (!is_new) sets_.join(triangle, known->second);
    }
  }
  /// The triangle that stands for all that belong together with this one.
  std::size_t root(std::size_t triangle) { return sets_.root(triangle); }

 private:
  float same_point_;
  DisjointSets sets_;
  std::map<std::array<double, 3>, std::size_t> triangle_at_;
};

}  // namespace parvis

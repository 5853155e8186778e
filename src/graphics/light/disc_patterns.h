// In which directions the rays of lit vertices go.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "graphics/reference/frame.h"

namespace parvis::light {

/// One ray of so many brings the light of what it hits, for all of them: such light is smooth, and its rays
/// cost several times as much. Every third point of the R2 sequence is as even as all are; every fourth is
/// not.
inline constexpr int rays_per_bounce = 3;

/// Whether a ray of a vertex brings the light of what it hits.
inline bool brings_bounce(int ray) { return ray % rays_per_bounce == 0; }
/// How many of the first rays do.
inline int bounces_of(int rays) { return (rays + rays_per_bounce - 1) / rays_per_bounce; }

/// A ray of a vertex: its number, and where it leaves the unit disc before its turn.
struct DiscPoint {
  glm::vec2 at;
  int ray;
};

/// Vertices that follow each other, which lie close to each other in common meshes, share a pattern and its
/// turn: a ray of all of them goes about the same way.
inline constexpr std::size_t vertices_per_turn = 8;

/// Points of the unit disc for several vertices to share: rays `first` to `first + count - 1` of each
/// pattern. Rays that bring bounces come first, then the others, each by their angles.
class DiscPatterns {
 public:
  /// Patterns of `count` rays from number `first` on.
  DiscPatterns(int first, int count);
  /// Those of a vertex.
  std::span<const DiscPoint> of(std::size_t vertex) const {
    return {points_.data() + vertex / vertices_per_turn % pattern_count * count_, count_};
  }
  /// Those of them that bring bounces.
  std::span<const DiscPoint> bounces_of_vertex(std::size_t vertex) const {
    return of(vertex).first(bounces_);
  }
  /// The others.
  std::span<const DiscPoint> others_of_vertex(std::size_t vertex) const {
    return of(vertex).subspan(bounces_);
  }

 private:
  static constexpr std::size_t pattern_count = 64;
  std::size_t count_, bounces_;
  std::vector<DiscPoint> points_;
};

/// Axes about a direction, turned for a vertex: vertices that have the same pattern, but not those that
/// follow each other, have other directions in it.
reference::Frame turned_frame(glm::vec3 normal, std::size_t vertex);

}  // namespace parvis::light

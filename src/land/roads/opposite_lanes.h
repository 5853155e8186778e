// Which lanes run beside others that run the other way, found in a grid of cells.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "scene/data/road_graph.h"

namespace parvis::scene {

/// The street lanes of a road graph by where they lie in plan. The graph must outlive it and stay as it is.
class OppositeLanes {
 public:
  explicit OppositeLanes(const RoadGraph& roads);

  /// Whether another street lane runs the other way, one lane's width to the left of this one's middle.
  /// `lane` is one of the graph's.
  bool has(const Lane& lane) const;

 private:
  struct Piece {
    const Lane* lane;
    std::size_t segment;
  };

  std::int64_t cell_of(glm::ivec2 cell) const;
  glm::ivec2 cell_at(glm::vec2 point) const;
  void note(const Lane& lane, std::size_t segment);

  float cell_m_;
  std::unordered_map<std::int64_t, std::vector<Piece>> pieces_;
};

}  // namespace parvis::scene

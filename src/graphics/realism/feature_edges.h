// The edges of models that a drawing shows: where two faces meet at an angle, where a surface ends or another
// material begins; and those where a smooth surface may turn away from the eye.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "scene/data/model.h"

namespace parvis::realism {

/// An edge between two faces, in the frame of its part's node.
struct Edge {
  glm::vec3 from, to;              ///< metres
  glm::vec3 normal, other_normal;  ///< unit, of its faces; equal where it has but one
  bool is_drawn_always;            ///< else only where one of its faces looks to the eye and the other away
};

/// Those of one part.
struct PartEdges {
  std::vector<Edge> edges;
  /// Surface divided by the length of the edges that are always drawn: how far apart they lie; infinite where
  /// there are none.
  float spacing_m = 0.0f;
};

/// Faces that meet at more than this angle (radians) make an edge that is always drawn.
inline constexpr float crease_angle = 0.61f;

/// The edges of each part of a model at rest. Parts of one node are one surface: an edge of two parts is in
/// the list of the first. What is cut out, as leaves are, and parts that deform have none.
std::vector<PartEdges> feature_edges(const scene::Model& model);

}  // namespace parvis::realism

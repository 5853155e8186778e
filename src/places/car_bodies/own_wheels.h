// Wheels that a car's model has already, known by their shape: files call them "Circle.001" as often as
// "wheel".
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "places/car_bodies/body.h"

namespace parvis::car_bodies {

/// A wheel in the frame of the car, metres, with the triangles of each part that belong to it.
struct OwnWheel {
  glm::vec3 centre{0.0f};
  float radius = 0.0f, width = 0.0f;
  std::map<std::size_t, std::vector<std::uint32_t>> triangles;
};

/// Round pieces (triangles that hang together) that stand on the road in two or more pairs, left and right,
/// with what lies within them: rims, discs, nuts. Empty where there are not two axles. Pairs in order of x,
/// the left wheel (greater y) first.
std::vector<OwnWheel> find_own_wheels(const Body& body);

/// True for a wheel whose triangles all hang on nodes whose names hold "wheel", in any case: traffic turns
/// it.
bool turns_in_traffic(const scene::Model& model, const OwnWheel& wheel);

}  // namespace parvis::car_bodies

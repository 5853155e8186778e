// What of an object hides the sky. Its bounds tell little: mirrors and bumpers set those of a car, which
// stands on wheels, and most of an umbrella's height is a pole.
#pragma once

#include <span>

#include "base/bounds.h"
#include "base/mesh.h"

namespace parvis::shading {

/// A mesh of an object at rest.
struct BodyMesh {
  const Mesh* mesh;
  glm::mat4 model_from_mesh;
};

/// A box within an object's bounds, and how much of it is filled.
struct BodyShape {
  Bounds box{glm::vec3(0.0f), glm::vec3(1.0f)};  ///< in shares 0..1 of the bounds
  glm::vec3 coverage{1.0f};  ///< the share of the box that is filled, as seen along x, y and z
};

/// The shape of what the meshes show, z up: the box spans the heights at which they are widest, and lies as
/// far out as they do there on average. Nothing, or a flat thing, fills its bounds.
BodyShape body_shape(std::span<const BodyMesh> meshes);

}  // namespace parvis::shading

// Generated street furniture and ground surfaces. The foot is at the origin, x runs to the right along the
// front, y ahead of it, z up.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "scene/data/model.h"

namespace parvis::design {

/// The dimensions and looks that a shape is to have.
struct ShapeRequest {
  glm::vec3 size_m{1.0f};  ///< width along the front, depth, height
  glm::vec3 colour{0.5f};  ///< linear, of its main part
  std::string material;    ///< of its main part: one of `material_names`; empty: the shape's own
};

/// The shapes that can be generated.
const std::vector<std::string>& shape_names();
/// Materials of objects: stone, concrete, wood, metal, lacquer.
const std::vector<std::string>& material_names();
/// Generates a shape of `shape_names`.
scene::Model shape_model(const std::string& shape, const ShapeRequest& request);

/// Materials of ground surfaces: paving, asphalt, gravel, lawn, plain.
const std::vector<std::string>& surface_names();
/// A ground surface within an outline (counter-clockwise or clockwise, not crossing itself), 2 cm above it.
/// Empty where the outline has no area. `colour` is that of "plain", and tints the others.
scene::Model surface_model(const std::vector<glm::vec3>& outline, const std::string& material,
                           glm::vec3 colour);

/// The decimal number that a person has written to get this float: 12.345 for 12.345f.
double exact_decimal(float value);
/// The same of each coordinate.
glm::dvec3 exact_decimals(glm::vec3 value);

}  // namespace parvis::design

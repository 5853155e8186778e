// Transforms of glTF 2.0 (section 3.5.3) in double precision.
#pragma once

#include <glm/glm.hpp>
#include <nlohmann/json.hpp>

#include "scene/data/model.h"

namespace parvis::scene {

/// Sets translation, rotation and scale of `node` to those of `matrix`, at any scale: mirrors have a negative
/// scale along x, what is flat has a scale of 0. False where the matrix shears, which the three cannot say:
/// they are then those of a matrix near it.
bool decompose(const glm::dmat4& matrix, ModelNode& node);

/// Sets translation, rotation and scale of two nodes, one below the other, to those of `matrix`, which may
/// shear: its singular value decomposition (Hestenes 1958). The lower one only rotates.
void decompose(const glm::dmat4& matrix, ModelNode& upper, ModelNode& lower);

/// The matrix that turns the y axis of glTF up, an exact exchange of coordinates: (x, y, z) becomes (x, -z,
/// y).
glm::dmat4 z_up_from_y_up();

/// A matrix as glTF writes it: 16 numbers, column by column. For z up it exchanges coordinates exactly, which
/// a quaternion in single precision does not.
nlohmann::json gltf_matrix(const glm::dmat4& matrix);

}  // namespace parvis::scene

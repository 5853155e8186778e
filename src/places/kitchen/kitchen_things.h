// Objects in the kitchen that are not mirror-like: fruit in a bowl, crockery, jars, a board, a cloth.
#pragma once

#include "scene/data/model.h"

namespace parvis::kitchen {

/// Adds the fruit to a model that has the kitchen's materials, at its place.
void add_fruit(scene::Model& model);
/// Adds crockery and the other objects, each at its place.
void add_crockery(scene::Model& model);

/// Adds a contact shadow below a round object.
void add_shade(scene::Model& model, glm::vec3 foot, float radius_m);

}  // namespace parvis::kitchen

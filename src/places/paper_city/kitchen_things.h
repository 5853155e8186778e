// What stands about in the kitchen and does not mirror: fruit in a bowl, crockery, jars, a board, a cloth.
#pragma once

#include "scene/data/model.h"

namespace parvis::city {

/// Adds it to a model that has the kitchen's materials, each thing on its place.
void add_fruit(scene::Model& model);
void add_crockery(scene::Model& model);

/// The shade that something round throws on what it stands on.
void add_shade(scene::Model& model, glm::vec3 foot, float radius_m);

}  // namespace parvis::city

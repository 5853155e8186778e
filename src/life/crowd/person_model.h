// A skinned model that walks: which of its animations, and how far a cycle of it carries.
#pragma once

#include <memory>
#include <vector>

#include "base/result.h"
#include "scene/data/model.h"

namespace parvis::crowd {

/// A person's model in Parvis's frame: z up, metres, standing on z = 0 at the origin, looking along +x.
struct PersonModel {
  std::shared_ptr<const scene::Model> model;
  int animation = 0;     ///< of the model, a cycle of two steps on the spot
  float cycle_m = 1.4f;  ///< walked in a cycle without feet that slide
  float cycle_s = 1.0f;  ///< of the animation
};

/// Measures a model: its first animation is taken for walking on the spot, and its feet are the nodes that
/// reach lowest. Errors: the model has no animation, more than 256 joints in a skin, or no animation in which
/// anything moves forward and back near the ground.
Result<PersonModel> person_model(std::shared_ptr<const scene::Model> model);

}  // namespace parvis::crowd

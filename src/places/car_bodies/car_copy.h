// A copy of a car's model as scripts and traffic want it, where the file's own is not.
#pragma once

#include <optional>
#include <string>

#include "base/result.h"
#include "scene/data/model.h"

namespace parvis::car_bodies {

/// A model in metres, x forward, y left, z up, the middle plane at y = 0.
struct CarCopy {
  scene::Model model;
  std::string remark;  ///< comment lines for its script: why it was made, and what was turned and scaled
};

/// The copy that the car in `file` needs: at rest, without animations, with each of its own wheels on a node
/// such as "wheel_front_left". Nothing where a script can use the file itself. Errors: those of survey.
Result<std::optional<CarCopy>> car_copy(const scene::Model& model, const std::string& file);

}  // namespace parvis::car_bodies

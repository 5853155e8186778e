// A script that makes a car of a bare body: paint, glass, lamps and wheels, proposed from its shape and
// picture.
#pragma once

#include <string>

#include "base/result.h"
#include "scene/data/model.h"

namespace parvis::car_bodies {

/// The script of `model`, which `file` names, for use in `traffic`. Comments say what was not found and has
/// to be given by hand. Errors: a body that is not 2 to 20 m long, or does not lie along x.
Result<std::string> car_script(const scene::Model& model, const std::string& file);

}  // namespace parvis::car_bodies

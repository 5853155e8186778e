// A script that makes a car of a bare body, or of a car's model as it comes: paint, glass, lamps and wheels,
// proposed from its shape, its materials and its pictures.
#pragma once

#include <string>

#include "base/result.h"
#include "scene/data/model.h"

namespace parvis::car_bodies {

/// The script of `model`, which `file` names, for use in `traffic`. Comments say what was not found and has
/// to be given by hand, and what only a copy of the model can have (car_copy.h). `remark`, comment lines,
/// stands above the node. Errors: those of find_frame (car_frame.h).
Result<std::string> car_script(const scene::Model& model, const std::string& file,
                               const std::string& remark = "");

}  // namespace parvis::car_bodies

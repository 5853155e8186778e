// What is found out about a car before anything is proposed: how it lies, and which wheels it has or needs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "places/car_bodies/car_frame.h"
#include "places/car_bodies/own_wheels.h"
#include "places/car_bodies/wheel_arches.h"

namespace parvis::car_bodies {

/// Measures in the frame of the car: metres, x forward, the middle plane at y = 0.
struct CarSurvey {
  CarFrame frame;
  std::vector<OwnWheel> wheels;  ///< that the model has
  bool has_wheel_nodes = false;  ///< by name; they may be wheels of a shape that is not known
  std::optional<WheelFit> fit;   ///< for a body without wheels whose arches were found
  /// Why a script cannot use the file itself, as a clause; empty: it can.
  std::string copy_reason;

  /// True if the model needs no node `wheels`.
  bool has_wheels() const { return !wheels.empty() || has_wheel_nodes; }
};

/// `file` names the model as its script will, relative to the script's folder: where it leads out of that, a
/// copy is needed. Its extension says how it is read. Errors: those of find_frame.
Result<CarSurvey> survey(const scene::Model& model, const std::string& file);

/// Comment lines of a script that say how the file's car was turned and scaled; empty where it was not.
std::string remarks(const CarFrame& frame);

}  // namespace parvis::car_bodies

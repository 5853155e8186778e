// How a car lies in its file: which axes are its length, width and height, in which unit.
#pragma once

#include <string>

#include "base/result.h"
#include "scene/data/model.h"

namespace parvis::car_bodies {

/// The attributes of the node `model` that set a file's car on its wheels, along x, in metres.
struct CarFrame {
  std::string up;            ///< attribute `up`; empty: as the reader has it
  float heading_deg = 0.0f;  ///< attribute `heading_deg`: 0, 90, -90 or 180
  float scale = 1.0f;        ///< attribute `scale`
  std::string unit;          ///< of the file, in words; empty: metres, or unknown
  bool is_guess = false;     ///< `scale` gives it the length of a usual car, for want of a unit that fits
  float units_long = 0.0f;   ///< length in the file's units
  float aside_m = 0.0f;      ///< y of the car's middle plane after turning and scaling

  /// The car's frame from the model's as read, the middle plane at y = 0.
  glm::mat4 car_from_model() const;
};

/// The longest axis is the length. Of the others the width is the one about whose middle the body is alike on
/// both sides. A car of no plausible size in metres is taken as one in millimetres, centimetres, inches or
/// feet. The front is where the cabin is not. Errors: `model` is flat, lies so that no attribute turns it
/// upright, or has more surface than can be looked at (sampling_limit.h).
Result<CarFrame> find_frame(const scene::Model& model, const std::string& file);

}  // namespace parvis::car_bodies

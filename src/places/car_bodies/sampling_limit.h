// A limit of what is looked at of a model: its surface is sampled point by point, and a small file can hold
// thousands of triangles that are each as large as a car.
#pragma once

#include <string>

#include "base/bounds.h"
#include "base/result.h"
#include "scene/data/model.h"

namespace parvis::car_bodies {

/// The box of the triangles of `model`, at rest, in its own frame; empty where it has none. Error: sampling
/// them would take too long, for together they are as much as 5,000 triangles that are as long as the whole
/// car. (A million triangles with sides of 5 cm are as much as a hundred.) `file` names the model in the
/// error.
Result<Bounds> bounds_to_sample(const scene::Model& model, const std::string& file);

}  // namespace parvis::car_bodies

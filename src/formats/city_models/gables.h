// Gables in place of hips.
#pragma once

#include <vector>

#include "formats/city_models/straight_skeleton.h"

namespace parvis::scene {

/// Extends the ridges of a roof to the edges at their ends, so that the triangular faces there stand upright.
/// A face stays a hip where no level ridge ends in it, as at the corners of a regular polygon, or where the
/// ridge would leave its edge. Returns for each face whether it is a gable now.
std::vector<bool> raise_gables(StraightSkeleton& skeleton);

}  // namespace parvis::scene

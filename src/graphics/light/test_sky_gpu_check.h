// How far the GPU's evaluation of the sky models is from the C++ build of the same files.
#pragma once

#include "base/result.h"
#include "graphics/light/air.h"

namespace parvis::light {

/// Differences over all directions above and below the horizon: the largest difference of a channel; NaN
/// where one is no number; and how many samples of either side are negative or not finite.
struct SkyGpuCheck {
  double max_relative_error = 0.0;  ///< to the sky's mean luminance or the value, whichever is larger
  long bad_samples = 0, samples = 0;
};

/// Needs a current OpenGL context. `table_error` is added to each texel of the GPU's copy: a control for the
/// comparison.
Result<SkyGpuCheck> check_sky_on_gpu(const Air& air, double sun_elevation_deg, float table_error = 0.0f);

}  // namespace parvis::light

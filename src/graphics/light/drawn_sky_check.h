// How far the sky that the renderer draws is from its C++ build.
#pragma once

#include "base/result.h"
#include "graphics/light/sky_model.h"

namespace parvis::light {

/// The largest difference of a channel in six views of a clear sky, relative to the value or to the view's
/// mean luminance, whichever is larger; NaN where either side is. `turned_deg` turns the sky of the C++
/// build: a control. Needs a current OpenGL context.
Result<double> drawn_sky_error(SkyKind kind, double turbidity, double sun_elevation_deg,
                               float turned_deg = 0.0f);

}  // namespace parvis::light

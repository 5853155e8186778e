// How far the sky that the renderer draws is from its C++ build, and from the model itself.
#pragma once

#include "base/camera.h"
#include "base/result.h"
#include "graphics/light/sky_model.h"

namespace parvis::light {

/// Differences in six views of a clear sky; NaN where either side is no number.
struct DrawnSkyError {
  /// The difference to the C++ build of the shader: the largest of a channel, relative to the value or to the
  /// view's mean luminance, whichever is larger.
  double of_build = 0.0;
  /// The difference to the model in the same directions: the mean over pixels and channels, relative to the
  /// mean luminance.
  double of_model = 0.0;
  long samples = 0;  ///< channels that were compared
};

/// A camera at the origin, 90 degrees wide: `face` 0 to 5 together show all directions.
Camera view_of_sky(int face);

/// `turned_deg` turns what the drawn sky is compared with: a control. Needs a current OpenGL context.
Result<DrawnSkyError> drawn_sky_error(SkyKind kind, double turbidity, double sun_elevation_deg,
                                      float turned_deg = 0.0f);

}  // namespace parvis::light

// Cameras of a plant on a turntable: one camera stands still, the plant turns by equal steps. What is not
// known of it is found in the silhouettes, without marks or features.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "base/image.h"
#include "base/result.h"
#include "capture/trees/tree_view.h"

namespace parvis::trees {

/// The camera before a turntable. The world's origin is where its middle row sees the axis; z is the axis.
struct Turntable {
  float focal_px = 0.0f;    ///< of the photographs
  float distance_m = 1.0f;  ///< from the camera to the origin: the scale of all that is reconstructed
  float elevation = 0.0f;   ///< of the camera above the origin's level, radians
  float roll = 0.0f;        ///< of the camera about its axis, radians, clockwise as it looks
  float axis_px = 0.0f;     ///< of the origin to the right of the picture's middle
  float step = 0.0f;        ///< of the plant per photograph, radians, counter-clockwise from above
};

/// The cameras in the frame of the plant, for photographs of this size (pixels).
std::vector<Pinhole> turntable_cameras(const Turntable& turntable, std::size_t count, glm::ivec2 size);

/// A turntable that was found.
struct FoundTurntable {
  Turntable turntable;
  double explained_share = 0.0;  ///< of the silhouettes by points that no photograph contradicts, 0..1
};

/// Finds elevation, roll, axis and direction of the step: those whose hull explains most of the silhouettes.
/// `start` has focal length, distance and the size of the step; `pictures` are RGBA, in the order in which
/// they were taken, of equal size. Errors: fewer than three photographs; one without tree, or of another
/// size; a focal length, distance or step that is not positive.
Result<FoundTurntable> found_turntable(std::span<const Image8> pictures, Turntable start);

}  // namespace parvis::trees

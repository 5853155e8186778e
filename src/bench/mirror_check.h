// A mirror ball and a mirror box in far, textured surroundings: there a cube map is exact, and FLIP against the ray tracer
// tells whether directions, faces and filters are right.
#pragma once

#include "base/result.h"

namespace parvis::bench {

struct MirrorFlips {
  double ball = 0.0, box = 0.0;
  double ball_faces_swapped = 0.0;  ///< the same ball with two faces of its map exchanged: the check can fail
};

/// Needs a current OpenGL context.
Result<MirrorFlips> mirror_flips();

}  // namespace parvis::bench

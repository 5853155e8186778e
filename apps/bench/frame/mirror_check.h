// A mirror ball and a mirror box in textured surroundings two thousand radii away: there a cube map is exact,
// and FLIP against the ray tracer shows whether directions, faces and filters are right.
#pragma once

#include "base/house.h"
#include "base/result.h"

namespace parvis::bench {

struct MirrorFlips {
  double ball = 0.0, box = 0.0;
  double ball_at_50_radii = 0.0, box_at_50_radii = 0.0;  ///< nearer walls: the map's one centre shows
  double ball_faces_swapped = 0.0;  ///< the same ball with two faces of its map exchanged: the check can fail
};

/// Needs a current OpenGL context; draws with the drawables of `house`.
Result<MirrorFlips> mirror_flips(const House& house);

}  // namespace parvis::bench

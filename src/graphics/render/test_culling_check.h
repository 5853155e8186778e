// How good the occlusion culling is: counted against an exact picture of which object each pixel shows.
#pragma once

#include "graphics/render/renderer.h"

namespace parvis::render {

/// Moving objects inside the frustum, that is with bounds that may be seen.
struct CullingCheck {
  int hidden = 0;         ///< that no pixel shows
  int hidden_culled = 0;  ///< of these, not drawn
  int false_culls = 0;    ///< not drawn, although a pixel shows them
};

/// Draws the picture of objects without culling at width x height, and compares it to what culling leaves.
CullingCheck check_culling(Renderer& renderer, const scene::Scene& scene, const Camera& camera, int width,
                           int height);

}  // namespace parvis::render

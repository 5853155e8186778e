// Where reference maps stand, seen from above (Meyer and Loscos 2003, figure 8).
#pragma once

#include <span>

#include "base/image.h"
#include "graphics/render/renderer.h"

namespace parvis::reference_maps {

/// The fixed scene from above, north up, `side_px` each way: discs at `places`, rings at `others`, which are
/// places to compare with and may be empty.
Image8 placement_plan(render::Renderer& renderer, const scene::Scene& scene,
                      std::span<const glm::vec3> places, std::span<const glm::vec3> others, int side_px);

}  // namespace parvis::reference_maps

// What every method of this room starts from: a scene's heights, and reference maps along its streets.
#pragma once

#include "environment_maps/height_pyramid.h"
#include "environment_maps/reference_maps.h"
#include "scene/scene.h"

namespace parvis::environment_maps {

/// The highest point over each cell of the ground of what stands still, is visible and lets no light through.
shading::Heightfield heights_of(const scene::Scene& scene);

/// Places as `place_for_pictures` finds them, one at least, and their maps; begins a frame for the light.
/// Fails only if a shader does.
Result<ReferenceMaps> bake_maps(const scene::Scene& scene, const HeightPyramid& heights,
                                render::Renderer& renderer);

}  // namespace parvis::environment_maps

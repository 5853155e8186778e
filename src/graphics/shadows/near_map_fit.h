// The renderer's near shadow map as the methods of graphics/light/shadow_fit.h place it for a view.
#pragma once

#include "graphics/light/shadow_fit.h"
#include "graphics/light/sun_shadow_maps.h"
#include "graphics/reference/ray_scene.h"

namespace parvis::shadows {

/// Surfaces that a view of any usual aspect ratio shows, sampled by rays. Without `updates_near` one more
/// point stands on the axis at the camera's near plane, as perspective shadow maps do before they know
/// better.
light::SeenSurfaces seen_surfaces(const reference::RayScene& rays, const Camera& camera, bool updates_near);

/// The near map of a method (not `uniform`). `casters` bounds everything that casts a shadow. Depth grows
/// from -1 at the sun's side to 1 along every line toward the sun, in perspective maps, too, whose own depth
/// may run the other way.
light::NearMap fit_near_map(light::ShadowMethod method, const Camera& camera, glm::vec3 to_sun,
                            const light::SeenSurfaces& seen, const Bounds& casters);

}  // namespace parvis::shadows

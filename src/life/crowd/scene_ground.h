// The ground of a scene as people see it: static geometry, and where vehicles drive.
#pragma once

#include "life/crowd/nav_mesh.h"
#include "scene/data/scene.h"

namespace parvis::crowd {

/// The triangles of the scene's static, visible objects within `radius_m` of `centre` in plan, and its lanes
/// as roads. What surrounds the place (scene::surrounds_place) does not count, nor what lies below ground.
WalkingGround ground_of(const scene::Scene& scene, glm::vec2 centre, float radius_m);

}  // namespace parvis::crowd

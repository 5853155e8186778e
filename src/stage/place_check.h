// What is odd about a scene as a place to stand in, beside what its nodes report themselves.
#pragma once

#include "base/result.h"
#include "scene/data/scene.h"

namespace parvis::stage {

/// A warning for each named camera that stands inside a wall or below the ground: the fixed, opaque faces
/// that it sees first, up, down and to four sides, show it their backs. Cameras that follow an object are
/// left out. One where nothing lies below the scene's lanes, and one for each visible object that lies many
/// kilometres from all others: its coordinates are those of another place.
Errors check_place(const scene::Scene& scene);

}  // namespace parvis::stage

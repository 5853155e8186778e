// The cameras of a scene as they stand now, for commands that name them.
#pragma once

#include <string>

#include "base/result.h"
#include "scene/data/scene.h"

namespace parvis::stage {

/// The camera of that name where it is now (it may follow an object); an unnamed one: the first of the scene,
/// or a view of the whole where the scene has none. Errors name the cameras that there are.
Result<Camera> scene_camera(const scene::Scene& scene, const std::string& name);

}  // namespace parvis::stage

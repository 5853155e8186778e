// The names of a scene's objects, for messages about a name that none of them has.
#pragma once

#include <string>
#include <vector>

#include "scene/data/scene.h"

namespace parvis::scene {

/// Each name once, in the order of the scene; objects without a name have none. For base/known_names.h.
std::vector<std::string> object_names(const Scene& scene);

}  // namespace parvis::scene

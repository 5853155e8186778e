// The names of a scene's objects, for messages about a name that none of them has.
#pragma once

#include <string>

#include "scene/data/scene.h"

namespace parvis::scene {

/// "; there are \"quarter\", \"hill\"": each name once, in the order of the scene, at most ten; "; there is
/// none with a name" if no object has one. Stands at the end of a message.
std::string object_names(const Scene& scene);

}  // namespace parvis::scene

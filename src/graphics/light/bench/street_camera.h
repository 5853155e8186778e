// Views from the streets of a city.
#pragma once

#include "base/camera.h"
#include "base/random.h"
#include "scene/data/scene.h"

namespace parvis::bench {

/// At most 2 m beside the position of one of the scene's first five cameras, taken in turn, which it must
/// have one of: in any direction, all but level.
Camera street_camera(const scene::Scene& city, int number, Random& random);

}  // namespace parvis::bench

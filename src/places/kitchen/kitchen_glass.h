// Bodies of solid glass for the kitchen's worktop: what refraction is looked at on.
#pragma once

#include <vector>

#include "places/kitchen/kitchen_mirrors.h"

namespace parvis::kitchen {

/// A ball, and an egg that lies on its side; each a model of its own.
std::vector<KitchenMirror> kitchen_glass();

}  // namespace parvis::kitchen

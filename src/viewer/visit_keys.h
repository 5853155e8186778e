// Keys that concern the visit alone, in a window and in a room of walls.
#pragma once

#include "viewer/visit.h"

namespace parvis::viewer {

/// Does what a GLFW key that is pressed stands for: modes, scenarios, traffic, realism. False: nothing of
/// these.
bool press_visit_key(Visit& visit, int key);

}  // namespace parvis::viewer

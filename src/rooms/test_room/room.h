// A room that nothing names: the test that a room joins by its own folder and one line in src/room_list.h.
// Balloons: mirror balls that rise when a message says so, a reflection method and a bake step.
#pragma once

#include "base/registries.h"

namespace parvis::test_room {

/// Adds all of it to the registries.
void register_room(Registries& registries);

}  // namespace parvis::test_room

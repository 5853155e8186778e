// parvis tree calibrate: cameras of a plant that turns before one camera.
#pragma once

#include "commands.h"

namespace parvis {

void add_tree_calibrate(CLI::App& tree, Chosen& chosen);

}  // namespace parvis

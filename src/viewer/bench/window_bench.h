// Bench `window`: the rate of the window with its default options on a virtual display, and what its lowered
// resolution costs in likeness.
#pragma once

#include "base/house.h"

namespace parvis::bench {

/// Registers the bench.
void furnish_window(House& house);

}  // namespace parvis::bench

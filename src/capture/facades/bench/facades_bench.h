// Bench `facades`: captured places against photographs that were held out, beside their baselines. Needs the
// shared photographs; figures of those that are absent are skipped.
#pragma once

#include "base/house.h"

namespace parvis::bench {

/// Registers the bench.
void furnish_facades(House& house);

}  // namespace parvis::bench

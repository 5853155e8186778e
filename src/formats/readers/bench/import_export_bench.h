// Bench `import_export`: reading scripts and city models, switching scenarios, path-traced photographs,
// exported files. Each measure has a file of its own.
#pragma once

#include "base/house.h"

namespace parvis::bench {

/// Registers the bench.
void furnish_import_export(House& house);

}  // namespace parvis::bench

// Bench `import_export`: reading scripts and city models, switching scenarios, path-traced photographs,
// exported files. Each measure has a file of its own.
#pragma once

#include "bench/benches.h"

namespace parvis::bench {

/// Adds the bench.
void add_import_export(Benches& benches);

}  // namespace parvis::bench

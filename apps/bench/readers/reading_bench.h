// script/bench import_export, the readers: scripts and city models.
#pragma once

#include "bench/benches.h"

namespace parvis::bench {

/// Adds script_mb_s (text to checked nodes), cityjson_mb_s (files of cities to models) and load_ms_delft (the
/// script scenes/delft.xp with all it names, to a scene ready to be drawn). Files are read from the page
/// cache.
Status measure_readers(const BenchSetup& setup, Report& report);

}  // namespace parvis::bench

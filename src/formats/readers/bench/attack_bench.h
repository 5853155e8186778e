// script/bench import_export, hostile files and faults: what script/attack finds.
#pragma once

#include "bench/benches.h"

namespace parvis::bench {

/// Adds attack_cases, attack_findings, crashes, escapes, raw_exceptions, silent_losses, kills_survived and
/// allocation_failures_survived (by script/attack, whose controls must all be found first; `setup.is_quick`:
/// a part of the cases, evenly spread). To be run in the project's folder.
Status measure_attacks(const BenchSetup& setup, Report& report);

}  // namespace parvis::bench

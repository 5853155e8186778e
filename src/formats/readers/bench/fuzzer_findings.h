// What fuzzers find: `fuzz_findings`, in the bench `import_export`.
#pragma once

#include <filesystem>
#include <span>

#include "bench/report.h"

namespace parvis::bench {

/// Runs a fuzzer for some seconds, from `seeds` (folders) on: how many inputs it finds at which its reader
/// fails; one where the fuzzer itself fails without any. What it finds and learns is kept below `folder`.
std::size_t findings_of_fuzzer(const std::filesystem::path& program,
                               std::span<const std::filesystem::path> seeds, int seconds,
                               const std::filesystem::path& folder);

/// `fuzz_findings` of the fuzzers of all readers, which script/fuzz builds with sanitizers, and its control:
/// a reader with a planted fault, which is built here. Where fuzzers are missing, the readers that are built
/// read the inputs once found, under another key.
Status measure_fuzzers(const std::filesystem::path& folder, int seconds, Report& report);

}  // namespace parvis::bench

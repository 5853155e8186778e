// The kitchen of curved mirrors, in the bench "curved": where its mirrors show what stands in it, and how
// near their pictures come to ray tracing beside cube maps rendered again.
#pragma once

#include "bench/benches.h"
#include "house/stage/stage.h"

namespace parvis::bench {

Status measure_kitchen(const BenchSetup& setup, Report& report);

/// Writes the kitchen into a folder and opens one of its scripts. Needs a current context.
Result<std::unique_ptr<house::Stage>> open_kitchen(const House& house, const std::filesystem::path& folder,
                                                   const std::string& script);

}  // namespace parvis::bench

#include "bench/benches.h"

#include <algorithm>
#include <cassert>

#include "base/progress.h"
#include "graphics/gl/context.h"

namespace parvis::bench {

void Benches::add(Bench bench) {
  assert(!find(bench.name) && "two benches have one name");
  benches_.push_back(std::move(bench));
}

const Bench* Benches::find(std::string_view name) const {
  const auto found = std::ranges::find(benches_, name, &Bench::name);
  return found == benches_.end() ? nullptr : &*found;
}

Measure in_context(Measure measure) {
  return [measure = std::move(measure)](const BenchSetup& setup, Report& report) -> Status {
    const Result<gl::Context> context = gl::Context::create_headless();
    if (!context) return context.errors();
    report.note("machine: " + gl::driver_name());
    return measure(setup, report);
  };
}

Status run_parts(const BenchSetup& setup, std::span<const BenchPart> parts) {
  Progress progress("parts of the bench", setup.part.empty() ? parts.size() : 1);
  for (const BenchPart& part : parts) {
    if (!setup.part.empty() && part.name != setup.part) continue;
    if (Status status = part.run(); !status) return status;
    progress.advance();
  }
  return Done{};
}

}  // namespace parvis::bench

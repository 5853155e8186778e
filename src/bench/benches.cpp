#include "bench/benches.h"

#include <algorithm>
#include <cassert>

#include "base/progress.h"

namespace parvis::bench {

void Benches::add(Bench bench) {
  assert(!find(bench.name) && "two benches have one name");
  benches_.push_back(std::move(bench));
}

const Bench* Benches::find(std::string_view name) const {
  const auto found = std::ranges::find(benches_, name, &Bench::name);
  return found == benches_.end() ? nullptr : &*found;
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

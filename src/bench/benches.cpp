#include "bench/benches.h"

#include <algorithm>
#include <cassert>

namespace parvis::bench {

void Benches::add(Bench bench) {
  assert(!find(bench.name) && "two benches have one name");
  benches_.push_back(std::move(bench));
}

const Bench* Benches::find(std::string_view name) const {
  const auto found = std::ranges::find(benches_, name, &Bench::name);
  return found == benches_.end() ? nullptr : &*found;
}

}  // namespace parvis::bench

// The registry of benches. A room adds its benches in `ROOM/bench`, through a function that house/rooms.cpp
// calls; `parvis bench NAME` runs one.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "base/house.h"
#include "bench/report.h"

namespace parvis::bench {

/// What a bench runs with.
struct BenchSetup {
  const House& house;     ///< all rooms: node types, drawables, methods of the scenes that are measured
  bool is_quick = false;  ///< fewer repetitions and views, every key all the same
};

/// One bench.
struct Bench {
  std::string name;     ///< snake_case; what `parvis bench` is given
  std::string summary;  ///< one clause for --help: what is measured
  /// Adds every figure to the report. An error ends the bench; figures that this machine cannot measure are
  /// skipped.
  std::function<Status(const BenchSetup&, Report&)> run;
};

/// All benches, in the order in which rooms have added them.
class Benches {
 public:
  /// No two benches have one name.
  void add(Bench bench);
  /// The bench of that name, or null.
  const Bench* find(std::string_view name) const;
  /// Every bench.
  const std::vector<Bench>& all() const { return benches_; }

 private:
  std::vector<Bench> benches_;
};

}  // namespace parvis::bench

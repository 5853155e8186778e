// Benches: what parvis_bench measures.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
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
  std::string part = {};  ///< the only part to measure (Bench::parts); empty: all
  /// Where a bench keeps what takes long to prepare, so that the next run of one of its parts finds it;
  /// empty: a folder of its own, which is removed at its end.
  std::filesystem::path kept = {};
};

/// One part of a bench, which can be run alone.
struct BenchPart {
  std::string name;
  std::function<Status()> run;
};

/// Runs the parts in their order, or the one that `setup` names; with a progress bar. The first error ends
/// it.
Status run_parts(const BenchSetup& setup, std::span<const BenchPart> parts);

/// What a bench does. An error ends it.
using Measure = std::function<Status(const BenchSetup&, Report&)>;

/// The same with a current OpenGL context, whose driver a row names.
Measure in_context(Measure measure);

/// One bench.
struct Bench {
  std::string name;     ///< snake_case; what parvis_bench is given
  std::string summary;  ///< one clause for --help: what is measured
  /// Adds every figure to the report; figures that this machine cannot measure are skipped.
  Measure run;
  std::vector<std::string> parts = {};  ///< that it can be asked for alone; empty: it runs as a whole
};

/// All benches, in the order in which they were added.
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

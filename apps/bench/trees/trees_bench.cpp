#include "bench/trees/trees_bench.h"

#include <filesystem>

#include "bench/benches.h"
#include "bench/trees/tree_figures.h"
#include "graphics/gl/context.h"

namespace parvis::bench {
namespace {

Status measure(const BenchSetup& setup, Report& report) {
  const Result<gl::Context> context = gl::Context::create_headless();
  if (!context) return context.errors();
  report.note("machine: " + gl::driver_name());
  const trees::FigureOptions options{setup.is_quick};
  if (Status status = trees::measure_reconstruction(options, report); !status) return status;
  if (Status status = trees::measure_display(options, report); !status) return status;
  if (Status status = trees::measure_maize(options, report); !status) return status;
  return trees::measure_distribution(options, std::filesystem::read_symlink("/proc/self/exe"), report);
}

/// The display alone: a part of `trees`.
Status measure_wood(const BenchSetup& setup, Report& report) {
  const Result<gl::Context> context = gl::Context::create_headless();
  if (!context) return context.errors();
  report.note("machine: " + gl::driver_name());
  return trees::measure_display({setup.is_quick}, report);
}

/// The maize alone: a part of `trees`.
Status measure_plant(const BenchSetup& setup, Report& report) {
  const Result<gl::Context> context = gl::Context::create_headless();
  if (!context) return context.errors();
  return trees::measure_maize({setup.is_quick}, report);
}

}  // namespace

void add_trees(Benches& benches) {
  benches.add({"trees",
               "captured trees against path-traced photographs that were held out, and their display",
               measure});
  benches.add({"trees_display", "a wood of a thousand captured trees: a part of trees", measure_wood});
  benches.add(
      {"trees_maize", "silhouettes of a real plant that were left out: a part of trees", measure_plant});
}

}  // namespace parvis::bench

#include "capture/trees/bench/trees_bench.h"

#include <filesystem>

#include "bench/benches.h"
#include "capture/trees/bench/tree_figures.h"
#include "graphics/gl/context.h"

namespace parvis::bench {
namespace {

Status measure(const BenchSetup& setup, Report& report) {
  const Result<gl::Context> context = gl::Context::create_headless();
  if (!context) return context.errors();
  report.note("machine: " + gl::driver_name());
  const trees::FigureSink sink{
      [&](const std::string& key, double value) { report.add(key, value); },
      [&](const std::string& row) { report.note(row); },
      [&](const std::string& key, const std::string& why) { report.skip(key, why); }};
  const trees::FigureOptions options{setup.is_quick};
  if (Status status = trees::measure_reconstruction(options, sink); !status) return status;
  if (Status status = trees::measure_display(options, sink); !status) return status;
  if (Status status = trees::measure_maize(options, sink); !status) return status;
  return trees::measure_distribution(options, std::filesystem::read_symlink("/proc/self/exe"), sink);
}

}  // namespace

void furnish_trees(House& house) {
  house.get<Benches>().add(
      {"trees", "captured trees against path-traced photographs that were held out, and their display",
       measure});
}

}  // namespace parvis::bench

// parvis_bench NAME: measures, prints every figure, and writes them as JSON.
// Exit status: 0 measured, 1 failed or a control has reached its target, 2 bad usage.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>

#include "base/isolated_process.h"
#include "bench/all_benches.h"
#include "house/rooms.h"

namespace parvis::bench {
namespace {

struct Arguments {
  std::string name, part;
  std::filesystem::path json, kept;
  bool is_quick = false, lists = false;
};

Status measure(const Bench& bench, const Arguments& arguments) {
  if (!arguments.part.empty() && std::ranges::find(bench.parts, arguments.part) == bench.parts.end())
    return error("--part {}: expected {}", arguments.part,
                 bench.parts.empty()
                     ? fmt::format("nothing: the bench {} runs as a whole", bench.name)
                     : fmt::format("a part of {}: {}", bench.name, fmt::join(bench.parts, ", ")));
  Report report(bench.name);
  const Status run =
      bench.run({house::all_rooms(), arguments.is_quick, arguments.part, arguments.kept}, report);
  if (!arguments.json.empty())  // what was measured before an error, too
    if (Status written = report.write(arguments.json); !written) return written;
  return run ? report.controls() : run;
}

void list() {
  for (const Bench& bench : all_benches().all())
    fmt::print("{}: {}{}\n", bench.name, bench.summary,
               bench.parts.empty() ? "" : fmt::format("; parts: {}", fmt::join(bench.parts, ", ")));
}

int run(int count, char** arguments_of_program) {
  CLI::App app{"Measures Parvis, and prints every figure."};
  Arguments arguments;
  std::vector<std::string> names;
  for (const Bench& bench : all_benches().all()) names.push_back(bench.name);
  app.add_option("name", arguments.name, "The bench; --list describes each")->check(CLI::IsMember(names));
  app.add_flag("--list", arguments.lists, "List the benches and their parts");
  app.add_flag("--quick", arguments.is_quick, "Fewer repetitions: minutes in place of an hour");
  app.add_option("--part", arguments.part, "Measure this part of the bench alone");
  app.add_option("--keep", arguments.kept,
                 "Keep the places that are measured, and their maps, in this folder for the next run");
  app.add_option("--json", arguments.json, "Also write the figures to this file");
  app.footer("Example: script/bench frame --quick --json frame.json");
  try {
    app.parse(count, arguments_of_program);
    if (arguments.lists) return list(), 0;
    if (arguments.name.empty()) throw CLI::RequiredError("name");
  } catch (const CLI::ParseError& problem) {
    return app.exit(problem) == 0 ? 0 : 2;
  }
  const Status status = measure(*all_benches().find(arguments.name), arguments);
  if (!status) std::fputs(to_string(status.errors()).c_str(), stderr);
  return status ? 0 : 1;
}

}  // namespace
}  // namespace parvis::bench

int main(int count, char** arguments) {
  parvis::start_isolation();  // before there are threads
  return parvis::bench::run(count, arguments);
}

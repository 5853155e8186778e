// parvis_bench NAME: measures, prints every figure, and writes them as JSON.
// Exit status: 0 measured, 1 failed or a control has reached its target, 2 bad usage.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>

#include "base/isolated_process.h"
#include "bench/bench.h"

namespace parvis::bench {
namespace {
namespace fs = std::filesystem;

struct Arguments {
  std::string name, part;
  fs::path json, kept;
  bool is_quick = false, lists = false;
};

void list() {
  for (const Part& part : all_parts()) fmt::print("{} --part {}: {}\n", part.bench, part.name, part.summary);
}

/// Writes what was measured before an error, too.
Status measure(std::span<const Part* const> parts, const Arguments& arguments) {
  const bool is_kept = !arguments.kept.empty();
  const fs::path folder =
      is_kept ? arguments.kept : fs::temp_directory_path() / fmt::format("parvis-bench-{}", getpid());
  std::error_code code;
  fs::create_directories(folder, code);
  if (code) return error("{}: {}", folder.string(), code.message());
  Report report(arguments.name, arguments.is_quick);
  const Status status = run_parts({arguments.is_quick, folder}, parts, report);
  if (!is_kept) fs::remove_all(folder, code);
  if (!arguments.json.empty())
    if (Status written = report.write(arguments.json); !written) return written;
  return status;
}

int run(int count, char** words) {
  CLI::App app{"Measures Parvis, and prints every figure."};
  Arguments arguments;
  app.add_option("name", arguments.name, "A bench, or one of its parts: --list shows them");
  app.add_flag("--list", arguments.lists, "List the benches and their parts");
  app.add_flag("--quick", arguments.is_quick, "Fewer repetitions: minutes in place of an hour");
  app.add_option("--part", arguments.part, "Measure this part of the bench alone");
  app.add_option("--keep", arguments.kept,
                 "Keep the places that are measured, and their maps, in this folder for the next run");
  app.add_option("--json", arguments.json, "Also write the figures to this file");
  app.footer("Example: script/bench frame --quick --json frame.json");
  std::vector<const Part*> parts;
  try {
    app.parse(count, words);
    if (arguments.lists) return list(), 0;
    const std::string name =
        arguments.part.empty() ? arguments.name : fmt::format("{}/{}", arguments.name, arguments.part);
    parts = parts_named(name);
    if (parts.empty()) throw CLI::ValidationError("name", name + ": no bench has this name; see --list");
  } catch (const CLI::ParseError& problem) {
    return app.exit(problem) == 0 ? 0 : 2;
  }
  const Status status = measure(parts, arguments);
  if (!status) std::fputs(to_string(status.errors()).c_str(), stderr);
  return status ? 0 : 1;
}

}  // namespace
}  // namespace parvis::bench

int main(int count, char** arguments) {
  parvis::start_isolation();  // before there are threads
  return parvis::bench::run(count, arguments);
}

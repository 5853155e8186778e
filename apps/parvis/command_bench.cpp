// parvis bench: figures, as a table and as JSON.
#include <algorithm>

#include "commands.h"
#include "house/rooms.h"

namespace parvis {
namespace {

struct Arguments {
  std::string name, part;
  std::filesystem::path json, kept;
  bool is_quick = false;
};

Status measure(const Arguments& arguments) {
  bench::Report report(arguments.name);
  const bench::Bench& bench = *house::benches().find(arguments.name);
  if (!arguments.part.empty() && std::ranges::find(bench.parts, arguments.part) == bench.parts.end())
    return error("--part {}: expected {}", arguments.part,
                 bench.parts.empty()
                     ? fmt::format("nothing: the bench {} runs as a whole", bench.name)
                     : fmt::format("a part of {}: {}", bench.name, fmt::join(bench.parts, ", ")));
  const Status run =
      bench.run({house::all_rooms(), arguments.is_quick, arguments.part, arguments.kept}, report);
  if (!arguments.json.empty())  // what was measured before an error, too
    if (Status written = report.write(arguments.json); !written) return written;
  return run ? report.controls() : run;
}

}  // namespace

void add_bench(CLI::App& app, Chosen& chosen) {
  CLI::App* command = app.add_subcommand("bench", "Measures, and prints every figure");
  const auto arguments = std::make_shared<Arguments>();
  std::vector<std::string> names, summaries;
  for (const bench::Bench& bench : house::benches().all()) {
    names.push_back(bench.name);
    summaries.push_back(fmt::format("{}: {}", bench.name, bench.summary));
  }
  command->add_option("name", arguments->name, fmt::format("{}", fmt::join(summaries, "; ")))
      ->required()
      ->check(CLI::IsMember(names));
  command->add_flag("--quick", arguments->is_quick, "Fewer repetitions: minutes in place of an hour");
  command->add_option("--part", arguments->part, "Measure this part of the bench alone");
  command->add_option("--keep", arguments->kept,
                      "Keep the places that are measured, and their maps, in this folder for the next run");
  command->add_option("--json", arguments->json, "Also write the figures to this file");
  command->footer("Example: parvis bench frame --quick --json frame.json");
  command->callback([arguments, &chosen] { chosen = [arguments] { return measure(*arguments); }; });
}

}  // namespace parvis

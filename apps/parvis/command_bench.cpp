// parvis bench: figures, as a table and as JSON.
#include "commands.h"
#include "house/rooms.h"

namespace parvis {
namespace {

struct Arguments {
  std::string name;
  std::filesystem::path json;
  bool is_quick = false;
};

Status measure(const Arguments& arguments) {
  bench::Report report(arguments.name);
  const bench::Bench& bench = *house::benches().find(arguments.name);
  if (Status status = bench.run({house::all_rooms(), arguments.is_quick}, report); !status) return status;
  return arguments.json.empty() ? Status(Done{}) : report.write(arguments.json);
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
  command->add_option("--json", arguments->json, "Also write the figures to this file");
  command->footer("Example: parvis bench frame --quick --json frame.json");
  command->callback([arguments, &chosen] { chosen = [arguments] { return measure(*arguments); }; });
}

}  // namespace parvis

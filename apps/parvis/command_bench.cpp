// parvis bench: figures, as a table and as JSON.
#include "bench/curved_bench.h"
#include "bench/doors_bench.h"
#include "bench/frame_bench.h"
#include "bench/light_bench.h"
#include "bench/mem_bench.h"
#include "commands.h"

namespace parvis {
namespace {

struct Arguments {
  std::string name;
  std::filesystem::path json;
  bool is_quick = false;
};

Status measure(const Arguments& arguments) {
  const Result<bench::Report> report = arguments.name == "doors"    ? bench::doors_bench(arguments.is_quick)
                                       : arguments.name == "mem"    ? bench::mem_bench(arguments.is_quick)
                                       : arguments.name == "curved" ? bench::curved_bench(arguments.is_quick)
                                       : arguments.name == "light"  ? bench::light_bench(arguments.is_quick)
                                                                    : bench::frame_bench(arguments.is_quick);
  if (!report) return report.errors();
  return arguments.json.empty() ? Status(Done{}) : report->write(arguments.json);
}

}  // namespace

void add_bench(CLI::App& app, Chosen& chosen) {
  CLI::App* command = app.add_subcommand("bench", "Measures, and prints every figure");
  const auto arguments = std::make_shared<Arguments>();
  command
      ->add_option(
          "name", arguments->name,
          "frame: a frame of the paper's city, its culling, the mirrors' truth; doors: what enters "
          "and leaves; mem: multiple environment maps, their cost and truth; curved: reflections on curved "
          "objects against the fine mesh; light: sun, sky and hours of sun against their truths")
      ->required()
      ->check(CLI::IsMember({"frame", "doors", "mem", "curved", "light"}));
  command->add_flag("--quick", arguments->is_quick, "Fewer repetitions: minutes in place of an hour");
  command->add_option("--json", arguments->json, "Also write the figures to this file");
  command->footer("Example: parvis bench frame --quick --json frame.json");
  command->callback([arguments, &chosen] { chosen = [arguments] { return measure(*arguments); }; });
}

}  // namespace parvis

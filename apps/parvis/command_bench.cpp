// parvis bench: figures.
#include "commands.h"

namespace parvis {

void add_bench(CLI::App& app, Chosen& chosen) {
  CLI::App* command = app.add_subcommand("bench", "Measures");
  command->callback([&chosen] { chosen = []() -> Status { return error("not yet"); }; });
}

}  // namespace parvis

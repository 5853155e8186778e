// The command: a table of subcommands, each of which reads its arguments and calls a room.
// Exit status: 0 done, 1 failed, 2 bad usage.
#include <fmt/format.h>

#include <exception>

#include "base/isolated_process.h"
#include "commands.h"

int main(int count, char** arguments) {
  parvis::start_isolation();  // before there are threads
  CLI::App app{"Parvis shows a city square before it changes."};
  app.name("parvis");
  app.require_subcommand(1);
  app.set_version_flag("--version", "parvis " PARVIS_VERSION);
  app.set_help_all_flag("--help-all", "Help of every subcommand");

  std::function<parvis::Status()> chosen;
  for (const auto add : parvis::command_table) add(app, chosen);

  try {
    app.parse(count, arguments);
  } catch (const CLI::ParseError& problem) {
    return app.exit(problem) == 0 ? 0 : 2;
  }
  try {
    if (const parvis::Status status = chosen(); !status) {
      fmt::print(stderr, "{}", parvis::to_string(status.errors()));
      return 1;
    }
  } catch (const std::exception& problem) {  // memory, threads: what no room can answer for
    fmt::print(stderr, "parvis: {}\n", problem.what());
    return 1;
  }
  return 0;
}

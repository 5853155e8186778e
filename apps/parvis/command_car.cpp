// parvis car: a script that makes a car of a bare body.
#include "base/files.h"
#include "commands.h"
#include "formats/readers/readers.h"
#include "house/rooms.h"
#include "places/car_bodies/car_script.h"

namespace parvis {
namespace {

struct Arguments {
  std::filesystem::path body, output;
};

Status propose(const Arguments& arguments) {
  Errors warnings;
  const Result<scene::Model> model =
      house::all_rooms().get<formats::Readers>().read(arguments.body, {}, warnings);
  for (const Error& warning : warnings) fmt::print(stderr, "warning: {}\n", to_string(warning));
  if (!model) return model.errors();
  const std::filesystem::path file =
      arguments.output.empty()
          ? arguments.body.filename()
          : std::filesystem::relative(arguments.body,
                                      std::filesystem::absolute(arguments.output).parent_path());
  const Result<std::string> script = car_bodies::car_script(*model, file.generic_string());
  if (!script) return script.errors();
  if (arguments.output.empty()) {
    fmt::print("{}", *script);
    return Done{};
  }
  if (std::filesystem::exists(arguments.output))
    return error("{} is there already; remove it or name another file", arguments.output.string());
  return write_file(arguments.output, *script);
}

}  // namespace

void add_car(CLI::App& app, Chosen& chosen) {
  CLI::App* command =
      app.add_subcommand("car", "Proposes paint, glass, lamps and wheels for a bare car body, as a script");
  const auto arguments = std::make_shared<Arguments>();
  command->add_option("body", arguments->body, "The body: a model in metres, x forward")->required();
  command->add_option("-o,--output", arguments->output, "The script to write (.xp); absent: it is printed");
  command->footer("Example: parvis car body.obj -o body.xp");
  command->callback([arguments, &chosen] { chosen = [arguments] { return propose(*arguments); }; });
}

}  // namespace parvis

// parvis car: a script that makes a car of a bare body, or of a car's model as it comes.
#include "base/files.h"
#include "commands.h"
#include "formats/gltf/gltf_writer.h"
#include "formats/readers/readers.h"
#include "house/rooms.h"
#include "places/car_bodies/car_copy.h"
#include "places/car_bodies/car_script.h"

namespace parvis {
namespace {

struct Arguments {
  std::filesystem::path body, output;
};

Result<scene::Model> read(const std::filesystem::path& file) {
  Errors warnings;
  Result<scene::Model> model = house::all_rooms().get<formats::Readers>().read(file, {}, warnings);
  for (const Error& warning : warnings) fmt::print(stderr, "warning: {}\n", to_string(warning));
  return model;
}

Status expect_free(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file)) return Done{};
  return error("{} is there already; remove it or name another file", file.string());
}

/// The script of a copy of the model, which is written beside the script.
Result<std::string> script_of_copy(const car_bodies::CarCopy& copy, const std::filesystem::path& output) {
  const std::filesystem::path file = output.parent_path() / (output.stem().string() + "_model.glb");
  if (Status status = expect_free(file); !status) return status.errors();
  if (Status status = scene::write_gltf(file, copy.model); !status) return status.errors();
  fmt::print("{}: a copy of the model, for the script\n", file.string());
  const Result<scene::Model> model = read(file);  // by the names that it has as a file
  if (!model) return model.errors();
  return car_bodies::car_script(*model, file.filename().generic_string(), copy.remark);
}

Status propose(const Arguments& arguments) {
  const Result<scene::Model> model = read(arguments.body);
  if (!model) return model.errors();
  if (arguments.output.empty()) {
    const auto script = car_bodies::car_script(*model, arguments.body.filename().generic_string());
    if (!script) return script.errors();
    fmt::print("{}", *script);
    return Done{};
  }
  if (Status status = expect_free(arguments.output); !status) return status;
  const std::string file =
      std::filesystem::relative(arguments.body, std::filesystem::absolute(arguments.output).parent_path())
          .generic_string();
  const Result<std::optional<car_bodies::CarCopy>> made = car_bodies::car_copy(*model, file);
  if (!made) return made.errors();
  const std::optional<car_bodies::CarCopy>& copy = *made;
  const Result<std::string> script =
      copy ? script_of_copy(*copy, arguments.output) : car_bodies::car_script(*model, file);
  if (!script) return script.errors();
  return write_file(arguments.output, *script);
}

}  // namespace

void add_car(CLI::App& app, Chosen& chosen) {
  CLI::App* command =
      app.add_subcommand("car", "Proposes paint, glass, lamps and wheels for a car's model, as a script");
  const auto arguments = std::make_shared<Arguments>();
  command->add_option("body", arguments->body, "The car, or its bare body: a model file")->required();
  command->add_option(
      "-o,--output", arguments->output,
      "The script to write (.xp), with a copy of the model beside it where the script needs one; "
      "absent: it is printed");
  command->footer("Example: parvis car body.obj -o body.xp");
  command->callback([arguments, &chosen] { chosen = [arguments] { return propose(*arguments); }; });
}

}  // namespace parvis

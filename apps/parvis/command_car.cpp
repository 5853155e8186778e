// parvis car: a script that makes a car of a bare body, or of a car's model as it comes.
#include "base/file_set.h"
#include "base/files.h"
#include "base/partial_file.h"
#include "commands.h"
#include "formats/gltf/gltf_writer.h"
#include "formats/readers/readers.h"
#include "places/car_bodies/car_copy.h"
#include "places/car_bodies/car_script.h"
#include "rooms/rooms.h"

namespace parvis {
namespace {

struct CarArguments {
  std::filesystem::path body, output;
};

Result<scene::Model> read(const std::filesystem::path& file) {
  Errors warnings;
  Result<scene::Model> model = rooms::all_registries().get<formats::Readers>().read(file, {}, warnings);
  for (const Error& warning : warnings) fmt::print(stderr, "warning: {}\n", to_string(warning));
  return model;
}

/// Says how large the car is, of which the file says no unit.
void print_size(const scene::Model& model, const std::filesystem::path& file) {
  constexpr float min_length_m = 3.0f, max_length_m = 7.0f, usual_length_m = 4.4f;
  const glm::vec3 size = scene::bounds(model).size();
  const float length = std::max(size.x, size.y);
  fmt::print(stderr, "{}: {:.2f} m long, {:.2f} m wide, {:.2f} m high\n", file.string(), length,
             std::min(size.x, size.y), size.z);
  if (length > 0.0f && (length < min_length_m || length > max_length_m))
    fmt::print(
        stderr,
        "warning: cars are {:.0f} to {:.0f} m long: give model() in the script scale={:.3g} if it is one "
        "of {:.1f} m\n",
        min_length_m, max_length_m, usual_length_m / length, usual_length_m);
}

Status expect_free(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file)) return Ok{};
  return error("{} is there already; remove it or name another file", file.string());
}

/// The copy as its file will be read: a script goes by the names that things have then.
Result<scene::Model> as_read_again(const scene::Model& copy, const std::filesystem::path& file) {
  const std::filesystem::path folder = std::filesystem::absolute(file).parent_path();
  std::error_code code;  // what stands in the way is said by the next line
  std::filesystem::create_directories(folder, code);
  const Result<PartialFolder> unfinished = PartialFolder::create(folder);
  if (!unfinished) return unfinished.errors();
  const std::filesystem::path trial = unfinished->path() / file.filename();
  if (Status status = scene::write_gltf(trial, copy); !status) return status.errors();
  return read(trial);
}

/// Writes the script `output` and, beside it, the copy of the model that it is for: both or none.
Status write_with_copy(const car_bodies::CarCopy& copy, const std::filesystem::path& output) {
  const std::filesystem::path file = output.parent_path() / (output.stem().string() + "_model.glb");
  if (Status status = expect_free(file); !status) return status;
  const Result<scene::Model> model = as_read_again(copy.model, file);
  if (!model) return model.errors();
  const Result<std::string> script =
      car_bodies::car_script(*model, file.filename().generic_string(), copy.remark);
  if (!script) return script.errors();
  // The script is whole beside its place before the copy appears: what can fail has failed by then.
  const Status status =
      write_together({{output, *script}}, [&] { return scene::write_gltf(file, copy.model); });
  if (status) fmt::print("{}: a copy of the model, for the script\n", file.string());
  return status;
}

Status propose_car(const CarArguments& arguments) {
  const Result<scene::Model> model = read(arguments.body);
  if (!model) return model.errors();
  print_size(*model, arguments.body);
  if (arguments.output.empty()) {
    const auto script = car_bodies::car_script(*model, arguments.body.filename().generic_string());
    if (!script) return script.errors();
    fmt::print("{}", *script);
    return Ok{};
  }
  if (Status status = expect_free(arguments.output); !status) return status;
  const std::string file =
      std::filesystem::relative(arguments.body, std::filesystem::absolute(arguments.output).parent_path())
          .generic_string();
  const Result<std::optional<car_bodies::CarCopy>> made = car_bodies::car_copy(*model, file);
  if (!made) return made.errors();
  if (const std::optional<car_bodies::CarCopy>& copy = *made) return write_with_copy(*copy, arguments.output);
  const Result<std::string> script = car_bodies::car_script(*model, file);
  if (!script) return script.errors();
  return write_file(arguments.output, *script);
}

}  // namespace

void add_car(CLI::App& app, Chosen& chosen) {
  CLI::App* command =
      app.add_subcommand("car", "Proposes paint, glass, lamps and wheels for a car's model, as a script");
  const auto arguments = std::make_shared<CarArguments>();
  command->add_option("body", arguments->body, "The car, or its bare body: a model file")->required();
  command->add_option(
      "-o,--output", arguments->output,
      "The script to write (.xp), with a copy of the model beside it where the script needs one; "
      "absent: it is printed");
  command->footer("Example: parvis car body.obj -o body.xp");
  command->callback([arguments, &chosen] { chosen = [arguments] { return propose_car(*arguments); }; });
}

}  // namespace parvis

// parvis export: a scene, or parts of it, as glTF for other programs.
#include "base/known_names.h"
#include "commands.h"
#include "formats/gltf/gltf_writer.h"
#include "scene_arguments.h"

namespace parvis {
namespace {

struct ExportArguments : SceneArguments {
  std::vector<std::string> objects;  ///< none: all that are to be seen
  std::filesystem::path output{"scene.glb"};
};

Result<std::vector<const scene::Object*>> chosen_objects(const ExportArguments& arguments,
                                                         const scene::Scene& scene) {
  std::vector<const scene::Object*> chosen;
  std::vector<std::string> names;
  for (const scene::Object& object : scene.objects) {
    names.push_back(object.name);
    const auto& wanted = arguments.objects;
    const bool is_named = std::find(wanted.begin(), wanted.end(), object.name) != wanted.end();
    if (wanted.empty() ? object.is_visible : is_named) chosen.push_back(&object);
  }
  for (const std::string& wanted : arguments.objects)
    if (std::find(names.begin(), names.end(), wanted) == names.end())
      return error("--object {}: nothing in the scene has this name{}", wanted,
                   names_that_exist(wanted, names));
  return chosen;
}

Status write_scene(const ExportArguments& arguments) {
  if (arguments.output.extension() != ".glb")
    return error("{}: a scene is written as .glb", arguments.output.string());
  if (Status status = arguments.expect_one_scenario(); !status) return status;
  const Result<stage::Simulation> simulation = arguments.open_simulation();
  if (!simulation) return simulation.errors();
  const Result<std::vector<const scene::Object*>> objects = chosen_objects(arguments, simulation->scene);
  if (!objects) return objects.errors();
  std::vector<scene::NamedCamera> cameras;
  for (const scene::NamedCamera& camera : simulation->scene.cameras)
    if (const Result<Camera> now = simulation->scene.camera_now(camera))
      cameras.push_back({camera.name, *now, "", glm::vec3(0.0f)});
  if (Status status = scene::write_gltf(arguments.output, *objects, cameras); !status) return status;
  fmt::print("{}: {} objects, {} cameras\n", arguments.output.string(), objects->size(), cameras.size());
  return Ok{};
}

}  // namespace

void add_export(CLI::App& app, Chosen& chosen) {
  CLI::App* command =
      app.add_subcommand("export", "A scene or parts of it as glTF, for Blender and other programs");
  const auto arguments = std::make_shared<ExportArguments>();
  arguments->add_scene(*command);
  arguments->add_state(*command);
  command->add_option("--object", arguments->objects,
                      "Name of an object to write (default: all that are to be seen); may be repeated");
  command->add_option("-o,--output", arguments->output, "The file (.glb); its pictures are written beside it")
      ->capture_default_str();
  command->footer("Example: parvis export out/paper/paper.xp --time 5 -o out/city.glb");
  command->callback([arguments, &chosen] { chosen = [arguments] { return write_scene(*arguments); }; });
}

}  // namespace parvis

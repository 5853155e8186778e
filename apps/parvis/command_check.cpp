// parvis check: is a scene right? And the reference of all nodes.
#include <set>

#include "base/content_hash.h"
#include "commands.h"
#include "formats/readers/account_json.h"
#include "life/traffic/demand.h"
#include "life/vegetation/scene_plant.h"
#include "scene/data/triangle_kinds.h"
#include "scene/script/scene_reference.h"
#include "scene/script/schema_json.h"
#include "scene_arguments.h"

namespace parvis {
namespace {

struct CheckArguments {
  std::filesystem::path scene;
  std::vector<std::filesystem::path> data;
  bool wants_reference = false, wants_schema = false, wants_triangles = false, wants_json = false;
};

/// Prints the names that --scenario and --tour accept.
void print_states(const scene::LiveScene& live) {
  for (const scene::Node* node : live.scenarios())
    fmt::print("scenario {}{}{}\n", node->text("name"), node->gives("title") ? ": " : "",
               node->text("title"));
  for (const scene::Node& node : live.nodes())
    if (node.schema->type == "tour") fmt::print("tour {}\n", node.text("name"));
}

/// Prints the number of triangles of each kind of thing.
void print_triangles(const scene::Scene& scene) {
  for (const scene::TriangleKind& kind : scene::triangle_kinds(scene))
    fmt::print("triangles of {}: {}{}\n", kind.name, kind.stored,
               kind.objects > 1 ? fmt::format(" in memory, {} in {} places", kind.placed, kind.objects) : "");
  const vegetation::PlantTriangles plants = vegetation::plant_triangles(scene);
  if (plants.placed > 0)
    fmt::print("triangles of grown plants: {} in memory, {} in {} places\n", plants.stored, plants.placed,
               vegetation::scene_plants(scene).size());
}

/// Hash of all that a scenario can change of a scene; models count as such, not by their content.
std::uint64_t state_of(const scene::Scene& scene) {
  ContentHash hash;
  for (const scene::Object& object : scene.objects) {
    hash.add(object.is_visible);
    if (!object.is_visible) continue;
    hash.add(object.model.get()), hash.add(object.paint.get());
    hash.add(object.world_from_model), hash.add(object.played.speed);
  }
  for (const scene::NamedCamera& camera : scene.cameras) hash.add(camera.camera.world_from_camera);
  for (const glm::vec3 v : {scene.sun.direction_to_sun, scene.sun.irradiance}) hash.add(v);
  for (const float v : {scene.sky.intensity, scene.sky.heading, scene.haze_per_m, scene.exposure})
    hash.add(v);
  hash.add(scene.sky.picture.pixels);
  scene.room_data.hash(hash, [](scene::DataRole) { return true; });
  return hash.value();
}

/// Warns of scenarios that change nothing: a planner would show the same picture twice.
Status check_scenarios(stage::Simulation& simulation) {
  const std::string begins = simulation.live().scenario();
  if (Status status = simulation.live().choose(simulation.scene, ""); !status) return status;
  const std::uint64_t base = state_of(simulation.scene);
  for (const scene::Node* scenario : simulation.live().scenarios()) {
    if (Status status = simulation.live().choose(simulation.scene, scenario->text("name")); !status)
      return status;
    if (state_of(simulation.scene) == base)
      fmt::print(stderr, "warning: {}\n",
                 to_string(error_at(scenario->where, "scenario \"{}\" changes nothing that is to be seen",
                                    scenario->text("name"))));
  }
  return simulation.live().choose(simulation.scene, begins);
}

/// The account of each model file once, in the order of the scene's objects.
std::vector<const scene::FileAccount*> accounts_of(const scene::Scene& scene) {
  std::vector<const scene::FileAccount*> accounts;
  std::set<const scene::FileAccount*> known;
  for (const scene::Object& object : scene.objects)
    if (const scene::FileAccount* account = object.model->account.get();
        account && known.insert(account).second)
      accounts.push_back(account);
  return accounts;
}

Status check(CheckArguments& arguments) {
  const scene::NodeRegistry& registry = rooms::node_registry();
  if (arguments.wants_reference) {
    fmt::print("{}", scene::scene_reference(registry));
    return Ok{};
  }
  if (arguments.wants_schema) {
    fmt::print("{}", scene::schema_json(registry));
    return Ok{};
  }
  if (arguments.scene.empty()) return error("name a scene, or ask for --reference or --schema");
  if (Status status = describe_bare_file(arguments.scene, arguments.data); !status) return status.errors();
  // As every command opens it, so that all warn of the same.
  Result<stage::Simulation> simulation =
      stage::open_simulation(rooms::all_registries(), arguments.scene, arguments.data);
  if (!simulation) return simulation.errors();
  if (Status status = check_scenarios(*simulation); !status) return status;
  const scene::Scene& scene = simulation->scene;
  const std::vector<const scene::FileAccount*> accounts = accounts_of(scene);
  if (arguments.wants_json) {
    fmt::print("{}\n", formats::accounts_json(accounts));
    return Ok{};
  }
  fmt::print("{}: right. {} objects, {} triangles that stand still, {} lanes, {} vehicles, {} cameras\n",
             arguments.scene.string(), scene.objects.size(), scene.static_triangle_count(),
             scene.roads.lanes.size(), scene.data<traffic::TrafficDemand>().vehicles, scene.cameras.size());
  for (const scene::FileAccount* account : accounts) fmt::print("{}", account->text());
  if (arguments.wants_triangles) print_triangles(scene);
  print_states(simulation->live());
  return Ok{};
}

}  // namespace

void add_check(CLI::App& app, Chosen& chosen) {
  CLI::App* command = app.add_subcommand("check", "Checks a scene; reports every error with its line");
  const auto arguments = std::make_shared<CheckArguments>();
  command->add_option("scene", arguments->scene, "The scene's script (.xp), or a model file");
  command->add_option("--data", arguments->data, "A further folder that the scene may read from");
  add_max_memory(*command);
  command->add_flag("--reference", arguments->wants_reference,
                    "Print the reference of all nodes (docs/scene-reference.md)");
  command->add_flag("--schema", arguments->wants_schema,
                    "Print all nodes with their attributes and messages as JSON");
  command->add_flag("--triangles", arguments->wants_triangles,
                    "Print how many triangles each kind of object has");
  command->add_flag(
      "--json", arguments->wants_json,
      "Print the account of each model file as JSON: what it holds, what was used, changed, left out");
  command->footer("Example: parvis check scenes/delft.xp --data ../shared/data");
  command->callback([arguments, &chosen] { chosen = [arguments] { return check(*arguments); }; });
}

}  // namespace parvis

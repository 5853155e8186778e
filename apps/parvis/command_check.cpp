// parvis check: is a scene right? And the reference of all nodes.
#include "commands.h"
#include "life/traffic/demand.h"
#include "life/vegetation/scene_plant.h"
#include "scene/data/triangle_kinds.h"
#include "scene/script/scene_reference.h"
#include "scene/script/schema_json.h"
#include "scene_arguments.h"

namespace parvis {
namespace {

struct Arguments {
  std::filesystem::path scene;
  std::vector<std::filesystem::path> data;
  bool wants_reference = false, wants_schema = false, wants_triangles = false;
};

/// What --scenario and --tour can name.
void print_states(const scene::LiveScene& live) {
  for (const scene::Node* node : live.scenarios())
    fmt::print("scenario {}{}{}\n", node->text("name"), node->gives("title") ? ": " : "",
               node->text("title"));
  for (const scene::Node& node : live.nodes())
    if (node.schema->type == "tour") fmt::print("tour {}\n", node.text("name"));
}

/// What the triangles show, kind by kind.
void print_triangles(const scene::Scene& scene) {
  for (const scene::TriangleKind& kind : scene::triangle_kinds(scene))
    fmt::print("triangles of {}: {}{}\n", kind.name, kind.stored,
               kind.objects > 1 ? fmt::format(" in memory, {} in {} places", kind.placed, kind.objects) : "");
  const vegetation::PlantTriangles plants = vegetation::plant_triangles(scene);
  if (plants.placed > 0)
    fmt::print("triangles of grown plants: {} in memory, {} in {} places\n", plants.stored, plants.placed,
               vegetation::scene_plants(scene).size());
}

Status check(Arguments& arguments) {
  const scene::NodeRegistry& registry = house::node_registry();
  if (arguments.wants_reference) {
    fmt::print("{}", scene::scene_reference(registry));
    return Done{};
  }
  if (arguments.wants_schema) {
    fmt::print("{}", scene::schema_json(registry));
    return Done{};
  }
  if (arguments.scene.empty()) return error("name a scene, or ask for --reference or --schema");
  if (Status status = describe_bare_file(arguments.scene, arguments.data); !status) return status.errors();
  // As every command opens it, so that all warn of the same.
  const Result<house::Play> play = house::open_play(house::all_rooms(), arguments.scene, arguments.data);
  if (!play) return play.errors();
  const scene::Scene& scene = play->scene;
  fmt::print("{}: right. {} objects, {} triangles that stand still, {} lanes, {} vehicles, {} cameras\n",
             arguments.scene.string(), scene.objects.size(), scene.static_triangle_count(),
             scene.roads.lanes.size(), scene.data<traffic::TrafficDemand>().vehicles, scene.cameras.size());
  if (arguments.wants_triangles) print_triangles(scene);
  print_states(play->live());
  return Done{};
}

}  // namespace

void add_check(CLI::App& app, Chosen& chosen) {
  CLI::App* command = app.add_subcommand("check", "Checks a scene; reports every error with its line");
  const auto arguments = std::make_shared<Arguments>();
  command->add_option("scene", arguments->scene, "The scene's script (.xp), or a model file");
  command->add_option("--data", arguments->data, "A further folder that the scene may read from");
  add_max_memory(*command);
  command->add_flag("--reference", arguments->wants_reference,
                    "Print the reference of all nodes (docs/scene-reference.md)");
  command->add_flag("--schema", arguments->wants_schema,
                    "Print all nodes with their attributes and messages as JSON");
  command->add_flag("--triangles", arguments->wants_triangles,
                    "Print how many triangles each kind of object has");
  command->footer("Example: parvis check scenes/delft.xp --data ../shared/data");
  command->callback([arguments, &chosen] { chosen = [arguments] { return check(*arguments); }; });
}

}  // namespace parvis

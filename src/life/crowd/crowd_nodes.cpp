#include "base/registries.h"
#include "formats/meshes/model_assembly.h"
#include "formats/meshes/model_node.h"
#include "life/crowd/crowd_process.h"
#include "life/crowd/demand.h"
#include "room_list.h"
#include "scene/script/attribute.h"
#include "scene/script/placement.h"
#include "scene/script/scene_builder.h"

namespace parvis::crowd {
namespace {

using namespace scene::attribute;

using scene::Node, scene::SceneBuilder;

std::vector<std::string> person_names(const Node& node) {
  std::vector<std::string> names;
  for (long i = 1; i <= node.integer("people"); ++i) names.push_back(person_name(std::size_t(i - 1)));
  return names;
}

scene::NodeSchema crowd_schema() {
  return {
      .type = "crowd",
      .help =
          "People who walk on the scene's ground, over pavements rather than roads, up and down steps, "
          "round what stands "
          "in their way. They are generated people, or its models: skinned people whose first animation "
          "is a cycle of walking on "
          "the spot; they look "
          "along x and stand on z = 0 (turn them with heading_deg). They are called \"person 1\", "
          "\"person 2\", ...: "
          "cameras can follow them.",
      .attributes =
          {text("name", "by which other nodes refer to it; %crowd does, too"),
           integer("people", "how many").between(0, 20'000).required(),
           integer("seed", "the same seed gives the same people").from(0).by_default("1"),
           vec3("centre", "of the part of the place in which they walk").in("m").by_default("0 0 0"),
           number("radius", "of that part").in("m").between(5, 2000).by_default("80"),
           file("flows",
                "table (CSV) of counts with the columns from, to, per_hour: places as \"x y\" or \"x y z\", "
                "people in an hour. People then come and go there, at most as many at a time as people "
                "says"),
           scene::visible_attribute()},
      .example = "crowd(people=60, seed=3, centre=\"40 -20 0\", radius=90)",
      .is_unique = true,
      .is_laid_out_once = true,
      .names_made = person_names};
}

void build_crowd(const Node& node, SceneBuilder& builder, const formats::Readers& readers) {
  CrowdDemand demand;
  demand.people = int(node.integer("people"));
  demand.seed = std::uint64_t(node.integer("seed"));
  demand.centre = glm::vec2(node.vec3("centre")), demand.radius_m = float(node.number("radius"));
  if (node.gives("flows")) {
    Result<std::vector<Flow>> flows = read_flows(node.file("flows"));
    if (!flows) return builder.fail(flows.errors(), node.where_of("flows"));
    for (Flow& flow : *flows) {
      flow.from = glm::vec3(builder.world_from_parent() * glm::vec4(flow.from, 1.0f));
      flow.to = glm::vec3(builder.world_from_parent() * glm::vec4(flow.to, 1.0f));
    }
    demand.flows = *std::move(flows);
  }
  demand.is_visible = builder.is_visible() && node.flag("visible");
  for (const Node& kind : node.children) {
    const std::shared_ptr<const scene::Model> model = scene::model_of(kind, builder, readers);
    if (!model) continue;
    const glm::quat turn = glm::angleAxis(-kind.angle("heading_deg"), glm::vec3(0.0f, 0.0f, 1.0f));
    Result<PersonModel> person = person_model(std::make_shared<const scene::Model>(
        scene::placed(*model, kind.vec3("position"), turn, float(kind.number("scale")))));
    if (person)
      demand.models.push_back(*std::move(person));
    else
      builder.fail(person.errors(), kind.where);
  }
  builder.scene.data<CrowdDemand>() = std::move(demand);
}

}  // namespace

/// Adds the node type, the process, and what draws and traces people who are far.
void register_room(Registries& registries) {
  scene::NodeRegistry& registry = registries.get<scene::NodeRegistry>();
  const formats::Readers& readers = registries.get<formats::Readers>();
  registry.add(crowd_schema(),
               [&readers](const Node& node, SceneBuilder& builder) { build_crowd(node, builder, readers); });
  registries.get<render::Drawables>().add(far_people_kind());
  registries.get<action::Processes>().add([] { return std::make_unique<CrowdProcess>(); });
  registry.allow("model", "crowd");
  registry.allow(scene::include_type, "crowd");
}

}  // namespace parvis::crowd

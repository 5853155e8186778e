// person: somebody who stands, sits or walks on the spot.
#include "base/registries.h"
#include "life/people/person_object.h"
#include "room_list.h"
#include "scene/script/attribute.h"
#include "scene/script/node_registry.h"
#include "scene/script/placement.h"

namespace parvis::people {
namespace {

using namespace scene::attribute;

using scene::Node, scene::SceneBuilder;

scene::NodeSchema person_schema() {
  std::vector<scene::AttributeSchema> attributes{
      text("name", "by which other nodes refer to it"),
      integer("seed", "another one, another person").between(0, 1e9).by_default("1"),
      choice("sex", "\"any\": by the seed", {"any", "female", "male"}).by_default("any"),
      number("age", "in years; without it: by the seed").between(4, 95),
      choice("does", "what the person does; who walks does so on the spot",
             {"stand", "walk", "wait", "talk", "phone", "sit"})
          .by_default("stand"),
      number("speed", "of who walks").in("m/s").between(0.3, 2.2).by_default("1.3")};
  for (scene::AttributeSchema& attribute : scene::placement_attributes())
    attributes.push_back(std::move(attribute));
  attributes.push_back(scene::visible_attribute());
  return {
      .type = "person",
      .help =
          "A generated person: body, face, clothes and posture follow from the seed. Feet stand at the "
          "position, and the person looks along x (turn it with heading_deg); who sits has the seat 0.45 m "
          "above it.",
      .attributes = std::move(attributes),
      .example = "person(seed=4, does=\"wait\", position=\"2 0 0\", heading_deg=90)"};
}

void build_person(const Node& node, SceneBuilder& builder) {
  PersonRequest request{.seed = std::uint64_t(node.integer("seed"))};
  if (const std::string sex = node.text("sex"); sex != "any")
    request.sex = sex == "female" ? Sex::female : Sex::male;
  if (node.gives("age")) request.age = float(node.number("age"));
  request.speed_m_s = float(node.number("speed"));
  request.does = node.text("does");
  scene::Object object = person_object(request, builder);
  object.name = node.gives("name") ? node.text("name") : "person";
  object.world_from_model = builder.world_from_parent() * scene::placement(node);
  object.is_visible = builder.is_visible() && node.flag("visible");
  builder.add(std::move(object));
}

}  // namespace

void register_room(Registries& registries) {
  registries.get<scene::NodeRegistry>().add(
      person_schema(), [](const Node& node, SceneBuilder& builder) { build_person(node, builder); });
}

}  // namespace parvis::people

// person: somebody who stands, sits or walks on the spot.
#include <glm/gtc/matrix_transform.hpp>

#include "base/registries.h"
#include "life/people/companions.h"
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
      choice("with",
             "what accompanies the person: a pram that is pushed, a wheelchair, in which who sits "
             "rather than doing anything else, or a dog",
             {"nothing", "pram", "wheelchair", "dog"})
          .by_default("nothing"),
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

Companion companion_of(const std::string& name) {
  return name == "pram"         ? Companion::pram
         : name == "wheelchair" ? Companion::wheelchair
         : name == "dog"        ? Companion::dog
                                : Companion::none;
}

void build_person(const Node& node, SceneBuilder& builder) {
  PersonRequest request{.seed = std::uint64_t(node.integer("seed"))};
  if (const std::string sex = node.text("sex"); sex != "any")
    request.sex = sex == "female" ? Sex::female : Sex::male;
  if (node.gives("age")) request.age = float(node.number("age"));
  request.speed_m_s = float(node.number("speed"));
  const std::string with = node.text("with");
  const Companion companion = companion_of(with);
  const bool is_seated = companion == Companion::wheelchair;
  request.does = is_seated ? "sit" : node.text("does");
  request.holds_handle = companion == Companion::pram;
  scene::Object object = person_object(request, builder);
  object.name = node.gives("name") ? node.text("name") : "person";
  const glm::mat4 world_from_person = builder.world_from_parent() * scene::placement(node);
  object.world_from_model =
      glm::translate(world_from_person, glm::vec3(0.0f, 0.0f, is_seated ? footrest_m : 0.0f));
  object.is_visible = builder.is_visible() && node.flag("visible");
  if (companion != Companion::none) {
    const Someone who = someone_of(request);
    scene::Object beside;
    beside.name = object.name + "'s " + with;
    beside.model = builder.shared_model(
        fmt::format("{} of {} {} {}", with, request.seed, int(who.person.sex), who.head.age),
        [&] { return companion_model(companion, BodyField(shape_of(who.person)), request.seed); });
    beside.world_from_model = world_from_person, beside.is_visible = object.is_visible;
    builder.add(std::move(beside));
  }
  builder.add(std::move(object));
}

}  // namespace

void register_room(Registries& registries) {
  registries.get<scene::NodeRegistry>().add(
      person_schema(), [](const Node& node, SceneBuilder& builder) { build_person(node, builder); });
}

}  // namespace parvis::people

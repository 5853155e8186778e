// wheels: for car bodies that come without.
#include "formats/meshes/mesh_nodes.h"
#include "formats/meshes/model_assembly.h"
#include "formats/meshes/wheel.h"
#include "scene/script/attribute.h"
#include "scene/script/node_registry.h"
#include "scene/script/scene_builder.h"

namespace parvis::scene {
namespace {

using namespace attribute;

NodeSchema wheels_schema() {
  const auto length = [](const char* name, const char* help, const char* fallback) {
    return number(name, help).in("m").between(-20, 20).by_default(fallback);
  };
  NodeSchema schema{
      .type = "wheels",
      .help = "Four wheels for a car body that comes without (x forward, in the model's own frame).",
      .attributes = {length("front_axle_x", "of the front axle", "1.3"),
                     length("rear_axle_x", "of the rear axle", "-1.3"),
                     length("axle_z", "height of the axles", "0.31"),
                     length("track", "between the middles of left and right wheels", "1.5")},
      .stands_in = {"model"},
      .example =
          "model(file=\"car.obj\") {\n"
          "  wheels(front_axle_x=1.38, rear_axle_x=-1.41, axle_z=0.2, track=1.5, radius=0.31)\n"
          "}"};
  const WheelShape shape;
  const auto size = [](const char* name, const char* help, float fallback) {
    return number(name, help).in("m").between(0.01, 5).by_default(fmt::format("{}", fallback));
  };
  schema.attributes.push_back(size("radius", "of the tyre", shape.radius_m));
  schema.attributes.push_back(size("width", "of the tyre", shape.width_m));
  schema.attributes.push_back(size("rim_radius", "of the rim; less than radius", shape.rim_radius_m));
  return schema;
}

void add_wheels(const Node& node, Model& model, SceneBuilder& builder) {
  const WheelShape shape{float(node.number("radius")), float(node.number("width")),
                         float(node.number("rim_radius"))};
  if (shape.rim_radius_m >= shape.radius_m)
    return builder.fail(error_at(node.where_of("rim_radius"), "the rim must be smaller than the tyre"));
  const Model wheel = make_wheel(shape);
  const glm::quat as_made(1.0f, 0.0f, 0.0f, 0.0f), facing_right(0.0f, 0.0f, 0.0f, 1.0f);
  const float y = 0.5f * float(node.number("track")), z = float(node.number("axle_z"));
  for (const char* end : {"front", "rear"}) {
    const float x = float(node.number(fmt::format("{}_axle_x", end)));
    mount(model, wheel, {fmt::format("wheel_{}_left", end), {x, y, z}, as_made});
    mount(model, wheel, {fmt::format("wheel_{}_right", end), {x, -y, z}, facing_right});
  }
}

}  // namespace

void add_wheel_nodes(NodeRegistry& registry) { registry.add_change(wheels_schema(), add_wheels); }

}  // namespace parvis::scene

// object: a model file as the thesis's scripts place it (document 003, appendix A.2.2).
#include "formats/meshes/mesh_nodes.h"
#include "scene/script/attribute.h"
#include "scene/script/placement.h"
#include "scene/script/scene_builder.h"

namespace parvis::scene {
namespace {

using namespace attribute;

NodeSchema object_schema() {
  NodeSchema schema{
      .type = "object",
      .help = "A model file, as the scripts of the thesis place it; model(...) can do more.",
      .attributes =
          {text("name", "by which other nodes refer to it"), file("file", "the model file").required(),
           flag("grab", "a visitor may move it: it stands in nothing that is computed once").by_default("0"),
           flag("wall", "it stops visitors who walk, in the thesis's system; here all that stands does")
               .by_default("0")},
      .stands_in = {top_level, "group", "scenario"},
      .example = "object(file=\"duck.glb\", grab=1, wall=0)"};
  const std::vector<AttributeSchema> placement = placement_attributes();
  schema.attributes.insert(schema.attributes.end(), placement.begin(), placement.end());
  schema.attributes.push_back(visible_attribute());
  return schema;
}

void build_object(const Node& node, SceneBuilder& builder, const formats::Readers& readers) {
  const std::filesystem::path file = node.file("file");
  Object object;
  object.model = builder.shared_model(file.string() + "?object", [&]() -> std::shared_ptr<const Model> {
    Errors warnings;
    Result<Model> model = readers.read(file, {}, warnings);
    for (const Error& warning : warnings) builder.warn(warning);
    if (model) return std::make_shared<const Model>(*std::move(model));
    builder.fail(model.errors(), node.where_of("file"));
    return nullptr;
  });
  if (!object.model) return;
  object.name = node.gives("name") ? node.text("name") : file.stem().string();
  object.is_dynamic = node.flag("grab");
  object.is_visible = builder.is_visible() && node.flag("visible");
  object.world_from_model = builder.world_from_parent() * placement(node);
  builder.add(std::move(object));
}

}  // namespace

void add_object_node(NodeRegistry& registry, const formats::Readers& readers) {
  registry.add(object_schema(),
               [&readers](const Node& node, SceneBuilder& builder) { build_object(node, builder, readers); });
}

}  // namespace parvis::scene

// material: another surface for a part of a model.
#include <set>

#include "base/known_names.h"
#include "formats/meshes/material_change.h"
#include "formats/meshes/mesh_nodes.h"
#include "scene/data/model_parts.h"
#include "scene/script/attribute.h"
#include "scene/script/node_registry.h"
#include "scene/script/scene_builder.h"

namespace parvis::scene {
namespace {

using namespace attribute;

NodeSchema material_schema() {
  AttributeSchema preset = choice("preset", "");
  for (const MaterialPreset& each : material_presets()) {
    preset.choices.push_back(each.name);
    preset.help += (preset.help.empty() ? "" : "; ") + each.name + ": " + each.help;
  }
  const auto fraction = [](const char* name, const char* help) { return number(name, help).between(0, 1); };
  return {
      .type = "material",
      .help =
          "Another surface for a part of a model: of the objects that match target, the triangles that lie "
          "in "
          "a mask. Later nodes see what earlier ones have changed.",
      .attributes = {text("name", "by which scenarios refer to it"),
                     text("target",
                          "name of objects, nodes or materials of the file; * and ? stand for any text and "
                          "any character")
                         .by_default("*"),
                     text("mask",
                          "\"box u0 v0 u1 v1\" of the picture (0..1, v down from the top), \"colour #RRGGBB "
                          "tolerance\" or \"grey tolerance\" (of the picture at the triangle's middle; "
                          "0..1), or several in one; repeated: any of them")
                         .by_default("object")
                         .repeatable(),
                     preset, colour("colour", "in place of the picture").between(0, 1),
                     fraction("roughness", "0 mirrors, 1 is dull"),
                     fraction("metallic", "0 paint, 1 bare metal"), fraction("clear_coat", "lacquer over it"),
                     fraction("alpha", "1 opaque, 0 invisible"),
                     colour("emission", "radiance of its own").in("W/m2/sr").from(0),
                     number("ior",
                            "index of refraction: makes it a closed body of solid glass, where it is open a "
                            "pane (1.33 water, 1.5 glass, 2.42 diamond)")
                         .between(1, 4),
                     colour("absorption",
                            "of red, green and blue light on its way through solid glass; 0 is clear")
                         .in("1/m")
                         .from(0),
                     flag("mirror_like", "takes the scene's reflection method on reflective models")},
      .stands_in = {"model"},
      .example =
          "model(file=\"car.obj\", reflective=1) {\n"
          "  material(preset=\"paint\")\n"
          "  material(mask=\"box 0.2 0.5 0.4 0.8\", mask=\"box 0.6 0.5 0.8 0.8 grey 0.05\", "
          "preset=\"glass\")\n"
          "}"};
}

std::vector<std::string> names_of_objects(const Model& model) {
  std::set<std::string> names;
  for (const Part& part : model.parts)
    if (!part.object.empty()) names.insert(part.object);
  return {names.begin(), names.end()};
}

Error no_such_object(const Node& node, const Model& model) {
  const std::string target = node.text("target");
  return error_at(node.where_of("target"), "no object of the model is called \"{}\"{}", target,
                  names_that_exist(target, names_of_objects(model)));
}

MaterialChange change_of(const Node& node) {
  MaterialChange given;
  const auto number = [&](const char* name) {
    return node.gives(name) ? std::optional<float>(float(node.number(name))) : std::nullopt;
  };
  if (node.gives("colour")) given.colour = node.vec3("colour");
  if (node.gives("emission")) given.emission = node.vec3("emission");
  if (node.gives("absorption")) given.absorption_per_m = node.vec3("absorption");
  if (node.gives("mirror_like")) given.is_mirror_like = node.flag("mirror_like");
  given.roughness = number("roughness"), given.metallic = number("metallic");
  given.clear_coat = number("clear_coat"), given.alpha = number("alpha"), given.ior = number("ior");
  for (const MaterialPreset& preset : material_presets())
    if (node.text("preset") == preset.name) return merged(preset.change, given);
  return given;
}

/// The places that masks could name: where in which pictures the triangles of these parts lie.
std::string what_masks_find(const Model& model, const std::vector<std::size_t>& parts) {
  std::set<std::string> pictures;
  glm::vec2 low(1e9f), high(-1e9f);
  for (const std::size_t index : parts) {
    const Part& part = model.parts[index];
    const int picture = model.materials[std::size_t(part.material)].base_colour_texture;
    if (picture == no_index) continue;
    pictures.insert(model.textures[std::size_t(picture)].name);
    for (const glm::vec2 uv : part.mesh.uvs) low = glm::min(low, uv), high = glm::max(high, uv);
  }
  if (pictures.empty() || low.x > high.x)
    return "what target names has no picture: leave the mask out, or compare with the material's colour";
  return fmt::format("what target names lies in box {:.2f} {:.2f} {:.2f} {:.2f} of the picture {}", low.x,
                     low.y, high.x, high.y, fmt::join(pictures, ", "));
}

void change_material_of(const Node& node, Model& model, SceneBuilder& builder) {
  std::vector<MaterialMask> masks;
  for (const NodeAttribute& attribute : node.attributes) {
    if (attribute.schema->name != "mask") continue;
    Result<MaterialMask> mask = parse_mask(std::get<std::string>(attribute.value), attribute.where);
    if (!mask) return builder.fail(mask.errors().front());
    masks.push_back(*mask);
  }
  const std::vector<std::size_t> parts = matching_parts(model, node.text("target"));
  if (parts.empty()) return builder.fail(no_such_object(node, model));
  const std::string name = node.gives("preset") ? node.text("preset") : "changed";
  if (change_material(model, parts, masks, change_of(node), name) == 0)
    builder.warn(error_at(node.where_of("mask"),
                          "no triangle lies in the mask: this material changes nothing; {}",
                          what_masks_find(model, parts)));
}

}  // namespace

void add_material_nodes(NodeRegistry& registry) {
  registry.add_change(material_schema(), change_material_of);
}

}  // namespace parvis::scene

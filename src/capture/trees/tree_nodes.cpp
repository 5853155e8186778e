// tree: a captured tree in a scene.
#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

#include "base/registries.h"
#include "capture/trees/scene_tree.h"
#include "capture/trees/tree_drawable.h"
#include "capture/trees/tree_file.h"
#include "capture/trees/wind.h"
#include "room_list.h"
#include "scene/script/attribute.h"
#include "scene/script/placement.h"
#include "scene/script/scene_builder.h"

namespace parvis::trees {
namespace {

using scene::Node, scene::SceneBuilder;

scene::NodeSchema tree_schema() {
  using namespace scene::attribute;
  scene::NodeSchema schema{
      .type = "tree",
      .help =
          "A real tree, captured from photographs (parvis tree): it is seen as the closest photographs saw "
          "it, "
          "lit by the scene's sun and sky, and casts shadows. Its foot stands at position. A tree that sways "
          "has no "
          "part in what is baked.",
      .attributes = {text("name", "by which other nodes refer to it"),
                     file("file",
                          "the tree, from parvis tree texture (.tree, or .glb from parvis tree export)")
                         .required(),
                     number("height", "of the whole tree; 0: as it was photographed")
                         .in("m")
                         .between(0, 1000)
                         .by_default("0")
                         .live(),
                     number("sway", "how far its top moves in the wind, to each side; 0: it stands still")
                         .in("m")
                         .between(0, 5)
                         .by_default("0")
                         .live()},
      .example = "tree(file=\"oak.tree\", position=\"12 -4 0\", heading_deg=40)"};
  for (scene::AttributeSchema& attribute : scene::placement_attributes())
    schema.attributes.push_back(std::move(attribute));
  schema.attributes.push_back(scene::visible_attribute());
  return schema;
}

/// Metres above the foot.
float height_m(const TreeLevels& tree) {
  const CellGrid& grid = tree.levels.front().grid;
  float top = tree.foot.z;
  for (std::size_t i = 0; i < grid.size(); ++i) top = std::max(top, grid.bounds(i).max.z);
  return top - tree.foot.z;
}

/// The tree, read once for all nodes. Null, with the errors in `builder`, where the file cannot be used.
const TreeCache::Read* tree_of(const Node& node, SceneBuilder& builder) {
  auto& cache = builder.scene.data<TreeCache>().trees;
  const std::filesystem::path file = node.file("file");
  if (const auto found = cache.find(file); found != cache.end()) return &found->second;
  Result<BillboardTree> tree = read_tree(file);
  if (!tree) {
    builder.fail(tree.errors(), node.where_of("file"));
    return nullptr;
  }
  if (tree->views.empty() || tree->grid.size() == 0) {
    builder.fail(error_at(node.where_of("file"),
                          "{}: the tree has no photographs or no cells: make it again "
                          "with parvis tree texture",
                          file.string()));
    return nullptr;
  }
  ContentHash hash;
  for (const BillboardTextures& view : tree->views) hash.add(view.texels);
  hash.add(tree->grid.cells()), hash.add(tree->base), hash.add(tree->light);
  if (tree->trunk) hash.add(tree->trunk->trunk.rings), hash.add(tree->trunk->bark.pixels);
  return &cache
              .emplace(file, TreeCache::Read{std::make_shared<const TreeLevels>(levels_of(*std::move(tree))),
                                             hash.value()})
              .first->second;
}

void build_tree(const Node& node, SceneBuilder& builder) {
  const TreeCache::Read* read = tree_of(node, builder);
  if (!read) return;
  const float height = float(node.number("height"));
  const float scale = height > 0.0f ? height / height_m(*read->tree) : 1.0f;
  SceneTree tree;
  tree.tree = read->tree, tree.content = read->content;
  tree.world_from_tree = glm::translate(
      glm::scale(builder.world_from_parent() * scene::placement(node), glm::vec3(scale)), -read->tree->foot);
  tree.is_visible = builder.is_visible() && node.flag("visible");
  tree.sway_m = float(node.number("sway"));
  if (std::optional<scene::Object> trunk = tree.trunk_object()) {
    if (!node.text("name").empty()) trunk->name = node.text("name");
    builder.add(*std::move(trunk));
  }
  builder.add(std::move(tree));
}

}  // namespace

/// How captured trees join Parvis: the node `tree`, and what draws and traces it.
void register_room(Registries& registries) {
  registries.get<scene::NodeRegistry>().add(tree_schema(), build_tree);
  registries.get<render::Drawables>().add(scene_trees_kind());
  registries.get<action::Processes>().add([] { return std::make_unique<WindProcess>(); });
}

}  // namespace parvis::trees

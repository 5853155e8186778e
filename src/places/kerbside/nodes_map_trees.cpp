// grownTrees: the trees of a map or city model as grown plants.
#include "places/kerbside/nodes_map_trees.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <map>
#include <memory>

#include "base/content_hash.h"
#include "base/random.h"
#include "life/vegetation/scene_plant.h"
#include "places/kerbside/map_trees.h"
#include "scene/data/model_change.h"
#include "scene/data/model_parts.h"
#include "scene/data/name_pattern.h"
#include "scene/script/attribute.h"
#include "scene/script/node_registry.h"
#include "scene/script/scene_builder.h"

namespace parvis::kerbside {
namespace {

using namespace scene::attribute;

constexpr float height_step_m = 2.0f;  // plants within one step share their shape, scaled
constexpr int shapes = 2;              // of each kind and height

/// Trees that a script asks for.
struct PlannedTrees {
  static constexpr std::string_view name = "kerbside.planned_map_trees";
  static constexpr scene::DataRole role = scene::DataRole::settings;  // what stands is among the plants
  std::string of, target, kind;
  std::uint64_t seed = 1;
  FileLocation where_of, where_target;

  /// What follows from the script is in the plants.
  void hash(ContentHash& hash) const { hash.add_text(of), hash.add_text(target), hash.add_text(kind); }
};

scene::NodeSchema grown_trees_schema() {
  return {
      .type = "grownTrees",
      .help =
          "Grown plants (plant) in place of the trees of a map or city model: oaks and planes where the "
          "map names the species, else of `kind`. Each is as high as the map's, and no lower than the lowest "
          "of its kind: 3 m for planes, 2 m for oaks, 1 m for orange trees.",
      .attributes =
          {text("of", "names of models of the scene, with * and ?").required(),
           text("target", "names of the trees in the model, with * and ?")
               .by_default("SolitaryVegetationObject*"),
           choice("kind", "of trees without a species", {"orange", "oak", "plane"}).by_default("plane"),
           integer("seed", "another one, other shapes").between(0, 1e9).by_default("1")},
      .example = "model(name=\"town\", file=\"town.osm\")\ngrownTrees(of=\"town\")",
      .is_laid_out_once = true};
}

void build_grown_trees(const scene::Node& node, scene::SceneBuilder& builder) {
  builder.add(PlannedTrees{.of = node.text("of"),
                           .target = node.text("target"),
                           .kind = node.text("kind"),
                           .seed = std::uint64_t(node.integer("seed")),
                           .where_of = node.where_of("of"),
                           .where_target = node.where_of("target")});
}

/// False where the scene has failed.
bool plant_tree(const PlannedTrees& planned, const MapTree& tree, const glm::mat4& world_from_model,
                bool is_visible, Random& random, scene::SceneBuilder& builder) {
  vegetation::PlantRecipe recipe;
  recipe.kind = vegetation::find_kind(plant_kind_of(tree.name, planned.kind));
  const float height_m = std::max(tree.height_m, recipe.kind->min_height_m);  // flat trees have none
  recipe.height_m = std::clamp(height_step_m * std::round(height_m / height_step_m),
                               recipe.kind->min_height_m, recipe.kind->max_height_m);
  recipe.seed = planned.seed + std::uint64_t(random.index(shapes));
  auto shape = vegetation::shared_plant(builder.scene.data<vegetation::PlantShelf>(), recipe);
  if (!shape) return builder.fail(shape.errors(), planned.where_of), false;
  const glm::mat4 placed = glm::rotate(glm::translate(world_from_model, tree.foot),
                                       random.uniform(0.0f, 6.2831853f), {0.0f, 0.0f, 1.0f});
  builder.add(vegetation::ScenePlant{*std::move(shape),
                                     glm::scale(placed, glm::vec3(height_m / recipe.height_m)), is_visible});
  return true;
}

/// A model without its trees, and these; the model itself where it has none.
struct TakenTrees {
  std::shared_ptr<const scene::Model> model;
  std::vector<MapTree> trees;
};

TakenTrees taken_from(const std::shared_ptr<const scene::Model>& original, const std::string& target) {
  if (scene::matching_parts(*original, target).empty()) return {original, {}};
  scene::Model model = *original;
  std::vector<MapTree> trees = take_trees(model, target);
  return {std::make_shared<const scene::Model>(std::move(model)), std::move(trees)};
}

/// Takes the trees of all objects that are named and plants them. Returns how many there were.
std::size_t replace(const PlannedTrees& planned, scene::SceneBuilder& builder) {
  scene::ModelChange change{.of = planned.of, .change = [target = planned.target](const auto& original) {
                              return taken_from(original, target).model;
                            }};
  std::map<std::shared_ptr<const scene::Model>, std::vector<MapTree>> trees_of;
  std::size_t count = 0;
  for (scene::Object& object : builder.scene.objects) {
    if (!scene::matches(planned.of, object.name)) continue;
    const auto [known, is_new] = trees_of.try_emplace(object.model);
    if (is_new) {
      TakenTrees taken = taken_from(object.model, planned.target);
      change.changed[object.model] = std::move(taken.model), known->second = std::move(taken.trees);
    }
    const std::vector<MapTree>& trees = known->second;
    count += trees.size();
    if (count > max_map_trees) {
      builder.fail(error_at(planned.where_target, "more than {} trees match \"{}\"; name fewer of them",
                            max_map_trees, planned.target));
      return count;
    }
    scene::apply(change, object);
    Random random(planned.seed, 301);
    for (const MapTree& tree : trees)
      if (!plant_tree(planned, tree, object.world_from_model, object.is_visible, random, builder))
        return count;
  }
  builder.add(std::move(change));
  return count;
}

}  // namespace

void add_map_tree_nodes(scene::NodeRegistry& registry) {
  registry.add(grown_trees_schema(), build_grown_trees);
}

void plant_map_trees(scene::SceneBuilder& builder) {
  for (const PlannedTrees& planned : std::vector<PlannedTrees>(builder.scene.items<PlannedTrees>())) {
    if (!builder.errors().empty()) return;
    const auto first = std::ranges::find_if(builder.scene.objects, [&](const scene::Object& object) {
      return scene::matches(planned.of, object.name);
    });
    if (first == builder.scene.objects.end())
      return builder.fail(
          error_at(planned.where_of, "no object is called \"{}\"; give the model that name", planned.of));
    if (replace(planned, builder) == 0)
      builder.warn(error_at(planned.where_target, "nothing that matches \"{}\" is a tree; the model has {}",
                            planned.target, scene::part_names(*first->model)));
  }
}

}  // namespace parvis::kerbside

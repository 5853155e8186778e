// grownTrees: the trees of a map or city model as grown plants.
#include "places/kerbside/nodes_map_trees.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <map>
#include <memory>

#include "base/content_hash.h"
#include "base/known_names.h"
#include "base/random.h"
#include "life/vegetation/scene_plant.h"
#include "places/kerbside/map_trees.h"
#include "scene/data/model_parts.h"
#include "scene/data/name_pattern.h"
#include "scene/data/object_animation.h"
#include "scene/data/object_names.h"
#include "scene/script/attribute.h"
#include "scene/script/node_registry.h"
#include "scene/script/scene_builder.h"
#include "synthesis/place_seed.h"

namespace parvis::kerbside {
namespace {

constexpr float height_step_m = 2.0f;  // plants within one step share their shape, scaled
constexpr int shapes_per_kind = 2;     // of each kind and height

/// A model without its trees, and these. Null: it has none.
struct TakenTrees {
  std::shared_ptr<const scene::Model> model;
  std::vector<MapTree> trees;
};

/// Trees that a script asks for.
struct PlannedTrees {
  static constexpr std::string_view name = "kerbside.planned_map_trees";
  static constexpr scene::DataRole role = scene::DataRole::settings;  // what stands is among the plants
  std::string of, target, kind;
  FileLocation where_of, where_target;
  /// Results by original, while somebody holds it: equal objects share the remaining model, also when they
  /// are rebuilt.
  std::map<std::weak_ptr<const scene::Model>, TakenTrees, std::owner_less<>> taken = {};

  /// Adds the attributes alone: all that follows from the script is in the plants.
  void hash(ContentHash& hash) const { hash.add_text(of), hash.add_text(target), hash.add_text(kind); }
};

scene::NodeSchema grown_trees_schema() {
  using namespace scene::attribute;
  return {.type = "grownTrees",
          .help =
              "Grown plants (plant) in place of the trees of a map or city model: oaks, planes, pines and "
              "spruces where the map names the species or says that they have needles, else of `kind`. Each "
              "is as high as the map's, and no lower than the lowest of its kind: 3 m for planes, 2 m for "
              "oaks and pines, 1.5 m for spruces, 1 m for orange trees.",
          .attributes = {text("of", "names of models of the scene, with * and ?").required(),
                         text("target", "names of the trees in the model, with * and ?")
                             .by_default("SolitaryVegetationObject*"),
                         choice("kind", "of trees without a species",
                                {"orange", "oak", "plane", "spruce", "pine"})
                             .by_default("plane")},
          .example = "model(name=\"town\", file=\"town.osm\")\ngrownTrees(of=\"town\")",
          .is_laid_out_once = true};
}

void build_grown_trees(const scene::Node& node, scene::SceneBuilder& builder) {
  builder.add(PlannedTrees{.of = node.text("of"),
                           .target = node.text("target"),
                           .kind = node.text("kind"),
                           .where_of = node.where_of("of"),
                           .where_target = node.where_of("target")});
}

/// Null: the scene has failed.
const TakenTrees* taken_from(const std::shared_ptr<const scene::Model>& original, PlannedTrees& planned,
                             scene::SceneBuilder& builder) {
  std::erase_if(planned.taken, [](const auto& each) { return each.first.expired(); });
  const auto [known, is_new] = planned.taken.try_emplace(original);
  TakenTrees& taken = known->second;
  if (!is_new || scene::matching_parts(*original, planned.target).empty()) return &taken;
  scene::Model model = *original;
  Result<std::vector<MapTree>> trees = take_trees(model, planned.target);
  if (!trees) {
    planned.taken.erase(known);
    builder.fail(trees.errors(), planned.where_target);
    return nullptr;
  }
  taken = {std::make_shared<const scene::Model>(std::move(model)), *std::move(trees)};
  return &taken;
}

void replace_model(scene::Object& object, const std::shared_ptr<const scene::Model>& model) {
  object.model = model;
  object.deformed_meshes.clear();  // they are one for each part of the former model
  if (object.played.animation != scene::no_index) scene::play(object, object.played);
}

/// Adds a plant in place of each tree of an object; none where the scene has failed.
void plant_trees(const PlannedTrees& planned, const std::vector<MapTree>& trees, std::size_t object,
                 scene::SceneBuilder& builder) {
  const glm::mat4& world_from_model = builder.scene.objects[object].world_from_model;
  Random random(synthesis::place_seed, 301);
  std::vector<vegetation::ScenePlant> plants;
  for (const MapTree& tree : trees) {
    vegetation::PlantRecipe recipe;
    recipe.kind = vegetation::find_kind(plant_kind_of(tree.name, planned.kind));
    const float height_m = std::max(tree.height_m, recipe.kind->min_height_m);  // flat trees have none
    recipe.height_m = std::clamp(height_step_m * std::round(height_m / height_step_m),
                                 recipe.kind->min_height_m, recipe.kind->max_height_m);
    recipe.seed = synthesis::place_seed + std::uint64_t(random.index(shapes_per_kind));
    auto shape = vegetation::shared_plant(builder.scene.data<vegetation::PlantCache>(), recipe);
    if (!shape) return builder.fail(shape.errors(), planned.where_of);
    const glm::mat4 placed = glm::rotate(glm::translate(world_from_model, tree.foot),
                                         random.uniform(0.0f, 6.2831853f), {0.0f, 0.0f, 1.0f});
    plants.push_back({*std::move(shape), glm::scale(placed, glm::vec3(height_m / recipe.height_m)),
                      builder.scene.objects[object].is_visible});
  }
  builder.add_all_for(object, std::move(plants));
}

/// Takes the trees of all objects that are named and plants them. Returns how many there were.
std::size_t replace(PlannedTrees& planned, scene::SceneBuilder& builder) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < builder.scene.objects.size(); ++i) {
    scene::Object& object = builder.scene.objects[i];
    if (!scene::matches(planned.of, object.name)) continue;
    const TakenTrees* taken = taken_from(object.model, planned, builder);
    if (!taken) return count;
    if (!taken->model) continue;
    count += taken->trees.size();
    if (count > max_map_trees) {
      builder.fail(error_at(planned.where_target, "more than {} trees match \"{}\"; name fewer of them",
                            max_map_trees, planned.target));
      return count;
    }
    replace_model(object, taken->model);
    plant_trees(planned, taken->trees, i, builder);
    if (!builder.errors().empty()) return count;
  }
  return count;
}

}  // namespace

void add_map_tree_nodes(scene::NodeRegistry& registry) {
  registry.add(grown_trees_schema(), build_grown_trees);
}

void plant_map_trees(scene::SceneBuilder& builder) {
  scene::ItemsOf<PlannedTrees>& all = builder.scene.data<scene::ItemsOf<PlannedTrees>>();
  std::ranges::fill(all.makers, -1);  // they stay when the group that they stand in is rebuilt
  for (PlannedTrees& planned : all.items) {
    if (!builder.errors().empty()) return;
    const auto first = std::ranges::find_if(builder.scene.objects, [&](const scene::Object& object) {
      return scene::matches(planned.of, object.name);
    });
    if (first == builder.scene.objects.end())
      return builder.fail(error_at(planned.where_of, "no object is called \"{}\"; give the model that name{}",
                                   planned.of,
                                   names_that_exist(planned.of, scene::object_names(builder.scene))));
    if (replace(planned, builder) == 0)
      builder.warn(error_at(planned.where_target, "nothing that matches \"{}\" is a tree{}", planned.target,
                            names_that_exist(planned.target, scene::part_names(*first->model))));
  }
}

void plant_rebuilt_map_trees(scene::SceneBuilder& builder) {
  for (PlannedTrees& planned : builder.scene.data<scene::ItemsOf<PlannedTrees>>().items)
    if (builder.errors().empty()) replace(planned, builder);
}

}  // namespace parvis::kerbside

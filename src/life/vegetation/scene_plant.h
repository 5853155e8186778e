// Grown plants that stand in a scene.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "life/vegetation/plant_shape.h"
#include "scene/data/room_data.h"
#include "scene/data/scene.h"

namespace parvis::vegetation {

/// One of them; nodes make any number.
struct ScenePlant {
  static constexpr std::string_view name = "vegetation.scene_plants";
  static constexpr scene::DataRole role = scene::DataRole::static_content;

  std::shared_ptr<const PlantShape> shape;  ///< shared by all of one recipe
  glm::mat4 world_from_plant{1.0f};
  bool is_visible = true;
  int series = -1;  ///< number of the node that laid it out with others; -1: none did

  /// Adds recipe and place: equal recipes grow equal plants.
  void hash(ContentHash& hash) const {
    hash.add_text(shape->kind().name), hash.add(shape->recipe.height_m), hash.add(shape->recipe.length_m);
    hash.add(shape->recipe.seed), hash.add(world_from_plant), hash.add(is_visible);
  }
};

using ScenePlants = scene::ItemsOf<ScenePlant>;

/// The scene's grown plants, in the order of their things.
inline const std::vector<ScenePlant>& scene_plants(const scene::Scene& scene) {
  return scene.data<ScenePlants>().items;
}

/// A number of triangles: full leaves and wood of grown plants.
struct PlantTriangles {
  std::size_t stored = 0;  ///< each plant that others share once
  std::size_t placed = 0;  ///< once per place
};
/// Counts those of all grown plants of the scene.
PlantTriangles plant_triangles(const scene::Scene& scene);

/// How finely plants are drawn.
struct PlantDetail {
  static constexpr std::string_view name = "vegetation.detail";
  static constexpr scene::DataRole role = scene::DataRole::settings;

  /// Triangles, lines and points of all plants in one view, at most.
  int max_primitives = 300'000;
  bool is_full = false;    ///< the real geometry of all plants, whatever its size: what the rest is judged by
  bool keeps_area = true;  ///< false: leaves that are left out are missing; a control

  bool operator==(const PlantDetail&) const = default;
  /// Adds the settings.
  void hash(ContentHash& hash) const { hash.add(max_primitives), hash.add(is_full), hash.add(keeps_area); }
};

/// Plants that have been grown, by recipe: a node that moves does not grow its plant again.
struct PlantCache {
  static constexpr std::string_view name = "vegetation.cache";
  static constexpr scene::DataRole role = scene::DataRole::settings;

  std::map<std::string, std::shared_ptr<const PlantShape>> shapes;

  /// Adds the recipes.
  void hash(ContentHash& hash) const {
    for (const auto& [recipe, shape] : shapes) hash.add_text(recipe);
  }
};

/// The plant of a recipe, grown when it is first asked for. Errors: a height or length out of bounds, too
/// many leaves for one plant, not enough memory; what to do is in the message.
Result<std::shared_ptr<const PlantShape>> shared_plant(PlantCache& cache, const PlantRecipe& recipe);

}  // namespace parvis::vegetation

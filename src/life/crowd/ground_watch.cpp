#include "life/crowd/ground_watch.h"

#include "capture/trees/scene_tree.h"
#include "life/vegetation/scene_plant.h"
#include "scene/data/model.h"

namespace parvis::crowd {

Bounds GroundWatch::changes(const scene::Scene& scene) {
  constexpr float body_m = 0.5f;
  Bounds changed;
  const auto compare = [&](Thing& thing, const std::shared_ptr<const void>& shape, const glm::mat4& placed,
                           const auto& bounds_of_shape) {
    if (thing.shape == shape && (!shape || thing.world_from_shape == placed)) return;
    Bounds both = thing.bounds;
    thing = {shape, placed, shape ? transformed(placed, bounds_of_shape()) : Bounds()};
    if (!thing.bounds.empty()) both.add(thing.bounds);
    if (!both.empty()) changed.add({both.min - body_m, both.max + body_m});
  };
  const auto compare_all = [&](std::vector<Thing>& things, const auto& items, const auto& shape_of,
                               const auto& place_of, const auto& bounds_of) {
    things.resize(std::max(things.size(), items.size()));
    for (std::size_t i = 0; i < items.size(); ++i)
      compare(things[i], shape_of(items[i]), place_of(items[i]), [&] { return bounds_of(items[i]); });
    for (std::size_t i = items.size(); i < things.size(); ++i)
      compare(things[i], nullptr, {}, [] { return Bounds(); });
  };
  using Shape = std::shared_ptr<const void>;
  compare_all(
      things_[0], scene.objects,
      [](const scene::Object& object) {
        return object.is_visible && !object.is_dynamic ? Shape(object.model) : Shape();
      },
      [](const scene::Object& object) { return object.world_from_model; },
      [](const scene::Object& object) { return bounds(*object.model); });
  compare_all(
      things_[1], vegetation::scene_plants(scene),
      [](const vegetation::ScenePlant& plant) { return plant.is_visible ? Shape(plant.shape) : Shape(); },
      [](const vegetation::ScenePlant& plant) { return plant.world_from_plant; },
      [](const vegetation::ScenePlant& plant) { return plant.shape->bounds; });
  compare_all(
      things_[2], trees::scene_trees(scene),
      [](const trees::SceneTree& tree) { return tree.is_visible ? Shape(tree.tree) : Shape(); },
      [](const trees::SceneTree& tree) { return tree.world_from_tree; },
      [](const trees::SceneTree& tree) { return tree.tree->box; });
  return std::exchange(has_looked_, true) ? changed : Bounds();
}

}  // namespace parvis::crowd

#include "scene/data/model_change.h"

#include "scene/data/name_pattern.h"
#include "scene/data/object_animation.h"

namespace parvis::scene {

void apply(ModelChange& change, Object& object) {
  if (!matches(change.of, object.name)) return;
  const auto [known, is_new] = change.changed.try_emplace(object.model);
  if (is_new) known->second = change.change(object.model);
  if (object.model == known->second) return;
  object.model = known->second;
  object.deformed_meshes.clear();  // they are one for each part of the former model
  if (object.played.animation != no_index) play(object, object.played);
}

void apply_model_changes(Scene& scene, Object& object) {
  for (ModelChange& change : scene.data<ItemsOf<ModelChange>>().items) apply(change, object);
}

}  // namespace parvis::scene

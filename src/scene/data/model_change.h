// Changes of models that a finished scene asks for: objects that nodes build again get the changed model,
// too.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>

#include "base/content_hash.h"
#include "scene/data/room_data.h"
#include "scene/data/scene.h"

namespace parvis::scene {

/// A change of the models of some objects. Finish steps add it: a node that is rebuilt later makes its
/// objects of the model as it was read.
struct ModelChange {
  static constexpr std::string_view name = "scene.model_change";
  static constexpr DataRole role = DataRole::settings;  // objects have the changed models

  std::string of;  ///< pattern of the objects' names (scene/data/name_pattern.h)
  /// The changed model; the given one where there is nothing to change.
  std::function<std::shared_ptr<const Model>(const std::shared_ptr<const Model>&)> change;
  /// What has been changed, by original: equal objects share their changed model, too.
  std::map<std::shared_ptr<const Model>, std::shared_ptr<const Model>> changed = {};

  /// Adds the pattern: what was changed is in the objects.
  void hash(ContentHash& hash) const { hash.add_text(of); }
};

/// Applies one change to an object, if its name matches.
void apply(ModelChange& change, Object& object);
/// Applies all changes of the scene to an object that a node has built, in the order of their items.
void apply_model_changes(Scene& scene, Object& object);

}  // namespace parvis::scene

// What a scene keeps of a vdobject(...) node.
#pragma once

#include <memory>
#include <string>

#include "capture/view_dependent_objects/blended_model.h"
#include "scene/data/room_data.h"
#include "scene/data/traced_scene.h"

namespace parvis::view_dependent_objects {

/// A blended model in the world.
struct PlacedObject {
  static constexpr std::string_view name = "view_dependent_objects.object";
  static constexpr scene::DataRole role = scene::DataRole::static_content;

  std::string called;
  std::shared_ptr<const BlendedModel> model;
  glm::mat4 world_from_object{1.0f};
  int passes = 2;           ///< setNumBlendPass
  float brightness = 1.0f;  ///< 1: the display shows the textures as they are, whatever the exposure
  bool is_visible = true;
  /// The fraction of its light that is left where other things of the scene cast a shadow on it; 1: they cast
  /// none.
  float kept_in_shadow = 1.0f;

  /// Adds all members.
  void hash(ContentHash& hash) const;
};

/// View-dependent objects as rays see them: one thing each.
scene::TracedKind traced_objects();

}  // namespace parvis::view_dependent_objects

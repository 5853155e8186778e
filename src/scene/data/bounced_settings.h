// Whether a scene has light that its surfaces reflect onto each other.
#pragma once

#include <string_view>

#include "base/content_hash.h"
#include "scene/data/room_data.h"

namespace parvis::scene {

/// Kept in a scene by the node bouncedLight. Where it is on, the visibility of the sky leaves out the
/// constant that else stands for light from walls and ground.
struct BouncedSettings {
  static constexpr std::string_view name = "data.bounced_light";
  static constexpr DataRole role = DataRole::static_content;

  bool is_on = false;
  float spacing_m = 8.0f;  ///< of the places where it is kept
  int rays = 64;           ///< from each of them

  /// Adds all members.
  void hash(ContentHash& hash) const { hash.add(is_on), hash.add(spacing_m), hash.add(rays); }
};

}  // namespace parvis::scene

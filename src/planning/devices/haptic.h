// haptic: what a hand feels when something happens, as a node of the scene.
#pragma once

#include <array>
#include <string_view>

#include "base/content_hash.h"
#include "planning/devices/sdl_module.h"
#include "scene/data/room_data.h"

namespace parvis::devices {

/// The events that can be felt.
enum class Felt : unsigned char { snapping, collision, selection };
/// Their names in scenes.
inline constexpr std::array felt_names{"snapping", "collision", "selection"};

/// One haptic node.
struct HapticEffect {
  static constexpr std::string_view name = "devices.haptic";
  static constexpr scene::DataRole role = scene::DataRole::settings;

  Felt on = Felt::snapping;
  Pulse pulse;

  /// Adds all of it.
  void hash(ContentHash& hash) const {
    hash.add(on), hash.add(pulse.low), hash.add(pulse.high), hash.add(pulse.force), hash.add(pulse.seconds);
  }
};

}  // namespace parvis::devices

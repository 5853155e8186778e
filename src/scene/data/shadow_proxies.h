// Objects whose shadows something simpler casts in renderers' shadow maps. Rays hit the objects themselves.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "base/content_hash.h"
#include "scene/data/room_data.h"

namespace parvis::scene {

/// The objects of a scene that are not drawn into shadow maps, as a drawable draws their proxies.
struct ShadowProxies {
  static constexpr std::string_view name = "scene.shadow_proxies";
  static constexpr DataRole role = DataRole::settings;  // no picture differs but by the proxies' coarseness
  std::vector<std::uint8_t> has_proxy;                  ///< of each object; those beyond have none

  void add(std::size_t object) {
    if (has_proxy.size() <= object) has_proxy.resize(object + 1, 0);
    has_proxy[object] = 1;
  }
  bool of(std::size_t object) const { return object < has_proxy.size() && has_proxy[object] != 0; }
  /// Adds all members; see SceneData.
  void hash(ContentHash& hash) const {
    hash.add(has_proxy.size());
    for (const std::uint8_t flag : has_proxy) hash.add(flag);
  }
};

}  // namespace parvis::scene

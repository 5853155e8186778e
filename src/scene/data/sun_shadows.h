// What the shadows of a scene come from, beside its sun: a lamp in the sun's place, and things that cast or
// receive none. Photographs of the scene (reference/path_tracer.h) know no such wishes.
#pragma once

#include <algorithm>
#include <optional>
#include <string_view>
#include <vector>

#include "base/content_hash.h"
#include "scene/data/scene.h"

namespace parvis::scene {

/// A lamp in the place of the sun: its light comes from a point and fills a cone about
/// `Sun::direction_to_sun`. It does not lessen with distance, as OpenGL's spot lights do unless told
/// otherwise.
struct Spot {
  glm::vec3 position{0.0f};
  float half_angle = 0.3926991f;  ///< radians, below a right angle

  bool operator==(const Spot&) const = default;
};

/// Kept in a scene by the node that replaces its sun.
struct SunShadows {
  static constexpr std::string_view name = "data.sun_shadows";
  static constexpr DataRole role = DataRole::static_content;

  std::optional<Spot> spot;                     ///< none: the sun is infinitely far away
  std::vector<bool> casts_none, receives_none;  ///< by the index of an object; those beyond do
  /// The nodes whose items (Scene::items) cast shadows; empty: all items do.
  std::vector<NodeRange> caster_nodes = {};

  /// Does an object cast shadows?
  bool casts(std::size_t object) const { return object >= casts_none.size() || !casts_none[object]; }
  /// Does an item cast shadows that the node of this number has made (ItemsOf::makers)?
  bool casts_item_of(int maker) const {
    return caster_nodes.empty() || std::ranges::any_of(caster_nodes, [&](const NodeRange& nodes) {
             return maker >= nodes.first && maker <= nodes.last;
           });
  }
  /// Does it receive those of others?
  bool receives(std::size_t object) const { return object >= receives_none.size() || !receives_none[object]; }
  /// Adds all members.
  void hash(ContentHash& hash) const {
    if (spot) hash.add(glm::vec4(spot->position, spot->half_angle));
    for (const std::vector<bool>* flags : {&casts_none, &receives_none})
      for (const bool flag : *flags) hash.add(flag);
    for (const NodeRange& nodes : caster_nodes) hash.add(nodes.first), hash.add(nodes.last);
  }
};

/// The sun with what stands in its place.
struct SunLight : Sun {
  std::optional<Spot> spot;

  bool operator==(const SunLight&) const = default;
};
/// The sun of a scene and its spot.
inline SunLight sun_light(const Scene& scene) { return {scene.sun, scene.data<SunShadows>().spot}; }

}  // namespace parvis::scene

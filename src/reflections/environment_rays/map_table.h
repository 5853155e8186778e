// The table of reference maps that each part of the ground looks into. It keeps the working set: which maps
// are in graphics memory, when there are more than fit or while not all are drawn yet.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/bounds.h"
#include "graphics/gl/objects.h"
#include "reflections/reference_maps/map_choice.h"

namespace parvis::environment_rays {

/// A MapChoice as a texture (RGBA16UI) of layers, in which maps that have a layer stand in for those that
/// have none. Layers are given to maps as they are looked into, and taken from those that were looked into
/// least recently.
class MapTable {
 public:
  /// `layers`: how many maps are held at once; none is drawn yet.
  MapTable(reference_maps::MapChoice choice, std::vector<glm::vec3> places, std::size_t layers);

  /// The choice's south-west corner and metres per cell, as multiple_environment_maps.frag takes them.
  glm::vec3 grid() const { return {choice_.origin(), choice_.cell_m()}; }
  GLuint texture() const { return texture_.name(); }                ///< nearest-neighbour lookup
  const std::vector<glm::vec3>& places() const { return places_; }  ///< of all maps
  bool is_complete() const { return std::ranges::find(layer_of_, none) == layer_of_.end(); }
  /// The layers that hold a map, ascending.
  std::vector<std::size_t> drawn_layers() const;

  /// Begins a new frame, for which lookups count from now on.
  void begin_frame() { ++frame_; }
  /// Numbers of the maps without a layer that reflecting points within a box of the world look into; the
  /// others count as looked into in this frame.
  std::vector<std::size_t> look_within(const Bounds& bounds);
  /// Is there a layer to give?
  bool has_room() const {
    return std::ranges::find(map_in_, none) != map_in_.end() || std::ranges::min(used_in_) != frame_;
  }
  /// Gives a map a layer: a free one, else that of the map that was looked into least recently. None: this
  /// frame looks into all that are held. `upload` shows it.
  std::optional<std::size_t> give_layer(std::size_t map);
  /// No map is drawn any more; until `upload` the texture shows them as they were.
  void forget();
  void upload();

 private:
  std::vector<int> stand_ins() const;

  static constexpr int none = -1;

  reference_maps::MapChoice choice_;
  std::vector<glm::vec3> places_;
  std::vector<int> layer_of_;  ///< of each map
  std::vector<int> map_in_;    ///< of each layer
  std::vector<int> used_in_;   ///< frame in which the map of each layer was looked into last
  int frame_ = 0;
  gl::Texture texture_;
};

}  // namespace parvis::environment_rays

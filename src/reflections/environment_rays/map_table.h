// The table of reference maps that each part of the ground looks into, while not all maps are drawn yet.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/bounds.h"
#include "graphics/gl/objects.h"
#include "reflections/reference_maps/map_choice.h"

namespace parvis::environment_rays {

/// A MapChoice as a texture (RGBA16UI), in which maps that are drawn stand in for those that are not.
class MapTable {
 public:
  /// `missing`: numbers of the maps that are not drawn yet.
  MapTable(reference_maps::MapChoice choice, std::vector<glm::vec3> places,
           std::span<const std::size_t> missing);

  /// The choice's south-west corner and metres per cell, as multiple_environment_maps.frag takes them.
  glm::vec3 grid() const { return {choice_.origin(), choice_.cell_m()}; }
  GLuint texture() const { return texture_.name(); }  ///< nearest-neighbour lookup
  bool is_complete() const { return missing_count_ == 0; }
  /// Numbers of the maps that are drawn, ascending.
  std::vector<std::size_t> drawn() const;
  /// Numbers of the maps, not drawn yet, that reflecting points within a box of the world look into.
  std::vector<std::size_t> missing_within(const Bounds& bounds) const;
  /// Notes that a map is drawn; `upload` shows it.
  void add(std::size_t map);
  /// Notes that no map is drawn any more; until `upload` the texture shows them as they were.
  void forget();
  void upload();

 private:
  std::uint16_t stand_in(std::size_t cell, std::uint16_t map) const;

  reference_maps::MapChoice choice_;
  std::vector<glm::vec3> places_;
  std::vector<char> is_drawn_;  ///< of each map
  std::size_t missing_count_ = 0;
  gl::Texture texture_;
};

}  // namespace parvis::environment_rays

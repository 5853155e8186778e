// Reference maps that are out of date or were never drawn: drawn while the scene runs, those first that are
// looked into.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "reflections/reference_maps/map_painter.h"

namespace parvis::reference_maps {

class MapRenewal {
 public:
  /// Creates the renewal of maps as `bake_maps` makes them. Errors: a shader; the driver has no memory for a
  /// map.
  static Result<MapRenewal> create(int face_resolution);

  /// Marks all of so many maps as out of date.
  void ask(std::size_t map_count) { is_old_.assign(map_count, true); }
  /// Marks, of so many maps, those of these numbers as out of date.
  void ask(std::size_t map_count, std::span<const std::size_t> maps);
  bool is_done() const;
  /// Draws a map that is out of date, the one nearest to `looked_from`, in the light of the renderer's frame.
  /// Returns its number; none is old: nothing.
  std::optional<std::size_t> renew_one(render::Renderer& renderer, ReferenceMaps& maps,
                                       glm::vec3 looked_from);
  /// The same for one map, whether it is out of date or not.
  void renew(render::Renderer& renderer, ReferenceMaps& maps, std::size_t map);
  /// The map that was drawn last, alone and not compressed.
  const ReferenceMaps& drawn_last() const { return fresh_; }

 private:
  MapRenewal(MapPainter painter, ReferenceMaps fresh)
      : painter_(std::move(painter)), fresh_(std::move(fresh)) {}

  MapPainter painter_;
  ReferenceMaps fresh_;  ///< one map, from which the others are copied
  std::vector<bool> is_old_;
};

}  // namespace parvis::reference_maps

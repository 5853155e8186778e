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
  void ask(std::size_t map_count);
  /// Marks, of so many maps, those of these numbers as out of date.
  void ask(std::size_t map_count, std::span<const std::size_t> maps);
  bool is_done() const;
  /// Draws at most so many faces of maps that are out of date, in the light of the renderer's frame: those of
  /// the map that is begun, then of the one nearest to `looked_from`. Maps with all faces are replaced.
  /// Returns how many it has drawn.
  int renew_faces(render::Renderer& renderer, ReferenceMaps& maps, glm::vec3 looked_from, int max_faces);
  /// Draws one whole map, whether it is out of date or not.
  void renew(render::Renderer& renderer, ReferenceMaps& maps, std::size_t map);
  /// The map that was drawn last, alone and not compressed.
  const ReferenceMaps& drawn_last() const { return fresh_; }

 private:
  MapRenewal(MapPainter painter, ReferenceMaps fresh)
      : painter_(std::move(painter)), fresh_(std::move(fresh)) {}

  /// Takes over the drawn map.
  void replace(ReferenceMaps& maps, std::size_t map, bool stays_old);

  MapPainter painter_;
  ReferenceMaps fresh_;  ///< one map, from which the others are copied
  std::vector<bool> is_old_;
  std::optional<std::size_t> begun_;  ///< a map with faces in `fresh_`
  int face_ = 0;                      ///< its next one
  bool is_late_ = false;              ///< it was asked for again since its first face
};

}  // namespace parvis::reference_maps

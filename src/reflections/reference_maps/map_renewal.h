// Reference maps of surroundings that have changed while the scene runs: drawn anew, a few a frame, those
// first that are looked into.
#pragma once

#include <optional>
#include <vector>

#include "reflections/reference_maps/map_painter.h"

namespace parvis::reference_maps {

class MapRenewal {
 public:
  /// For maps as `bake_maps` makes them. Fails only if a shader does.
  static Result<MapRenewal> create(int face_resolution);

  /// All of so many maps are out of date.
  void ask(std::size_t map_count) { is_old_.assign(map_count, true); }
  bool is_done() const;
  /// Draws a map that is out of date, the one nearest to `looked_from`, in the light of the renderer's frame.
  /// Returns its number; none is old: nothing.
  std::optional<std::size_t> renew_one(render::Renderer& renderer, ReferenceMaps& maps,
                                       glm::vec3 looked_from);

 private:
  explicit MapRenewal(MapPainter painter) : painter_(std::move(painter)) {}

  MapPainter painter_;
  std::vector<bool> is_old_;
};

}  // namespace parvis::reference_maps

#include "reflections/reference_maps/map_renewal.h"

#include <algorithm>

namespace parvis::reference_maps {

Result<MapRenewal> MapRenewal::create(int face_resolution) {
  Result<MapPainter> painter = MapPainter::create(face_resolution);
  if (!painter) return painter.errors();
  Result<ReferenceMaps> fresh =
      ReferenceMaps::create({glm::vec3(0.0f)}, ReferenceMaps::layer_side(face_resolution));
  if (!fresh) return fresh.errors();
  return MapRenewal(*std::move(painter), *std::move(fresh));
}

void MapRenewal::ask(std::size_t map_count, std::span<const std::size_t> maps) {
  is_old_.assign(map_count, false);
  for (const std::size_t map : maps) is_old_[map] = true;
}

bool MapRenewal::is_done() const { return std::ranges::find(is_old_, true) == is_old_.end(); }

std::optional<std::size_t> MapRenewal::renew_one(render::Renderer& renderer, ReferenceMaps& maps,
                                                 glm::vec3 looked_from) {
  std::optional<std::size_t> nearest;
  const auto off_m = [&](std::size_t map) { return glm::distance(maps.places()[map], looked_from); };
  for (std::size_t map = 0; map < is_old_.size(); ++map)
    if (is_old_[map] && (!nearest || off_m(map) < off_m(*nearest))) nearest = map;
  if (nearest) renew(renderer, maps, *nearest);
  return nearest;
}

void MapRenewal::renew(render::Renderer& renderer, ReferenceMaps& maps, std::size_t map) {
  fresh_.move(0, maps.places()[map]);
  painter_.paint(renderer, fresh_, 0);
  fresh_.update_levels();
  maps.copy(map, fresh_, 0);
  is_old_[map] = false;
}

}  // namespace parvis::reference_maps

#include "reflections/reference_maps/map_renewal.h"

#include <algorithm>
#include <utility>

namespace parvis::reference_maps {

Result<MapRenewal> MapRenewal::create(int face_resolution) {
  Result<MapPainter> painter = MapPainter::create(face_resolution);
  if (!painter) return painter.errors();
  Result<ReferenceMaps> fresh =
      ReferenceMaps::create({glm::vec3(0.0f)}, ReferenceMaps::layer_side(face_resolution));
  if (!fresh) return fresh.errors();
  return MapRenewal(*std::move(painter), *std::move(fresh));
}

void MapRenewal::ask(std::size_t map_count) {
  is_old_.assign(map_count, true);
  is_late_ = true;
}

void MapRenewal::ask(std::size_t map_count, std::span<const std::size_t> maps) {
  is_old_.assign(map_count, false);
  for (const std::size_t map : maps) is_old_[map] = true;
  is_late_ = true;
}

bool MapRenewal::is_done() const { return std::ranges::find(is_old_, true) == is_old_.end(); }

int MapRenewal::renew_faces(render::Renderer& renderer, ReferenceMaps& maps, glm::vec3 looked_from,
                            int max_faces) {
  const std::vector<glm::vec3>& places = maps.places();
  int drawn = 0;
  for (; drawn < max_faces; ++drawn) {
    const auto is_begun = [&] {  // its layer may show another place by now
      return begun_ && *begun_ < is_old_.size() && is_old_[*begun_] && places[*begun_] == fresh_.places()[0];
    };
    if (!is_begun()) {
      begun_.reset();
      for (std::size_t map = 0; map < is_old_.size(); ++map)
        if (is_old_[map] && (!begun_ || glm::distance(places[map], looked_from) <
                                            glm::distance(places[*begun_], looked_from)))
          begun_ = map;
      if (!begun_) break;
      fresh_.move(0, places[*begun_]);
      face_ = 0, is_late_ = false;
    }
    painter_.paint_face(renderer, fresh_, 0, face_++);
    if (face_ == methods::cube_faces) replace(maps, *std::exchange(begun_, std::nullopt), is_late_);
  }
  return drawn;
}

void MapRenewal::renew(render::Renderer& renderer, ReferenceMaps& maps, std::size_t map) {
  begun_.reset();
  fresh_.move(0, maps.places()[map]);
  painter_.paint(renderer, fresh_, 0);
  replace(maps, map, false);
}

void MapRenewal::replace(ReferenceMaps& maps, std::size_t map, bool stays_old) {
  fresh_.update_levels();
  maps.copy(map, fresh_, 0);
  is_old_[map] = stays_old;
}

}  // namespace parvis::reference_maps

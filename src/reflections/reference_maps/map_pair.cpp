#include "reflections/reference_maps/map_pair.h"

#include <limits>

namespace parvis::reference_maps {

MapPair pair_about(glm::vec3 place, const std::vector<glm::vec3>& maps, const MapChoice& choice) {
  const glm::ivec2 cell = glm::clamp(glm::ivec2((glm::vec2(place) - choice.origin()) / choice.cell_m()),
                                     glm::ivec2(0), choice.cells() - 1);
  const std::size_t first_of_cell =
      (std::size_t(cell.y) * std::size_t(choice.cells().x) + std::size_t(cell.x)) * MapChoice::maps_per_cell;
  const auto map_of_cell = [&](int i) { return int(choice.indices()[first_of_cell + std::size_t(i)]); };
  MapPair pair{map_of_cell(0), map_of_cell(1)};
  const glm::vec2 to_first(maps[std::size_t(pair.first)] - place);
  float nearest = std::numeric_limits<float>::max();
  for (int i = 1; i < MapChoice::maps_per_cell; ++i) {
    const glm::vec2 to_other(maps[std::size_t(map_of_cell(i))] - place);
    const float distance = glm::length(to_other);
    if (glm::dot(to_first, to_other) >= 0.0f || distance >= nearest) continue;
    nearest = distance;
    pair.second = map_of_cell(i);
  }
  return pair;
}

}  // namespace parvis::reference_maps

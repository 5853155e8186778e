// Lamps, bollards and the pits of the trees.
#pragma once

#include <vector>

#include "places/paper_city/city_mesh.h"

namespace parvis::city {

/// A tree of the city: where it stands, how it is turned, and which species it is.
struct TreePlace {
  glm::vec3 foot{0.0f};
  float heading_deg = 0.0f;
  int species = 0;
};

inline constexpr int tree_species = 2;
/// Eight: four along the wide road that runs north, four in the parks.
std::vector<TreePlace> tree_places();

/// The lamps that stand along the wide roads, by distance from the main crossing; `add_street_furniture` puts
/// up the first.
std::vector<glm::vec3> street_lamp_places();
/// How many of them belong to `add_street_furniture` when it adds so many triangles.
std::size_t furnished_lamps(std::size_t triangles);

/// Adds pits, lamps along the wide roads, and bollards round the main crossing: exactly `triangles` (even,
/// and enough for the pits).
void add_street_furniture(CityMesh& mesh, std::size_t triangles);

}  // namespace parvis::city

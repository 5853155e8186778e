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

/// Adds pits, lamps along the wide roads, and bollards round the main crossing: exactly `triangles` (even,
/// and enough for the pits).
void add_street_furniture(CityMesh& mesh, std::size_t triangles);

}  // namespace parvis::city

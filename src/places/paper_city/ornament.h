// Ornaments of houses: balconies and cornices that cast shadows, awnings, signs, dormers, chimneys, wings in
// the courtyard. Each has a known number of triangles.
#pragma once

#include <vector>

#include "places/paper_city/building.h"

namespace parvis::city {

/// One ornament on a face of a building.
struct Ornament {
  enum class Kind : std::uint8_t { ledge, balcony, awning, sign, dormer, chimney, wing };
  Kind kind = Kind::sign;
  int building = 0;
  int face = 0;
  float x_m = 0.0f;  ///< left end along the face
  float width_m = 1.0f;
  float z_m = 0.0f;      ///< foot, above the pavement
  float reach_m = 1.0f;  ///< outward from the wall, or inward for a wing
  int variant = 0;
  float rank = 0.0f;  ///< priority when the triangles do not suffice for all
};

/// Number of triangles of an ornament of this kind.
std::size_t triangle_count(Ornament::Kind kind);

/// All ornaments that fit a building; their rank falls with the distance to the city's centre.
std::vector<Ornament> possible_ornaments(const Building& building, int index, float distance_to_centre_m,
                                         Random& random);

/// Builds the ornament on its building.
void add_ornament(CityMesh& mesh, const Building& building, const Ornament& ornament);

}  // namespace parvis::city

// Houses of few triangles: the outline (eaves, roofs, cut corners) is geometry, windows are texture.
#pragma once

#include <vector>

#include "base/random.h"
#include "places/paper_city/city_mesh.h"
#include "places/paper_city/street_plan.h"

namespace parvis::city {

enum class Roof : std::uint8_t { gable, mansard, set_back };

/// One upright wall toward a street.
struct Face {
  Frame frame;
  float width_m = 0.0f;
  int bays = 1;
};

struct Building {
  Plot plot;
  int style = 0, tint = 0;
  int upper_floors = 3;
  float ground_m = 4.5f, floor_m = 3.4f;
  bool has_shops = false;
  int shop_strip = 0;     ///< which row of the sheet of shops
  int module_offset = 0;  ///< which shop comes first
  int bay_offset = 0;     ///< which bay of the sheet comes first
  Roof roof = Roof::gable;
  CityMaterial roof_material = CityMaterial::roof_tile;
  float cornice_m = 0.5f, overhang_m = 0.5f;
  float roof_rise_m = 3.0f;  ///< from the eaves to the ridge; of a mansard, to its knee
  std::vector<Face> faces;   ///< one, or three of a corner house: left, cut corner, right

  float eaves_m() const { return ground_m + floor_m * float(upper_floors); }
  CityMaterial wall() const { return wall_material(style, tint); }
};

/// Draws up a house for a plot. `neighbour` (may be null) is the one on its left: no two are alike.
Building plan_building(const Plot& plot, const Building* neighbour, float distance_to_centre_m,
                       Random& random);

/// Builds its walls, cornice and roof. The heights of the neighbours' eaves (0: none) tell how much of the
/// side walls is seen.
void add_building(CityMesh& mesh, const Building& building, float left_eaves_m, float right_eaves_m);

/// Profile of the roof across a row house: from the eaves' edge (y < 0, over the street) to the back wall.
std::vector<glm::vec2> roof_profile(const Building& building);

}  // namespace parvis::city

// Houses of few triangles: the outline (eaves, roofs, cut corners) is geometry, windows are textures.
#pragma once

#include <vector>

#include "base/random.h"
#include "places/paper_city/city_mesh.h"
#include "places/paper_city/street_plan.h"

namespace parvis::city {

/// Shape of a roof.
enum class Roof : std::uint8_t { gable, mansard, set_back };

/// One vertical wall that faces a street.
struct Face {
  Frame frame;
  float width_m = 0.0f;
  int bays = 1;
};

/// The design of a house: dimensions in metres, style, roof, and its street fronts.
struct Building {
  Plot plot;
  int style = 0, tint = 0;
  int upper_floors = 3;
  float ground_m = 4.5f, floor_m = 3.4f;
  bool has_shops = false;
  int shop_strip = 0;     ///< strip of the shop sheet
  int module_offset = 0;  ///< first shop of the strip
  int bay_offset = 0;     ///< first bay of the facade sheet
  Roof roof = Roof::gable;
  CityMaterial roof_material = CityMaterial::roof_tile;
  float cornice_m = 0.5f, overhang_m = 0.5f;
  float roof_rise_m = 3.0f;  ///< from the eaves to the ridge; to the knee of a mansard roof
  std::vector<Face> faces;   ///< one; three for a corner house: left, cut corner, right

  /// Height of the eaves above the pavement.
  float eaves_m() const { return ground_m + floor_m * float(upper_floors); }
  /// Material of its street fronts.
  CityMaterial wall() const { return wall_material(style, tint); }
};

/// How many modules of a length fit a wall best; at least one.
int modules_along(float length_m, float module_m);

/// Designs a house for a plot. `neighbour` (may be null) is the house on its left: adjacent houses differ.
Building plan_building(const Plot& plot, const Building* neighbour, float distance_to_centre_m,
                       Random& random);

/// Builds its walls, cornice and roof. The heights of the neighbours' eaves (0: none) determine the visible
/// part of the side walls.
void add_building(CityMesh& mesh, const Building& building, float left_eaves_m, float right_eaves_m);

/// Roof profile across a row house, from the edge of the eaves (y < 0, over the street) to the back wall.
std::vector<glm::vec2> roof_profile(const Building& building);

}  // namespace parvis::city

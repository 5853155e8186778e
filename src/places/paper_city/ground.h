// Roads, crossings, pavements with their kerbs, courtyards, parks, lamps and bollards: exactly what the
// paper's count leaves.
#pragma once

#include "places/paper_city/city_mesh.h"
#include "places/paper_city/street_plan.h"

namespace parvis::city {

inline constexpr std::size_t ground_triangles = 1600;  // 500,000 less buildings and trees

void add_ground(CityMesh& mesh, const StreetPlan& plan);

}  // namespace parvis::city

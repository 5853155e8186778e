// Roads, crossings, pavements with kerbs, courtyards, parks, lamps and bollards, with exactly the number of
// triangles that the paper's total leaves.
#pragma once

#include "places/paper_city/city_mesh.h"
#include "places/paper_city/street_plan.h"

namespace parvis::city {

inline constexpr std::size_t ground_triangles = 1600;  // 500,000 less buildings and trees

/// How many of them the street furniture takes.
std::size_t furniture_triangles(const StreetPlan& plan);

/// Adds the ground and the street furniture of the plan: exactly `ground_triangles` triangles.
void add_ground(CityMesh& mesh, const StreetPlan& plan);

}  // namespace parvis::city

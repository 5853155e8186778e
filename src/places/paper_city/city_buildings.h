// All the houses of the city, to the triangle.
#pragma once

#include <cstdint>
#include <vector>

#include "places/paper_city/building.h"
#include "places/paper_city/city_mesh.h"
#include "places/paper_city/street_plan.h"

namespace parvis::city {

inline constexpr std::size_t building_triangles = 25600;  // the paper, section 7

/// Designs all houses: those of `add_buildings` with its seed.
std::vector<Building> plan_buildings(const StreetPlan& plan, std::uint64_t seed);

/// Adds houses on every plot, then ornaments, those near the centre first, until exactly `building_triangles`
/// are spent.
void add_buildings(CityMesh& mesh, const StreetPlan& plan, std::uint64_t seed);

}  // namespace parvis::city

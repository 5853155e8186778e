#include "places/paper_city/city_buildings.h"

#include <algorithm>
#include <cassert>
#include <tuple>
#include <vector>

#include "places/paper_city/building.h"
#include "places/paper_city/ornament.h"

namespace parvis::city {
namespace {

float distance_to_centre(const Plot& plot) {
  return glm::length(glm::vec2(plot.frame.point(0.5f * plot.width_m, 0, 0)) - main_crossing());
}

std::vector<Building> planned_buildings(const StreetPlan& plan, Random& random) {
  std::vector<Building> buildings;
  buildings.reserve(plan.plots.size());
  for (const Plot& plot : plan.plots) {
    const Building* neighbour = plot.has_left_neighbour && !buildings.empty() ? &buildings.back() : nullptr;
    buildings.push_back(plan_building(plot, neighbour, distance_to_centre(plot), random));
  }
  return buildings;
}

std::string block_name(const StreetPlan& plan, const Building& building) {
  const Block& block = plan.blocks[std::size_t(building.plot.block)];
  return "block " + std::to_string(block.column) + std::to_string(block.row);
}

/// Chooses by rank; signs fill what is left when nothing larger fits.
std::vector<Ornament> chosen_ornaments(std::vector<Ornament> possible, std::size_t triangles) {
  std::sort(possible.begin(), possible.end(), [](const Ornament& a, const Ornament& b) {
    return std::tuple(-a.rank, a.building, a.face, a.x_m, a.z_m) <
           std::tuple(-b.rank, b.building, b.face, b.x_m, b.z_m);
  });
  std::vector<Ornament> chosen;
  for (const Ornament& ornament : possible) {
    const std::size_t cost = triangle_count(ornament.kind);
    if (cost > triangles) continue;
    chosen.push_back(ornament), triangles -= cost;
  }
  assert(triangles == 0);
  return chosen;
}

}  // namespace

std::vector<Building> plan_buildings(const StreetPlan& plan, std::uint64_t seed) {
  Random random(seed, 2);
  return planned_buildings(plan, random);
}

void add_buildings(CityMesh& mesh, const StreetPlan& plan, std::uint64_t seed) {
  Random random(seed, 2);
  const std::size_t before = mesh.triangle_count();
  const std::vector<Building> buildings = planned_buildings(plan, random);
  std::vector<Ornament> possible;
  for (std::size_t i = 0; i < buildings.size(); ++i) {
    const Building& b = buildings[i];
    // A row that starts at a corner follows the corner house that ends the row before it, or, for the block's
    // first side, the one that comes last: there the side wall is built in full.
    const float left = b.plot.has_left_neighbour && i > 0 && buildings[i - 1].plot.block == b.plot.block
                           ? buildings[i - 1].eaves_m()
                           : 0.0f;
    const float right =
        b.plot.has_right_neighbour && i + 1 < buildings.size() ? buildings[i + 1].eaves_m() : 0.0f;
    mesh.begin_group(block_name(plan, b));
    add_building(mesh, b, left, right);
    const std::vector<Ornament> more = possible_ornaments(b, int(i), distance_to_centre(b.plot), random);
    possible.insert(possible.end(), more.begin(), more.end());
  }
  const std::size_t spent = mesh.triangle_count() - before;
  assert(spent < building_triangles);
  for (const Ornament& ornament : chosen_ornaments(std::move(possible), building_triangles - spent)) {
    const Building& b = buildings[std::size_t(ornament.building)];
    mesh.begin_group(block_name(plan, b));
    add_ornament(mesh, b, ornament);
  }
}

}  // namespace parvis::city

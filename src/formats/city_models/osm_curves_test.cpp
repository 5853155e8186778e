#include "formats/city_models/osm_curves.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "formats/city_models/test_osm.h"

namespace parvis::scene {
namespace {

using glm::dvec2;

std::vector<dvec2> circle(int sides, double radius_m) {
  std::vector<dvec2> outline;
  outline.reserve(std::size_t(sides));
  for (int i = 0; i < sides; ++i) {
    const double angle = 2.0 * std::numbers::pi * double(i) / double(sides);
    outline.push_back(radius_m * dvec2(std::cos(angle), std::sin(angle)));
  }
  return outline;
}

Model building(const std::vector<dvec2>& outline, const char* roof, const char* roof_m) {
  TestMap map;
  map.add_area(outline,
               {{"building", "yes"}, {"height", "14"}, {"roof:shape", roof}, {"roof:height", roof_m}});
  TestTown town = read(map);
  EXPECT_TRUE(town.model) << town.warnings;
  return town.model ? *std::move(town.model) : Model();
}

/// The largest angle between the normals of a vertex and of its triangle, degrees, over walls and roofs.
double max_bend_deg(const Model& model) {
  double smallest = 1.0;
  for (const Part& part : model.parts)
    for (std::size_t i = 0; i + 2 < part.mesh.indices.size(); i += 3) {
      const auto at = [&](std::size_t k) { return part.mesh.positions[part.mesh.indices[i + k]]; };
      const glm::vec3 flat = glm::normalize(glm::cross(at(1) - at(0), at(2) - at(0)));
      for (std::size_t k = 0; k < 3; ++k)
        smallest = std::min(smallest, double(glm::dot(flat, part.mesh.normals[part.mesh.indices[i + k]])));
    }
  return glm::degrees(std::acos(std::min(smallest, 1.0)));
}

TEST(OsmCurves, ADomeOnARoundWallIsShadedAsRound) {
  const Model model = building(circle(24, 6.0), "dome", "6");
  for (const Part& part : model.parts) {
    const bool is_wall = part.object.starts_with("WallSurface"), is_roof = part.object == "RoofSurface metal";
    if (!is_wall && !is_roof) continue;
    for (std::size_t i = 0; i < part.mesh.positions.size(); ++i) {
      glm::vec3 outward = part.mesh.positions[i] - glm::vec3(0.0f, 0.0f, 8.0f);
      if (is_wall) outward.z = 0.0f;
      const bool is_at_eaves = is_roof && outward.z < 0.1f;  // nothing of the roof lies below
      // Maps have coordinates in steps of a centimetre. Flat facets would be off by 7.5 degrees, 0.991.
      const float needed = is_wall ? 0.9995f : is_at_eaves ? 0.98f : 0.996f;
      EXPECT_GT(glm::dot(glm::normalize(outward), part.mesh.normals[i]), needed) << part.object;
    }
  }
}

TEST(OsmCurves, ConesAreRoundAndPyramidsHaveEdges) {
  EXPECT_GT(max_bend_deg(building(circle(24, 6.0), "cone", "6")), 5.0);
  EXPECT_LT(max_bend_deg(building({{0, 0}, {12, 0}, {12, 12}, {0, 12}}, "pyramidal", "1.5")), 0.1)
      << "though its sides turn by no more than 20 degrees";
}

TEST(OsmCurves, BarrelsAreRoundAlongTheirProfile) {
  EXPECT_GT(max_bend_deg(building({{0, 0}, {20, 0}, {20, 9}, {0, 9}}, "round", "4")), 8.0);
}

TEST(OsmCurves, WideWallsAndCornersStayFlat) {
  EXPECT_LT(max_bend_deg(building(circle(16, 20.0), "flat", "0")), 0.1);
  EXPECT_LT(max_bend_deg(building(circle(8, 4.0), "flat", "0")), 0.1);
}

}  // namespace
}  // namespace parvis::scene

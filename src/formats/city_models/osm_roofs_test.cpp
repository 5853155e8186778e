#include "formats/city_models/osm_roofs.h"

#include <gtest/gtest.h>

#include <cmath>

namespace parvis::scene {
namespace {

using glm::dvec2, glm::dvec3;

const OsmRing rectangle{{0, 0}, {12, 0}, {12, 8}, {0, 8}};
const OsmRing pentagon{{0, 0}, {10, 0}, {13, 6}, {5, 11}, {-3, 6}};
const OsmRing l_shape{{0, 0}, {12, 0}, {12, 5}, {5, 5}, {5, 12}, {0, 12}};

dvec3 area_of(const std::vector<dvec3>& points) {
  dvec3 area(0.0);
  for (std::size_t i = 1; i + 1 < points.size(); ++i)
    area += 0.5 * glm::cross(points[i] - points[0], points[i + 1] - points[0]);
  return area;
}

/// Faces of a closed surface have areas that sum up to that of its open side, here the eaves.
void expect_closed(const OsmRoofTags& tags, const OsmRing& corners) {
  ASSERT_TRUE(has_osm_roof(tags, corners)) << tags.shape;
  dvec3 sum(0.0);
  double lowest_m = 1e9, highest_m = -1e9;
  bool has_roof = false;
  for (const OsmRoofFace& face : osm_roof(tags, corners, 6.0, 9.0)) {
    const dvec3 area = area_of(face.points);
    sum += area;
    if (face.semantics == std::string_view("RoofSurface")) {
      has_roof = true;
      EXPECT_TRUE(tags.shape == "onion" || area.z >= -1e-9) << tags.shape;
    } else {
      EXPECT_NEAR(area.z, 0.0, 1e-9) << tags.shape << ": a wall stands upright";
    }
    dvec2 centre(0.0);
    for (const dvec3& point : face.points) {
      lowest_m = std::min(lowest_m, point.z), highest_m = std::max(highest_m, point.z);
      centre += dvec2(point) / double(face.points.size());
    }
    EXPECT_GE(glm::dot(dvec2(area), centre - middle(corners)), tags.shape == "saltbox" ? -50.0 : -1e-6)
        << tags.shape << ": faces look outward";
  }
  EXPECT_TRUE(has_roof);
  EXPECT_NEAR(lowest_m, 6.0, 1e-9) << tags.shape;
  EXPECT_NEAR(highest_m, 9.0, 1e-9) << tags.shape;
  EXPECT_NEAR(glm::distance(sum, dvec3(0.0, 0.0, area_m2(corners))), 0.0, 1e-6) << tags.shape;
  EXPECT_GT(usual_osm_roof_m(tags, corners), 0.5) << tags.shape;
}

TEST(OsmRoofs, AreClosedAndAsHighAsTheTop) {
  for (const char* shape : {"gabled", "hipped", "half-hipped", "gambrel", "saltbox", "round", "skillion",
                            "mansard", "pyramidal", "cone", "dome", "onion", "lean_to"})
    for (const bool runs_across : {false, true}) expect_closed({shape, runs_across, {}}, rectangle);
  for (const char* shape : {"skillion", "mansard", "pyramidal", "dome", "onion"})
    expect_closed({shape, false, {}}, pentagon);
}

TEST(OsmRoofs, OtherOutlinesAndShapesAreFlat) {
  EXPECT_FALSE(has_osm_roof({"gabled", false, {}}, pentagon));
  EXPECT_FALSE(has_osm_roof({"mansard", false, {}}, l_shape));
  EXPECT_FALSE(has_osm_roof({"flat", false, {}}, rectangle));
  EXPECT_FALSE(has_osm_roof({"", false, {}}, rectangle));
  EXPECT_TRUE(has_osm_roof({"pyramidal", false, {}}, l_shape));
}

TEST(OsmRoofs, ASkillionFallsToItsDirection) {
  const std::vector<OsmRoofFace> faces = osm_roof({"skillion", false, 90.0}, rectangle, 6.0, 9.0);
  for (const dvec3& point : faces.back().points)
    EXPECT_NEAR(point.z, point.x > 6.0 ? 6.0 : 9.0, 1e-9) << "to the east";
}

TEST(OsmRoofs, RidgesRunAlongTheLongerSideOrAcross) {
  const auto reach_m = [](bool runs_across) {
    double most = 0.0;
    for (const OsmRoofFace& face : osm_roof({"gabled", runs_across, {}}, rectangle, 6.0, 9.0))
      for (const dvec3& a : face.points)
        for (const dvec3& b : face.points)
          if (a.z > 8.99 && b.z > 8.99) most = std::max(most, std::abs(a.x - b.x));
    return most;
  };
  EXPECT_NEAR(reach_m(false), 12.0, 1e-9);
  EXPECT_NEAR(reach_m(true), 0.0, 1e-9);
}

}  // namespace
}  // namespace parvis::scene

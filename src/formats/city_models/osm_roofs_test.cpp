#include "formats/city_models/osm_roofs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include "formats/city_models/test_rings.h"

namespace parvis::scene {
namespace {

using glm::dvec2, glm::dvec3;

const OsmRing pentagon{{0, 0}, {10, 0}, {13, 6}, {5, 11}, {-3, 6}};

dvec3 area_of(const std::vector<dvec3>& points) {
  dvec3 area(0.0);
  for (std::size_t i = 1; i + 1 < points.size(); ++i)
    area += 0.5 * glm::cross(points[i] - points[0], points[i + 1] - points[0]);
  return area;
}

/// The roof, of which no reason is needed.
std::optional<OsmRoof> find_osm_roof(const OsmRoofTags& tags, const std::vector<OsmRing>& rings) {
  std::string why_flat;
  std::optional<OsmRoof> found = scene::find_osm_roof(tags, rings, why_flat);
  EXPECT_TRUE(!found || why_flat.empty()) << why_flat;
  return found;
}

std::string why_flat(const std::string& shape, const std::vector<OsmRing>& rings) {
  std::string why;
  EXPECT_FALSE(scene::find_osm_roof({shape, false, {}}, rings, why)) << shape;
  return why;
}

/// Faces of a closed surface have areas that sum up to that of its open side, here the eaves.
void expect_closed(const OsmRoofTags& tags, const OsmRing& corners) {
  const std::optional<OsmRoof> found = find_osm_roof(tags, {corners});
  ASSERT_TRUE(found) << tags.shape;
  dvec3 sum(0.0);
  double lowest_m = 1e9, highest_m = -1e9;
  bool has_roof = false;
  for (const OsmRoofFace& face : osm_roof_faces(*found, 6.0, 9.0)) {
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
    if (!found->skeleton && tags.shape != "saltbox") {
      EXPECT_GE(glm::dot(dvec2(area), centre - middle(corners)), -1e-6)
          << tags.shape << ": faces look outward";
    }
  }
  EXPECT_TRUE(has_roof);
  EXPECT_NEAR(lowest_m, 6.0, 1e-9) << tags.shape;
  EXPECT_NEAR(highest_m, 9.0, 1e-9) << tags.shape;
  EXPECT_NEAR(glm::distance(sum, dvec3(0.0, 0.0, area_m2(corners))), 0.0, 1e-6) << tags.shape;
  EXPECT_GT(usual_osm_roof_m(*found), 0.5) << tags.shape;
}

TEST(OsmRoofs, AreClosedAndAsHighAsTheTop) {
  for (const char* shape : {"gabled", "hipped", "half-hipped", "gambrel", "saltbox", "round", "skillion",
                            "mansard", "pyramidal", "cone", "dome", "onion", "lean_to"})
    for (const bool runs_across : {false, true}) expect_closed({shape, runs_across, {}}, rectangle);
  for (const char* shape : {"skillion", "mansard", "pyramidal", "dome", "onion"})
    expect_closed({shape, false, {}}, pentagon);
}

TEST(OsmRoofs, RidgesFollowOutlinesOfWings) {
  for (const char* shape : {"gabled", "hipped", "half-hipped", "gambrel", "saltbox", "round"}) {
    expect_closed({shape, false, {}}, l_shape);
    expect_closed({shape, false, {}}, pentagon);
  }
  const auto upright = [](const char* shape) {
    return std::ranges::count_if(
        osm_roof_faces(*find_osm_roof({shape, false, {}}, {l_shape}), 6.0, 9.0),
        [](const OsmRoofFace& face) { return face.semantics == std::string_view("WallSurface"); });
  };
  EXPECT_EQ(upright("gabled"), 2) << "at the ends of both wings";
  EXPECT_EQ(upright("hipped"), 0);
}

TEST(OsmRoofs, RoofsWithoutAHeightRiseWithOneSlope) {
  const auto height_m = [](const char* shape, const OsmRing& corners) {
    return usual_osm_roof_m(*find_osm_roof({shape, false, {}}, {corners}));
  };
  EXPECT_NEAR(height_m("hipped", rectangle), height_m("gabled", rectangle), 1e-9);
  EXPECT_NEAR(height_m("gabled", l_shape), height_m("gabled", rectangle) * 5.0 / 8.0, 1e-9)
      << "wings of 5 m, a house of 8 m";
}

TEST(OsmRoofs, StandRoundCourtyards) {
  OsmRing hole{{4, 2}, {4, 6}, {8, 6}, {8, 2}};
  EXPECT_TRUE(find_osm_roof({"hipped", false, {}}, {rectangle, hole}));
  EXPECT_TRUE(find_osm_roof({"pyramidal", false, {}}, {rectangle, hole})) << "hipped";
  EXPECT_NE(why_flat("skillion", {rectangle, hole}).find("without courtyards"), std::string::npos);
}

TEST(OsmRoofs, PyramidsAreHipsWhereTheirFacesWouldLeanOutward) {
  const OsmRing wide_l{{0, 0}, {30, 0}, {30, 4}, {4, 4}, {4, 30}, {0, 30}};
  EXPECT_TRUE(find_osm_roof({"pyramidal", false, {}}, {wide_l})->skeleton);
  EXPECT_FALSE(find_osm_roof({"pyramidal", false, {}}, {pentagon})->skeleton);
  expect_closed({"pyramidal", false, {}}, wide_l);
}

TEST(OsmRoofs, OthersAreFlatAndSayWhy) {
  const OsmRing crossed{{0, 0}, {10, 10}, {10, 0}, {0, 10}, {-5, 5}};
  EXPECT_NE(why_flat("gabled", {crossed}).find("crosses"), std::string::npos);
  EXPECT_NE(why_flat("mansard", {l_shape}).find("convex"), std::string::npos);
  EXPECT_NE(why_flat("sawtooth", {rectangle}).find("not known"), std::string::npos);
  OsmRing star;
  for (std::size_t i = 0; i <= max_skeleton_corners; ++i)
    star.push_back((i % 2 == 0 ? 20.0 : 15.0) *
                   dvec2(std::cos(0.04 * double(i)), std::sin(0.04 * double(i))));
  EXPECT_NE(why_flat("hipped", {star}).find("more than 150 corners"), std::string::npos);
  EXPECT_EQ(why_flat("flat", {rectangle}), "");
  EXPECT_EQ(why_flat("", {rectangle}), "");
}

TEST(OsmRoofs, ASkillionFallsToItsDirection) {
  const std::vector<OsmRoofFace> faces =
      osm_roof_faces(*find_osm_roof({"skillion", false, 90.0}, {rectangle}), 6.0, 9.0);
  for (const dvec3& point : faces.back().points)
    EXPECT_NEAR(point.z, point.x > 6.0 ? 6.0 : 9.0, 1e-9) << "to the east";
}

TEST(OsmRoofs, RidgesRunAlongTheLongerSideOrAcross) {
  const auto reach_m = [](bool runs_across) {
    double most = 0.0;
    for (const OsmRoofFace& face :
         osm_roof_faces(*find_osm_roof({"gabled", runs_across, {}}, {rectangle}), 6.0, 9.0))
      for (const dvec3& a : face.points)
        for (const dvec3& b : face.points)
          if (a.z > 8.99 && b.z > 8.99) most = std::max(most, std::abs(a.x - b.x));
    return most;
  };
  EXPECT_NEAR(reach_m(false), 12.0, 1e-9);
  EXPECT_NEAR(reach_m(true), 0.0, 1e-9);
}

TEST(OsmRoofs, RidgesAreSquareToTheDirectionOfTheRoof) {
  for (const char* shape : {"gabled", "half-hipped", "gambrel", "round", "saltbox"})
    for (const double direction_deg : {0.0, 80.0, 100.0, 180.0, 270.0}) {
      const auto roof = find_osm_roof({.shape = shape, .direction_deg = direction_deg}, {rectangle});
      ASSERT_TRUE(roof) << shape;
      dvec2 low(1e9), high(-1e9);  // of the ridge
      for (const OsmRoofFace& face : osm_roof_faces(*roof, 6.0, 9.0))
        for (const dvec3& point : face.points)
          if (point.z > 8.99) low = glm::min(low, dvec2(point)), high = glm::max(high, dvec2(point));
      const bool runs_north = direction_deg == 80.0 || direction_deg == 100.0 || direction_deg == 270.0;
      EXPECT_NEAR(runs_north ? high.x - low.x : high.y - low.y, 0.0, 1e-6) << shape << " " << direction_deg;
      EXPECT_GT(runs_north ? high.y - low.y : high.x - low.x, 1.5) << shape << " " << direction_deg;
      if (shape == std::string_view("saltbox") && direction_deg == 180.0) {
        EXPECT_GT(low.y, 5.0) << "the long slope is the main face, and looks south";
      }
    }
}

}  // namespace
}  // namespace parvis::scene

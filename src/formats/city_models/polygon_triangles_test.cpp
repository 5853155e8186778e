#include "formats/city_models/polygon_triangles.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace parvis::scene {
namespace {

using glm::dvec3;
using Ring = std::vector<dvec3>;

constexpr dvec3 polygon_normal(0.0, 0.0, 1.0);
constexpr double slip_m2 = 1e-5;  // the tessellator weights the ends of edges that cross by floats

Ring box(double x0, double y0, double x1, double y1) {
  return {{x0, y0, 0.0}, {x1, y0, 0.0}, {x1, y1, 0.0}, {x0, y1, 0.0}};
}

Ring reversed(Ring ring) {
  std::ranges::reverse(ring);
  return ring;
}

/// Outlines' areas, those of holes negative.
std::vector<double> areas_of(const std::vector<Ring>& rings) {
  std::vector<double> areas;
  for (const Ring& ring : rings) areas.push_back(0.5 * newell_normal(ring).z);
  std::ranges::sort(areas);
  return areas;
}

TEST(PolygonTriangles, OutlinesOfWhatIsLeftOfACutPolygon) {
  const std::vector<double> parted =
      areas_of(outlines({box(0, 0, 10, 4), reversed(box(4, -1, 6, 5))}, polygon_normal, Inside::positive));
  ASSERT_EQ(parted.size(), 2u);
  EXPECT_NEAR(parted[0], 16.0, slip_m2);
  EXPECT_NEAR(parted[1], 16.0, slip_m2);
  const std::vector<double> holed =
      areas_of(outlines({box(0, 0, 10, 4), reversed(box(4, 1, 6, 3))}, polygon_normal, Inside::positive));
  ASSERT_EQ(holed.size(), 2u);
  EXPECT_NEAR(holed[0], -4.0, slip_m2) << "a hole runs clockwise";
  EXPECT_NEAR(holed[1], 40.0, slip_m2);
}

TEST(PolygonTriangles, OutlinesOfPolygonsThatOverlapAreJoined) {
  const std::vector<Ring> joined =
      outlines({box(0, 0, 4, 4), box(3, 0, 8, 4), box(4, 2, 5, 9)}, polygon_normal, Inside::positive);
  const std::vector<double> areas = areas_of(joined);
  ASSERT_EQ(areas.size(), 1u);
  EXPECT_NEAR(areas[0], 37.0, slip_m2);
  for (const dvec3 corner : {dvec3(0.0, 0.0, 0.0), dvec3(8.0, 4.0, 0.0), dvec3(5.0, 9.0, 0.0)})
    EXPECT_TRUE(std::ranges::find(joined[0], corner) != joined[0].end()) << "corners keep their places";
  EXPECT_TRUE(outlines({}, polygon_normal, Inside::odd).empty());
}

TEST(PolygonTriangles, TwiceInsideIsWhatTwoPolygonsHaveInCommon) {
  std::vector<dvec3> points;
  const std::vector<std::uint32_t> triangles =
      triangulated({box(0, 0, 10, 10), reversed(box(3, 3, 7, 7)), box(5, -1, 6, 11)}, polygon_normal, points,
                   Inside::twice);
  double area = 0.0;
  for (std::size_t i = 0; i + 2 < triangles.size(); i += 3)
    area += 0.5 * newell_normal({points[triangles[i]], points[triangles[i + 1]], points[triangles[i + 2]]}).z;
  EXPECT_NEAR(area, 6.0, slip_m2) << "without the hole";
}

}  // namespace
}  // namespace parvis::scene

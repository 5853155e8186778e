#include "formats/terrain/map_system.h"

#include <gtest/gtest.h>

namespace parvis::scene {
namespace {

TEST(MapSystem, NumbersAreFoundInNamesOfManyForms) {
  EXPECT_EQ(epsg_in("EPSG:4326"), 4326);
  EXPECT_EQ(epsg_in("urn:ogc:def:crs:EPSG::7415"), 7415);
  EXPECT_EQ(epsg_in("urn:ogc:def:crs,crs:EPSG:6.12:3068,crs:EPSG:6.12:5783"), 3068);
  EXPECT_EQ(epsg_in("http://www.opengis.net/def/crs/EPSG/0/6697"), 6697);
  EXPECT_EQ(epsg_in("http://www.opengis.net/def/crs/EPSG/6.12/3068"), 3068);
  EXPECT_EQ(epsg_in("http://www.opengis.net/gml/srs/epsg.xml#4326"), 4326);
  EXPECT_EQ(epsg_in("EPSG:4326+5773"), 4326);
  for (const char* none : {"", "EPSG", "EPSG:", "EPSG::", "EPSG:4326a", "EPSG:99999999999999999999",
                           "urn:adv:crs:ETRS89_UTM32*DE_DHHN2016_NH", "urn:ogc:def:crs:OGC:1.3:CRS84"})
    EXPECT_FALSE(epsg_in(none)) << none;
}

TEST(MapSystem, DegreesHaveAnOrderAndMapsAUnit) {
  for (const int japan : {6697, 6668, 4979, 4326, 4258}) {
    const std::optional<MapSystem> degrees = map_system(japan);
    ASSERT_TRUE(degrees) << japan;
    EXPECT_TRUE(degrees->is_geographic && degrees->is_north_first) << japan;
  }
  const std::optional<MapSystem> utm = map_system(25832);
  ASSERT_TRUE(utm);
  EXPECT_FALSE(utm->is_geographic);
  EXPECT_EQ(utm->plan_unit_m, 1.0);
  EXPECT_FALSE(utm->height_unit_m);
  const std::optional<MapSystem> new_york = map_system(2263);
  ASSERT_TRUE(new_york);
  EXPECT_NEAR(new_york->plan_unit_m, 1200.0 / 3937.0, 1e-9) << "the foot of the US survey";
  ASSERT_TRUE(map_system(7415));
  EXPECT_EQ(map_system(7415)->height_unit_m, 1.0) << "Amersfoort / RD New + NAP height";
  EXPECT_FALSE(map_system(99999));
  EXPECT_FALSE(map_system(5783)) << "of heights alone";
}

TEST(MapSystem, PlacesOnMapsLieOnTheEarth) {
  const std::optional<glm::dvec2> amersfoort = place_on_earth(28992, {155'000.0, 463'000.0});
  ASSERT_TRUE(amersfoort);
  EXPECT_NEAR(amersfoort->x, 5.387, 0.01);
  EXPECT_NEAR(amersfoort->y, 52.155, 0.01);
  const std::optional<glm::dvec2> liberty = place_on_earth(2263, {971'000.0, 190'600.0});
  ASSERT_TRUE(liberty);
  EXPECT_NEAR(liberty->x, -74.044, 0.02);
  EXPECT_NEAR(liberty->y, 40.689, 0.02);
  EXPECT_FALSE(place_on_earth(99999, {0.0, 0.0}));
}

}  // namespace
}  // namespace parvis::scene

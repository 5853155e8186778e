#include "formats/city_models/city_coordinates.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace parvis::scene {
namespace {

/// Clues of a place of about a kilometre with houses of 30 m at a point.
CoordinateClues town_at(const std::string& system, glm::dvec2 middle, double size) {
  CoordinateClues clues;
  clues.system = system;
  clues.add({middle.x - size / 2.0, middle.y - size / 2.0, 2.0});
  clues.add({middle.x + size / 2.0, middle.y + size / 2.0, 32.0});
  return clues;
}

struct Found {
  Result<CityCoordinates> coordinates;
  std::string warnings;
};

Found find(const CoordinateClues& clues) {
  Errors warnings;
  Result<CityCoordinates> coordinates = CityCoordinates::find(clues, "town.gml", warnings);
  return {std::move(coordinates), to_string(warnings)};
}

constexpr glm::dvec2 in_tokyo_deg{139.77, 35.68}, delft_deg{4.36, 52.01};  // east, north

glm::dvec2 on_map(glm::dvec2 deg) { return MapProjection::utm(deg)(deg); }

TEST(CityCoordinates, DegreesOfJapanStandOnTheMapOfOpenStreetMap) {
  const Found found =
      find(town_at("http://www.opengis.net/def/crs/EPSG/0/6697", {in_tokyo_deg.y, in_tokyo_deg.x}, 0.01));
  ASSERT_TRUE(found.coordinates) << to_string(found.coordinates.errors());
  EXPECT_EQ(found.warnings, "");
  const glm::dvec3 place = (*found.coordinates)({in_tokyo_deg.y, in_tokyo_deg.x, 12.5});
  EXPECT_NEAR(glm::distance(glm::dvec2(place), on_map(in_tokyo_deg)), 0.0, 1e-6);
  EXPECT_DOUBLE_EQ(place.z, 12.5);
  const glm::dvec3 north = (*found.coordinates)({in_tokyo_deg.y + 0.001, in_tokyo_deg.x, 12.5});
  EXPECT_NEAR(north.y - place.y, 110.9, 0.5) << "a thousandth of a degree to the north";
  EXPECT_NEAR(north.x - place.x, 0.0, 2.0);
  ASSERT_TRUE(found.coordinates->place_deg());
  EXPECT_NEAR(glm::distance(*found.coordinates->place_deg(), in_tokyo_deg), 0.0, 1e-9);
}

TEST(CityCoordinates, TheOrderOfTheAxesIsTheNamesWhereBothArePossible) {
  const Found latitude_first = find(town_at("urn:ogc:def:crs:EPSG::4979", {delft_deg.y, delft_deg.x}, 0.01));
  ASSERT_TRUE(latitude_first.coordinates);
  EXPECT_NEAR(glm::distance(*latitude_first.coordinates->place_deg(), delft_deg), 0.0, 1e-9);
  const Found longitude_first = find(town_at("urn:ogc:def:crs:OGC:1.3:CRS84", delft_deg, 0.01));
  ASSERT_TRUE(longitude_first.coordinates);
  EXPECT_NEAR(glm::distance(*longitude_first.coordinates->place_deg(), delft_deg), 0.0, 1e-9);
  EXPECT_EQ(latitude_first.warnings + longitude_first.warnings, "");
}

TEST(CityCoordinates, CoordinatesAndRoofsThatContradictTheNameCountMore) {
  const Found by_coordinates = find(town_at("EPSG:4979", in_tokyo_deg, 0.01));
  ASSERT_TRUE(by_coordinates.coordinates);
  EXPECT_NEAR(glm::distance(*by_coordinates.coordinates->place_deg(), in_tokyo_deg), 0.0, 1e-9);
  EXPECT_NE(by_coordinates.warnings.find("town.gml: \"EPSG:4979\" means latitude first"), std::string::npos)
      << by_coordinates.warnings;
  CoordinateClues roofs = town_at("EPSG:4979", delft_deg, 0.01);
  roofs.roofs = 10.0, roofs.roofs_up = 9.0;  // they face up if the first axis points east
  const Found by_roofs = find(roofs);
  ASSERT_TRUE(by_roofs.coordinates);
  EXPECT_NEAR(glm::distance(*by_roofs.coordinates->place_deg(), delft_deg), 0.0, 1e-9);
  EXPECT_NE(by_roofs.warnings.find("by its roofs"), std::string::npos) << by_roofs.warnings;
}

TEST(CityCoordinates, DegreesWithoutANameAreReadWhereOneIsBeyondNinety) {
  const Found found = find(town_at("", {in_tokyo_deg.y, in_tokyo_deg.x}, 0.01));
  ASSERT_TRUE(found.coordinates && found.coordinates->place_deg());
  EXPECT_NEAR(glm::distance(*found.coordinates->place_deg(), in_tokyo_deg), 0.0, 1e-9);
  EXPECT_NE(found.warnings.find("names no coordinate system"), std::string::npos) << found.warnings;
  const Found unknown = find(town_at("", delft_deg, 0.01));
  ASSERT_TRUE(unknown.coordinates);
  EXPECT_FALSE(unknown.coordinates->place_deg()) << "either order is possible";
}

TEST(CityCoordinates, MetresStayAndFeetBecomeMetres) {
  for (const char* name : {"", "EPSG:25832", "urn:adv:crs:ETRS89_UTM32*DE_DHHN2016_NH"}) {
    const Found found = find(town_at(name, {566'000.0, 5'933'000.0}, 1000.0));
    ASSERT_TRUE(found.coordinates) << name;
    EXPECT_EQ((*found.coordinates)({566'001.0, 5'933'002.0, 3.0}), glm::dvec3(566'001.0, 5'933'002.0, 3.0));
    EXPECT_EQ(found.warnings, "") << name;
  }
  const Found feet = find(town_at("urn:ogc:def:crs:EPSG::2263", {971'000.0, 190'600.0}, 3000.0));
  ASSERT_TRUE(feet.coordinates && feet.coordinates->place_deg());
  EXPECT_NEAR((*feet.coordinates)({1000.0, 2000.0, 100.0}).x, 304.8006, 1e-3);
  EXPECT_NEAR((*feet.coordinates)({1000.0, 2000.0, 100.0}).z, 30.48006, 1e-3);
  EXPECT_NEAR(feet.coordinates->place_deg()->x, -74.05, 0.05) << "New York";
  EXPECT_NE(feet.warnings.find("has no heights"), std::string::npos) << feet.warnings;
}

TEST(CityCoordinates, MapsWhoseNorthingStandsFirstAreKnownByTheirRoofs) {
  CoordinateClues warsaw = town_at("EPSG:2180", {487'000.0, 637'000.0}, 1000.0);  // northing, easting
  warsaw.roofs = 100.0, warsaw.roofs_up = -95.0;
  const Found found = find(warsaw);
  ASSERT_TRUE(found.coordinates);
  EXPECT_EQ((*found.coordinates)({487'000.0, 637'000.0, 1.0}), glm::dvec3(637'000.0, 487'000.0, 1.0));
  ASSERT_TRUE(found.coordinates->place_deg());
  EXPECT_NEAR(found.coordinates->place_deg()->x, 21.0, 0.1);
  warsaw.roofs_up = 95.0;
  EXPECT_EQ((*find(warsaw).coordinates)({487'000.0, 637'000.0, 1.0}).x, 487'000.0) << "control";
}

TEST(CityCoordinates, UnknownSystemsAndExchangedAxesSaySo) {
  const Found unknown = find(town_at("EPSG:99999", {1000.0, 2000.0}, 100.0));
  ASSERT_TRUE(unknown.coordinates);
  EXPECT_EQ((*unknown.coordinates)({1.0, 2.0, 3.0}), glm::dvec3(1.0, 2.0, 3.0));
  EXPECT_NE(unknown.warnings.find("town.gml: its coordinates are of a system that is not known"),
            std::string::npos)
      << unknown.warnings;
  const Found metres = find(town_at("EPSG:4979", {85'000.0, 447'000.0}, 100.0));
  ASSERT_TRUE(metres.coordinates);
  EXPECT_EQ((*metres.coordinates)({1.0, 2.0, 3.0}), glm::dvec3(1.0, 2.0, 3.0));
  EXPECT_NE(metres.warnings.find("read as metres"), std::string::npos) << metres.warnings;
  CoordinateClues exchanged = town_at("EPSG:4979", delft_deg, 0.01);
  exchanged.add({delft_deg.y, delft_deg.x, 3.0});
  const Found mixed = find(exchanged);
  ASSERT_FALSE(mixed.coordinates);
  EXPECT_NE(to_string(mixed.coordinates.errors()).find("axes of some objects exchanged"), std::string::npos);
}

TEST(CityCoordinates, BodiesSayWhichAxisIsFirstWhereNoRoofDoes) {
  const std::vector<std::vector<glm::dvec3>> tower{
      // bottom and top, the right side out if x points east
      {{637'200, 486'000, 100}, {637'200, 486'010, 100}, {637'210, 486'010, 100}, {637'210, 486'000, 100}},
      {{637'200, 486'000, 130}, {637'210, 486'000, 130}, {637'210, 486'010, 130}, {637'200, 486'010, 130}}};
  for (const char* name : {"urn:ogc:def:crs:EPSG::2180", "EPSG:2180"})
    for (const bool is_north_first : {false, true}) {
      CoordinateClues clues;
      clues.system = name;
      std::vector<std::vector<glm::dvec3>> rings = tower;
      for (auto& ring : rings)
        for (glm::dvec3& point : ring) {
          if (is_north_first) std::swap(point.x, point.y);
          clues.add(point);
        }
      clues.add_body(rings);
      Errors warnings;
      const Result<CityCoordinates> found = CityCoordinates::find(clues, "town.gml", warnings);
      ASSERT_TRUE(found);
      EXPECT_NEAR((*found)(rings[0][0]).x, 637'200.0, 1e-6) << name << is_north_first;
      EXPECT_EQ(found->map(), "EPSG:2180");
    }
  for (const bool is_urn : {false, true}) {  // nothing but the name says it
    CoordinateClues clues;
    clues.system = is_urn ? "urn:ogc:def:crs:EPSG::2180" : "EPSG:2180";
    clues.add({637'200, 486'000, 0});
    Errors warnings;
    const Result<CityCoordinates> found = CityCoordinates::find(clues, "town.gml", warnings);
    ASSERT_TRUE(found);
    EXPECT_EQ((*found)({637'200, 486'000, 0}).x, is_urn ? 486'000.0 : 637'200.0);
  }
}

TEST(CityCoordinates, AProjectedTownIsLaidOnTheMapOfTheScene) {
  CoordinateClues clues;
  clues.system = "EPSG:28992";
  const glm::dvec3 delft(84'500, 447'500, 1);
  clues.add(delft);
  Errors warnings;
  const Result<CityCoordinates> found = CityCoordinates::find(clues, "town.json", warnings, "EPSG:25831");
  ASSERT_TRUE(found && found->place_deg());
  EXPECT_EQ(found->map(), "EPSG:25831");
  const auto target = MapProjection::of("EPSG:25831");
  ASSERT_TRUE(target);
  EXPECT_NEAR(glm::distance(glm::dvec2((*found)(delft)), (*target)(*found->place_deg())), 0.0, 0.5);
}

}  // namespace
}  // namespace parvis::scene

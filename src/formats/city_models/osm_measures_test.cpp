#include "formats/city_models/osm_measures.h"

#include <gtest/gtest.h>

#include "formats/city_models/test_osm.h"

namespace parvis::scene {
namespace {

TEST(OsmMeasures, LengthsHaveUnits) {
  const auto metres = [](const char* text) { return metres_in(text).value_or(-1.0); };
  for (const char* text :
       {"12.5", "12,5", "12.5 m", "12.5m", "1250 cm", "12.5;20", "12500 mm", " +12.5 metres"})
    EXPECT_NEAR(metres(text), 12.5, 1e-9) << text;
  EXPECT_NEAR(metres("40'"), 12.192, 1e-9);
  EXPECT_NEAR(metres("40 ft"), 12.192, 1e-9);
  EXPECT_NEAR(metres("40 Feet"), 12.192, 1e-9);
  EXPECT_NEAR(metres("6'4\""), 6 * 0.3048 + 4 * 0.0254, 1e-9);
  EXPECT_NEAR(metres("6 ft 4 in"), 6 * 0.3048 + 4 * 0.0254, 1e-9);
  EXPECT_NEAR(metres("6′4″"), 6 * 0.3048 + 4 * 0.0254, 1e-9);
  EXPECT_NEAR(metres("300 in"), 7.62, 1e-9);
  EXPECT_NEAR(metres("300\""), 7.62, 1e-9);
  for (const char* text : {"", "tall", "12 storeys", "12 furlongs", "1e9", "nan", "12x"})
    EXPECT_FALSE(metres_in(text)) << text;
}

TEST(OsmMeasures, DirectionsAreDegreesOrPointsOfTheCompass) {
  EXPECT_EQ(degrees_in("90"), 90.0);
  EXPECT_EQ(degrees_in("22,5°"), 22.5);
  EXPECT_EQ(degrees_in("sse"), 157.5);
  EXPECT_EQ(degrees_in("north-west"), 315.0);
  for (const char* text : {"", "up", "400", "90 rad"}) EXPECT_FALSE(degrees_in(text)) << text;
}

TEST(OsmMeasures, TagsThatCannotBeReadAreNamed) {
  TestMap map;
  map.add_area(
      {{0, 0}, {10, 0}, {10, 10}, {0, 10}},
      {{"building", "yes"}, {"height", "12 ells"}, {"building:levels", "3"}, {"roof:direction", "up"}});
  const TestFolder folder;
  Errors warnings;
  FileAccount account("OpenStreetMap");
  const Result<Model> model =
      read_osm(folder.write("town.osm", map.text()), warnings, {}, nullptr, {}, &account);
  ASSERT_TRUE(model) << to_string(model.errors());
  EXPECT_NEAR(bounds_of(*model, "RoofSurface").max.z, 9.0f, 1e-4f) << "by the levels";
  EXPECT_EQ(account.count(Fate::left_out, "tags height"), 1u) << account.text();
  EXPECT_EQ(account.count(Fate::left_out, "tags roof:direction"), 1u);
  for (const char* words : {"way 1: 12 ells", "way 1: up"})
    EXPECT_NE(account.text().find(words), std::string::npos) << account.text();
}

TEST(OsmMeasures, WhatIsNotDrawnIsCountedInTheAccount) {
  TestMap map;
  map.add_area({{0, 0}, {10, 0}, {10, 10}, {0, 10}}, {{"building", "yes"}});
  for (const double x : {20.0, 30.0}) map.add_line({{x, 0}, {x, 50}}, {{"power", "line"}});
  map.add_line({{0, 20}, {50, 20}}, {{"highway", "footway"}});
  const TestFolder folder;
  Errors warnings;
  FileAccount account("OpenStreetMap");
  ASSERT_TRUE(read_osm(folder.write("town.osm", map.text()), warnings, {}, nullptr, {}, &account));
  EXPECT_EQ(account.count(Fate::used, "elements with a kind"), 2u) << account.text();
  EXPECT_EQ(account.count(Fate::left_out, "elements with a kind"), 2u) << account.text();
  EXPECT_NE(account.text().find("2 power=line"), std::string::npos) << account.text();
}

}  // namespace
}  // namespace parvis::scene

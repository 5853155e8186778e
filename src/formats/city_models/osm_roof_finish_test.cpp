#include "formats/city_models/osm_roof_finish.h"

#include <gtest/gtest.h>

#include "base/colour.h"
#include "formats/city_models/test_osm.h"
#include "scene/data/model_parts.h"
#include "scene/data/test_scene.h"

namespace parvis::scene {
namespace {

TestTown house(TestTags tags) {
  TestMap map;
  tags.insert(tags.end(), {{"building", "yes"}, {"height", "9"}});
  map.add_area({{0, 0}, {10, 0}, {10, 10}, {0, 10}}, tags);
  return read(map);
}

glm::vec3 colour_of(const Model& model, const std::string& name) {
  for (const Material& material : model.materials)
    if (material.name == name) return material.base_colour;
  return glm::vec3(-1.0f);
}

TEST(OsmRoofFinish, RoundRoofsAreOfMetalUpToTheirTop) {
  for (const char* shape : {"dome", "onion", "round"}) {
    const TestTown town = house({{"roof:shape", shape}, {"roof:height", "3"}});
    ASSERT_TRUE(town.model) << shape;
    EXPECT_EQ(town.warnings, "");
    EXPECT_GT(area_m2(*town.model, "RoofSurface metal"), 100.0) << shape;
    EXPECT_TRUE(matching_parts(*town.model, "RoofSurface").empty())
        << shape << ": what lays gravel where a roof is level would find its top";
    EXPECT_FALSE(matching_parts(*town.model, "RoofSurface*").empty()) << shape;
  }
}

TEST(OsmRoofFinish, TilesAndGravelAreChosenByWhatDressesRoofs) {
  for (const TestTags& tags :
       {TestTags{}, TestTags{{"roof:shape", "gabled"}, {"roof:material", "roof_tiles"}},
        TestTags{{"roof:shape", "gabled"}, {"roof:colour", "#335577"}}}) {
    const TestTown town = house(tags);
    ASSERT_TRUE(town.model);
    EXPECT_GT(area_m2(*town.model, "RoofSurface"), 99.0);
    EXPECT_TRUE(matching_parts(*town.model, "RoofSurface ?*").empty());
  }
}

TEST(OsmRoofFinish, MaterialsAndColoursAreThoseOfTheTags) {
  const TestTown copper = house({{"roof:shape", "gabled"}, {"roof:material", "copper"}});
  ASSERT_TRUE(copper.model);
  const glm::vec3 weathered = colour_of(*copper.model, "RoofSurface copper");
  EXPECT_GT(weathered.y, weathered.x) << "green";
  const TestTown blue = house({{"roof:material", "metal_sheet"}, {"roof:colour", "#335577"}});
  ASSERT_TRUE(blue.model);
  EXPECT_LT(glm::distance(colour_of(*blue.model, "RoofSurface metal"), linear_from_srgb8(0x33, 0x55, 0x77)),
            1e-3f);
  const TestTown planted = house({{"roof:material", "grass"}});
  ASSERT_TRUE(planted.model);
  EXPECT_GT(area_m2(*planted.model, "RoofSurface green"), 99.0);
}

}  // namespace
}  // namespace parvis::scene

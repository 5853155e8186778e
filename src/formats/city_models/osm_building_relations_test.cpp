#include "formats/city_models/osm_building_relations.h"

#include <gtest/gtest.h>

#include "formats/city_models/test_osm.h"

namespace parvis::scene {
namespace {

/// Heights of roofs, the lowest and the highest.
Bounds roofs(const TestMap& map) {
  const TestTown town = read(map);
  EXPECT_TRUE(town.model) << to_string(town.model.errors());
  return town.model ? bounds_of(*town.model, "RoofSurface") : Bounds();
}

TEST(OsmBuildingRelations, PartsOfARelationStandInPlaceOfItsOutline) {
  TestMap map;
  map.add_area({{0, 0}, {20, 0}, {20, 10}, {0, 10}}, {{"building", "yes"}, {"height", "30"}});
  map.add_area({{0, 0}, {50, 0}, {50, 10}, {0, 10}}, {{"building:part", "yes"}, {"height", "8"}});
  EXPECT_NEAR(roofs(map).max.z, 30.0f, 1e-3f) << "control: the part's middle lies beyond the outline";
  map.add_relation({{1, "outline"}, {2, "part"}}, {{"type", "building"}});
  EXPECT_NEAR(roofs(map).max.z, 8.0f, 1e-3f);
}

TEST(OsmBuildingRelations, BuildingsThatAreNamedAsPartsAreParts) {
  TestMap map;
  map.add_area({{0, 0}, {20, 0}, {20, 10}, {0, 10}}, {{"building", "yes"}, {"height", "30"}});
  map.add_area({{0, 0}, {20, 0}, {20, 9}, {0, 9}}, {{"building", "yes"}, {"height", "8"}});
  EXPECT_NEAR(roofs(map).max.z, 30.0f, 1e-3f) << "control";
  map.add_relation({{1, "outline"}, {2, "part"}}, {{"type", "building"}});
  EXPECT_NEAR(roofs(map).max.z, 8.0f, 1e-3f);
}

TEST(OsmBuildingRelations, TagsOfTheRelationAreThoseOfItsOutline) {
  TestMap map;
  map.add_area({{0, 0}, {20, 0}, {20, 10}, {0, 10}}, {});
  map.add_area({{100, 0}, {120, 0}, {120, 10}, {100, 10}}, {{"building", "yes"}, {"height", "4"}});
  EXPECT_NEAR(roofs(map).max.z, 4.0f, 1e-3f) << "control";
  map.add_relation({{1, "outline"}}, {{"type", "building"}, {"building", "office"}, {"height", "12"}});
  EXPECT_NEAR(roofs(map).max.z, 12.0f, 1e-3f);
}

TEST(OsmBuildingRelations, ATowerAloneLeavesItsChurchStanding) {
  TestMap map;
  map.add_area({{0, 0}, {40, 0}, {40, 15}, {0, 15}}, {{"building", "church"}, {"height", "15"}});
  map.add_area({{1, 5}, {6, 5}, {6, 10}, {1, 10}}, {{"building:part", "yes"}, {"height", "40"}});
  const Bounds church = roofs(map);
  EXPECT_NEAR(church.max.z, 40.0f, 1e-3f);
  EXPECT_NEAR(church.size().x, 40.0f, 0.1f) << "the nave is not left out";
  EXPECT_NEAR(church.min.z, 15.0f, 1e-3f);
  map.add_area({{6, 0}, {40, 0}, {40, 15}, {6, 15}}, {{"building:part", "yes"}, {"height", "9"}});
  EXPECT_NEAR(roofs(map).min.z, 9.0f, 1e-3f) << "now its parts cover it";
}

TEST(OsmBuildingRelations, AnOutlineThatIsItsOwnPartIsDrawnOnce) {
  TestMap map;
  map.add_area({{0, 0}, {20, 0}, {20, 10}, {0, 10}}, {{"building", "yes"}, {"height", "8"}});
  const TestTown once = read(map);
  TestMap twice;
  twice.add_area({{0, 0}, {20, 0}, {20, 10}, {0, 10}},
                 {{"building", "yes"}, {"building:part", "yes"}, {"height", "8"}});
  const TestTown as_part = read(twice);
  ASSERT_TRUE(once.model && as_part.model);
  EXPECT_EQ(as_part.model->triangle_count(), once.model->triangle_count());
}

TEST(OsmBuildingRelations, MissingMembersAndCirclesAreNoHarm) {
  TestMap map;
  map.add_area({{0, 0}, {20, 0}, {20, 10}, {0, 10}}, {{"building", "yes"}, {"height", "8"}});
  map.add_relation({{77, "outline"}, {1, "part"}, {78, "part"}}, {{"type", "building"}, {"building", "yes"}});
  map.add_relation({{1, "outline"}, {1, "part"}}, {{"type", "building"}});
  EXPECT_NEAR(roofs(map).max.z, 8.0f, 1e-3f);
}

}  // namespace
}  // namespace parvis::scene

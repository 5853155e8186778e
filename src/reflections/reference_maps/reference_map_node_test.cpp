#include "reflections/reference_maps/reference_map_node.h"

#include <gtest/gtest.h>

#include "reflections/reference_maps/scene_maps.h"
#include "reflections/reference_maps/settings.h"
#include "room_list.h"
#include "scene/script/test_registries.h"
#include "scene/script/test_script.h"

namespace parvis::reference_maps {
namespace {

class ReferenceMapNodeTest : public scene::ScriptTest<> {
 protected:
  ReferenceMapNodeTest() : ScriptTest(scene::test_registries()) { register_room(registries_); }
};

TEST_F(ReferenceMapNodeTest, PlacesAreTakenAsTheScriptGivesThem) {
  const auto loaded = load(
      "group(position=\"100 0 0\") { referenceMaps(position=\"1 2 1.2\", position=\"3 4 1.2, 5 6 1.2\", "
      "path=\"0 0 1, 25 0 1\", spacing=10, resolution=64, maps=7, cell=0.5, compressed=yes) }");
  ASSERT_TRUE(loaded) << to_string(loaded.errors());
  const ReferenceMapPlan& plan = map_plan(loaded->scene);
  ASSERT_EQ(plan.places.size(), 6u);
  EXPECT_EQ(plan.places[0], glm::vec3(101, 2, 1.2f));
  EXPECT_EQ(plan.places[2], glm::vec3(105, 6, 1.2f));
  EXPECT_LT(glm::distance(plan.places[5], glm::vec3(120, 0, 1)), 1e-4f);
  EXPECT_EQ(plan.resolution, 64);
  EXPECT_EQ(plan.max_maps, 7);
  EXPECT_EQ(plan.cell_m, 0.5f);
  EXPECT_TRUE(plan.is_compressed);
  EXPECT_EQ(map_places(loaded->scene, HeightPyramid(heights_of(loaded->scene))), plan.places);
}

TEST_F(ReferenceMapNodeTest, WithoutItMapsPlaceThemselves) {
  const auto loaded = load("road(path=\"-50 0, 50 0\")");
  ASSERT_TRUE(loaded) << to_string(loaded.errors());
  EXPECT_TRUE(map_plan(loaded->scene).places.empty());
  EXPECT_FALSE(map_plan(loaded->scene).is_compressed);
  EXPECT_EQ(map_places(loaded->scene, HeightPyramid(heights_of(loaded->scene))).size(), 1u)
      << "one at least, where there is nothing to be mirrored";
}

TEST_F(ReferenceMapNodeTest, BadInputIsRefusedWithItsLine) {
  EXPECT_NE(errors_of("\nreferenceMaps(path=\"0 0, 90000 0\", spacing=1)").find(":2:"), std::string::npos);
  EXPECT_NE(errors_of("referenceMaps(path=\"0 0, 90000 0\", spacing=1)").find("wider spacing"),
            std::string::npos);
  EXPECT_NE(errors_of("referenceMaps(postion=\"0 0 1\")").find("position"), std::string::npos);
  EXPECT_NE(errors_of("referenceMaps()\nreferenceMaps()").find("referenceMaps"), std::string::npos);
  EXPECT_NE(errors_of("referenceMaps(position=\"0 zero 1\")").find(":1:"), std::string::npos);
}

}  // namespace
}  // namespace parvis::reference_maps

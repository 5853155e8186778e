#include "reflections/reference_maps/scene_maps.h"

#include <gtest/gtest.h>

#include "reflections/reference_maps/settings.h"
#include "scene/data/test_scene.h"

namespace parvis::reference_maps {
namespace {

constexpr double max_bytes = 256.0 * 1024.0 * 1024.0;

double bytes_of(glm::vec2 size_m, float cell_m) {
  scene::Scene scene;
  const glm::vec3 half(0.5f * size_m, 0.0f);
  scene::add(scene, scene::model_of(scene::quad({-half.x, -half.y, 0}, {half.x, -half.y, 0},
                                                {half.x, half.y, 0}, {-half.x, half.y, 0}),
                                    scene::matt(glm::vec3(0.5f))));
  map_plan(scene).cell_m = cell_m;
  const HeightPyramid heights(heights_of(scene));
  const ImageF& finest = heights.levels().front();
  return double(finest.pixels.size() * sizeof(float));
}

TEST(Heights, CellsAreAsWideAsTheSceneWants) {
  for (const float cell_m : {0.25f, 1.0f, 2.5f}) {
    EXPECT_EQ(fitting_cell_m({1000.0f, 800.0f}, cell_m), cell_m);
    scene::Scene scene;
    scene::add(scene, scene::model_of(scene::ground(40.0f), scene::matt(glm::vec3(0.5f))));
    map_plan(scene).cell_m = cell_m;
    EXPECT_EQ(HeightPyramid(heights_of(scene)).cell_m(), cell_m);
  }
  EXPECT_EQ(fitting_cell_m({0.0f, 0.0f}, 1.0f), 1.0f);
}

TEST(Heights, APlaceThatWouldNotFitIntoMemoryGetsWiderCellsAndItIsReportedHowMuchItWouldTake) {
  testing::internal::CaptureStderr();
  EXPECT_LE(bytes_of({9000.0f, 5000.0f}, 0.5f), max_bytes);
  const std::string told = testing::internal::GetCapturedStderr();
  EXPECT_NE(told.find("9.0 x 5.0 km"), std::string::npos) << told;
  EXPECT_NE(told.find("would take 2147 MB"), std::string::npos) << told;  // 32768 x 16384 cells of four bytes
  EXPECT_NE(told.find("referenceMaps(cell="), std::string::npos) << told;
  // A long and narrow place is held by its length, a very large one by its area.
  EXPECT_NEAR(fitting_cell_m({40000.0f, 10.0f}, 1.0f), 40000.0f / 16384.0f, 0.05f);
  const float of_a_country_m = fitting_cell_m({300000.0f, 300000.0f}, 1.0f);
  EXPECT_NEAR(of_a_country_m, 300000.0f / 8192.0f, 0.02f * of_a_country_m);
}

}  // namespace
}  // namespace parvis::reference_maps

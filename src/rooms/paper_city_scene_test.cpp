#include <gtest/gtest.h>

#include "formats/gltf/test_validator.h"
#include "life/traffic/demand.h"
#include "places/paper_city/paper_city.h"
#include "places/paper_city/paper_script.h"
#include "rooms/rooms.h"
#include "stage/stage.h"

namespace parvis::rooms {
namespace {
namespace fs = std::filesystem;
using namespace city;

fs::path fresh_folder(const std::string& name) {
  const fs::path folder = fs::path(testing::TempDir()) / ("parvis_city_scene_" + name);
  fs::remove_all(folder);
  return folder;
}

TEST(PaperCity, IsASceneOfThePapersFigures) {
  const fs::path folder = fresh_folder("whole");
  const Status status = write_paper_city(folder, 1);
  ASSERT_TRUE(status) << to_string(status.errors());
  EXPECT_FALSE(fs::exists(folder / ".unfinished"));
  const auto loaded = scene::load_scene(folder / "paper.xp", node_registry());
  ASSERT_TRUE(loaded) << to_string(loaded.errors());
  const scene::Scene& scene = loaded->scene;
  EXPECT_EQ(scene.static_triangle_count(), city_triangles);
  EXPECT_EQ(scene.objects.size(), 9u);  // the city and eight trees
  EXPECT_EQ(scene.data<traffic::TrafficDemand>().vehicles, 30);
  EXPECT_GE(scene.data<traffic::TrafficDemand>().models.size(), 4u);
  EXPECT_FALSE(scene.roads.empty());
  EXPECT_NE(scene.find_camera("street"), nullptr);
  EXPECT_NE(scene.find_camera("balcony"), nullptr);
  EXPECT_NEAR(glm::dot(scene.sun.direction_to_sun, to_sun()), 1.0f, 1e-5f);
  scene::expect_valid_gltf(folder);
  const auto figures = scene::load_scene(folder / "figures.xp", node_registry());
  EXPECT_TRUE(figures) << to_string(figures.errors());
  fs::remove_all(folder);
}

}  // namespace
}  // namespace parvis::rooms

#include "capture/trees/visual_hull.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "capture/trees/test_volume.h"

namespace parvis::trees {
namespace {

TEST(VisualHull, TheBoxHoldsTheTreeAndLittleMore) {
  const TestVolume ball(27, 1.0f);
  const std::vector<TreeView> views = ball.ring(12, 64);
  const Result<Bounds> box = hull_box(views, silhouettes(views));
  ASSERT_TRUE(box.ok());
  for (int a = 0; a < 3; ++a) {
    EXPECT_LE(box->min[a], (a == 2 ? 0.5f : -0.5f) + 0.02f);
    EXPECT_GE(box->max[a], (a == 2 ? 1.5f : 0.5f) - 0.02f);
    EXPECT_LT(box->size()[a], 1.25f);
  }
}

TEST(VisualHull, NoCellOfTheTreeIsLost) {
  const TestVolume ball(27, 0.1f);
  const std::vector<TreeView> views = ball.ring(12, 64);
  const std::vector<Silhouette> masks = silhouettes(views);
  for (const auto& [branching, level] : {std::pair{3, 3}, std::pair{2, 5}}) {
    const Result<CellGrid> grid = hull_grid(views, masks, *hull_box(views, masks), {branching, level});
    ASSERT_TRUE(grid.ok());
    EXPECT_EQ(grid->side(), branching == 3 ? 27 : 32);
    for (std::size_t i = 0; i < ball.grid.size(); ++i) {
      const glm::vec3 place = (ball.grid.centre(i) - grid->box().min) / grid->cell_size_m();
      EXPECT_NE(grid->cell_at(glm::ivec3(glm::floor(place))), no_cell);
    }
    EXPECT_LT(grid->size(), std::size_t(grid->side() * grid->side() * grid->side()) * 8 / 10);
  }
}

TEST(VisualHull, RefusesWhatIsNoCapture) {
  const TestVolume ball(27, 0.3f);
  std::vector<TreeView> views = ball.ring(8, 64);
  const auto message = [](const auto& result) { return result ? std::string() : to_string(result.errors()); };

  const std::vector<TreeView> two(views.begin(), views.begin() + 2);
  EXPECT_NE(message(hull_box(two, silhouettes(two))).find("2 photographs"), std::string::npos);

  std::vector<TreeView> empty = views;
  std::ranges::fill(empty[3].picture.pixels, std::uint8_t(0));
  EXPECT_NE(message(hull_box(empty, silhouettes(empty))).find("view 3: the matte is empty"),
            std::string::npos);

  const std::vector<Silhouette> masks = silhouettes(views);
  const Bounds box = *hull_box(views, masks);
  views[5].camera.position_in_world = box.centre();
  EXPECT_NE(message(hull_grid(views, masks, box, {3, 3})).find("view 5: the camera is inside"),
            std::string::npos);
  EXPECT_NE(message(hull_grid(ball.ring(8, 64), masks, box, {3, 7})).find("2187"), std::string::npos);
}

TEST(VisualHull, NamesTheOneWrongCameraAmongTwenty) {
  const TestVolume ball(27, 0.05f);
  std::vector<TreeView> views = ball.ring(20, 56);
  EXPECT_TRUE(inconsistent_views(views, silhouettes(views)).empty());
  views[7].camera.position_in_world += glm::vec3(0.5f, 0.2f, 0.4f);
  EXPECT_EQ(inconsistent_views(views, silhouettes(views)), std::vector<std::size_t>{7});
}

}  // namespace
}  // namespace parvis::trees

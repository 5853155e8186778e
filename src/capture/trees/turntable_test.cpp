#include "capture/trees/turntable.h"

#include <gtest/gtest.h>

#include <cmath>

#include "capture/trees/test_volume.h"

namespace parvis::trees {
namespace {

constexpr glm::ivec2 size(160, 200);

Turntable true_turntable() { return {500.0f, 4.0f, 0.14f, 0.02f, 7.0f, 6.2831853f / 16.0f}; }

/// A few opaque blocks on the turntable, photographed.
std::vector<Image8> photographs(const Turntable& turntable) {
  std::vector<glm::u16vec3> cells;
  Random random(5);
  for (int i = 0; i < 40; ++i) cells.emplace_back(random.index(27), random.index(27), random.index(27));
  std::ranges::sort(cells, {}, [](glm::u16vec3 c) { return c.x + 27 * (c.y + 27 * c.z); });
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  const CellGrid grid({{-0.3f, -0.3f, -0.4f}, {0.3f, 0.3f, 0.6f}}, 3, 27, cells);
  const std::vector<float> opaque(grid.size(), 1e4f);
  std::vector<Image8> pictures;
  for (const Pinhole& camera : turntable_cameras(turntable, 16, size)) {
    Image8& picture = pictures.emplace_back(size.x, size.y, 4, 128);
    const ImageF alpha = render_alpha(grid, opaque, camera);
    for (std::size_t i = 0; i < alpha.pixels.size(); ++i)
      picture.pixels[4 * i + 3] = alpha.pixels[i] > 0.5f ? 255 : 0;
  }
  return pictures;
}

TEST(Turntable, ItsCamerasGoRoundTheAxisTheOtherWay) {
  const Turntable turntable = true_turntable();
  const std::vector<Pinhole> cameras = turntable_cameras(turntable, 16, size);
  for (const Pinhole& camera : cameras) {
    const glm::vec3 origin = camera.project(glm::vec3(0.0f));
    EXPECT_NEAR(origin.x, 0.5f * float(size.x) + turntable.axis_px, 1e-2f);
    EXPECT_NEAR(origin.y, 0.5f * float(size.y), 1e-2f);
    EXPECT_NEAR(origin.z, turntable.distance_m, 1e-3f);
  }
  // A point before the camera moves to the right as the plant turns counter-clockwise.
  const glm::vec3 front(0.0f, -0.2f, 0.0f);
  EXPECT_GT(cameras[1].project(front).x, cameras[0].project(front).x);
  const glm::mat2 turned(std::cos(turntable.step), std::sin(turntable.step), -std::sin(turntable.step),
                         std::cos(turntable.step));
  const glm::vec2 after = turned * glm::vec2(front);
  EXPECT_NEAR(cameras[1].project(front).x, cameras[0].project({after.x, after.y, 0.0f}).x, 1e-2f);
}

TEST(Turntable, IsFoundInTheSilhouettes) {
  const Turntable truth = true_turntable();
  Turntable start;
  start.focal_px = truth.focal_px, start.distance_m = truth.distance_m;
  start.step = -truth.step;  // the other direction
  const Result<FoundTurntable> found = found_turntable(photographs(truth), start);
  ASSERT_TRUE(found) << to_string(found.errors());
  EXPECT_GT(found->explained_share, 0.8);  // a silhouette's outermost pixels are partly covered
  EXPECT_NEAR(found->turntable.step, truth.step, 1e-6f);
  EXPECT_NEAR(found->turntable.elevation, truth.elevation, 0.02f);
  EXPECT_NEAR(found->turntable.roll, truth.roll, 0.01f);
  EXPECT_NEAR(found->turntable.axis_px, truth.axis_px, 1.5f);
}

TEST(Turntable, RefusesWhatIsNone) {
  const std::vector<Image8> pictures = photographs(true_turntable());
  EXPECT_FALSE(found_turntable(std::span(pictures).first(2), true_turntable()));
  EXPECT_FALSE(found_turntable(pictures, {}));
  std::vector<Image8> empty = pictures;
  std::ranges::fill(empty[4].pixels, std::uint8_t(0));
  const Result<FoundTurntable> none = found_turntable(empty, true_turntable());
  ASSERT_FALSE(none);
  EXPECT_NE(to_string(none.errors()).find("photograph 5"), std::string::npos) << to_string(none.errors());
}

}  // namespace
}  // namespace parvis::trees

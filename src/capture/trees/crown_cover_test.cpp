// What billboards hide: whole and in part, from front to back.
#include "capture/trees/crown_cover.h"

#include <gtest/gtest.h>

#include <array>

namespace parvis::trees {
namespace {

/// A view to the north of 128x128 pixels, 90 degrees, and squares that face it.
class CrownCoverTest : public testing::Test {
 protected:
  CrownCoverTest() {
    Camera camera;
    camera.world_from_camera = look_at({0, 0, 0}, {0, 1, 0});
    camera.vertical_fov = 1.5707963f;
    view_ = render::camera_view(camera, 0, 128, 128);
  }
  static CoveringBillboard square(float distance_m, float half_m, float x = 0.0f) {
    return {{x, distance_m, 0}, {half_m, 0, 0}, {0, 0, half_m}, glm::vec4(0.0f)};
  }
  static OpacityMask mask_of(const std::array<std::uint8_t, 4>& opacities) { return {2, opacities}; }

  render::View view_;
  CrownCover cover_;
};

TEST_F(CrownCoverTest, AnOpaqueBillboardHidesWhatIsBehindIt) {
  cover_.begin(view_, 0.01f);
  EXPECT_TRUE(cover_.visible_part(square(20, 2)));
  cover_.add(square(10, 4), mask_of({255, 255, 255, 255}), glm::vec2(1));
  EXPECT_FALSE(cover_.visible_part(square(20, 2)));
  EXPECT_TRUE(cover_.visible_part(square(20, 2, 12))) << "beside it";
  EXPECT_TRUE(cover_.visible_part(square(20, 10))) << "larger than it";
  EXPECT_TRUE(cover_.visible_part(square(-20, 2))) << "behind the eye nothing is known";
}

TEST_F(CrownCoverTest, HalfOpaqueOnesHideTogether) {
  cover_.begin(view_, 0.01f);
  int layers = 0;
  for (; layers < 20 && cover_.visible_part(square(20, 2)); ++layers)
    cover_.add(square(10, 4), mask_of({128, 128, 128, 128}), glm::vec2(1));
  EXPECT_EQ(layers, 7) << "0.5^7 < 0.01";
}

TEST_F(CrownCoverTest, TheVisiblePartIsWhatIsNotCovered) {
  cover_.begin(view_, 0.01f);
  cover_.add(square(10, 4), mask_of({255, 0, 255, 0}), glm::vec2(1));  // its left half
  const std::optional<glm::vec4> part = cover_.visible_part(square(20, 6));
  ASSERT_TRUE(part);
  EXPECT_LE(part->x, 0.01f);
  EXPECT_GE(part->x, -0.5f) << "two squares of 4 pixels, of 19 in half a billboard";
  EXPECT_GE(part->z, 1.0f);
  EXPECT_LE(part->y, -1.0f);
  EXPECT_GE(part->w, 1.0f);
}

TEST_F(CrownCoverTest, DepthHidesWhatIsBehind) {
  const auto depth_at = [&](float distance_m) {
    const glm::vec4 clip = view_.clip_from_world * glm::vec4(0.0f, distance_m, 0.0f, 1.0f);
    return 0.5f - 0.5f * clip.z / clip.w;
  };
  const auto hiding_at = [&](int x, int y) { return cover_.hiding_depths()[std::size_t(32 * y + x)]; };
  cover_.begin(view_, 0.01f);
  cover_.add(square(10, 4), mask_of({255, 255, 255, 255}), glm::vec2(1));  // 6.4 squares to each side
  ASSERT_EQ(cover_.squares(), glm::ivec2(32));
  EXPECT_EQ(cover_.touched(), glm::ivec4(9, 9, 23, 23));
  EXPECT_LT(hiding_at(16, 16), depth_at(10)) << "the billboard itself";
  EXPECT_GT(hiding_at(16, 16), depth_at(20));
  EXPECT_GT(hiding_at(20, 16), depth_at(20));
  EXPECT_EQ(hiding_at(21, 16), 0.0f) << "its neighbour is open";
  EXPECT_EQ(hiding_at(31, 31), 0.0f);
  // Of several that hide together the farthest counts; what is added behind them does not.
  cover_.begin(view_, 0.01f);
  for (int i = 0; i < 6; ++i)
    cover_.add(square(10 + float(i), 8), mask_of({128, 128, 128, 128}), glm::vec2(1));
  EXPECT_EQ(hiding_at(16, 16), 0.0f) << "0.5^6 > 0.01";
  cover_.add(square(20, 8), mask_of({128, 128, 128, 128}), glm::vec2(1));
  const float hiding = hiding_at(16, 16);
  EXPECT_LT(hiding, depth_at(20));
  EXPECT_GT(hiding, depth_at(40));
  cover_.add(square(60, 30), mask_of({128, 128, 128, 128}), glm::vec2(1));
  EXPECT_EQ(hiding_at(16, 16), hiding);
}

TEST_F(CrownCoverTest, FramesShareTheMemoryOfDepths) {
  cover_.begin(view_, 0.01f);
  cover_.add(square(10, 4), mask_of({255, 255, 255, 255}), glm::vec2(1));
  const std::span<const float> first = cover_.hiding_depths();
  const float* const memory = first.data();
  EXPECT_GT(first[32 * 16 + 16], 0.0f);
  cover_.begin(view_, 0.01f);
  const std::span<const float> second = cover_.hiding_depths();
  EXPECT_EQ(second.data(), memory);
  EXPECT_EQ(second.size(), std::size_t(32 * 32));
  EXPECT_EQ(second[32 * 16 + 16], 0.0f) << "nothing of the frame before is left";
}

TEST_F(CrownCoverTest, NothingIsHiddenWhereAllIsDrawn) {
  cover_.begin(view_, 0.0f);
  cover_.add(square(10, 4), mask_of({255, 255, 255, 255}), glm::vec2(1));
  EXPECT_TRUE(cover_.visible_part(square(20, 2)));
}

}  // namespace
}  // namespace parvis::trees

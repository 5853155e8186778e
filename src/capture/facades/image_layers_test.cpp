#include "capture/facades/image_layers.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "capture/facades/test_model.h"

namespace parvis::facades {
namespace {

TEST(ImageLayers, BoxesAreMergedWhereThatSavesTexture) {
  // Equation 3.1 with power-of-two sides: 48 and 16 pixels side by side fill one texture of 64.
  EXPECT_EQ(merged_boxes({{0, 0, 48, 64}, {48, 0, 16, 64}}, 1),
            (std::vector<std::vector<std::uint32_t>>{{0, 1}}));
  // Two that together need just as much stay apart: the inequality is strict.
  EXPECT_EQ(merged_boxes({{0, 0, 64, 64}, {64, 0, 64, 64}}, 1).size(), 2u);
  // Far apart in one visibility layer (figure 3.8): never one box.
  EXPECT_EQ(merged_boxes({{0, 0, 40, 40}, {900, 700, 40, 40}}, 1).size(), 2u);
  // Merging goes on with what was merged.
  EXPECT_EQ(merged_boxes({{0, 0, 40, 100}, {40, 0, 20, 100}, {0, 100, 64, 20}}, 1).size(), 1u);
}

TEST(ImageLayers, NoPairIsLeftThatWouldSaveTexture) {
  Random random(3);
  std::vector<PixelBox> boxes;
  for (int i = 0; i < 200; ++i)
    boxes.push_back({int(random.uniform(0, 1000)), int(random.uniform(0, 700)),
                     1 + int(random.uniform(0, 90)), 1 + int(random.uniform(0, 90))});
  const auto groups = merged_boxes(boxes, 1);
  std::vector<PixelBox> merged;
  std::size_t members = 0;
  for (const auto& group : groups) {
    PixelBox box = boxes[group[0]];
    for (const std::uint32_t i : group) box = united(box, boxes[i]);
    merged.push_back(box), members += group.size();
  }
  EXPECT_EQ(members, boxes.size());
  EXPECT_LT(groups.size(), boxes.size());
  for (std::size_t i = 0; i < merged.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      EXPECT_GE(texture_area(united(merged[i], merged[k]), 1),
                texture_area(merged[i], 1) + texture_area(merged[k], 1));
}

// The slip of 3.6.1: the thesis prints w and w_i in the rows for y.
TEST(ImageLayers, TheShearedFrustumUsesTheHeightForY) {
  const Frustum whole{-1.2, 1.4, -0.9, 0.7};
  const PixelBox box{200, 300, 256, 64};
  const Frustum f = sheared(whole, box, 1000, 800);
  EXPECT_NEAR(f.x_min, -1.2 + 200 * 2.6 / 1000, 1e-12);
  EXPECT_NEAR(f.x_max, -1.2 + 456 * 2.6 / 1000, 1e-12);
  EXPECT_NEAR(f.y_max, 0.7 - 300 * 1.6 / 800, 1e-12);
  EXPECT_NEAR(f.y_min, 0.7 - 364 * 1.6 / 800, 1e-12);
  const Frustum all = sheared(whole, {0, 0, 1000, 800}, 1000, 800);
  EXPECT_NEAR(all.y_min, whole.y_min, 1e-12);
  EXPECT_NEAR(all.x_max, whole.x_max, 1e-12);
}

TEST(ImageLayers, ATextureMatrixFindsThePhotographsOwnPixels) {
  View view = test_view(640, 400, {1, 2, 3});
  view.cx = 301.5, view.cy = 222.25, view.fy = 350;
  const PixelBox box{96, 40, 128, 32};
  const glm::dmat4 matrix = texture_from_world(view, box);
  Random random(5);
  for (int i = 0; i < 100; ++i) {
    const glm::dvec2 pixel(random.uniform(0, 640), random.uniform(0, 400));
    const double depth = random.uniform(1, 30);
    const glm::dvec4 p = matrix * glm::dvec4(view.to_world(pixel, depth), 1.0);
    EXPECT_NEAR(p.x / p.w * box.width + box.x, pixel.x, 1e-9);
    EXPECT_NEAR(p.y / p.w * box.height + box.y, pixel.y, 1e-9);
    EXPECT_NEAR(p.w, depth, 1e-9);
    EXPECT_NEAR(p.z, depth, 1e-9);
  }
}

TEST(ImageLayers, MasksSayWhatIsCoveredAndWhatIsSeen) {
  LayerModel model = model_of({wall("far", 8, -4, 4, -4, 4), wall("near", 4, -1, 1, -1, 1)});
  const View view = test_view(128, 128);
  const VisibilityLayers visibility = visibility_layers(model, view, "test");
  const LayeredView layered = image_layers(model, view, visibility);
  ASSERT_EQ(layered.layers.size(), 2u);
  EXPECT_EQ(layered.layers[0].name, "L00-000 near");
  EXPECT_EQ(layered.layers[0].box, (PixelBox{48, 48, 32, 32}));
  EXPECT_EQ(layered.layers[1].name, "L01-000 far");
  EXPECT_EQ(layered.layers[1].box, (PixelBox{32, 32, 64, 64}));
  int covered = 0, seen = 0;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      covered += layered.masks[1].at(x, y)[0] == 255, seen += layered.masks[1].at(x, y)[1] == 255;
      EXPECT_EQ(layered.masks[1].at(x, y)[1] == 0, (PixelBox{16, 16, 32, 32}).contains(x, y));
    }
  EXPECT_EQ(covered, 64 * 64);
  EXPECT_EQ(seen, 64 * 64 - 32 * 32);
}

TEST(ImageLayers, DistantObjectsOfOneVisibilityLayerAreLayersOfTheirOwn) {
  LayerModel model = model_of({wall("left", 4, -3.5f, -2.5f, -1, 1), wall("right", 4, 2.5f, 3.5f, -1, 1)});
  const VisibilityLayers visibility = visibility_layers(model, test_view(512, 512), "test");
  ASSERT_EQ(visibility.layers.size(), 1u);
  EXPECT_EQ(image_layers(model, test_view(512, 512), visibility).layers.size(), 2u);
}

}  // namespace
}  // namespace parvis::facades

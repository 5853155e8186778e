#include "capture/facades/fill.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/colour.h"
#include "capture/facades/plane_patch.h"
#include "capture/facades/test_model.h"

namespace parvis::facades {
namespace {

/// A facade with windows every 1.5 m, sharp: what smooth filling cannot know. sRGB.
glm::vec3 facade(glm::dvec3 p) {
  const double u = p.x - 1.5 * std::floor(p.x / 1.5), v = p.z - 2.0 * std::floor(p.z / 2.0);
  const bool is_window = u > 0.4 && u < 1.0 && v > 0.5 && v < 1.5;
  return is_window ? glm::vec3(0.2f, 0.25f, 0.35f) : glm::vec3(0.8f, 0.7f, 0.5f);
}

struct Scene {
  LayerModel model = model_of({wall("facade", 8, -7, 7, -5, 5), wall("tree", 5, -0.6f, 0.9f, -1.2f, 1.1f)});
  std::vector<View> views;
  std::vector<PreparedPhoto> photos;
  VisibilityLayers visibility;
  LayeredView layered;
  LayerPixels pixels;

  explicit Scene(const std::vector<double>& xs) {
    for (const double x : xs) {
      const View view = test_view(240, 180, {x, 0, 0});
      views.push_back(view);
      PreparedPhoto photo{"test", view, ImageF(240, 180, 3), item_buffer(model, view).depths, {}};
      for (int y = 0; y < 180; ++y)
        for (int px = 0; px < 240; ++px) {
          const double depth = photo.depths[std::size_t(y * 240 + px)];
          const glm::vec3 srgb =
              depth < 6 ? glm::vec3(0.1f, 0.4f, 0.1f) : facade(view.to_world({px + 0.5, y + 0.5}, depth));
          const glm::vec3 linear = linear_from_srgb(srgb);
          for (int c = 0; c < 3; ++c) photo.colours.at(px, y)[c] = linear[c];
        }
      photos.push_back(std::move(photo));
    }
    visibility = visibility_layers(model, views[0], "test");
    layered = image_layers(model, views[0], visibility);
    ImageF rgba(240, 180, 4, 1.0f);
    for (std::size_t i = 0; i < photos[0].colours.pixels.size(); ++i)
      rgba.pixels[i / 3 * 4 + i % 3] = photos[0].colours.pixels[i];
    pixels = original_pixels(srgb8_from_linear(rgba), layered);
  }
  LayersOfModel layers() const { return {model, views[0], visibility, layered}; }

  /// PSNR of the facade's hidden pixels against the truth.
  double hidden_psnr(const Filled& filled) const {
    const std::size_t l = 1;
    const PixelBox& box = layered.layers[l].box;
    double squared = 0.0, count = 0.0;
    for (int y = 0; y < box.height; ++y)
      for (int x = 0; x < box.width; ++x) {
        if (!layered.masks[l].at(x, y)[0] || layered.masks[l].at(x, y)[1]) continue;
        const glm::vec3 truth = 255.0f * facade(views[0].to_world({x + box.x + 0.5, y + box.y + 0.5}, 8.0));
        for (int c = 0; c < 3; ++c)
          squared += std::pow(double(filled.pixels[l].at(x, y)[c]) - double(truth[c]), 2.0), ++count;
      }
    EXPECT_GT(count, 1000);
    return 10.0 * std::log10(255.0 * 255.0 * count / squared);
  }
};

TEST(Fill, OtherPhotographsShowWhatOneHides) {
  const Scene scene({0.0, 2.5, -2.5});
  const Filled filled = filled_layers(scene.layers(), scene.photos, 0, scene.pixels);
  const Filled smooth = filled_layers(scene.layers(), scene.photos, 0, scene.pixels, {false, false, 1});
  EXPECT_GT(scene.hidden_psnr(filled), scene.hidden_psnr(smooth) + 6.0);
  EXPECT_EQ(filled.states[1], Filling::proposal);
  EXPECT_EQ(filled.states[0], Filling::none) << "nothing of the tree is hidden";
  EXPECT_GT(std::ranges::count(filled.sources[1].pixels, std::uint8_t(FillSource::photographs)), 1000);
}

TEST(Fill, AloneAPhotographRepeatsItsFacade) {
  const Scene scene({0.0});
  const Filled filled = filled_layers(scene.layers(), scene.photos, 0, scene.pixels);
  const Filled smooth = filled_layers(scene.layers(), scene.photos, 0, scene.pixels, {false, false, 1});
  EXPECT_GT(scene.hidden_psnr(filled), scene.hidden_psnr(smooth) + 3.0);
  EXPECT_GT(std::ranges::count(filled.sources[1].pixels, std::uint8_t(FillSource::patches)), 1000);
}

TEST(Fill, EveryCoveredPixelHasAColourAndSeenOnesKeepTheirs) {
  const Scene scene({0.0, 2.0});
  const Filled filled = filled_layers(scene.layers(), scene.photos, 0, scene.pixels);
  for (std::size_t l = 0; l < filled.pixels.size(); ++l)
    for (int y = 0; y < filled.pixels[l].height; ++y)
      for (int x = 0; x < filled.pixels[l].width; ++x) {
        const bool is_covered = scene.layered.masks[l].at(x, y)[0];
        EXPECT_EQ(*filled.sources[l].at(x, y) != std::uint8_t(FillSource::none), is_covered);
        if (*filled.sources[l].at(x, y) == std::uint8_t(FillSource::seen)) {
          EXPECT_TRUE(
              std::equal(filled.pixels[l].at(x, y), filled.pixels[l].at(x, y) + 4, scene.pixels[l].at(x, y)));
        }
      }
}

TEST(Fill, ARefusedProposalLeavesTheLayerAsItWas) {
  const Scene scene({0.0, 2.0});
  Filled filled = filled_layers(scene.layers(), scene.photos, 0, scene.pixels);
  EXPECT_NE(chosen_pixels(filled, scene.pixels)[1].pixels, scene.pixels[1].pixels);
  filled.states[1] = Filling::refused;
  EXPECT_EQ(chosen_pixels(filled, scene.pixels)[1].pixels, scene.pixels[1].pixels);
}

TEST(PlanePatch, AHoleInAPeriodicPatternIsFilledExactly) {
  PlaneGrid grid(90, 60);
  const auto value = [](int x, int y) {
    return glm::vec3(x % 15 < 7 ? 0.8f : 0.3f, y % 12 < 5 ? 0.6f : 0.2f, 0.5f);
  };
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 90; ++x) {
      const bool is_hole = x >= 35 && x < 55 && y >= 20 && y < 40;
      grid.is_missing[grid.index(x, y)] = is_hole, grid.is_known[grid.index(x, y)] = !is_hole;
      if (!is_hole) grid.colours[grid.index(x, y)] = value(x, y);
    }
  const std::vector<char> filled = fill_by_shifts(grid);
  EXPECT_EQ(std::ranges::count(filled, 1), 400);
  for (int y = 20; y < 40; ++y)
    for (int x = 35; x < 55; ++x)
      EXPECT_LT(glm::distance(grid.colours[grid.index(x, y)], value(x, y)), 1e-4f);
}

TEST(PlanePatch, ALinearRampIsContinuedSmoothlyAndNothingKnownFillsNothing) {
  PlaneGrid grid(40, 30);
  for (int y = 0; y < 30; ++y)
    for (int x = 0; x < 40; ++x) {
      const bool is_hole = x >= 10 && x < 30 && y >= 8 && y < 22;
      grid.is_missing[grid.index(x, y)] = is_hole, grid.is_known[grid.index(x, y)] = !is_hole;
      if (!is_hole) grid.colours[grid.index(x, y)] = glm::vec3(0.01f * float(x) + 0.005f * float(y));
    }
  PlaneGrid empty(5, 5);
  std::ranges::fill(empty.is_missing, 1);
  (void)fill_smoothly(grid);
  for (int y = 8; y < 22; ++y)
    for (int x = 10; x < 30; ++x)
      EXPECT_NEAR(grid.colours[grid.index(x, y)].x, 0.01f * float(x) + 0.005f * float(y), 1e-3f);
  EXPECT_EQ(std::ranges::count(fill_smoothly(empty), 1), 0);
  EXPECT_EQ(std::ranges::count(fill_by_shifts(empty), 1), 0);
}

}  // namespace
}  // namespace parvis::facades

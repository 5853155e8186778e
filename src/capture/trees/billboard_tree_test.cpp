#include "capture/trees/billboard_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "capture/trees/billboard_math.h"
#include "capture/trees/billboard_textures.h"
#include "capture/trees/judge.h"
#include "capture/trees/test_volume.h"

namespace parvis::trees {
namespace {

/// The sparse ball with a colour that changes from cell to cell.
TreeVolume coloured_ball(int side = 9) {
  const TestVolume ball(side, 0.4f, 20.0f);
  TreeVolume volume{ball.grid, ball.extinction_per_m, {}};
  Random random(5);
  for (std::size_t i = 0; i < volume.grid.size(); ++i)
    volume.colour.emplace_back(random.uniform(0.2f, 0.9f), random.uniform(0.2f, 0.9f),
                               random.uniform(0.1f, 0.5f));
  return volume;
}

/// Photographs of a volume, as 8-bit RGBA.
std::vector<TreeView> photographs_of(const TreeVolume& volume, int count, int size, float first = 0.0f) {
  std::vector<TreeView> views = TestVolume(3).ring(count, size, first);
  for (TreeView& view : views) view.picture = photograph_of(render_volume(volume, view.camera));
  return views;
}

double mean_psnr(const BillboardTree& tree, const std::vector<TreeView>& views) {
  double sum = 0.0;
  for (const TreeView& view : views) sum += judged(render_billboards(tree, view.camera), view)->psnr_db;
  return sum / double(views.size());
}

TEST(Billboards, AreOrderedAsRaysPassTheirCells) {
  const TestVolume ball(9, 0.5f);
  Random random(4);
  for (const TreeView& view : ball.ring(5, 32)) {
    const std::vector<PlacedBillboard> placed = placed_billboards(ball.grid, view.camera, false);
    std::vector<std::size_t> rank(ball.grid.size(), 0);
    for (std::size_t i = 0; i < placed.size(); ++i) rank[placed[i].cell] = i;
    for (int i = 0; i < 400; ++i) {
      std::vector<std::size_t> ranks;
      ball.grid.walk(view.camera.ray({random.uniform(0.0f, 32.0f), random.uniform(0.0f, 32.0f)}),
                     [&](std::size_t cell, float enter, float leave) {
                       if (leave - enter > 1e-5f) ranks.push_back(rank[cell]);
                       return true;
                     });
      EXPECT_TRUE(std::ranges::is_sorted(ranks));
    }
  }
}

TEST(Billboards, CoverTheirCells) {
  const TestVolume ball(9, 0.2f);
  const TreeView view = ball.view(0.7f, 1.6f, 64);
  for (const PlacedBillboard& b : placed_billboards(ball.grid, view.camera, true)) {
    const Bounds box = ball.grid.bounds(b.cell);
    for (int corner = 0; corner < 8; ++corner) {
      const glm::vec3 seen =
          view.camera.project({corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                               corner & 4 ? box.max.z : box.min.z});
      const glm::vec2 metres = b.metres_from_pixels * (glm::vec2(seen) - b.middle);
      EXPECT_LE(std::abs(metres.x), 1.03f * b.half_size_m.x);
      EXPECT_LE(std::abs(metres.y), 1.03f * b.half_size_m.y);
    }
  }
}

TEST(Billboards, TheTwoClosestCamerasFadeWithoutAJump) {
  EXPECT_NEAR(display::two_closest_weights({0.0f, 0.3f, 0.4f}).x, 1.0f, 1e-4f);
  EXPECT_NEAR(display::two_closest_weights({0.2f, 0.2f, 0.4f}).x, 0.5f, 1e-6f);
  EXPECT_NEAR(display::two_closest_weights({0.2f, 0.4f, 0.4f}).y, 0.0f, 1e-6f);  // as the third takes over
  EXPECT_NEAR(display::two_closest_weights({0.0f, 0.0f, 0.0f}).x, 0.5f, 1e-6f);
  BillboardTree tree;
  tree.grid = TestVolume(3).grid;
  for (const TreeView& view : TestVolume(3).ring(6, 8)) tree.views.push_back({view.camera, {}, {}});
  std::array<float, 6> last{};
  for (int i = 0; i <= 720; ++i) {
    const TreeView view = TestVolume(3).view(6.2831853f * float(i) / 720.0f, 1.3f, 8);
    const ClosestViews closest =
        closest_views(tree, {0.0f, 0.0f, 1.0f},
                      glm::normalize(view.camera.position_in_world - glm::vec3(0.0f, 0.0f, 1.0f)));
    std::array<float, 6> weights{};
    for (std::size_t v = 0; v < 2; ++v) weights[std::size_t(closest.views[v])] += closest.weights[v];
    for (std::size_t v = 0; i > 0 && v < 6; ++v) {
      EXPECT_NEAR(weights[v], last[v], 0.05f) << "step " << i;
    }
    last = weights;
  }
}

TEST(BillboardTextures, OptimisedShowTheirPhotographsAndPredictOthers) {
  const TreeVolume volume = coloured_ball();
  const std::vector<TreeView> views = photographs_of(volume, 12, 48),
                              others = photographs_of(volume, 4, 48, 0.2f);
  TextureOptions options;
  options.parent_levels = 0, options.texels_per_side = 8;
  const BillboardTree optimised = textured(volume, views, options);
  options.iterations = 0;
  const BillboardTree start = textured(volume, views, options);
  EXPECT_GT(mean_psnr(optimised, views), 32.0);
  EXPECT_GT(mean_psnr(optimised, views), mean_psnr(start, views) + 1.0);
  options.method = TextureMethod::age_importance;
  const double thesis = mean_psnr(textured(volume, views, options), others);
  options.method = TextureMethod::naive;
  const double naive = mean_psnr(textured(volume, views, options), others);
  EXPECT_GT(mean_psnr(optimised, others), thesis + 1.0);
  EXPECT_GT(mean_psnr(optimised, others), naive + 1.0);
}

TEST(BillboardTextures, ACellThatAPhotographSeesToBeEmptyShowsNothingThere) {
  // The volume has cells all round the ball, which the hull could not exclude; photographs show the ball
  // alone.
  const TreeVolume ball = coloured_ball();
  std::vector<TreeView> views = photographs_of(ball, 8, 64);
  TreeVolume hull{CellGrid({{-1, -1, 0}, {1, 1, 2}}, 3, 9, {}), {}, {}};
  std::vector<glm::u16vec3> cells;
  for (int i = 0; i < 729; ++i) cells.emplace_back(i % 9, i / 9 % 9, i / 81);
  hull.grid = CellGrid(hull.grid.box(), 3, 9, std::move(cells));
  hull.extinction_per_m.assign(729, 0.5f), hull.colour.assign(729, glm::vec3(0.5f));
  TextureOptions options;
  options.parent_levels = 0, options.texels_per_side = 8;
  BillboardTree tree = textured(hull, views, options);
  const auto haze = [&] {
    const ImageF picture = render_billboards(tree, views[3].camera);
    double sum = 0.0, count = 0.0;
    for (std::size_t i = 3; i < picture.pixels.size(); i += 4)
      if (views[3].picture.pixels[i] == 0) sum += double(picture.pixels[i]), count += 1.0;
    return sum / count;
  };
  const double with_textures = haze();
  // The control: the photograph's textures are dropped where they show nothing, so that the cell's own
  // opacity stands in.
  for (BillboardTextures& view : tree.views)
    for (std::int32_t& texture : view.texture_of_cell) {
      if (texture < 0) continue;
      int opacity = 0;
      for (std::size_t k = 0; k < 64; ++k)
        opacity = std::max(opacity, int(view.texels[4 * (std::size_t(texture) * 64 + k) + 3]));
      if (opacity < 8) texture = -1;
    }
  EXPECT_LT(with_textures, 0.02);
  EXPECT_GT(haze(), 4.0 * with_textures);
}

TEST(Billboards, ACellIsShownByPhotographsThatSeeIt) {
  BillboardTree tree;
  tree.grid = CellGrid({{-0.1f, -0.1f, 0.9f}, {0.1f, 0.1f, 1.1f}}, 3, 1, {glm::u16vec3(0)});
  for (const TreeView& view : TestVolume(3).ring(8, 16)) tree.views.push_back({view.camera, {0}, {}});
  const glm::vec3 at(0, 0, 1), to_eye = glm::normalize(tree.views[2].camera.position_in_world - at);
  EXPECT_EQ(closest_views(tree, at, to_eye, 0).views[0], 2);
  EXPECT_NEAR(closest_views(tree, at, to_eye, 0).weights[0], 1.0f, 1e-3f);
  tree.views[2].texture_of_cell[0] = -1;
  const ClosestViews others = closest_views(tree, at, to_eye, 0);
  EXPECT_NE(others.views[0], 2);
  EXPECT_NE(others.views[1], 2);
  EXPECT_NEAR(others.weights[0] + others.weights[1], 1.0f, 1e-5f);
  EXPECT_EQ(closest_views(tree, at, to_eye).views[0], 2) << "without a cell all of them count";
  for (BillboardTextures& view : tree.views) view.texture_of_cell[0] = -1;
  EXPECT_EQ(closest_views(tree, at, to_eye, 0).views[0], 2) << "none sees it: its own colour stands in";
}

TEST(BillboardTextures, AgeAndImportanceSelectTheFloorOfAlphaTimesTexels) {
  const TreeVolume volume = coloured_ball();
  const std::vector<TreeView> views = photographs_of(volume, 4, 64);
  TextureOptions options;
  options.parent_levels = 0, options.texels_per_side = 4, options.method = TextureMethod::age_importance;
  BillboardTree tree = textured(volume, views, options);
  // Within the ball's silhouette every selected texel keeps the photograph's alpha, the others have none.
  const BillboardTextures& view = tree.views[0];
  for (std::size_t cell = 0; cell < tree.grid.size(); ++cell) {
    const std::int32_t texture = view.texture_of_cell[cell];
    ASSERT_GE(texture, 0);
    int shown = 0;
    for (std::size_t k = 0; k < 16; ++k) shown += view.texels[4 * (16 * std::size_t(texture) + k) + 3] > 0;
    EXPECT_LE(shown, int(std::floor(volume.alpha(cell) * 16.0f + 0.05f)));
  }
}

TEST(BillboardTextures, CoarserBillboardsStandForFinerCells) {
  const TreeVolume volume = coloured_ball(27);
  const std::vector<TreeView> views = photographs_of(volume, 8, 48);
  TextureOptions options;
  options.parent_levels = 1;
  const BillboardTree tree = textured(volume, views, options);
  EXPECT_EQ(tree.grid.side(), 9);
  EXPECT_LT(tree.grid.size(), volume.grid.size());
  EXPECT_GT(mean_psnr(tree, views), 22.0);
}

TEST(Textures, AreAsFineAsThePhotographs) {
  const TreeVolume volume = coloured_ball();
  TextureOptions options;
  options.parent_levels = 0, options.iterations = 1;
  const auto side_at = [&](int size) {
    return textured(volume, photographs_of(volume, 4, size), options).texels_per_side;
  };
  // A cell of 0.11 m at 4 m before a lens of 0.3 rad is an 11th of the picture wide, its billboard an 8th.
  EXPECT_EQ(side_at(32), 4);
  EXPECT_EQ(side_at(64), 8);
  EXPECT_EQ(side_at(400), 16) << "no finer than this";
  const BillboardTree fine = textured(volume, photographs_of(volume, 4, 64), options);
  std::size_t bytes = 0;
  for (const BillboardTextures& view : fine.views) bytes += view.texels.size() / 4;
  options.max_megabytes = 0.5e-6f * float(bytes);
  EXPECT_EQ(side_at(64), 4) << "no room for more";
}

}  // namespace
}  // namespace parvis::trees

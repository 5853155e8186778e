#include "capture/trees/new_individual.h"

#include <gtest/gtest.h>

#include <set>

#include "capture/trees/billboard_textures.h"
#include "capture/trees/judge.h"
#include "capture/trees/test_volume.h"

namespace parvis::trees {
namespace {

/// A ball whose cells thin out to the east, so that its quarters differ.
BillboardTree uneven_tree() {
  const TestVolume ball(27, 0.5f);
  TreeVolume volume{ball.grid, ball.extinction_per_m,
                    std::vector<glm::vec3>(ball.grid.size(), glm::vec3(0.05f, 0.1f, 0.03f))};
  for (std::size_t i = 0; i < ball.grid.size(); ++i)
    volume.extinction_per_m[i] *= ball.grid.centre(i).x > 0.0f ? 0.15f : 2.0f;
  std::vector<TreeView> views = ball.ring(8, 48);
  for (TreeView& view : views) view.picture = photograph_of(render_volume(volume, view.camera));
  TextureOptions options;
  options.iterations = 2, options.texels_per_side = 4;
  return textured(volume, views, options);
}

TEST(NewIndividual, IsAnotherTreeOfTheSameKind) {
  const BillboardTree tree = uneven_tree(), other = new_individual(tree, 5);
  EXPECT_NEAR(double(other.grid.size()), double(tree.grid.size()), 0.1 * double(tree.grid.size()));
  std::set<std::array<int, 3>> places;
  for (const glm::u16vec3 cell : other.grid.cells()) {
    EXPECT_TRUE(places.insert({cell.x, cell.y, cell.z}).second) << "two cells in one place";
    EXPECT_LT(std::max({cell.x, cell.y, cell.z}), tree.grid.side());
  }
  ASSERT_EQ(other.views.size(), tree.views.size());
  double before = 0.0, after = 0.0, difference = 0.0;
  for (std::size_t i = 0; i < tree.views.size(); ++i) {
    const ImageF a = render_billboards(tree, tree.views[i].camera),
                 b = render_billboards(other, tree.views[i].camera);
    for (std::size_t k = 3; k < a.pixels.size(); k += 4)
      before += double(a.pixels[k]), after += double(b.pixels[k]),
          difference += std::abs(double(a.pixels[k]) - double(b.pixels[k]));
  }
  EXPECT_NEAR(after, before, 0.25 * before) << "it has the kind's opacity";
  EXPECT_GT(difference, 0.1 * before) << "but is not the same";
}

TEST(NewIndividual, FollowsFromItsSeed) {
  const BillboardTree tree = uneven_tree();
  const BillboardTree a = new_individual(tree, 5), b = new_individual(tree, 5), c = new_individual(tree, 6);
  EXPECT_EQ(a.grid.cells(), b.grid.cells());
  EXPECT_EQ(a.views.front().texels, b.views.front().texels);
  EXPECT_TRUE(a.grid.cells() != c.grid.cells() || a.views.front().texels != c.views.front().texels);
}

}  // namespace
}  // namespace parvis::trees

#include "capture/trees/measure.h"

#include <gtest/gtest.h>

#include "capture/trees/sample_trees.h"

namespace parvis::trees {
namespace {

/// A trunk of 0.4 m and 2 m height below a ball of 1.5 m radius, in cells of 0.1 m.
TreeVolume lollipop() {
  TreeVolume volume;
  std::vector<glm::u16vec3> cells;
  constexpr int side = 81;
  const Bounds box{{-4.05f, -4.05f, 0.0f}, {4.05f, 4.05f, 8.1f}};
  for (int z = 0; z < side; ++z)
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        const glm::vec3 p = box.min + 0.1f * (glm::vec3(float(x), float(y), float(z)) + 0.5f);
        const bool is_trunk = p.z < 2.0f && glm::length(glm::vec2(p)) < 0.2f;
        const bool is_crown = glm::distance(p, glm::vec3(0.0f, 0.0f, 3.5f)) < 1.5f;
        if (!is_trunk && !is_crown) continue;
        cells.emplace_back(x, y, z);
        volume.extinction_per_m.push_back(is_trunk ? 50.0f : 6.0f), volume.colour.emplace_back(0.3f);
      }
  volume.grid = CellGrid(box, 3, side, std::move(cells));
  return volume;
}

TEST(Measure, KnowsASimpleTree) {
  const TreeMeasures m = measured(lollipop());
  EXPECT_NEAR(m.height_m, 5.0f, 0.11f);
  EXPECT_NEAR(m.trunk_diameter_m, 0.4f, 0.06f);
  EXPECT_NEAR(m.crown_base_m, 2.0f, 0.2f);
  EXPECT_NEAR(m.crown_width_m, 3.0f, 0.1f);
  EXPECT_NEAR(m.crown_volume_m3, 4.0f / 3.0f * 3.1416f * 3.375f, 0.1f * 14.1f);
  EXPECT_NEAR(m.projected_area_m2, 3.1416f * 2.25f + 0.4f * 2.0f, 0.15f * 7.9f);
  ASSERT_EQ(m.leaf_area_density_per_m.size(), 10u);
}

TEST(Measure, AnEmptyVolumeHasNoSize) { EXPECT_EQ(measured(TreeVolume()).height_m, 0.0f); }

TEST(SampleTrees, AreWhatTheyAreCalled) {
  EXPECT_FALSE(make_sample_tree("palm", 1).ok());
  for (const std::string_view name : sample_tree_names) {
    const Result<scene::Model> model = make_sample_tree(name, 1);
    ASSERT_TRUE(model.ok());
    const TreeMeasures m = measured(*model);
    EXPECT_NEAR(m.height_m, scene::bounds(*model).size().z, 0.02f) << name;
    EXPECT_GT(m.crown_width_m, 4.0f * m.trunk_diameter_m) << name;
    EXPECT_EQ(make_sample_tree(name, 1)->triangle_count(), model->triangle_count()) << name;
  }
}

}  // namespace
}  // namespace parvis::trees

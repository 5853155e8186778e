#include "capture/trees/measure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "capture/trees/sample_trees.h"
#include "capture/trees/tree_outline.h"

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
  for (std::size_t band = 0; band < 3; ++band)
    EXPECT_EQ(m.leaf_area_density_per_m[band], 0.0f) << "a trunk has no leaves";
  for (std::size_t band = 4; band < 10; ++band)
    EXPECT_NEAR(m.leaf_area_density_per_m[band], 12.0f, 1.5f) << band;  // twice the extinction
}

/// The volume as from cameras whose distances are wrong by a factor.
TreeVolume scaled(TreeVolume volume, float scale) {
  const Bounds box = volume.grid.box();
  volume.grid = CellGrid({scale * box.min, scale * box.max}, volume.grid.branching(), volume.grid.side(),
                         volume.grid.cells());
  for (float& extinction : volume.extinction_per_m) extinction /= scale;
  return volume;
}

TEST(Measure, ATreeThatIsTenPercentLargerIsReportedSo) {
  const TreeMeasures one = measured(lollipop()), more = measured(scaled(lollipop(), 1.1f));
  EXPECT_NEAR(more.height_m / one.height_m, 1.1f, 1e-3f);
  EXPECT_NEAR(more.crown_width_m / one.crown_width_m, 1.1f, 1e-3f);
  EXPECT_NEAR(more.crown_volume_m3 / one.crown_volume_m3, 1.331f, 5e-3f);
}

/// A trunk with twelve bare limbs that end at 1.5 m from it, 4 m high, with so much opacity in each cell of a
/// limb.
TreeVolume bare_tree(float limb_alpha) {
  constexpr int side = 81;
  const Bounds box{{-2.025f, -2.025f, 0.0f}, {2.025f, 2.025f, 4.05f}};
  TreeVolume volume;
  std::vector<glm::u16vec3> cells;
  const auto add = [&](glm::vec3 p, float alpha) {
    const glm::u16vec3 place((p - box.min) / 0.05f);
    if (std::ranges::find(cells, place) != cells.end()) return;
    cells.push_back(place);
    volume.extinction_per_m.push_back(-std::log(1.0f - alpha) / mean_chord_m(glm::vec3(0.05f)));
    volume.colour.emplace_back(0.3f);
  };
  for (float z = 0.025f; z < 4.0f; z += 0.05f)
    for (const glm::vec2 p :
         {glm::vec2(0.01f), glm::vec2(-0.04f, 0.01f), glm::vec2(0.01f, -0.04f), glm::vec2(-0.04f)})
      add({p.x, p.y, z}, z < 3.0f ? 0.95f : limb_alpha);
  for (int limb = 0; limb < 12; ++limb)
    for (float out = 0.05f; out < 1.5f; out += 0.02f) {
      const float turn = 6.2831853f * float(limb) / 12.0f;
      for (const float z : {1.6f, 2.0f, 2.4f, 2.8f})
        add({out * std::cos(turn), out * std::sin(turn), z + 0.01f}, limb_alpha);
    }
  volume.grid = CellGrid(box, 3, side, std::move(cells));
  return volume;
}

TEST(Measure, ThinTwigsBelongToTheTree) {
  // A twig of 1 mm in a cell of 50 mm stops 2 % of the light: what is solid must not measure larger.
  const TreeMeasures thin = measured(bare_tree(0.02f)), solid = measured(bare_tree(0.9f));
  EXPECT_NEAR(thin.height_m, 4.0f, 0.04f);
  EXPECT_NEAR(thin.crown_width_m, 3.0f, 0.1f);
  EXPECT_GT(solid.crown_volume_m3, 1.0f);
  EXPECT_NEAR(thin.crown_volume_m3, solid.crown_volume_m3, 0.05f * solid.crown_volume_m3);
}

TEST(Measure, ATreeEndsWithinACell) {
  for (const float share : {0.2f, 0.5f, 0.8f}) {
    TreeVolume volume = bare_tree(0.5f);  // its top layer covers 3.95 to 4 m
    std::uint16_t top = 0;
    for (const glm::u16vec3 cell : volume.grid.cells()) top = std::max(top, cell.z);
    for (std::size_t i = 0; i < volume.grid.size(); ++i)
      volume.extinction_per_m[i] = volume.grid.cells()[i].z == top ? 0.5f * share : 0.5f;
    EXPECT_NEAR(measured(volume, 1e-3f).height_m, 3.95f + 0.05f * share, 0.005f) << share;
  }
}

TEST(Measure, HolesOfLeavesAreNotTheTree) {
  scene::Model model;
  scene::Texture texture;
  texture.image = Image8(2, 2, 4, 255), texture.set_repeats(false);
  for (const int x : {0, 1}) texture.image.at(x, 0)[3] = 0;  // the upper half is a hole
  model.textures.push_back(texture);
  scene::Material leaf;
  leaf.base_colour_texture = 0, leaf.alpha_mode = scene::Alpha::cutout;
  model.materials.push_back(leaf);
  scene::Part part;
  part.mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 0, 2}, {0, 0, 2}};
  part.mesh.uvs = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
  part.mesh.indices = {0, 1, 2, 0, 2, 3};
  model.parts.push_back(part);
  EXPECT_NEAR(measured(model).height_m, 1.0f, 0.05f);
  model.materials[0].alpha_mode = scene::Alpha::opaque;
  EXPECT_NEAR(measured(model).height_m, 2.0f, 1e-4f);
}

TEST(TreeSlice, HasTheAreaOfItsHull) {
  TreeSlice slice;
  EXPECT_EQ(slice.hull_area_m2(), 0.0f);
  // The corners of a square, and what lies within: how densely does not matter.
  for (const glm::vec2 p : {glm::vec2(3, 1), glm::vec2(5, 1), glm::vec2(5, 3), glm::vec2(3, 3)}) slice.add(p);
  EXPECT_NEAR(slice.hull_area_m2(), 4.0f, 1e-3f);
  slice.add(glm::vec2(4.0f, 2.0f));
  EXPECT_NEAR(slice.hull_area_m2(), 4.0f, 1e-3f);
  EXPECT_NEAR(slice.mean_width_m(), 8.0f / 3.14159f, 0.01f);
}

TEST(Measure, AnEmptyVolumeHasNoSize) { EXPECT_EQ(measured(TreeVolume()).height_m, 0.0f); }

TEST(SampleTrees, AreWhatTheyAreCalled) {
  EXPECT_FALSE(make_sample_tree("palm", 1).ok());
  for (const std::string_view name : sample_tree_names) {
    const Result<scene::Model> model = make_sample_tree(name, 1);
    ASSERT_TRUE(model.ok());
    const TreeMeasures m = measured(*model);
    // The corners of leaf sprays are holes: only what is bare ends where its triangles do.
    const float triangles_m = scene::bounds(*model).size().z;
    EXPECT_NEAR(m.height_m, triangles_m, name == "winter" ? 0.001f : 0.1f) << name;
    EXPECT_LE(m.height_m, triangles_m + 0.001f) << name;
    EXPECT_GT(m.crown_width_m, 4.0f * m.trunk_diameter_m) << name;
    EXPECT_EQ(make_sample_tree(name, 1)->triangle_count(), model->triangle_count()) << name;
  }
}

}  // namespace
}  // namespace parvis::trees

#include "capture/trees/texture_codes.h"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <set>
#include <utility>

#include "base/test_folder.h"
#include "capture/trees/billboard_blocks.h"
#include "capture/trees/block_table.h"
#include "capture/trees/test_volume.h"
#include "capture/trees/tree_file.h"

namespace parvis::trees {
namespace {

/// A tree whose blocks are of a few kinds, with some noise.
BillboardTree tree_of_kinds(int kinds, int noise) {
  BillboardTree tree;
  tree.grid = TestVolume(9, 0.2f).grid, tree.texels_per_side = 8;
  tree.base.assign(tree.grid.size(), {90, 100, 30, 200});
  Random random(3);
  for (const TreeView& view : TestVolume(3).ring(3, 16)) {
    BillboardTextures textures{view.camera, {}, {}};
    for (std::size_t i = 0; i < tree.grid.size(); ++i) textures.texture_of_cell.push_back(std::int32_t(i));
    textures.texels.resize(tree.grid.size() * 256);
    replace_blocks(textures, 8, [&] {
      BlockTexels block;
      const int kind = random.index(kinds);
      for (std::size_t k = 0; k < 64; ++k)
        block[k] = std::uint8_t(40 + 30 * (kind % 5) + (k % 4 == 3 ? 60 - 10 * (kind / 5) : int(k)) +
                                (noise > 0 ? random.index(noise) : 0));
      return block;
    });
    tree.views.push_back(std::move(textures));
  }
  return tree;
}

std::size_t different_blocks(const BillboardTree& tree) {
  std::set<BlockTexels> blocks;
  for (const BillboardTextures& view : tree.views)
    for_each_block(view, tree.texels_per_side, [&](const BlockTexels& block) { blocks.insert(block); });
  return blocks.size();
}

double quantised_rmse(BillboardTree tree, std::size_t codes) {
  const Result<Quantisation> done = quantise_textures(tree, codes);
  EXPECT_TRUE(done.ok());
  EXPECT_LE(done->codes, codes);
  EXPECT_LE(different_blocks(tree), done->codes);
  return done->rmse;
}

TEST(TextureCodes, BlocksOfFewKindsAreFoundAgain) {
  BillboardTree tree = tree_of_kinds(10, 0);
  ASSERT_EQ(different_blocks(tree), 10u);
  const BillboardTree before = tree;
  const Result<Quantisation> done = quantise_textures(tree, 64);
  ASSERT_TRUE(done.ok());
  EXPECT_EQ(done->codes, 10u) << "no more sets than there are different blocks";
  EXPECT_EQ(done->blocks, 3 * 4 * tree.grid.size());
  EXPECT_EQ(tree.views[1].texels, as_stored(before).views[1].texels)
      << "what is lost the blocks' format loses";
}

TEST(TextureCodes, MoreCodesLoseLess) {
  const BillboardTree tree = tree_of_kinds(25, 12);
  const double one = quantised_rmse(tree, 1), few = quantised_rmse(tree, 8), many = quantised_rmse(tree, 64);
  EXPECT_LT(few, 0.6 * one);
  EXPECT_LT(many, 0.6 * few);
  EXPECT_LT(many, 0.02) << "of the 25 kinds the noise is left, 12 / 255 / sqrt(12) with the colours'";
}

TEST(TextureCodes, AFileStoresEachOnceAndReturnsThem) {
  const TestFolder folder;
  BillboardTree tree = tree_of_kinds(25, 12);
  const Result<std::size_t> plain = write_tree(folder.path() / "plain.tree", tree);
  ASSERT_TRUE(quantise_textures(tree, 64).ok());
  for (const char* name : {"coded.tree", "coded.glb"}) {
    const Result<std::size_t> coded = write_tree(folder.path() / name, tree);
    ASSERT_TRUE(plain.ok() && coded.ok());
    EXPECT_LT(*coded, *plain / 3);
    const Result<BillboardTree> again = read_tree(folder.path() / name);
    ASSERT_TRUE(again.ok()) << to_string(again.errors());
    const BillboardTree stored = as_stored(tree);
    ASSERT_EQ(again->views.size(), stored.views.size());
    for (std::size_t v = 0; v < stored.views.size(); ++v) {
      EXPECT_EQ(again->views[v].texture_of_cell, stored.views[v].texture_of_cell);
      EXPECT_EQ(again->views[v].texels, stored.views[v].texels);
    }
  }
  EXPECT_LT(std::filesystem::file_size(folder.path() / "coded.tree"), *plain / 3);
  // What is read and written again is as small.
  const Result<BillboardTree> read = read_tree(folder.path() / "coded.glb");
  ASSERT_TRUE(read.ok());
  const Result<std::size_t> written = write_tree(folder.path() / "again.tree", *read);
  ASSERT_TRUE(written.ok());
  EXPECT_LT(*written, *plain / 3);
}

TEST(BlockTable, IsThereWhereItIsSmaller) {
  std::vector<std::vector<TextureBlock>> views(2, std::vector<TextureBlock>(10));
  for (std::size_t i = 0; i < 10; ++i)
    views[0][i][0] = std::uint8_t(i), views[1][i][0] = std::uint8_t(i + 10);
  EXPECT_FALSE(BlockTable::of(views)) << "no block repeats";
  for (std::size_t i = 0; i < 10; ++i) views[0][i][0] = views[1][i][0] = std::uint8_t(i % 3);
  const std::optional<BlockTable> table = BlockTable::of(views);
  ASSERT_TRUE(table);
  EXPECT_EQ(table->blocks().size(), 3u);
  EXPECT_EQ(*table->blocks_of(table->numbers_of(views[0])), views[0]);
  EXPECT_FALSE(table->blocks_of(std::array<std::uint16_t, 2>{1, 3})) << "beyond it";
  views[0].assign(2 * BlockTable::max_blocks, {});
  for (std::size_t i = 0; i < views[0].size(); ++i)
    views[0][i][0] = std::uint8_t(i), views[0][i][1] = std::uint8_t(i >> 8),
    views[0][i][2] = std::uint8_t(i >> 16);
  views[1] = views[0];
  EXPECT_FALSE(BlockTable::of(views)) << "numbers have 16 bits";
}

}  // namespace
}  // namespace parvis::trees

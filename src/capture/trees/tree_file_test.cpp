#include "capture/trees/tree_file.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "base/files.h"
#include "base/sealed_file.h"
#include "base/test_data.h"
#include "base/test_folder.h"
#include "capture/trees/crossed_billboards.h"
#include "capture/trees/test_volume.h"
#include "capture/trees/texture_blocks.h"
#include "formats/gltf/gltf_reader.h"
#include "formats/gltf/gltf_writer.h"

namespace parvis::trees {
namespace {

/// A small tree with random textures, of which some cells have none.
BillboardTree random_tree() {
  BillboardTree tree;
  tree.grid = TestVolume(9, 0.1f).grid, tree.texels_per_side = 8;
  Random random(8);
  for (std::size_t i = 0; i < tree.grid.size(); ++i) tree.base.emplace_back(i % 256, 100, 30, 200);
  for (const TreeView& view : TestVolume(3).ring(3, 16)) {
    BillboardTextures textures{view.camera, {}, {}};
    std::int32_t next = 0;
    for (std::size_t i = 0; i < tree.grid.size(); ++i) {
      const bool has_one = random.chance(0.6f);
      textures.texture_of_cell.push_back(has_one ? next++ : -1);
      const int grey = random.index(200);
      for (int k = 0; has_one && k < 64; ++k)
        for (int c = 0; c < 4; ++c) textures.texels.push_back(std::uint8_t(grey + k % 8 * 5));
    }
    tree.views.push_back(std::move(textures));
  }
  return tree;
}

TEST(TextureBlocks, KeepSmoothColoursAndAlphas) {
  BlockTexels texels{};
  for (std::size_t i = 0; i < 16; ++i) {
    const auto value = std::uint8_t(40 + 8 * i);
    texels[4 * i] = value, texels[4 * i + 1] = std::uint8_t(value / 2),
               texels[4 * i + 2] = std::uint8_t(value / 3);
    texels[4 * i + 3] = std::uint8_t(255 - 10 * i);
  }
  const BlockTexels again = decompressed_block(compressed_block(texels));
  for (std::size_t i = 0; i < 64; ++i) EXPECT_NEAR(again[i], texels[i], i % 4 == 3 ? 12 : 24) << i;
}

TEST(TextureBlocks, ColoursOfTransparentTexelsDoNotMatter) {
  BlockTexels texels{};
  for (std::size_t i = 0; i < 16; ++i) {
    const bool is_seen = i % 2 == 0;
    texels[4 * i] = is_seen ? 60 : 255, texels[4 * i + 1] = is_seen ? 120 : 0,
               texels[4 * i + 2] = is_seen ? 40 : 255;
    texels[4 * i + 3] = is_seen ? 255 : 0;
  }
  const BlockTexels again = decompressed_block(compressed_block(texels));
  for (std::size_t i = 0; i < 16; i += 2) {
    EXPECT_NEAR(again[4 * i], 60, 5);
    EXPECT_NEAR(again[4 * i + 1], 120, 5);
    EXPECT_EQ(again[4 * i + 3], 255);
    EXPECT_EQ(again[4 * i + 7], 0);
  }
}

TEST(TreeFile, ReturnsWhatWasWritten) {
  const TestFolder folder;
  const BillboardTree tree = random_tree(), stored = as_stored(tree);
  const Result<std::size_t> bytes = write_tree(folder.path() / "a.tree", tree);
  ASSERT_TRUE(bytes.ok());
  EXPECT_EQ(*bytes, std::filesystem::file_size(folder.path() / "a.tree"));
  const Result<BillboardTree> again = read_tree(folder.path() / "a.tree");
  ASSERT_TRUE(again.ok()) << to_string(again.errors());
  EXPECT_EQ(again->grid.cells(), tree.grid.cells());
  EXPECT_EQ(again->base, tree.base);
  ASSERT_EQ(again->views.size(), tree.views.size());
  for (std::size_t v = 0; v < tree.views.size(); ++v) {
    EXPECT_EQ(again->views[v].texture_of_cell, tree.views[v].texture_of_cell);
    EXPECT_EQ(again->views[v].texels, stored.views[v].texels);
    for (std::size_t i = 0; i < tree.views[v].texels.size(); ++i)
      ASSERT_NEAR(int(again->views[v].texels[i]), int(tree.views[v].texels[i]), 16);
  }
}

TEST(TreeFile, AsGltfItIsAModelForOthersAndTheSameTreeForUs) {
  const TestFolder folder;
  const BillboardTree tree = random_tree();
  ASSERT_TRUE(write_tree(folder.path() / "a.tree", tree).ok());
  ASSERT_TRUE(write_tree(folder.path() / "a.glb", tree).ok());
  const Result<BillboardTree> again = read_tree(folder.path() / "a.glb"),
                              plain_kind = read_tree(folder.path() / "a.tree");
  ASSERT_TRUE(again.ok()) << to_string(again.errors());
  EXPECT_EQ(again->grid.cells(), plain_kind->grid.cells());
  for (std::size_t v = 0; v < tree.views.size(); ++v)
    EXPECT_EQ(again->views[v].texels, plain_kind->views[v].texels);
  Errors warnings;
  const Result<scene::Model> model = scene::read_gltf(folder.path() / "a.glb", warnings);
  ASSERT_TRUE(model.ok()) << to_string(model.errors());
  EXPECT_TRUE(warnings.empty());
  EXPECT_EQ(model->triangle_count(), 4u) << "two crossed billboards";
  const Bounds box = scene::bounds(*model);
  EXPECT_NEAR(box.min.z, tree.grid.box().min.z, 1e-3f);
  EXPECT_NEAR(box.max.z, tree.grid.box().max.z, 1e-3f);
  // A model without the extension is no tree.
  ASSERT_TRUE(scene::write_gltf(folder.path() / "other.glb", crossed_model(tree)).ok());
  const Result<BillboardTree> other = read_tree(folder.path() / "other.glb");
  ASSERT_FALSE(other.ok());
  EXPECT_NE(to_string(other.errors()).find("PARVIS_captured_tree"), std::string::npos);
}

/// The same with a trunk whose bark is brighter upward.
BillboardTree tree_with_trunk() {
  BillboardTree tree = random_tree();
  TrunkShape shape{{{{{0, 0, 0.5f}, 0.1f}, {{0.01f, 0, 0.8f}, 0.09f}, {{0.03f, 0, 1.2f}, 0.07f}}},
                   Image8(8, 12, 4, 255)};
  for (int y = 0; y < 12; ++y)
    for (int x = 0; x < 8; ++x)
      for (int c = 0; c < 3; ++c) shape.bark.at(x, y)[c] = std::uint8_t(200 - 12 * y);
  tree.trunk = shape;
  return tree;
}

TEST(TreeFile, HoldsTheTrunk) {
  const TestFolder folder;
  const BillboardTree tree = tree_with_trunk();
  for (const char* name : {"a.tree", "a.glb"}) {
    ASSERT_TRUE(write_tree(folder.path() / name, tree).ok());
    const Result<BillboardTree> again = read_tree(folder.path() / name);
    ASSERT_TRUE(again.ok()) << to_string(again.errors());
    ASSERT_TRUE(again->trunk);
    ASSERT_EQ(again->trunk->trunk.rings.size(), 3u);
    EXPECT_EQ(again->trunk->trunk.rings[2].centre, tree.trunk->trunk.rings[2].centre);
    EXPECT_EQ(again->trunk->trunk.rings[2].radius_m, 0.07f);
    ASSERT_EQ(again->trunk->bark.pixels.size(), tree.trunk->bark.pixels.size());
    for (std::size_t i = 0; i < tree.trunk->bark.pixels.size(); ++i)
      ASSERT_NEAR(int(again->trunk->bark.pixels[i]), int(tree.trunk->bark.pixels[i]), 12);
  }
  Errors warnings;
  const Result<scene::Model> model = scene::read_gltf(folder.path() / "a.glb", warnings);
  ASSERT_TRUE(model.ok()) << to_string(model.errors());
  EXPECT_GT(model->triangle_count(), 50u) << "other programs see it, too";
}

TEST(TreeFile, ADamagedTrunkIsRefused) {
  const TestFolder folder;
  const std::filesystem::path file = folder.path() / "a.tree";
  const auto refusal = [&](auto&& damage) {
    BillboardTree tree = tree_with_trunk();
    damage(*tree.trunk);
    EXPECT_TRUE(write_tree(file, tree).ok());
    const Result<BillboardTree> read = read_tree(file);
    return read.ok() ? std::string() : to_string(read.errors());
  };
  EXPECT_EQ(refusal([](TrunkShape&) {}), "");
  EXPECT_NE(refusal([](TrunkShape& shape) { shape.trunk.rings.resize(1); }).find("trunk"), std::string::npos);
  EXPECT_NE(refusal([](TrunkShape& shape) { shape.trunk.rings[1].radius_m = -1.0f; }).find("trunk"),
            std::string::npos);
  EXPECT_NE(refusal([](TrunkShape& shape) { shape.trunk.rings[1].centre.z = 9.0f; }).find("trunk"),
            std::string::npos)
      << "rings that are not in order";
  EXPECT_NE(refusal([](TrunkShape& shape) { shape.trunk.rings[1].centre.x = NAN; }).find("trunk"),
            std::string::npos);
}

TEST(TreeFile, ReturnsVolumes) {
  const TestFolder folder;
  const TestVolume ball(9, 0.3f);
  const TreeVolume volume{ball.grid, ball.extinction_per_m,
                          std::vector<glm::vec3>(ball.grid.size(), glm::vec3(0.25f))};
  ASSERT_TRUE(write_volume(folder.path() / "a.volume", volume).ok());
  const Result<TreeVolume> again = read_volume(folder.path() / "a.volume");
  ASSERT_TRUE(again.ok()) << to_string(again.errors());
  EXPECT_EQ(again->extinction_per_m, volume.extinction_per_m);
  EXPECT_EQ(again->grid.cells(), volume.grid.cells());
}

constexpr SealedKind plain_kind{"PVTREE_2", "captured tree"}, coded_kind{"PVTREE_3", "captured tree"};

/// The same with noise: no two blocks are alike, so that the file has no table of blocks.
BillboardTree noisy_tree() {
  BillboardTree tree = random_tree();
  Random random(9);
  for (BillboardTextures& view : tree.views)
    for (std::uint8_t& value : view.texels) value = std::uint8_t(random.index(256));
  return tree;
}

TEST(TreeFile, EveryShorterFileIsRefused) {
  const TestFolder folder;
  const std::filesystem::path file = folder.path() / "a.tree";
  for (const auto& [kind, tree] :
       {std::pair{plain_kind, noisy_tree()}, std::pair{coded_kind, random_tree()}}) {
    ASSERT_TRUE(write_tree(file, tree).ok());
    const std::string content = *read_sealed(file, kind);
    for (std::size_t size = 0; size < content.size(); size += 1 + size / 20) {
      ASSERT_TRUE(write_sealed(file, kind, std::string_view(content).substr(0, size)).ok());
      EXPECT_FALSE(read_tree(file).ok()) << size << " of " << content.size();
    }
  }
}

TEST(TreeFile, RefusesImpossibleGridsAndCounts) {
  const TestFolder folder;
  const std::filesystem::path file = folder.path() / "a.tree";
  for (const auto& [kind, tree] :
       {std::pair{plain_kind, noisy_tree()}, std::pair{coded_kind, random_tree()}}) {
    ASSERT_TRUE(write_tree(file, tree).ok());
    const std::string content = *read_sealed(file, kind);
    // Offsets: box 24 bytes, branching, side, texels, cell count, cells.
    for (const auto& [offset, value] :
         {std::pair{24, 7}, std::pair{28, 10}, std::pair{28, 6561}, std::pair{32, 5}, std::pair{32, 4000},
          std::pair{36, 0x7fffffff}, std::pair{40, 0xffff}}) {
      std::string damaged = content;
      std::memcpy(damaged.data() + offset, &value, 4);
      ASSERT_TRUE(write_sealed(file, kind, damaged).ok());
      EXPECT_FALSE(read_tree(file).ok()) << "offset " << offset;
    }
  }
}

TEST(TreeFile, RefusesNumbersOfBlocksBeyondTheirTable) {
  const TestFolder folder;
  const std::filesystem::path file = folder.path() / "a.tree";
  const BillboardTree tree = random_tree();
  ASSERT_TRUE(write_tree(file, tree).ok());
  const std::string content = *read_sealed(file, coded_kind);
  // The numbers of the last view are the last bytes.
  std::string damaged = content;
  damaged[damaged.size() - 1] = damaged[damaged.size() - 2] = '\xff';
  ASSERT_TRUE(write_sealed(file, coded_kind, damaged).ok());
  const Result<BillboardTree> beyond = read_tree(file);
  ASSERT_FALSE(beyond.ok());
  EXPECT_NE(to_string(beyond.errors()).find("beyond its table"), std::string::npos)
      << to_string(beyond.errors());
  // Behind box, three numbers, cells, base colours, light and count of views lies that of the table's blocks.
  const std::size_t table = 24 + 3 * 4 + 4 + 6 * tree.grid.size() + 4 + 4 * tree.grid.size() + 20 + 4;
  for (const std::uint32_t count : {0u, 65537u, 0xffffffffu}) {
    damaged = content;
    damaged.replace(table, 4, reinterpret_cast<const char*>(&count), 4);
    if (count == 65537u) damaged.insert(table + 4, std::size_t(count) * block_bytes, '\0');
    ASSERT_TRUE(write_sealed(file, coded_kind, damaged).ok());
    const Result<BillboardTree> refused = read_tree(file);
    ASSERT_FALSE(refused.ok()) << count;
    if (count == 65537u) {
      EXPECT_NE(to_string(refused.errors()).find("65536 are possible"), std::string::npos)
          << to_string(refused.errors());
    }
  }
}

TEST(TreeFile, TheFuzzersSeedsReachTheEndOfTheReaders) {
  const TestFolder folder;
  const std::filesystem::path file = folder.path() / "seed";
  int seeds = 0;
  const std::string corpus = (source_folder() / "src/capture/trees/fuzz/corpus/tree").string();
  for (const auto& entry : std::filesystem::directory_iterator(corpus)) {
    const std::string content = *read_file(entry.path());
    const std::string name = entry.path().filename().string();
    const bool is_volume = name.starts_with("volume");
    const SealedKind kind = is_volume                   ? SealedKind{"PVTVOL_2", "tree volume"}
                            : name.starts_with("coded") ? coded_kind
                                                        : plain_kind;
    ASSERT_TRUE(write_sealed(file, kind, content).ok());
    EXPECT_TRUE(is_volume ? read_volume(file).ok() : read_tree(file).ok()) << entry.path();
    ++seeds;
  }
  EXPECT_GE(seeds, 8);
}

TEST(Packing, PairsTexturesOfDisjointAlphas) {
  BillboardTree tree = random_tree();
  tree.views.resize(1);
  BillboardTextures& view = tree.views[0];
  const std::size_t count = view.count(8);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t k = 0; k < 64; ++k)
      view.texels[4 * (64 * i + k) + 3] = (k < 32) == (i % 2 == 0) ? 255 : 0;
  EXPECT_EQ(packed_disjoint_alphas(tree).packed, (count + 1) / 2);
  EXPECT_NEAR(packed_disjoint_alphas(tree).ratio(), 0.625, 0.02);
  for (std::size_t i = 3; i < view.texels.size(); i += 4) view.texels[i] = 255;
  EXPECT_EQ(packed_disjoint_alphas(tree).packed, count);
}

}  // namespace
}  // namespace parvis::trees

#include <gtest/gtest.h>

#include <array>
#include <filesystem>

#include "base/test_folder.h"
#include "capture/trees/billboard_textures.h"
#include "capture/trees/test_volume.h"

namespace parvis::trees {
namespace {
namespace fs = std::filesystem;

constexpr int photographs = 5;

/// A ball of one colour, and photographs of it.
struct Captured {
  TreeVolume volume;
  std::vector<TreeView> views;

  Captured() {
    const TestVolume ball(9, 0.4f, 20.0f);
    volume = {ball.grid, ball.extinction_per_m, std::vector(ball.grid.size(), glm::vec3(0.5f, 0.7f, 0.2f))};
    views = ball.ring(photographs, 32);
    for (TreeView& view : views) view.picture = photograph_of(render_volume(volume, view.camera));
  }
};

TextureOptions options() {
  TextureOptions result;
  result.parent_levels = 0, result.iterations = 3;
  return result;
}

void expect_same(const BillboardTree& a, const BillboardTree& b) {
  EXPECT_EQ(a.texels_per_side, b.texels_per_side);
  ASSERT_EQ(a.views.size(), b.views.size());
  for (std::size_t i = 0; i < a.views.size(); ++i) {
    EXPECT_EQ(a.views[i].texture_of_cell, b.views[i].texture_of_cell) << i;
    EXPECT_EQ(a.views[i].texels, b.views[i].texels) << i;
  }
}

fs::path part(const fs::path& folder, int photograph) {
  return folder / ("photograph_000" + std::to_string(photograph) + ".part");
}

TEST(KeptTextures, GoOnFromThosePhotographsThatWereDone) {
  const TestFolder folder;
  const Captured captured;
  const KeptParts checkpoint(folder.path() / "steps");
  const BillboardTree whole = textured(captured.volume, captured.views, options());
  // The third cannot be kept: a folder lies in its place.
  fs::create_directories(part(checkpoint.folder(), 2));
  const Result<BillboardTree> ended = textured(captured.volume, captured.views, options(), checkpoint);
  ASSERT_FALSE(ended);
  EXPECT_NE(to_string(ended.errors()).find("photograph_0002"), std::string::npos)
      << to_string(ended.errors());

  fs::remove(part(checkpoint.folder(), 2));
  std::array<fs::file_time_type, photographs> kept;
  for (const int i : {0, 1, 3, 4}) kept[std::size_t(i)] = fs::last_write_time(part(checkpoint.folder(), i));
  const Result<BillboardTree> tree = textured(captured.volume, captured.views, options(), checkpoint);
  ASSERT_TRUE(tree) << to_string(tree.errors());
  expect_same(*tree, whole);
  EXPECT_TRUE(fs::exists(part(checkpoint.folder(), 2)));
  for (const int i : {0, 1, 3, 4})
    EXPECT_EQ(fs::last_write_time(part(checkpoint.folder(), i)), kept[std::size_t(i)])
        << "written once more: " << i;
  checkpoint.remove();
  EXPECT_FALSE(fs::exists(checkpoint.folder()));
}

TEST(KeptTextures, ThoseOfAnotherPhotographVolumeOrMethodAreMadeAfresh) {
  const TestFolder folder;
  const KeptParts checkpoint(folder.path() / "steps");
  Captured captured;
  ASSERT_TRUE(textured(captured.volume, captured.views, options(), checkpoint));
  const auto expect_made_afresh = [&](const TextureOptions& chosen) {
    const Result<BillboardTree> tree = textured(captured.volume, captured.views, chosen, checkpoint);
    ASSERT_TRUE(tree) << to_string(tree.errors());
    expect_same(*tree, textured(captured.volume, captured.views, chosen));
  };
  captured.views[1].picture.pixels.assign(captured.views[1].picture.pixels.size(), 90);
  expect_made_afresh(options());
  captured.volume.extinction_per_m.front() = 1.0f;
  expect_made_afresh(options());
  TextureOptions thesis = options();
  thesis.method = TextureMethod::age_importance;
  expect_made_afresh(thesis);
}

}  // namespace
}  // namespace parvis::trees

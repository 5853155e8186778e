#include "capture/trees/figures.h"

#include <gtest/gtest.h>

#include "base/test_folder.h"
#include "capture/trees/test_volume.h"

namespace parvis::trees {
namespace {

TEST(Figures, CellsHaveFacesAndEdges) {
  const CellGrid one({{-0.5f, -0.5f, 0.5f}, {0.5f, 0.5f, 1.5f}}, 3, 1, {glm::u16vec3(0)});
  const ImageF picture = render_cells(one, TestVolume().view(0.3f, 1.0f, 64).camera);
  std::set<int> shades;
  std::size_t covered = 0;
  for (std::size_t i = 0; i < picture.pixels.size(); i += 4)
    if (picture.pixels[i + 3] > 0.0f) ++covered, shades.insert(int(255.0f * picture.pixels[i]));
  EXPECT_GT(covered, 400u);
  EXPECT_EQ(shades.size(), 4u) << "two faces, and the edges of each";
}

TEST(Figures, ASliceIsBlackWhereCellsAreOpaque) {
  const CellGrid grid({{-1, -1, 0}, {1, 1, 2}}, 2, 2, {glm::u16vec3(1, 0, 0)});
  const std::vector<float> extinction{100.0f};
  const Image8 below = opacity_slice(grid, extinction, 0.2f), above = opacity_slice(grid, extinction, 0.8f);
  EXPECT_LT(below.at(3 * below.width / 4, 3 * below.height / 4)[0], 5) << "x to the right, y upward";
  EXPECT_EQ(below.at(below.width / 4, 3 * below.height / 4)[0], 255);
  EXPECT_EQ(below.at(3 * below.width / 4, below.height / 4)[0], 255);
  EXPECT_EQ(above.at(3 * above.width / 4, 3 * above.height / 4)[0], 255);
}

TEST(Figures, AreWrittenFromACapture) {
  const TestVolume ball(9, 0.6f);
  const TestFolder folder;
  const std::vector<TreeView> views = ball.ring(8, 32), held_out = ball.ring(2, 32, 0.4f);
  const Result<std::vector<std::string>> lines = write_figures(folder.path(), {views, held_out, 2});
  ASSERT_TRUE(lines) << to_string(lines.errors());
  for (const char* name : {"figure-4.5.png", "figure-4.8.svg", "figure-4.9.png", "figure-4.10.png",
                           "figure-4.12.png", "figure-4.15.png"})
    EXPECT_TRUE(std::filesystem::exists(folder.path() / name)) << name;
  EXPECT_FALSE(write_figures(folder.path(), {views, {}, 2})) << "no view to compare with";
}

TEST(Figures, TheChartHasACurvePerMethod) {
  const std::vector<Curve> curves{{"first", {0.1, 0.01}}, {"second", {0.2, 0.002}}};
  const std::string svg = convergence_chart(curves);
  EXPECT_NE(svg.find(">first<"), std::string::npos);
  std::size_t lines = 0;
  for (std::size_t at = svg.find("<polyline"); at != std::string::npos; at = svg.find("<polyline", at + 1))
    ++lines;
  EXPECT_EQ(lines, 2u);
}

}  // namespace
}  // namespace parvis::trees

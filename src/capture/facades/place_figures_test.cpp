#include "capture/facades/place_figures.h"

#include <gtest/gtest.h>

#include "capture/facades/test_street.h"

namespace parvis::facades {
namespace {

PlaceLayers made_street() {
  const Photos input;
  Result<PlaceLayers> place = place_layers(input.photos, street());
  EXPECT_TRUE(place);
  return *std::move(place);
}

/// Pixels of a figure's region that show the checkerboard of nothing.
int empty_pixels(const Image8& figure, int left, int right) {
  int count = 0;
  for (int y = 0; y < figure.height; ++y)
    for (int x = left; x < right; ++x) {
      const std::uint8_t* p = figure.at(x, y);
      count += p[0] == p[1] && p[1] == p[2] && (p[0] == 235 || p[0] == 200);
    }
  return count;
}

TEST(PlaceFigures, FilledLayersHaveNoHoleWhereThePhotographHasOne) {
  const PlaceLayers place = made_street();
  const std::size_t photo = richest_photograph(place);
  const Image8 figure = layers_figure(place, photo);
  const int before = empty_pixels(figure, 0, 640), after = empty_pixels(figure, 648, 1288);
  EXPECT_GT(before, after + 1000) << "the near wall and the post hide a part of the far one";
}

TEST(PlaceFigures, LayersCoverMoreThanPhotographsSee) {
  PlaceLayers place = made_street();
  const Coverage coverage = coverage_of(place);
  EXPECT_GE(coverage.layered_percent, coverage.seen_percent);
  EXPECT_GT(coverage.seen_percent, 50.0);
  for (Filled& filled : place.filled)
    for (Image8& sources : filled.sources) std::ranges::fill(sources.pixels, std::uint8_t(FillSource::none));
  EXPECT_EQ(coverage_of(place).layered_percent, coverage.seen_percent) << "the control: nothing is filled";
}

TEST(PlaceFigures, AllAreWritten) {
  const PlaceLayers place = made_street();
  const TestFolder folder;
  ASSERT_TRUE(write_figures(folder.path(), place, packed_facade(place), richest_photograph(place)));
  for (const char* name : {"figure_3_2.png", "figure_3_3.png", "figure_3_8.png", "figure_3_14.png"}) {
    const Result<Image8> figure = read_image8(folder.path() / name);
    ASSERT_TRUE(figure) << name;
    EXPECT_GE(figure->width, 640) << name;
  }
}

}  // namespace
}  // namespace parvis::facades

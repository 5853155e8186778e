#include "land/roads/asphalt_cover.h"

#include <gtest/gtest.h>

namespace parvis::scene {
namespace {

/// Asphalt of 3.5 m along the x axis from 0 to 40, with others beside it every 3 m to the north.
std::vector<AsphaltStrip> lanes(int count, float z = 0.0f) {
  std::vector<AsphaltStrip> strips;
  for (int i = 0; i < count; ++i)
    strips.push_back({{{0, 3.0f * float(i), z}, {20, 3.0f * float(i), z}, {40, 3.0f * float(i), z}}, 1.75f});
  return strips;
}

/// Whether a piece of a ribbon between two places, 2 m along x, is hidden.
bool hides(const AsphaltCover& cover, std::uint32_t own, float x, float from_y, float to_y, float z = 0.0f) {
  return cover.hides(own, {x, from_y, z}, {x, to_y, z}, {x + 2.0f, from_y, z}, {x + 2.0f, to_y, z});
}

constexpr std::uint32_t no_strip = 99;

TEST(AsphaltCover, HidesWhatLiesBelowSeveralStripsTogether) {
  const AsphaltCover cover(lanes(3));
  EXPECT_TRUE(hides(cover, no_strip, 10, -1.0f, 7.0f)) << "over the seams of three lanes";
  EXPECT_TRUE(hides(cover, no_strip, 19, 1.0f, 2.0f)) << "over the points of a strip";
  EXPECT_FALSE(hides(cover, no_strip, 10, -1.8f, 7.0f)) << "it looks out at the side";
  EXPECT_FALSE(hides(cover, no_strip, 39, 0.0f, 1.0f)) << "it looks out at the end";
  EXPECT_FALSE(hides(cover, no_strip, 60, 0.0f, 1.0f)) << "there is nothing";
}

TEST(AsphaltCover, OwnAsphaltAndOtherLevelsHideNothing) {
  const AsphaltCover one(lanes(1)), above(lanes(3, 5.0f));
  EXPECT_TRUE(hides(one, no_strip, 10, -1.0f, 1.0f));
  EXPECT_FALSE(hides(one, 0, 10, -1.0f, 1.0f)) << "a kerb stands beside its own asphalt";
  EXPECT_FALSE(hides(above, no_strip, 10, -1.0f, 7.0f)) << "of a bridge";
  EXPECT_TRUE(hides(above, no_strip, 10, -1.0f, 7.0f, 4.8f));
}

TEST(AsphaltCover, SeesAHoleInTheMiddle) {
  std::vector<AsphaltStrip> strips = lanes(2);
  strips[1].middle = {{0, 3.6f, 0}, {40, 3.6f, 0}};
  EXPECT_FALSE(hides(AsphaltCover(strips), no_strip, 10, -1.0f, 4.6f)) << "10 cm between two strips";
}

}  // namespace
}  // namespace parvis::scene

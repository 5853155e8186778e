#include "capture/trees/matte_folder.h"

#include <gtest/gtest.h>

#include <glm/glm.hpp>

#include "base/image_io.h"
#include "base/test_folder.h"

namespace parvis::trees {
namespace {
namespace fs = std::filesystem;

constexpr int side_px = 48;  // pixels

/// A green disc of a radius before a plain blue background.
Image8 photograph(float radius) {
  Image8 picture(side_px, side_px, 3);
  for (int y = 0; y < side_px; ++y)
    for (int x = 0; x < side_px; ++x) {
      const bool is_disc = glm::length(glm::vec2(float(x), float(y)) - 0.5f * float(side_px)) < radius;
      const glm::ivec3 colour = is_disc ? glm::ivec3(50, 100, 30) : glm::ivec3(150, 180, 235);
      for (int c = 0; c < 3; ++c) picture.at(x, y)[c] = std::uint8_t(colour[c]);
    }
  return picture;
}

/// A red frame as wide as so many pixels, and a green middle.
Image8 scribbles(int frame) {
  Image8 picture(side_px, side_px, 4, 255);
  for (int y = 0; y < side_px; ++y)
    for (int x = 0; x < side_px; ++x) {
      const int to_edge = std::min({x, y, side_px - 1 - x, side_px - 1 - y});
      if (to_edge < frame) picture.at(x, y)[1] = picture.at(x, y)[2] = 0;
      if (to_edge > side_px / 2 - 4) picture.at(x, y)[0] = picture.at(x, y)[2] = 0;
    }
  return picture;
}

int opaque_pixels(const fs::path& file) {
  const Result<Image8> picture = read_image8(file);
  if (!picture) return -1;
  int count = 0;
  for (std::size_t i = 3; i < picture->pixels.size(); i += 4) count += picture->pixels[i] > 127;
  return count;
}

/// Two photographs, a.png and b.png.
class MatteFolders : public testing::Test {
 protected:
  MatteFolders() : folder{files.path() / "photographs", {}, files.path() / "capture"} {
    fs::create_directories(folder.photographs);
    paint("a.png", 10.0f), paint("b.png", 10.0f);
  }

  void paint(const char* name, float radius) const {
    ASSERT_TRUE(write_image(folder.photographs / name, photograph(radius)).ok());
  }
  void expect_counts(int made, int up_to_date, int foreign) const {
    const Result<MatteCounts> counts = write_mattes(folder);
    ASSERT_TRUE(counts.ok()) << to_string(counts.errors());
    EXPECT_EQ(counts->made, made);
    EXPECT_EQ(counts->up_to_date, up_to_date);
    EXPECT_EQ(counts->foreign, foreign);
  }

  TestFolder files;
  MatteFolder folder;
};

TEST_F(MatteFolders, AMatteOfAnotherPhotographIsMadeAfresh) {
  expect_counts(2, 0, 0);
  expect_counts(0, 2, 0);
  const int before = opaque_pixels(folder.output / "a.png");
  paint("a.png", 16.0f);
  expect_counts(1, 1, 0);
  EXPECT_GT(opaque_pixels(folder.output / "a.png"), before + 300);
  EXPECT_EQ(opaque_pixels(folder.output / "b.png"), before);
  expect_counts(0, 2, 0);
}

TEST_F(MatteFolders, AMatteByAnotherMethodOrOfOtherZonesIsMadeAfresh) {
  expect_counts(2, 0, 0);
  folder.method = MatteMethod::laplacian;
  expect_counts(2, 0, 0);
  expect_counts(0, 2, 0);
  folder.zones = files.path() / "zones";
  fs::create_directories(folder.zones);
  expect_counts(0, 2, 0);  // the folder has nothing for them
  for (const int frame : {3, 4}) {
    ASSERT_TRUE(write_image(folder.zones / "b.png", scribbles(frame)).ok());
    expect_counts(1, 1, 0);
  }
}

TEST_F(MatteFolders, OneThatSomebodyPaintedIsKept) {
  expect_counts(2, 0, 0);
  Image8 own(side_px, side_px, 4, 255);
  own.at(3, 3)[3] = 0;
  ASSERT_TRUE(write_image(folder.output / "a.png", own).ok());
  expect_counts(0, 2, 0);  // of the same photograph as before
  paint("a.png", 16.0f);
  expect_counts(0, 1, 1);
  EXPECT_EQ(opaque_pixels(folder.output / "a.png"), side_px * side_px - 1);
  fs::remove(folder.output / "a.png");
  expect_counts(1, 1, 0);
}

TEST_F(MatteFolders, OneThatCoversTheEdgesIsDoubtfulAlsoWhereItIsNotSure) {
  Image8 inverted = photograph(10.0f);  // RGBA: of the disc's surroundings
  Image8 rgba(side_px, side_px, 4, 255);
  for (int y = 0; y < side_px; ++y)
    for (int x = 0; x < side_px; ++x) {
      for (int c = 0; c < 3; ++c) rgba.at(x, y)[c] = inverted.at(x, y)[c];
      rgba.at(x, y)[3] = inverted.at(x, y)[2] > 100 ? 255 : 0;
    }
  Image8 unsure = rgba;
  for (std::size_t i = 3; i < unsure.pixels.size(); i += 4) unsure.pixels[i] = unsure.pixels[i] / 3;
  ASSERT_TRUE(write_image(folder.photographs / "a.png", unsure).ok());
  ASSERT_TRUE(write_image(folder.photographs / "b.png", rgba).ok());
  const Result<MatteCounts> counts = write_mattes(folder);
  ASSERT_TRUE(counts) << to_string(counts.errors());
  EXPECT_EQ(counts->made, 2);
  EXPECT_EQ(counts->doubtful, 2);
}

}  // namespace
}  // namespace parvis::trees

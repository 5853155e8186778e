#include <gtest/gtest.h>

#include <algorithm>

#include "capture/facades/test_street.h"

namespace parvis::facades {
namespace {

TEST(Masks, WhatAMaskLeavesOutIsFilledFromOtherPhotographs) {
  Photos input;
  // A red square stands before the far wall in one photograph only; its mask leaves the square out.
  Image8 picture = *read_image8(input.photos[1].file), mask(picture.width, picture.height, 1, 255);
  for (int y = 10; y < 40; ++y)
    for (int x = 10; x < 40; ++x) {
      const std::uint8_t red[3] = {255, 0, 0};
      std::copy_n(red, 3, picture.at(x, y));
      *mask.at(x, y) = 0;
    }
  ASSERT_TRUE(write_image(input.photos[1].file, picture));
  const PlaceSettings without_search{.finds_occluders = false};
  const auto red_pixels = [&] {
    const Result<PlaceLayers> place = place_layers(input.photos, street(), without_search);
    EXPECT_TRUE(place);
    int red = 0;
    for (const Image8& layer : place->filled[1].pixels)
      for (std::size_t p = 0; p < layer.pixels.size(); p += 4)
        red += layer.pixels[p] > 240 && layer.pixels[p + 1] < 10 && layer.pixels[p + 3] > 0;
    return red;
  };
  EXPECT_GT(red_pixels(), 800) << "the control: without a mask the square is taken for the wall";
  input.photos[1].mask = input.folder.path() / "mask.png";
  ASSERT_TRUE(write_image(input.photos[1].mask, mask));
  EXPECT_EQ(red_pixels(), 0);
  // A mask of another size leaves the photograph out, and is named.
  ASSERT_TRUE(write_image(input.photos[1].mask, Image8(10, 10, 1, 255)));
  const Result<PlaceLayers> place = place_layers(input.photos, street(), without_search);
  ASSERT_TRUE(place);
  EXPECT_EQ(place->names.size(), 3u);
  EXPECT_NE(to_string(place->warnings).find("its mask"), std::string::npos);
}

}  // namespace
}  // namespace parvis::facades

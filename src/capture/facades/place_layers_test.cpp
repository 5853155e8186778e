#include "capture/facades/place_layers.h"

#include <gtest/gtest.h>

#include "capture/facades/rephotography.h"
#include "capture/facades/test_street.h"

namespace parvis::facades {
namespace {

TEST(PlaceLayers, APhotographsViewIsItsCamera) {
  const TestFolder folder;
  View view = test_view(160, 120, {1, 2, 3});
  view.cx = 71.5;
  const Result<View> back = view_of(photograph(folder, "a.png", view, 1.0f));
  ASSERT_TRUE(back);
  EXPECT_LT(glm::distance(back->centre, view.centre), 1e-12);
  const glm::dvec3 point(2, 9, 4);
  EXPECT_LT(glm::distance(back->to_pixel(back->to_camera(point)), view.to_pixel(view.to_camera(point))),
            1e-9);
}

TEST(PlaceLayers, FromPhotographsToAView) {
  const Photos input;
  Result<PlaceLayers> place = place_layers(input.photos, street());
  ASSERT_TRUE(place) << to_string(place.errors());
  EXPECT_TRUE(place->warnings.empty()) << to_string(place->warnings);
  const std::vector<LayeredPhoto> photos = displayed(*place);
  ASSERT_EQ(photos.size(), 4u);

  // A photograph's own viewpoint is plainly the photograph, whatever its exposure.
  const Image8 own = srgb8_from_linear(own_view(place->model, photos[1]));
  EXPECT_GT(rephotography(own, *read_image8(input.photos[1].file)).psnr_db, 45.0);

  // From between them the pattern shows, everywhere.
  const View view = test_view(160, 120, {0.4, 0.5, 0.2});
  const ImageF picture = novel_view(place->model, view, photos, {});
  const Rephotography judged = rephotography(srgb8_from_linear(picture), true_picture(view));
  EXPECT_GT(judged.covered_percent, 99.5);
  EXPECT_GT(judged.psnr_cc_db, 35.0);
}

TEST(PlaceLayers, WhatCannotBeUsedIsNamedAndTheRestGoesOn) {
  Photos input;
  input.photos[0].file = input.folder.path() / "missing.png";
  input.photos[1].lens = photographs::pinhole_lens(320, 240, 80, 80, 80, 60);
  input.photos[2].lens.model = photographs::LensModel::simple_radial;
  input.photos[2].lens.parameters = {80, 80, 60, 0.1};
  const Result<PlaceLayers> place = place_layers(input.photos, street());
  ASSERT_TRUE(place);
  EXPECT_EQ(place->names, (std::vector<std::string>{"0003.png"}));
  ASSERT_EQ(place->warnings.size(), 3u);
  const std::string text = to_string(place->warnings);
  EXPECT_NE(text.find("missing.png"), std::string::npos);
  EXPECT_NE(text.find("photograph 0001.png: the picture is 160 x 120, its camera's 320 x 240"),
            std::string::npos);
  EXPECT_NE(text.find("photograph 0002.png: its lens has distortion"), std::string::npos);
}

TEST(PlaceLayers, WithoutAnyPhotographThereIsNoPlace) {
  Photos input;
  for (photographs::Photograph& photo : input.photos) photo.file = input.folder.path() / "missing.png";
  EXPECT_FALSE(place_layers(input.photos, street()));
  EXPECT_FALSE(place_layers({}, street()));
}

}  // namespace
}  // namespace parvis::facades

#include "capture/facades/place_layers.h"

#include <gtest/gtest.h>

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

TEST(PlaceLayers, FromPhotographsToLayers) {
  const Photos input;
  const Result<PlaceLayers> place = place_layers(input.photos, street());
  ASSERT_TRUE(place) << to_string(place.errors());
  EXPECT_TRUE(place->warnings.empty()) << to_string(place->warnings);
  ASSERT_EQ(place->names.size(), 4u);
  EXPECT_EQ(place->surfaces, std::vector<Filling>(place->model.objects.size(), Filling::proposal));
  std::size_t filled = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const Image8 photograph = *read_image8(input.photos[i].file);
    for (std::size_t l = 0; l < place->layered[i].layers.size(); ++l) {
      const PixelBox& box = place->layered[i].layers[l].box;
      for (int y = 0; y < box.height; ++y)
        for (int x = 0; x < box.width; ++x) {
          if (place->layered[i].masks[l].at(x, y)[0] == 0) continue;
          const std::uint8_t *own = place->originals[i][l].at(x, y),
                             *there = photograph.at(x + box.x, y + box.y);
          for (int c = 0; c < 3; ++c) EXPECT_NEAR(own[c], there[c], 1) << "whatever its exposure";
          const auto source = FillSource(*place->filled[i].sources[l].at(x, y));
          EXPECT_NE(source, FillSource::none);
          filled += source != FillSource::seen;
        }
    }
  }
  EXPECT_GT(filled, 1000u) << "the near wall and the post hide a part of the far one";
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

TEST(PlaceLayers, AModelThatNoCameraSeesIsNoPlace) {
  const Photos input;
  const Result<PlaceLayers> place = place_layers(input.photos, {wall("behind", -6, -4, 4, -2, 3)});
  ASSERT_FALSE(place);
  const std::string text = to_string(place.errors());
  EXPECT_NE(text.find("0003.png: its camera sees nothing"), std::string::npos) << text;
  EXPECT_NE(text.find("no photograph sees anything of the model"), std::string::npos) << text;
}

TEST(PlaceLayers, WithoutAnyPhotographThereIsNoPlace) {
  Photos input;
  for (photographs::Photograph& photo : input.photos) photo.file = input.folder.path() / "missing.png";
  EXPECT_FALSE(place_layers(input.photos, street()));
  EXPECT_FALSE(place_layers({}, street()));
}

}  // namespace
}  // namespace parvis::facades

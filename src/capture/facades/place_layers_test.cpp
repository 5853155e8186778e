#include "capture/facades/place_layers.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/colour.h"
#include "base/image_io.h"
#include "base/test_folder.h"
#include "capture/facades/rephotography.h"
#include "capture/facades/test_model.h"

namespace parvis::facades {
namespace {

glm::vec3 pattern(glm::dvec3 p) {
  return {0.4 + 0.2 * std::sin(2.0 * p.x), 0.4 + 0.2 * std::sin(3.0 * p.z + p.x), 0.05 * p.y};
}

std::vector<NamedMesh> street() {
  return {wall("far", 6, -12, 12, -8, 8), wall("near", 4, -0.7f, 0.7f, -2, 2),
          wall("post", 3, 1.5f, 1.8f, -2, 2)};
}

/// What a view sees of the street, as a PNG file, each with an exposure of its own.
photographs::Photograph photograph(const TestFolder& folder, const std::string& name, const View& view,
                                   float exposure) {
  const LayerModel model = model_of(street());
  const ItemBuffer seen = item_buffer(model, view);
  ImageF picture(view.width, view.height, 4, 1.0f);
  for (int y = 0; y < view.height; ++y)
    for (int x = 0; x < view.width; ++x)
      for (int c = 0; c < 3; ++c)
        picture.at(x, y)[c] =
            exposure * pattern(view.to_world({x + 0.5, y + 0.5}, seen.depths[seen.index(x, y)]))[c];
  photographs::Photograph photo;
  photo.name = name, photo.file = folder.path() / name;
  EXPECT_TRUE(write_image(photo.file, srgb8_from_linear(picture)));
  photo.lens = photographs::pinhole_lens(view.width, view.height, view.fx, view.fy, view.cx, view.cy);
  glm::dmat4 opencv_from_world(view.camera_from_world);
  opencv_from_world[3] = glm::dvec4(-(view.camera_from_world * view.centre), 1.0);
  photo.world_from_camera = photographs::world_from_camera_of_opencv(opencv_from_world);
  return photo;
}

struct Photos {
  TestFolder folder;
  std::vector<photographs::Photograph> photos;
  Photos() {
    for (int i = 0; i < 4; ++i)
      photos.push_back(photograph(folder, fmt::format("{:04}.png", i),
                                  test_view(160, 120, {1.3 * i - 2.0, 0, 0}), 0.8f + 0.1f * float(i)));
  }
};

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
  const ItemBuffer seen = item_buffer(place->model, view);
  ImageF truth(160, 120, 4, 1.0f);
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 160; ++x)
      for (int c = 0; c < 3; ++c)
        truth.at(x, y)[c] = pattern(view.to_world({x + 0.5, y + 0.5}, seen.depths[seen.index(x, y)]))[c];
  const Rephotography judged = rephotography(srgb8_from_linear(picture), srgb8_from_linear(truth));
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

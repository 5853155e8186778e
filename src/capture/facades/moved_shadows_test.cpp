#include "capture/facades/moved_shadows.h"

#include <gtest/gtest.h>

#include "capture/facades/test_street.h"

namespace parvis::facades {
namespace {

constexpr int shadow_left = 20, shadow_right = 60, shadow_top = 40,
              shadow_bottom = 80;  // of a shadow in photograph 1, on the far wall

/// The street's photographs; in one of them a rectangle has a third of the light.
std::vector<PreparedPhoto> shadowed(const Photos& input) {
  const LayerModel model = model_of(street());
  std::vector<PreparedPhoto> photos;
  for (const photographs::Photograph& photo : input.photos) {
    photos.push_back(*prepared_photo(photo, model));
    const float exposure = 0.8f + 0.1f * float(photos.size() - 1);
    for (float& value : photos.back().colours.pixels) value /= exposure;  // balanced
  }
  for (int y = shadow_top; y < shadow_bottom; ++y)
    for (int x = shadow_left; x < shadow_right; ++x)
      for (int c = 0; c < 3; ++c) photos[1].colours.at(x, y)[c] /= 3.0f;
  return photos;
}

/// Mean ratio of a rectangle's light to what the street has there.
double light(const PreparedPhoto& photo, const ImageF& colours, int x0, int y0, int x1, int y1) {
  const LayerModel model = model_of(street());
  double seen = 0.0, truth = 0.0;
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x) {
      const float depth = photo.depths[std::size_t(y) * std::size_t(photo.view.width) + std::size_t(x)];
      seen += double(colours.at(x, y)[0]);
      truth += double(pattern(photo.view.to_world({x + 0.5, y + 0.5}, depth))[0]);
    }
  return seen / truth;
}

TEST(MovedShadows, AShadowInOnePhotographIsLightAsInTheOthers) {
  const Photos input;
  std::vector<PreparedPhoto> photos = shadowed(input);
  EXPECT_NEAR(light(photos[1], photos[1].colours, shadow_left + 4, shadow_top + 4, shadow_right - 4,
                    shadow_bottom - 4),
              0.333, 0.01)
      << "the control: it is there";
  const std::vector<ImageF> gains = shadow_gains(photos);
  apply_gains(gains[1], photos[1].colours);
  EXPECT_NEAR(light(photos[1], photos[1].colours, shadow_left + 4, shadow_top + 4, shadow_right - 4,
                    shadow_bottom - 4),
              1.0, 0.12);
  EXPECT_NEAR(light(photos[1], photos[1].colours, shadow_left, 90, shadow_right, 115), 1.0, 0.05)
      << "beside it nothing changes";
  for (const std::size_t other : {0u, 2u, 3u}) {
    apply_gains(gains[other], photos[other].colours);
    EXPECT_NEAR(light(photos[other], photos[other].colours, 10, 30, 150, 110), 1.0, 0.04) << other;
  }
}

TEST(MovedShadows, WithoutThreeWitnessesNothingChanges) {
  const Photos input;
  std::vector<PreparedPhoto> photos = shadowed(input);
  photos.resize(2);
  for (const ImageF& gains : shadow_gains(photos))
    for (const float gain : gains.pixels) ASSERT_EQ(gain, 1.0f);
}

TEST(MovedShadows, APlaceFlattensThemOnRequestAlone) {
  Photos input;
  Result<Image8> picture = read_image8(input.photos[1].file);
  ASSERT_TRUE(picture);
  for (int y = shadow_top; y < shadow_bottom; ++y)
    for (int x = shadow_left; x < shadow_right; ++x)
      for (int c = 0; c < 3; ++c)
        picture->at(x, y)[c] = std::uint8_t(
            255.0f * srgb_from_linear(linear_from_srgb(float(picture->at(x, y)[c]) / 255.0f) / 3.0f));
  ASSERT_TRUE(write_image(input.photos[1].file, *picture));
  PlaceSettings settings{.finds_occluders = false};
  const auto brightness = [&] {  // of the layer's own pixel in the middle of the shadow
    const Result<PlaceLayers> place = place_layers(input.photos, street(), settings);
    EXPECT_TRUE(place);
    for (std::size_t l = 0; l < place->originals[1].size(); ++l)
      if (place->layered[1].layers[l].name.ends_with(" far")) {
        const PixelBox& box = place->layered[1].layers[l].box;
        return int(place->originals[1][l].at(40 - box.x, 60 - box.y)[0]);
      }
    return -1;
  };
  const int before = brightness();
  settings.flattens_shadows = true;
  EXPECT_GT(brightness(), before + 40);
}

}  // namespace
}  // namespace parvis::facades

#include "capture/facades/layered_photo.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/colour.h"
#include "capture/facades/blend.h"
#include "capture/facades/test_model.h"

namespace parvis::facades {
namespace {

glm::vec3 pattern(glm::dvec3 p) {
  return {0.4 + 0.2 * std::sin(2.0 * p.x), 0.4 + 0.2 * std::sin(3.0 * p.z + p.x), 0.1 * p.y};
}

struct Street {
  LayerModel model = model_of({wall("far", 6, -9, 9, -6, 6), wall("near", 4, -0.7f, 0.7f, -2, 2),
                               wall("post", 3, 1.5f, 1.8f, -2, 2)});
  std::vector<View> views;
  std::vector<VisibilityLayers> visibility;
  std::vector<LayeredView> layered;
  std::vector<Image8> photographs;

  explicit Street(const std::vector<double>& xs) {
    for (const double x : xs) views.push_back(test_view(160, 120, {x, 0, 0}));
    visibility = visibility_layers(model, views, std::vector<std::string>(xs.size(), "test"));
    for (std::size_t i = 0; i < views.size(); ++i) {
      layered.push_back(image_layers(model, views[i], visibility[i], 32));
      const ItemBuffer seen = item_buffer(model, views[i]);
      ImageF picture(160, 120, 4, 1.0f);
      for (int y = 0; y < 120; ++y)
        for (int px = 0; px < 160; ++px)
          for (int c = 0; c < 3; ++c)
            picture.at(px, y)[c] =
                pattern(views[i].to_world({px + 0.5, y + 0.5}, seen.depths[seen.index(px, y)]))[c];
      photographs.push_back(srgb8_from_linear(picture));
    }
  }
  LayersOfModel layers(std::size_t i) const { return {model, views[i], visibility[i], layered[i]}; }
  LayeredPhoto photo(std::size_t i) const {
    return layered_photo("test", layers(i), original_pixels(photographs[i], layered[i]));
  }
};

TEST(LayerAtlas, LayersDoNotOverlapAndTheirRimsGoOn) {
  const Street street({0.0});
  const LayerPixels pixels = original_pixels(street.photographs[0], street.layered[0]);
  const LayerAtlas atlas = layer_atlas(street.layered[0], pixels);
  EXPECT_EQ(atlas.colours.width % 4, 0);
  EXPECT_EQ(atlas.colours.height % 4, 0);
  std::size_t texels = 0;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const glm::ivec2 at = atlas.offsets[i];
    for (int y = 0; y < pixels[i].height; ++y)
      for (int x = 0; x < pixels[i].width; ++x)
        if (pixels[i].at(x, y)[3]) {
          EXPECT_TRUE(
              std::equal(pixels[i].at(x, y), pixels[i].at(x, y) + 4, atlas.colours.at(at.x + x, at.y + y)));
        }
    const PixelBox box{at.x - atlas_border, at.y - atlas_border, pixels[i].width + 2 * atlas_border,
                       pixels[i].height + 2 * atlas_border};
    EXPECT_GE(box.x, 0);
    EXPECT_GE(box.y, 0);
    EXPECT_LE(box.y + box.height, atlas.colours.height);
    EXPECT_EQ(atlas.colours.at(at.x - 3, at.y + 5)[3], 255) << "the rim is not repeated";
    for (std::size_t k = 0; k < i; ++k) {
      const PixelBox other{atlas.offsets[k].x, atlas.offsets[k].y, pixels[k].width, pixels[k].height};
      EXPECT_TRUE(box.x + box.width <= other.x || other.x + other.width <= box.x ||
                  box.y + box.height <= other.y || other.y + other.height <= box.y);
    }
    texels += std::size_t(box.width) * std::size_t(box.height);
  }
  EXPECT_GE(atlas.compressed_bytes(), texels);
  EXPECT_LE(atlas.compressed_bytes(), 2 * texels);
}

TEST(LayeredPhoto, ItsOwnViewpointIsPlainlyThePhotograph) {
  const Street street({0.4});
  const Image8 own = srgb8_from_linear(own_view(street.model, street.photo(0)));
  for (std::size_t i = 0; i < own.pixels.size(); ++i)
    EXPECT_LE(std::abs(own.pixels[i] - street.photographs[0].pixels[i]), 1) << i;
}

// Figure 3.1: from another place the wall behind shows what was painted on its layer, not the wall before it.
TEST(LayeredPhoto, WhatWasHiddenShowsItsOwnLayer) {
  const Street street({0.0});
  LayerPixels pixels = original_pixels(street.photographs[0], street.layered[0]);
  for (std::size_t l = 0; l < pixels.size(); ++l)
    for (int y = 0; y < pixels[l].height; ++y)
      for (int x = 0; x < pixels[l].width; ++x)
        if (street.layered[0].masks[l].at(x, y)[0] && !street.layered[0].masks[l].at(x, y)[1])
          pixels[l].at(x, y)[0] = 255, pixels[l].at(x, y)[1] = 0;
  const std::vector<LayeredPhoto> photos = {layered_photo("test", street.layers(0), pixels)};
  const View view = test_view(160, 120, {1.2, 0, 0});
  const ImageF picture = novel_view(street.model, view, photos, {});
  const ItemBuffer seen = item_buffer(street.model, view), from = item_buffer(street.model, street.views[0]);
  int hidden = 0;
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 160; ++x) {
      const glm::dvec3 point = view.to_world({x + 0.5, y + 0.5}, seen.depths[seen.index(x, y)]);
      const glm::dvec3 p = street.views[0].to_camera(point);
      const glm::dvec2 pixel = street.views[0].to_pixel(p);
      if (pixel.x < 2 || pixel.x > 158) continue;
      const float before = from.depths[from.index(int(pixel.x), int(pixel.y))];
      const bool is_hidden = p.z > before + 0.5;
      hidden += is_hidden;
      // Pixels at the rim mix both.
      const float left = from.depths[from.index(int(pixel.x) - 1, int(pixel.y))],
                  right = from.depths[from.index(int(pixel.x) + 1, int(pixel.y))];
      if (left != before || right != before) continue;
      if (is_hidden)
        EXPECT_GT(picture.at(x, y)[0], 0.95f);
      else
        EXPECT_NEAR(picture.at(x, y)[1], pattern(point).y, 0.05) << x << "," << y;
    }
  EXPECT_GT(hidden, 300);
}

TEST(LayeredPhoto, WhatAnotherPhotographSawIsPreferredToWhatWasFilled) {
  const Street street({0.0, -2.5});
  const std::vector<LayeredPhoto> photos = {street.photo(0), street.photo(1)};
  // Behind "near" in the first photograph, seen by the second; the eye stands by the first.
  const glm::dvec3 point(-0.3, 6, 0);
  const std::uint32_t triangle = item_buffer(street.model, street.views[1]).triangles[60 * 160 + 109];
  ASSERT_EQ(street.model.triangles[triangle].object, 0u);
  const std::vector<Opinion> found = opinions(photos, {}, triangle, point, {0.2, 0, 0}, 0.05);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].photo, 1u);
  EXPECT_GT(found[0].confidence, 20.0f * found[1].confidence);
}

TEST(LayeredPhoto, AnAlphaMapMakesItsLayerSeeThrough) {
  const Street street({0.0});
  LayerPixels pixels = original_pixels(street.photographs[0], street.layered[0]);
  for (std::size_t l = 0; l < pixels.size(); ++l)
    if (street.layered[0].layers[l].name.ends_with("post"))
      for (std::size_t p = 3; p < pixels[l].pixels.size(); p += 4) pixels[l].pixels[p] = 0;
  const LayeredPhoto photo = layered_photo("test", street.layers(0), pixels);
  const ImageF own = own_view(street.model, photo);
  const ItemBuffer seen = item_buffer(street.model, street.views[0]);
  for (std::size_t i = 0; i < seen.triangles.size(); ++i)
    EXPECT_EQ(own.pixels[4 * i + 3] < 0.01f, street.model.triangles[seen.triangles[i]].object == 2) << i;
}

}  // namespace
}  // namespace parvis::facades

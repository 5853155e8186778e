#include "capture/facades/packed_facade.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "base/files.h"
#include "base/test_data.h"
#include "capture/facades/facade_lookup.h"
#include "capture/facades/rephotography.h"
#include "capture/facades/test_measure_place.h"
#include "capture/facades/test_street.h"

namespace parvis::facades {
namespace {

struct Packed {
  Photos input;
  PlaceLayers place;
  PackedFacade facade;
  std::vector<ItemBuffer> seen;

  Packed() {
    Result<PlaceLayers> made = place_layers(input.photos, street());
    EXPECT_TRUE(made) << to_string(made ? Errors{} : made.errors());
    place = *std::move(made);
    facade = packed_facade(place);
    for (const View& view : place.views) seen.push_back(item_buffer(place.model, view));
  }
  /// The object that photograph `photo` sees at a pixel.
  std::string object_at(std::size_t photo, int x, int y) const {
    const std::uint32_t triangle = seen[photo].triangles[seen[photo].index(x, y)];
    return place.model.objects[place.model.triangles[triangle].object].name;
  }
  Image8 picture(const View& view) const {
    const ImageF shown = view_of_facade(facade, FacadeTexels(facade), view);
    Image8 bytes(shown.width, shown.height, 4);
    for (std::size_t i = 0; i < bytes.pixels.size(); ++i)
      bytes.pixels[i] = std::uint8_t(std::lround(255.0f * std::clamp(shown.pixels[i], 0.0f, 1.0f)));
    return bytes;
  }
};

TEST(PackedFacade, AnOwnViewpointIsPlainlyThePhotograph) {
  const Packed packed;
  for (std::size_t i = 0; i < 4; ++i) {
    const Image8 photograph = *read_image8(packed.input.photos[i].file);
    const Rephotography judged = rephotography(packed.picture(packed.place.views[i]), photograph);
    EXPECT_GT(judged.psnr_db, 43.0) << i << ": blocks at outlines hold one line of colours, with alpha";
    EXPECT_EQ(judged.covered_percent, 100.0);
  }
  // The control: another photograph's picture is not this one.
  EXPECT_LT(
      rephotography(packed.picture(packed.place.views[0]), *read_image8(packed.input.photos[1].file)).psnr_db,
      25.0);
}

TEST(PackedFacade, BetweenPhotographsItShowsThePlaceEverywhere) {
  const Packed packed;
  const View view = test_view(160, 120, {0.4, 0.5, 0.2});
  const Rephotography judged = rephotography(packed.picture(view), true_picture(view));
  EXPECT_EQ(judged.covered_percent, 100.0);
  EXPECT_GT(judged.psnr_cc_db, 34.0);
}

/// The layers of a photograph that hold an object.
std::vector<std::size_t> layers_of(const PlaceLayers& place, std::size_t photo, const std::string& object) {
  std::vector<std::size_t> found;
  for (std::size_t l = 0; l < place.layered[photo].layers.size(); ++l)
    if (std::ranges::any_of(place.layered[photo].layers[l].items, [&](std::uint32_t item) {
          return place.model.objects[place.visibility[photo].items[item].object].name == object;
        }))
      found.push_back(l);
  return found;
}

/// Pixels of two pictures, 0..1, that are far from one colour, by red and green.
std::size_t differing(const ImageF& a, const ImageF& b) {
  std::size_t count = 0;
  for (std::size_t p = 0; p < a.pixels.size(); p += 4)
    count += std::abs(a.pixels[p] - b.pixels[p]) > 0.2f || std::abs(a.pixels[p + 1] - b.pixels[p + 1]) > 0.2f;
  return count;
}

/// A place of which one photograph was taken, packed.
struct OnePhotograph {
  Photos input;
  PlaceLayers place = *place_layers({input.photos[2]}, street());
  View own = place.views[0], aside = test_view(160, 120, {1.6, 0, 0});

  ImageF shown(const View& view) const {
    const PackedFacade facade = packed_facade(place);
    return view_of_facade(facade, FacadeTexels(facade), view);
  }
};

// Figure 3.1: from another place the wall behind shows what its layer has, not the wall before it.
TEST(PackedFacade, WhatWasHiddenShowsItsOwnLayer) {
  OnePhotograph one;
  const ImageF own = one.shown(one.own), aside = one.shown(one.aside);
  Filled& filled = one.place.filled[0];
  for (const std::size_t l : layers_of(one.place, 0, "far"))
    for (std::size_t p = 0; p < filled.sources[l].pixels.size(); ++p)
      if (filled.sources[l].pixels[p] > std::uint8_t(FillSource::seen)) {
        std::uint8_t* pixel = filled.pixels[l].pixels.data() + 4 * p;
        pixel[0] = 255, pixel[1] = 0;
      }
  EXPECT_GT(differing(aside, one.shown(one.aside)), 300u);
  EXPECT_LT(differing(own, one.shown(one.own)), 60u)
      << "nothing that is hidden shows, but in filters at rims";
}

TEST(PackedFacade, ARefusedProposalIsNotShown) {
  const Packed packed;
  const std::vector<View> views = random_views(packed.place.views, 20);
  EXPECT_EQ(shown_shares(packed.facade, views).filled_percent, 100.0);
  OnePhotograph one;
  const auto shares = [&] { return shown_shares(packed_facade(one.place), {&one.aside, 1}); };
  const ShownShares with = shares();
  EXPECT_EQ(with.filled_percent, 100.0);
  for (Filling& state : one.place.filled[0].states)
    if (state == Filling::proposal) state = Filling::refused;
  const ShownShares without = shares();
  EXPECT_LT(without.layered_percent, with.layered_percent - 2.0) << "what hides the wall is not its colour";
  EXPECT_EQ(without.filled_percent, 100.0) << "surfaces have their proposed colours";
}

// The balcony: an artist's alpha lets what is behind show.
TEST(PackedFacade, AnAlphaMapMakesItsLayerSeeThrough) {
  Packed packed;
  for (std::size_t i = 0; i < packed.place.names.size(); ++i)
    for (const std::size_t l : layers_of(packed.place, i, "post")) {
      const PixelBox& box = packed.place.layered[i].layers[l].box;
      for (int y = 0; y < box.height; ++y)
        for (int x = 0; x < box.width; ++x) {
          if (packed.object_at(i, x + box.x, y + box.y) != "post") continue;
          packed.place.filled[i].pixels[l].at(x, y)[3] = 0;
          *packed.place.filled[i].sources[l].at(x, y) = std::uint8_t(FillSource::painted);
        }
    }
  const PackedFacade facade = packed_facade(packed.place);
  const View& view = packed.place.views[1];
  const ImageF picture = view_of_facade(facade, FacadeTexels(facade), view);
  int posts = 0;
  for (int y = 0; y < view.height; ++y)
    for (int x = 0; x < view.width; ++x) {
      const bool is_post = packed.object_at(1, x, y) == "post";
      posts += is_post;
      EXPECT_EQ(picture.at(x, y)[3] < 0.5f, is_post) << x << "," << y;
    }
  EXPECT_GT(posts, 100);
}

TEST(PackedFacade, HiddenPartsThatOthersShowAreNotStored) {
  const Packed packed;
  std::size_t boxes = 0;
  for (const PackedLayer& layer : packed.facade.layers) boxes += std::size_t(layer.across() * layer.down());
  EXPECT_EQ(boxes, packed.facade.tiles.size());
  EXPECT_LE(packed.facade.slot_count(), boxes);
  EXPECT_GT(packed.facade.slot_count(), 4u * 4u) << "a picture of 160 x 120 has 3 x 2 tiles";
  EXPECT_LT(double(packed.facade.texture_bytes()) / double(packed.facade.photograph_bytes()), 0.8);
}

TEST(MeasurePlace, EveryFigureIsThere) {
  const Photos input;
  const Result<PlaceFigures> figures = measured_place(input.photos, street(), {"0001.png"}, {10, true});
  ASSERT_TRUE(figures) << to_string(figures.errors());
  ASSERT_EQ(figures->methods.size(), 5u);
  for (const MethodFigures& method : figures->methods) {
    EXPECT_GT(method.psnr_cc_db, 25.0) << method.method;
    EXPECT_GT(method.covered_percent, 90.0) << method.method;
  }
  EXPECT_EQ(figures->filled.filled_percent, 100.0);
  EXPECT_GT(figures->filled.layered_percent, 90.0);
  EXPECT_GT(figures->unfilled.filled_percent, 0.0) << "the control; surface_colours_test sees it fail";
  EXPECT_EQ(figures->uncovered_percent, 0.0) << "the control";
  EXPECT_GE(figures->layers_s, figures->layers_s_per_photo);
  EXPECT_GT(figures->uncompressed_share_percent, figures->texture_share_percent) << "the control";
  EXPECT_GT(figures->uncompressed_over_extracted, figures->texture_over_extracted) << "the control";
  EXPECT_EQ(figures->psd_changed_px, 1u) << "the control: one pixel was changed";
  EXPECT_LT(figures->aside_viewpoint_psnr_db, figures->own_viewpoint_psnr_db - 3.0) << "the control";
  EXPECT_GT(figures->own_viewpoint_covered_percent, 99.0);
  EXPECT_GT(figures->own_viewpoint_psnr_db, 43.0);
  EXPECT_EQ(figures->psd_roundtrip_differing_px, 0u);
  EXPECT_FALSE(measured_place(input.photos, street(), {"nobody.png"}));
}

TEST(PackedFacade, AFileIsReadBackAsItWas) {
  const Packed packed;
  const TestFolder folder;
  const std::filesystem::path file = folder.path() / "a.facade";
  ASSERT_TRUE(write_facade(file, packed.facade));
  const Result<PackedFacade> back = read_facade(file);
  ASSERT_TRUE(back) << to_string(back.errors());
  EXPECT_EQ(back->blocks, packed.facade.blocks);
  EXPECT_EQ(back->tiles, packed.facade.tiles);
  EXPECT_EQ(back->surfaces, packed.facade.surfaces);
  EXPECT_EQ(back->photos[2].name, packed.facade.photos[2].name);
}

TEST(PackedFacade, WhatDoesNotFitTogetherIsRefused) {
  const Packed packed;
  const TestFolder folder;
  const std::filesystem::path file = folder.path() / "a.facade";
  const auto refused = [&](auto change) {
    PackedFacade bad = packed.facade;
    change(bad);
    EXPECT_TRUE(write_facade(file, bad));
    const Result<PackedFacade> back = read_facade(file);
    return back ? std::string() : to_string(back.errors());
  };
  EXPECT_NE(refused([](PackedFacade& f) { f.candidates[0] = 999999; }).find("a layer that is not there"),
            std::string::npos);
  EXPECT_NE(refused([](PackedFacade& f) { f.tiles[0] = 1u | 999999u << 2; }).find("a tile has no texture"),
            std::string::npos);
  EXPECT_NE(refused([](PackedFacade& f) { f.layers[0].box.x = 500; }).find("outside of its photograph"),
            std::string::npos);
  EXPECT_NE(refused([](PackedFacade& f) { f.photos[0].view.fx = NAN; }).find("camera is none"),
            std::string::npos);
  EXPECT_NE(refused([](PackedFacade& f) { f.photos[0].view.centre.x = 1e200; }).find("camera is none"),
            std::string::npos)
      << "the shader's floats do not hold it";
  EXPECT_NE(refused([](PackedFacade& f) { f.corners.pop_back(); }).find("differ in length"),
            std::string::npos);
  EXPECT_NE(refused([](PackedFacade& f) { f.lists[0].y = 77777; }).find("cut off"), std::string::npos);
  EXPECT_EQ(refused([](PackedFacade&) {}), "");

  ASSERT_TRUE(write_facade(file, packed.facade));
  std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
  EXPECT_FALSE(read_facade(file));
  EXPECT_FALSE(read_facade(folder.path() / "missing.facade"));
}

/// Numbers that fit into a file, and whose products do not fit into the shader's floats.
TEST(PackedFacade, APointFarBeyondItsPhotographsHasNoColour) {
  const Packed packed;
  PackedFacade facade = packed.facade;
  const FacadeTexels texels(facade);
  for (const float far : {1e30f, -1e30f, 3e38f, -3e38f})
    for (const glm::vec3 direction : {glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(1, 1, 1)}) {
      FacadeLookup lookup(facade, &texels);
      for (std::uint32_t layer = 0; layer < facade.layers.size(); ++layer)
        EXPECT_EQ(lookup.key(layer, far * direction, {0, 0, 1}, 0.01f), FacadeLookup::no_opinion);
    }
}

/// script/fuzz_seeds has written them.
TEST(PackedFacade, TheFuzzersSeedsReachTheEndOfTheReader) {
  std::size_t slots = 0;
  for (const auto& seed :
       std::filesystem::directory_iterator(source_folder() / "src/capture/facades/fuzz/corpus/facade")) {
    const Result<PackedFacade> facade = facade_of(*read_file(seed.path()), seed.path());
    ASSERT_TRUE(facade) << to_string(facade.errors());
    EXPECT_EQ(facade->triangle_count(), 2u);
    slots += facade->slot_count();
  }
  EXPECT_EQ(slots, 4u);
}

}  // namespace
}  // namespace parvis::facades

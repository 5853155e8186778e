#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "base/files.h"
#include "capture/facades/coarse_model_file.h"
#include "capture/facades/place_folder.h"
#include "capture/facades/psd.h"
#include "capture/facades/test_street.h"
#include "formats/gltf/gltf_reader.h"

namespace parvis::facades {
namespace {
namespace fs = std::filesystem;

/// The street as a stage of the program finds it in a file.
std::vector<NamedMesh> read_street(const fs::path& file) {
  EXPECT_TRUE(write_meshes(file, street()));
  Errors warnings;
  const Result<scene::Model> model = scene::read_gltf(file, warnings);
  EXPECT_TRUE(model) << to_string(model ? Errors{} : model.errors());
  return model ? named_meshes(*model) : std::vector<NamedMesh>{};
}

/// A place on disk whose layered pictures are written.
struct Written {
  Photos input;
  fs::path folder = input.folder.path() / "place";
  PlaceSource source{folder, read_street(folder / "model.glb"), input.photos, {}};

  Written() { write(made()); }
  PlaceLayers made() const {
    Result<PlaceLayers> place = make_place(source);
    EXPECT_TRUE(place) << to_string(place ? Errors{} : place.errors());
    return place ? *std::move(place) : PlaceLayers{};
  }
  void write(const PlaceLayers& place) const {
    const Status status = write_layered_pictures(source, place);
    EXPECT_TRUE(status) << to_string(status ? Errors{} : status.errors());
  }
  fs::path psd() const { return folder / "layers" / "0001.psd"; }
};

PsdLayer& layer_of(PsdPicture& picture, const std::string& object) {
  for (PsdLayer& layer : picture.layers)
    if (layer.name.ends_with(" " + object)) return layer;
  ADD_FAILURE() << object;
  return picture.layers.front();
}

/// A square of the far wall is painted blue in the picture of photograph 0001.
void paint_far(const fs::path& file) {
  Result<PsdPicture> picture = read_psd(file);
  ASSERT_TRUE(picture) << to_string(picture.errors());
  PsdLayer& far = layer_of(*picture, "far");
  for (int y = 20; y < 30; ++y)
    for (int x = 20; x < 30; ++x) {
      std::uint8_t* p = far.pixels.at(x - far.box.x, y - far.box.y);
      p[0] = 1, p[1] = 2, p[2] = 250;
    }
  ASSERT_TRUE(write_psd(file, *picture));
}

/// Pixels of photograph 0001's layer `object` that are blue, and of these the ones marked as painted.
std::pair<int, int> blue_pixels(const PlaceLayers& place, const std::string& object) {
  std::pair<int, int> count;
  for (std::size_t l = 0; l < place.layered[1].layers.size(); ++l) {
    if (!place.layered[1].layers[l].name.ends_with(" " + object)) continue;
    const Filled& filled = place.filled[1];
    for (std::size_t p = 0; p < filled.sources[l].pixels.size(); ++p)
      if (filled.pixels[l].pixels[4 * p + 2] == 250 && filled.pixels[l].pixels[4 * p] == 1) {
        ++count.first;
        count.second += filled.sources[l].pixels[p] == std::uint8_t(FillSource::painted);
      }
  }
  return count;
}

TEST(PlaceEdits, WhatWasPaintedIsCollectedAndKept) {
  const Written place;
  EXPECT_EQ(blue_pixels(place.made(), "far"), std::pair(0, 0)) << "the control: nothing was painted yet";
  paint_far(place.psd());
  const PlaceLayers painted = place.made();
  ASSERT_EQ(painted.warnings.size(), 1u)
      << "all layers are found by their names: " << to_string(painted.warnings);
  EXPECT_NE(painted.warnings[0].message.find("0001.png: other photographs show"), std::string::npos)
      << to_string(painted.warnings);
  EXPECT_EQ(blue_pixels(painted, "far"), std::pair(100, 100));
  // Written once more, the picture holds the edit, and nothing is collected twice.
  place.write(painted);
  EXPECT_EQ(blue_pixels(place.made(), "far"), std::pair(100, 100));
  // The packed facade shows it at the photograph's own place.
  EXPECT_TRUE(fs::exists(place.folder / "layers" / "edits" / "0001.edits"));
}

TEST(PlaceEdits, AreCarriedIntoPhotographsThatShowThePlace) {
  const Written place;
  paint_far(place.psd());
  const auto blue_elsewhere = [](const PlaceLayers& made) {
    int count = 0;
    for (const std::size_t photo : {0u, 2u})
      for (const Image8& layer : made.filled[photo].pixels)
        for (std::size_t p = 0; p < layer.pixels.size(); p += 4)
          count += layer.pixels[p] == 1 && layer.pixels[p + 1] == 2 && layer.pixels[p + 2] == 250;
    return count;
  };
  EXPECT_EQ(blue_elsewhere(place.made()), 0);
  PlaceSettings settings;
  settings.carries_edits = true;
  const Result<PlaceLayers> carried = make_place(place.source, settings);
  ASSERT_TRUE(carried) << to_string(carried.errors());
  EXPECT_TRUE(carried->warnings.empty()) << to_string(carried->warnings);
  EXPECT_EQ(blue_pixels(*carried, "far"), std::pair(100, 100));
  // The cameras look the same way from as far: each sees the square as large, where nothing hides it.
  EXPECT_GE(blue_elsewhere(*carried), 80);
}

TEST(PlaceEdits, SurviveAChangedModelOrAreReported) {
  Written place;
  paint_far(place.psd());
  place.source.meshes = {wall("far", 6.1f, -12, 12, -9, 9), wall("near", 4, -0.7f, 0.7f, -2, 2)};
  const PlaceLayers moved = place.made();
  EXPECT_EQ(blue_pixels(moved, "far"), std::pair(100, 100)) << to_string(moved.warnings);
  // The wall is gone: what was painted on it has no place, is named, and stays in the edits.
  place.source.meshes = {wall("near", 4, -0.7f, 0.7f, -2, 2)};
  const PlaceLayers gone = place.made();
  EXPECT_NE(to_string(gone.warnings).find("far"), std::string::npos) << to_string(gone.warnings);
  place.source.meshes = street();
  EXPECT_EQ(blue_pixels(place.made(), "far"), std::pair(100, 100));
}

TEST(PlaceEdits, APictureThatCannotBeReadIsNamedAndLeftAsItIs) {
  const Written place;
  const std::string broken = "8BPS, but not really";
  ASSERT_TRUE(write_file(place.psd(), broken));
  const PlaceLayers made = place.made();
  EXPECT_NE(to_string(made.warnings).find("0001.psd"), std::string::npos) << to_string(made.warnings);
  EXPECT_EQ(*read_file(place.psd()), broken);
  EXPECT_EQ(made.names.size(), 4u) << "the rest goes on";
  const Status status = write_layered_pictures(place.source, made);
  ASSERT_FALSE(status);
  EXPECT_NE(to_string(status.errors()).find("0001.psd"), std::string::npos) << to_string(status.errors());
  EXPECT_EQ(*read_file(place.psd()), broken) << "somebody's work is not written over";
}

}  // namespace
}  // namespace parvis::facades

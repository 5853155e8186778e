#include "capture/facades/kept_layers.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>

#include "base/files.h"
#include "base/sealed_file.h"
#include "capture/facades/place_folder.h"
#include "capture/facades/test_street.h"

namespace parvis::facades {
namespace {
namespace fs = std::filesystem;

struct Place {
  Photos input;
  fs::path folder = input.folder.path() / "place", kept = folder / "layers" / "kept",
           found = kept / "all.found";
  PlaceSource source{folder, street(), input.photos, {}};

  PlaceLayers made(const PlaceSettings& settings = {}) const {
    Result<PlaceLayers> place = make_place(source, settings);
    EXPECT_TRUE(place) << to_string(place ? Errors{} : place.errors());
    return place ? *std::move(place) : PlaceLayers{};
  }
  fs::path filled(int photo) const { return kept / fmt::format("{:04}.png.filled", photo); }
};

/// Makes a file old, and says later whether it was written since.
void make_old(const fs::path& file) {
  fs::last_write_time(file, fs::file_time_type::clock::now() - std::chrono::hours(24));
}
bool is_new(const fs::path& file) {
  return fs::last_write_time(file) > fs::file_time_type::clock::now() - std::chrono::hours(12);
}

void expect_equal(const PlaceLayers& a, const PlaceLayers& b) {
  ASSERT_EQ(a.names, b.names);
  EXPECT_EQ(a.model.triangles.size(), b.model.triangles.size());
  for (std::size_t i = 0; i < a.names.size(); ++i) {
    EXPECT_EQ(a.balances[i].scale, b.balances[i].scale);
    ASSERT_EQ(a.layered[i].layers.size(), b.layered[i].layers.size());
    EXPECT_EQ(a.filled[i].states, b.filled[i].states);
    for (std::size_t l = 0; l < a.layered[i].layers.size(); ++l) {
      EXPECT_EQ(a.layered[i].layers[l].name, b.layered[i].layers[l].name);
      EXPECT_EQ(a.layered[i].masks[l].pixels, b.layered[i].masks[l].pixels);
      EXPECT_EQ(a.filled[i].sources[l].pixels, b.filled[i].sources[l].pixels);
      EXPECT_EQ(a.filled[i].pixels[l].pixels, b.filled[i].pixels[l].pixels);
    }
  }
}

TEST(KeptLayers, WhatIsFinishedIsTakenOverAndTheRestIsMade) {
  const Place place;
  const PlaceLayers first = place.made();
  for (const fs::path& file : {place.found, place.filled(0), place.filled(1), place.filled(3)})
    make_old(file);
  fs::remove(place.filled(2));  // the stage was stopped before its filling was kept
  expect_equal(first, place.made());
  EXPECT_FALSE(is_new(place.found)) << "visibility, balances and occluders are not found once more";
  EXPECT_FALSE(is_new(place.filled(1)));
  EXPECT_TRUE(fs::exists(place.filled(2)));
  // Another stage, without proposals, starts from the same.
  PlaceSettings plain;
  plain.fills = false;
  (void)place.made(plain);
  EXPECT_FALSE(is_new(place.found));
  EXPECT_FALSE(is_new(place.filled(1)));
}

TEST(KeptLayers, AnotherPhotographModelOrSettingIsComputedAgain) {
  Place place;
  (void)place.made();
  const auto is_computed_again = [&](const PlaceSettings& settings) {
    make_old(place.found), make_old(place.filled(1));
    (void)place.made(settings);
    return is_new(place.found) && is_new(place.filled(1));
  };
  EXPECT_FALSE(is_computed_again({})) << "the control";
  place.source.meshes[2] = wall("post", 3, 1.5f, 2.0f, -2, 2);
  EXPECT_TRUE(is_computed_again({}));
  fs::copy_file(place.input.photos[0].file, place.input.photos[1].file, fs::copy_options::overwrite_existing);
  EXPECT_TRUE(is_computed_again({}));
  PlaceSettings settings;
  settings.finds_occluders = false;
  EXPECT_TRUE(is_computed_again(settings));
}

TEST(KeptLayers, DamagedFilesCountAsAbsentWhateverTheyHold) {
  const Place place;
  const PlaceLayers first = place.made();
  const std::string bytes = *read_file(place.found);
  ASSERT_TRUE(write_file(place.found, bytes.substr(0, bytes.size() / 2)));
  ASSERT_TRUE(write_file(place.filled(1), "PVFILL_1 and no filling"));
  expect_equal(first, place.made());
  // A stranger's file with a seal of its own must not lead outside of any list: it is refused, or taken with
  // the numbers that it holds.
  const SealedKind kind{"PVFOUN_1", "layers of a place"};
  const std::string content = *read_sealed(place.found, kind);
  const std::size_t key_bytes = 8;
  const std::size_t step = std::max<std::size_t>(content.size() / 40, 1);
  std::vector<std::string> filled;
  for (int i = 0; i < 4; ++i) filled.push_back(*read_file(place.filled(i)));
  int refused = 0;
  for (std::size_t at = key_bytes; at < content.size(); at += step) {
    std::string changed = content;
    changed[at] = char(changed[at] ^ 0x55);
    ASSERT_TRUE(write_sealed(place.found, kind, changed));
    for (int i = 0; i < 4; ++i) ASSERT_TRUE(write_file(place.filled(i), filled[std::size_t(i)]));
    make_old(place.found);
    const PlaceLayers made = place.made();
    EXPECT_EQ(made.names, first.names) << at;
    if (!is_new(place.found)) continue;
    ++refused;
    expect_equal(first, made);
  }
  EXPECT_GT(refused, 10);
}

TEST(KeptLayers, BalancesThatFloatsCannotHoldAreRefused) {
  const Place place;
  PlaceLayers first = place.made();
  const LayerKeeper keeper(place.folder, 7);
  const std::vector<PreparedPhoto> prepared(first.names.size());
  ASSERT_TRUE(keeper.keep_found(first, prepared));
  EXPECT_TRUE(keeper.read_found(first)) << "the control";
  first.balances[1].scale[2] = 1e300;
  ASSERT_TRUE(keeper.keep_found(first, prepared));
  EXPECT_FALSE(keeper.read_found(first));
}

}  // namespace
}  // namespace parvis::facades

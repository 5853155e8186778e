#include "reflections/reference_maps/map_keeper.h"

#include <gtest/gtest.h>

#include "base/files.h"
#include "base/test_folder.h"
#include "reflections/reference_maps/settings.h"

namespace parvis::reference_maps {
namespace {
namespace fs = std::filesystem;

class MapKeeperTest : public ::testing::Test {
 protected:
  MapKeeperTest() {
    scene_.file = folder_.path() / "street.xp";
    map_plan(scene_).places = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}};
  }
  MapFile map(std::uint32_t number) const {
    return {map_plan(scene_).places, number, 2, {{1, 2, 3, std::uint8_t(number)}, {9, 8}}};
  }
  /// The report while two maps are kept.
  std::string keep_two() {
    testing::internal::CaptureStderr();
    {
      MapKeeper keeper{MapCache(scene_)};
      for (const std::uint32_t number : {2u, 0u}) keeper.keep(map(number));
    }
    return testing::internal::GetCapturedStderr();
  }

  TestFolder folder_;
  scene::Scene scene_;
};

TEST_F(MapKeeperTest, WhatItWasGivenIsKeptWhenItEnds) {
  EXPECT_EQ(keep_two(), "");
  const MapCache cache(scene_);
  for (const std::uint32_t number : {2u, 0u}) {
    const std::optional<MapFile> kept = cache.read(number);
    ASSERT_TRUE(kept) << number;
    EXPECT_EQ(kept->places, map(number).places);
    EXPECT_EQ(kept->textures, map(number).textures);
  }
  EXPECT_FALSE(cache.read(1));
}

TEST_F(MapKeeperTest, WhereNothingCanBeWrittenItSaysSoOnce) {
  ASSERT_TRUE(write_file(folder_.path() / "street.baked", "a file where the folder would be"));
  const std::string reported = keep_two();
  const std::size_t first = reported.find("are not kept");
  EXPECT_NE(first, std::string::npos) << reported;
  EXPECT_EQ(reported.find("are not kept", first + 1), std::string::npos) << reported;
}

TEST_F(MapKeeperTest, OfASceneMadeInMemoryItKeepsNothing) {
  scene_.file.clear();
  EXPECT_EQ(keep_two(), "");
  EXPECT_TRUE(fs::is_empty(folder_.path()));
}

}  // namespace
}  // namespace parvis::reference_maps

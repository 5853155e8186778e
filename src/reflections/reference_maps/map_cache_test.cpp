#include "reflections/reference_maps/map_cache.h"

#include <gtest/gtest.h>

#include "base/files.h"
#include "base/test_folder.h"
#include "graphics/gl/test_context.h"
#include "graphics/light/sun_and_sky.h"
#include "graphics/render/test_quads.h"
#include "graphics/render/test_room.h"
#include "reflections/reference_maps/scene_maps.h"
#include "reflections/reference_maps/settings.h"

namespace parvis::reference_maps {
namespace {
namespace fs = std::filesystem;

MapFile small_map() { return {{{1, 2, 3}, {4, 5, 6}}, 1, 2, {{1, 2, 3, 4}, {}, {9, 8}}}; }

TEST(MapFile, WhatIsWrittenIsRead) {
  const std::optional<MapFile> map = map_of(bytes_of(small_map()));
  ASSERT_TRUE(map);
  EXPECT_EQ(map->places, small_map().places);
  EXPECT_EQ(map->number, 1u);
  EXPECT_EQ(map->resolution, 2u);
  EXPECT_EQ(map->textures, small_map().textures);
}

TEST(MapFile, CutShortOrLongerItIsRefused) {
  const std::string whole = bytes_of(small_map());
  for (std::size_t length = 0; length < whole.size(); ++length)
    ASSERT_FALSE(map_of(whole.substr(0, length))) << length;
  EXPECT_FALSE(map_of(whole + "x"));
}

class MapCacheTest : public gl::ContextTest {
 protected:
  MapCacheTest() {
    scene_.file = folder_.path() / "room.xp";
    map_plan(scene_).places = {{4, 2.5f, -3.5f}, {-3.5f, -4.5f, 2}, {0, 1, 0}};
    methods::settings(scene_).resolution = 16;
  }

  /// Bakes the maps that are not kept yet; every byte of all.
  std::vector<std::vector<std::uint8_t>> keep() {
    Result<std::unique_ptr<render::Renderer>> renderer =
        render::Renderer::create(scene_, {}, light::sun_and_sky);
    EXPECT_TRUE(renderer && keep_maps(scene_, HeightPyramid(heights_of(scene_)), **renderer));
    return bake();
  }
  /// Every byte of the scene's maps, read or drawn.
  std::vector<std::vector<std::uint8_t>> bake(const render::Drawables& drawables = {}) {
    Result<std::unique_ptr<render::Renderer>> renderer =
        render::Renderer::create(scene_, drawables, light::sun_and_sky);
    EXPECT_TRUE(renderer);
    const Result<ReferenceMaps> maps = bake_maps(scene_, HeightPyramid(heights_of(scene_)), **renderer);
    EXPECT_TRUE(maps) << (maps ? "" : to_string(maps.errors()));
    std::vector<std::vector<std::uint8_t>> all;
    for (std::size_t i = 0; i < maps->places().size(); ++i)
      for (std::vector<std::uint8_t>& texture : maps->read(i)) all.push_back(std::move(texture));
    return all;
  }
  fs::path map_file(std::size_t number) const { return MapCache(scene_).file(number); }

  TestFolder folder_;
  scene::Scene scene_ = render::room_scene(8.0f);
};

TEST_F(MapCacheTest, BakedMapsAreReadAndNotDrawn) {
  const auto drawn = bake();
  EXPECT_FALSE(fs::exists(map_file(0)));
  EXPECT_EQ(keep(), drawn);
  ASSERT_TRUE(fs::exists(map_file(2)));
  EXPECT_FALSE(fs::exists(map_file(3)));
  EXPECT_EQ(bake(), drawn);

  MapFile forged = *MapCache(scene_).read(1);  // to see that it is read
  forged.textures[0].assign(forged.textures[0].size(), 0);
  ASSERT_TRUE(MapCache(scene_).write(forged));
  EXPECT_NE(bake(), drawn);
}

/// Another drawable than the scene's own (graphics/render/test_quads.h): the maps have the colours and
/// distances of static quads, and none of dynamic ones.
TEST_F(MapCacheTest, StaticDrawablesAreInTheMaps) {
  map_plan(scene_).places = {{0, 0, 0}};
  const auto bare = bake();
  const auto with_quad = [&](bool is_dynamic, bool is_visible) {
    const glm::mat4 before_the_eye(glm::vec4(2, 0, 0, 0), glm::vec4(0, 0, 2, 0), glm::vec4(0, -1, 0, 0),
                                   glm::vec4(0, 4, 0, 1));
    render::TestQuads quads{{before_the_eye, is_dynamic, is_visible}};
    render::Drawables drawables;
    drawables.add(test_quads_kind(quads));
    drawables.attach(scene_);
    return bake(drawables);
  };
  EXPECT_EQ(with_quad(true, true), bare);
  EXPECT_EQ(with_quad(false, false), bare) << "the control: hidden";
  const auto shown = with_quad(false, true);
  ASSERT_EQ(shown.size(), bare.size());
  EXPECT_NE(shown.front(), bare.front()) << "colours";
  EXPECT_NE(shown.back(), bare.back()) << "distances";
}

TEST_F(MapCacheTest, InterruptedBakingGoesOnWithTheMapsThatAreMissing) {
  const auto drawn = keep();
  fs::remove(map_file(0));
  fs::remove(map_file(2));
  const fs::file_time_type kept = fs::last_write_time(map_file(1));
  EXPECT_EQ(keep(), drawn);
  EXPECT_EQ(fs::last_write_time(map_file(1)), kept);
  EXPECT_TRUE(fs::exists(map_file(0)) && fs::exists(map_file(2)));
}

TEST_F(MapCacheTest, AnyMapThatIsKeptKnowsThePlacesOfAll) {
  const std::vector<glm::vec3> kept{{1, 1, 1}, {2, 2, 2}, {3, 3, 3}};
  const MapCache cache(scene_);
  EXPECT_FALSE(cache.places());
  ASSERT_TRUE(cache.write({kept, 2, 2, {}}));
  ASSERT_TRUE(write_file(cache.folder() / "notes.map", "mine"));
  EXPECT_EQ(cache.places(), kept);
  EXPECT_EQ(places_of(scene_, HeightPyramid(heights_of(scene_)), cache), kept) << "not those of the script";
}

TEST_F(MapCacheTest, DamagedMapsAreDrawnAgainAndReportedNeverShown) {
  const auto drawn = keep();
  for (std::size_t number = 0; number < 3; ++number) {
    fs::resize_file(map_file(number), 100);
    testing::internal::CaptureStderr();
    EXPECT_EQ(bake(), drawn);
    const std::string told = testing::internal::GetCapturedStderr();
    EXPECT_NE(told.find("cut short or damaged; the map is rendered again"), std::string::npos) << told;
    EXPECT_EQ(keep(), drawn) << "and kept again";
  }
}

TEST_F(MapCacheTest, MapsOfAnotherSceneLightOrPlaceDoNotCount) {
  keep();
  const fs::path before = MapCache(scene_).folder();
  const auto is_other = [&](auto&& change) {
    const scene::Scene kept = scene_;
    change(scene_);
    const bool result = MapCache(scene_).folder() != before;
    scene_ = kept;
    return result;
  };
  EXPECT_TRUE(is_other([](scene::Scene& s) { s.sun.direction_to_sun = {0, 0, 1}; }));
  EXPECT_TRUE(is_other([](scene::Scene& s) { s.sky.intensity = 2.0f; }));
  EXPECT_TRUE(is_other([](scene::Scene& s) { s.objects[0].world_from_model[3].x = 1.0f; }));
  EXPECT_TRUE(is_other([](scene::Scene& s) { s.objects[0].is_visible = false; }));
  EXPECT_TRUE(is_other([](scene::Scene& s) { map_plan(s).places[0].x = 3.0f; }));
  EXPECT_TRUE(is_other([](scene::Scene& s) { methods::settings(s).resolution = 32; }));
  EXPECT_FALSE(is_other([](scene::Scene& s) { s.exposure = 3.0f; }));
  EXPECT_FALSE(is_other([](scene::Scene& s) { render::add_mirror(s, {0, 0, 0}, 1.0f); })) << "it moves";

  scene_.sky.intensity = 2.0f;
  testing::internal::CaptureStderr();
  bake();
  EXPECT_NE(testing::internal::GetCapturedStderr().find("another state of the scene"), std::string::npos);
}

TEST_F(MapCacheTest, StatesThatAreNotAskedForAreForgottenAndOtherFilesStay) {
  keep();
  const MapCache old(scene_);
  ASSERT_TRUE(write_file(old.folder().parent_path() / "notes.txt", "mine"));
  fs::create_directories(old.folder().parent_path() / "mine");
  scene_.sky.intensity = 2.0f;
  keep();
  forget_other_states(scene_, {MapCache(scene_).folder()});
  EXPECT_FALSE(fs::exists(old.folder()));
  EXPECT_TRUE(fs::exists(MapCache(scene_).file(2)));
  EXPECT_TRUE(fs::exists(old.folder().parent_path() / "notes.txt"));
  EXPECT_TRUE(fs::exists(old.folder().parent_path() / "mine"));
}

TEST_F(MapCacheTest, ForgettingAStateLeavesWhatOthersKeepInItsFolderAndBehindLinks) {
  keep();
  const MapCache old(scene_);
  const fs::path baked = old.folder().parent_path(), outside = folder_.path() / "outside";
  ASSERT_TRUE(write_file(old.folder() / "notes.txt", "mine"));
  fs::create_directories(outside);
  ASSERT_TRUE(write_file(outside / "0001.map", "mine"));
  fs::create_directory_symlink(outside, baked / "0123456789abcdef");
  scene_.sky.intensity = 2.0f;
  keep();
  forget_other_states(scene_, {MapCache(scene_).folder()});
  EXPECT_FALSE(fs::exists(old.file(2)));
  EXPECT_TRUE(fs::exists(old.folder() / "notes.txt"));
  EXPECT_TRUE(fs::exists(outside / "0001.map"));
}

TEST_F(MapCacheTest, ASceneMadeInMemoryKeepsNothing) {
  scene_.file.clear();
  EXPECT_TRUE(MapCache(scene_).folder().empty());
  EXPECT_FALSE(bake().empty());
}

TEST_F(MapCacheTest, CompressedMapsShowNearlyTheSameInAQuarterOfTheMemory) {
  methods::settings(scene_).resolution = 64;
  Result<std::unique_ptr<render::Renderer>> renderer =
      render::Renderer::create(scene_, {}, light::sun_and_sky);
  ASSERT_TRUE(renderer);
  const HeightPyramid heights(heights_of(scene_));
  const Result<ReferenceMaps> plain = bake_maps(scene_, heights, **renderer);
  map_plan(scene_).is_compressed = true;
  const Result<ReferenceMaps> small = bake_maps(scene_, heights, **renderer);
  ASSERT_TRUE(plain && small);
  EXPECT_NEAR(4.0 * double(small->colour_bytes()) / double(plain->colour_bytes()), 1.0,
              0.02);  // whole blocks
  const std::size_t side = std::size_t(plain->resolution());
  std::vector<glm::vec3> a(3 * side * side), b(3 * side * side);
  glGetTextureImage(plain->colours(), 0, GL_RGB, GL_FLOAT, GLsizei(a.size() * sizeof(glm::vec3)), a.data());
  glGetTextureImage(small->colours(), 0, GL_RGB, GL_FLOAT, GLsizei(b.size() * sizeof(glm::vec3)), b.data());
  double squares = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) squares += double(glm::dot(a[i] - b[i], a[i] - b[i]));
  // Walls of one colour each: only blocks across their edges, which hold three colours at most, are wrong.
  EXPECT_LT(std::sqrt(squares / double(3 * a.size())), 0.06);
}

}  // namespace
}  // namespace parvis::reference_maps

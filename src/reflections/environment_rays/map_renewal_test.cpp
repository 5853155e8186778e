#include "reflections/reference_maps/map_renewal.h"

#include <gtest/gtest.h>

#include <chrono>
#include <set>
#include <thread>

#include "base/test_folder.h"
#include "graphics/gl/test_context.h"
#include "graphics/light/sun_and_sky.h"
#include "graphics/render/test_room.h"
#include "reflections/environment_rays/map_table.h"
#include "reflections/environment_rays/multiple_environment_maps.h"
#include "reflections/methods/frame.h"
#include "reflections/reference_maps/settings.h"

namespace parvis::environment_rays {
using namespace reference_maps;
namespace {

constexpr int face_resolution = 16;
const std::vector<glm::vec3> map_places{{5, 0, 0}, {-5, 0, 0}, {0, 5, 0}};

/// A room with a lamp in it that can be switched off.
class MapRenewalTest : public gl::ContextTest {
 protected:
  MapRenewalTest() {
    scene::Material lamp = scene::matt(glm::vec3(0.0f));
    lamp.metallic = 1.0f;
    lamp.emission = glm::vec3(3.0f);
    scene::add(scene_, scene::model_of(scene::box({-1, -1, -1}, {1, 1, 1}), lamp));
    lamp_ = scene_.objects.size() - 1;
  }

  scene::Scene scene_ = render::room_scene(8.0f);
  std::size_t lamp_ = 0;
};

TEST_F(MapRenewalTest, TheNearestMapsComeFirstAndAllShowWhatIsThereNow) {
  Result<std::unique_ptr<render::Renderer>> renderer =
      render::Renderer::create(scene_, {}, light::sun_and_sky);
  ASSERT_TRUE(renderer);
  (*renderer)->begin_frame(scene_, Camera{});
  Result<ReferenceMaps> maps = ReferenceMaps::bake(**renderer, map_places, face_resolution);
  Result<MapRenewal> renewal = MapRenewal::create(face_resolution);
  ASSERT_TRUE(maps && renewal);
  EXPECT_TRUE(renewal->is_done());
  constexpr int all = methods::cube_faces;
  EXPECT_EQ(renewal->renew_faces(**renderer, *maps, {}, all), 0);

  const auto with_lamp = maps->read(0);
  scene_.objects[lamp_].is_visible = false;
  (*renderer)->begin_frame(scene_, Camera{});
  renewal->ask(map_places.size());
  const auto nearest_with_lamp = maps->read(1);
  for (int face = 0; face < all; ++face) {
    EXPECT_EQ(maps->read(1), nearest_with_lamp) << "replaced as a whole";
    EXPECT_EQ(renewal->renew_faces(**renderer, *maps, {-4, 1, 0}, 1), 1);
  }
  EXPECT_NE(maps->read(1), nearest_with_lamp);
  EXPECT_EQ(renewal->renew_faces(**renderer, *maps, {-4, 1, 0}, all), all);
  EXPECT_EQ(maps->read(0), with_lamp) << "not its turn";
  EXPECT_FALSE(renewal->is_done());
  EXPECT_EQ(renewal->renew_faces(**renderer, *maps, {-4, 1, 0}, 2 * all), all);
  EXPECT_TRUE(renewal->is_done());
  const Result<ReferenceMaps> fresh = ReferenceMaps::bake(**renderer, map_places, face_resolution);
  ASSERT_TRUE(fresh);
  for (std::size_t map = 0; map < map_places.size(); ++map) EXPECT_EQ(maps->read(map), fresh->read(map));
  EXPECT_NE(maps->read(0), with_lamp);
}

TEST_F(MapRenewalTest, AWindowDrawsFacesOfMapsAfterAChangeAndNoneElse) {
  render::add_mirror(scene_, {3, 0, 0}, 0.5f);
  methods::settings(scene_).method = "multiple_environment_maps";
  methods::settings(scene_).resolution = face_resolution;
  map_plan(scene_).places = map_places;
  Result<std::unique_ptr<render::Renderer>> renderer =
      render::Renderer::create(scene_, {}, light::sun_and_sky);
  ASSERT_TRUE(renderer);
  Result<std::unique_ptr<methods::Reflections>> reflections =
      make_multiple_environment_maps(scene_, **renderer);
  ASSERT_TRUE(reflections);
  ASSERT_TRUE((*renderer)->set_reflection(reflections->get()));
  (*reflections)->prefer_rate();
  const auto faces_per_frame = [&] {
    Camera camera;
    camera.world_from_camera = look_at({7, 3, 1}, {3, 0, 0});
    EXPECT_TRUE(methods::draw_frame(**renderer, scene_, reflections->get(), {camera, 64, 48}));
    return (*reflections)->faces_drawn();
  };
  EXPECT_EQ(faces_per_frame(), 0);
  EXPECT_EQ(faces_per_frame(), 0);
  scene_.objects[lamp_].is_visible = false;
  const int at_once = gl::is_software() ? 1 : methods::cube_faces, frames = 3 * methods::cube_faces / at_once;
  for (int frame = 0; frame < frames; ++frame) EXPECT_EQ(faces_per_frame(), at_once) << frame;
  EXPECT_EQ(faces_per_frame(), 0);
  scene_.sun.direction_to_sun = glm::vec3(0.0f, 0.0f, 1.0f);
  EXPECT_EQ(faces_per_frame(), at_once) << "the sun counts, too";
}

/// Maps in a long room, of which the mirror at one end looks into some.
class MissingMapsTest : public gl::ContextTest {
 protected:
  void SetUp() override {
    ContextTest::SetUp();
    if (IsSkipped() || HasFatalFailure()) return;
    render::add_mirror(scene_, {27, 0, 0}, 0.5f);
    methods::settings(scene_).method = "multiple_environment_maps";
    methods::settings(scene_).resolution = face_resolution;
    for (float x = -28.0f; x < 29.0f; x += 4.0f) map_plan(scene_).places.emplace_back(x, 0.0f, 0.0f);
    renderer_ = std::move(*render::Renderer::create(scene_, {}, light::sun_and_sky));
    reflections_ = std::move(*make_multiple_environment_maps(scene_, *renderer_));
    EXPECT_TRUE(renderer_->set_reflection(reflections_.get()));
  }
  /// Makes the method again: the maps of the one before are gone, and what it had to write is written.
  void start_again() {
    EXPECT_TRUE(renderer_->set_reflection(nullptr));
    reflections_.reset();
    reflections_ = std::move(*make_multiple_environment_maps(scene_, *renderer_));
    EXPECT_TRUE(renderer_->set_reflection(reflections_.get()));
  }
  const MultipleEnvironmentMaps& maps() const {
    return dynamic_cast<const MultipleEnvironmentMaps&>(*reflections_);
  }
  /// Draws a frame with the mirror in its middle; how many maps are drawn then.
  std::size_t maps_after_next_frame() {
    const float x = scene_.objects.back().world_from_model[3].x;
    Camera camera;
    camera.world_from_camera = look_at({x - 3, 3, 1}, {x, 0, 0});
    EXPECT_TRUE(methods::draw_frame(*renderer_, scene_, reflections_.get(), {camera, 64, 48}));
    return maps().drawn_maps();
  }

  scene::Scene scene_ = render::room_scene(32.0f);
  std::unique_ptr<render::Renderer> renderer_;
  std::unique_ptr<methods::Reflections> reflections_;
};

TEST_F(MissingMapsTest, APictureDrawsThoseThatAreLookedInto) {
  const std::size_t drawn = maps_after_next_frame();
  EXPECT_GE(drawn, std::size_t(MapChoice::maps_per_cell));
  EXPECT_LT(drawn, map_plan(scene_).places.size()) << "the mirror looks into no farther maps";
  const Image8 picture = renderer_->read_picture(1.0f);
  EXPECT_EQ(maps_after_next_frame(), drawn);
  EXPECT_EQ(renderer_->read_picture(1.0f).pixels, picture.pixels) << "complete at once";
}

TEST_F(MissingMapsTest, AWindowDrawsOnePerFrameAndEndsWithTheSamePicture) {
  const std::size_t wanted = maps_after_next_frame();
  const Image8 whole = renderer_->read_picture(1.0f);
  reflections_ = std::move(*make_multiple_environment_maps(scene_, *renderer_));
  ASSERT_TRUE(renderer_->set_reflection(reflections_.get()));
  reflections_->prefer_rate();
  EXPECT_EQ(maps_after_next_frame(), 2u) << "the first frame is drawn again with its first map";
  for (std::size_t drawn = 3; drawn <= wanted; ++drawn) EXPECT_EQ(maps_after_next_frame(), drawn);
  EXPECT_EQ(maps_after_next_frame(), wanted);
  EXPECT_EQ(renderer_->read_picture(1.0f).pixels, whole.pixels);
}

TEST_F(MissingMapsTest, AWindowShowsNoMapOfTheDayByNight) {
  scene_.sun.irradiance = glm::vec3(24.0f);  // seven times as bright with its sky as the sky alone
  reflections_->prefer_rate();
  std::size_t drawn = 0;
  while (maps_after_next_frame() != drawn) drawn = maps().drawn_maps();
  scene_.sun.irradiance = glm::vec3(0.0f);
  const std::size_t begun = maps_after_next_frame();
  EXPECT_LT(begun, drawn) << "those of the day are gone";
  const Image8 first = renderer_->read_picture(1.0f);
  while (maps_after_next_frame() != drawn) {
  }
  const auto brightest = [](const Image8& picture) { return int(std::ranges::max(picture.pixels)); };
  EXPECT_NEAR(brightest(first), brightest(renderer_->read_picture(1.0f)), 8);
}

TEST_F(MissingMapsTest, WhatAWindowDrewItsNextStartReads) {
  const TestFolder folder;
  scene_.file = folder.path() / "room.xp";
  const MapCache cache(scene_);
  start_again();
  const std::size_t wanted = maps_after_next_frame();
  const Image8 whole = renderer_->read_picture(1.0f);
  start_again();
  EXPECT_FALSE(cache.places()) << "a picture keeps nothing";
  reflections_->prefer_rate();
  for (std::size_t frame = 0; frame < wanted; ++frame) maps_after_next_frame();
  EXPECT_EQ(maps_after_next_frame(), wanted);

  start_again();
  std::size_t kept = 0;
  for (std::size_t map = 0; map < map_plan(scene_).places.size(); ++map) kept += cache.read(map).has_value();
  EXPECT_EQ(kept, wanted);
  reflections_->prefer_rate();
  EXPECT_EQ(maps_after_next_frame(), wanted) << "reading takes no frame of its own";
  EXPECT_EQ(renderer_->read_picture(1.0f).pixels, whole.pixels);
}

TEST_F(MissingMapsTest, MapsOfALightThatHasChangedAreNotKept) {
  const TestFolder folder;
  scene_.file = folder.path() / "room.xp";
  start_again();
  reflections_->prefer_rate();
  const MapCache before(scene_);
  scene_.sun.irradiance = glm::vec3(8.0f);  // before the first frame, as day light does
  const MapCache after(scene_);
  ASSERT_NE(before.folder(), after.folder());
  maps_after_next_frame();
  start_again();
  EXPECT_FALSE(before.places());
  EXPECT_FALSE(after.places());
}

TEST_F(MissingMapsTest, AWindowBeginsWithFewMapsAndEndsWithThePictureOfAll) {
  map_plan(scene_).places.clear();
  map_plan(scene_).max_maps = 6;  // to be placed in no time
  start_again();
  EXPECT_TRUE(maps().is_placed()) << "a picture waits";
  const std::vector<glm::vec3> all = maps().maps().places();
  maps_after_next_frame();
  const Image8 whole = renderer_->read_picture(1.0f);

  scene_.data<methods::Pace>().begins_at_once = true;
  start_again();
  EXPECT_FALSE(maps().is_placed());
  EXPECT_GE(maps().maps().places().size(), 1u);
  for (int frame = 0; frame < 600 && !maps().is_placed(); ++frame) {
    maps_after_next_frame();
    EXPECT_GE(maps().drawn_maps(), 1u) << "a map is looked into from the first frame on";
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  ASSERT_TRUE(maps().is_placed());
  EXPECT_EQ(maps().maps().places().size(), all.size());
  maps_after_next_frame();
  EXPECT_EQ(renderer_->read_picture(1.0f).pixels, whole.pixels);
}

TEST_F(MissingMapsTest, APictureShowsNoMapThatIsOutOfDate) {
  maps_after_next_frame();
  const Image8 dark = renderer_->read_picture(1.0f);
  scene_.sun.irradiance = glm::vec3(8.0f);
  maps_after_next_frame();
  const Image8 sunny = renderer_->read_picture(1.0f);
  maps_after_next_frame();
  EXPECT_EQ(renderer_->read_picture(1.0f).pixels, sunny.pixels) << "complete at once";
  scene_.sun.irradiance = glm::vec3(0.0f);
  maps_after_next_frame();
  EXPECT_EQ(renderer_->read_picture(1.0f).pixels, dark.pixels);
}

TEST_F(MissingMapsTest, PicturesAreTheSameWhereNotAllMapsAreHeld) {
  const auto pictures_along_the_room = [&] {
    std::vector<std::vector<std::uint8_t>> pictures;
    for (const float x : {-25.0f, 0.0f, 25.0f, -25.0f}) {
      scene_.objects.back().world_from_model[3].x = x;
      maps_after_next_frame();
      pictures.push_back(renderer_->read_picture(1.0f).pixels);
    }
    return pictures;
  };
  const auto whole = pictures_along_the_room();
  const std::size_t all = maps_after_next_frame(), held = 8;
  EXPECT_GT(all, held);
  map_plan(scene_).memory_mb =
      1e-6f * (float(held) + 0.5f) *
      float(ReferenceMaps::bytes_per_map(ReferenceMaps::layer_side(face_resolution)));
  reflections_ = std::move(*make_multiple_environment_maps(scene_, *renderer_));
  ASSERT_TRUE(renderer_->set_reflection(reflections_.get()));
  EXPECT_EQ(pictures_along_the_room(), whole);
  EXPECT_EQ(maps_after_next_frame(), held);
}

/// The maps of the room are numbered beyond the layers of a texture, 2048 on the software renderer.
TEST_F(MissingMapsTest, PicturesAreTheSameWhereThereAreMoreMapsThanLayers) {
  const std::size_t drawn = maps_after_next_frame();
  const Image8 whole = renderer_->read_picture(1.0f);
  std::vector<glm::vec3>& all = map_plan(scene_).places;
  std::vector<glm::vec3> far_away(ReferenceMaps::max_count());
  for (std::size_t i = 0; i < far_away.size(); ++i) far_away[i] = {1000.0f + float(i), 0.0f, 0.0f};
  all.insert(all.begin(), far_away.begin(), far_away.end());
  reflections_ = std::move(*make_multiple_environment_maps(scene_, *renderer_));
  ASSERT_TRUE(renderer_->set_reflection(reflections_.get()));
  EXPECT_EQ(maps_after_next_frame(), drawn);
  EXPECT_EQ(renderer_->read_picture(1.0f).pixels, whole.pixels);
}

TEST_F(MissingMapsTest, MoreMapsThanLayersAreRefusedWhereAllAreToBeHeld) {
  constexpr int side = 16;
  const std::size_t layers = ReferenceMaps::max_count();
  EXPECT_TRUE(ReferenceMaps::create(std::vector<glm::vec3>(layers), side));
  const Result<ReferenceMaps> refused = ReferenceMaps::create(std::vector<glm::vec3>(layers + 1), side);
  ASSERT_FALSE(refused);
  const std::string told = to_string(refused.errors());
  EXPECT_NE(told.find(fmt::format("{} reference maps", layers + 1)), std::string::npos) << told;
  EXPECT_NE(told.find(fmt::format("at most {}", layers)), std::string::npos) << told;
}

/// Three maps, of which each part of the ground has all; two layers.
class MapTableTest : public gl::ContextTest {
 protected:
  MapTable table(std::size_t layers) {
    shading::Heightfield heights(Bounds{glm::vec3(-8, -8, 0), glm::vec3(8, 8, 1)}, 1.0f, 64);
    return {MapChoice(map_places, HeightPyramid(heights)), map_places, layers};
  }
  /// The layers that the south-western cell looks into.
  static std::vector<std::uint16_t> first_cell(const MapTable& table) {
    std::vector<std::uint16_t> layers(4);
    glGetTextureSubImage(table.texture(), 0, 0, 0, 0, 1, 1, 1, GL_RGBA_INTEGER, GL_UNSIGNED_SHORT, 8,
                         layers.data());
    return layers;
  }
  const Bounds all_{glm::vec3(-8), glm::vec3(8)};
};

TEST_F(MapTableTest, MapsThatAreHeldStandInForThoseThatAreNot) {
  MapTable table = this->table(3);
  EXPECT_EQ(table.look_within(all_).size(), 3u);
  EXPECT_EQ(table.give_layer(1), 0u);
  EXPECT_EQ(table.give_layer(1), 0u) << "it has one";
  EXPECT_FALSE(table.is_complete());
  table.upload();
  EXPECT_EQ(first_cell(table), std::vector<std::uint16_t>(4, 0));
  EXPECT_EQ(table.look_within(all_).size(), 2u);
  EXPECT_EQ(table.give_layer(0), 1u);
  EXPECT_EQ(table.give_layer(2), 2u);
  EXPECT_TRUE(table.is_complete());
  table.upload();
  const std::vector<std::uint16_t> layers = first_cell(table);
  EXPECT_EQ(std::set(layers.begin(), layers.end()).size(), 3u) << "each map has a layer of its own";
  table.forget();
  EXPECT_EQ(table.look_within(all_).size(), 3u);
}

TEST_F(MapTableTest, TheMapThatWasLookedIntoLeastRecentlyGivesUpItsLayer) {
  MapTable table = this->table(2);
  table.begin_frame();
  EXPECT_EQ(table.give_layer(0), 0u);
  EXPECT_EQ(table.give_layer(1), 1u);
  EXPECT_EQ(table.give_layer(2), std::nullopt) << "this frame looks into both";
  table.begin_frame();
  EXPECT_EQ(table.look_within(all_), std::vector<std::size_t>{2}) << "which notes that 0 and 1 are in use";
  EXPECT_EQ(table.give_layer(2), std::nullopt);
  table.begin_frame();
  EXPECT_EQ(table.give_layer(2), 0u);
  EXPECT_EQ(table.look_within(all_), std::vector<std::size_t>{0});
  table.upload();
  for (const std::uint16_t layer : first_cell(table)) EXPECT_LT(layer, 2);
}

}  // namespace
}  // namespace parvis::environment_rays

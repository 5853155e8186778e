#include "graphics/reference/photograph.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "base/files.h"
#include "base/test_folder.h"
#include "graphics/reference/photograph_checkpoint.h"
#include "graphics/reference/seen_points.h"
#include "scene/data/test_scene.h"

namespace parvis::reference {
namespace {
namespace fs = std::filesystem;

constexpr int photo_width = 80, photo_height = 70;  // tiles of the right and lower edge are cut

/// A street corner in small: ground, a box, a pane; sun and the plain blue sky.
struct Corner {
  scene::Scene scene;
  shading::SkyLight sky = shading::make_sky_light({}, 1.0f, 0.0f);
  Camera camera;

  Corner() {
    scene::add(scene, scene::model_of(scene::ground(20.0f), scene::matt(glm::vec3(0.5f))));
    scene::add(scene, scene::model_of(scene::box({-1, -1, 0}, {1, 1, 2}), scene::matt({0.8f, 0.4f, 0.2f})));
    camera.world_from_camera = look_at({2, -8, 1.6f}, {0, 0, 1});
  }
  Result<Photograph> take(const PhotographOptions& options) const {
    const RayScene rays(scene);
    return take_photograph(rays, scene, sky, camera, photo_width, photo_height, options);
  }
};

PhotographOptions four_samples(const fs::path& checkpoint = {}) {
  PhotographOptions options;
  options.samples_per_pixel = 4;
  options.checkpoint = checkpoint;
  return options;
}

void expect_same(const Photograph& a, const Photograph& b) {
  EXPECT_EQ(a.radiance.pixels, b.radiance.pixels);
  EXPECT_EQ(a.alpha.pixels, b.alpha.pixels);
  EXPECT_EQ(a.depth_m.pixels, b.depth_m.pixels);
}

TEST(PhotographCheckpoint, TilesOfOtherWorkUnderItsHeaderAreNotTaken) {
  const TestFolder folder;
  const fs::path file = folder.path() / "a.checkpoint", other = folder.path() / "b.checkpoint";
  const std::vector<float> values{1.0f, 2.0f, 3.0f};
  std::vector<std::uint32_t> found;
  const auto open = [&](const fs::path& path, std::uint64_t key) {
    found.clear();
    return PhotographCheckpoint::open(
        path, key, false, [&](std::uint32_t tile, std::span<const float>) { found.push_back(tile); });
  };
  for (const auto& [path, key] : {std::pair(file, 1u), std::pair(other, 2u)}) {
    auto checkpoint = open(path, key);
    ASSERT_TRUE(checkpoint) << to_string(checkpoint.errors());
    checkpoint->keep(7, values);
    EXPECT_EQ(checkpoint->tiles(), 1u);
  }
  ASSERT_TRUE(open(file, 1));
  EXPECT_EQ(found, std::vector<std::uint32_t>{7});
  constexpr std::size_t header = 16;
  ASSERT_TRUE(write_file(file, read_file(file)->substr(0, header) + read_file(other)->substr(header)));
  ASSERT_TRUE(open(file, 1));
  EXPECT_TRUE(found.empty()) << "the tile of other work";
}

TEST(Photograph, IsTheSameForAnyNumberOfThreads) {
  const Corner corner;
  const Result<Photograph> many = corner.take(four_samples());
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  const Result<Photograph> one = corner.take(four_samples());
  ASSERT_TRUE(many && one);
  expect_same(*many, *one);
}

TEST(Photograph, OtherSeedsGiveOtherNoise) {
  const Corner corner;
  PhotographOptions options = four_samples();
  const Result<Photograph> first = corner.take(options);
  options.seed = 2;
  EXPECT_NE(first->radiance.pixels, corner.take(options)->radiance.pixels);
}

TEST(Photograph, GoesOnFromAnyPlaceAtWhichItWasCut) {
  const TestFolder folder;
  const Corner corner;
  const fs::path file = folder.path() / "photo.checkpoint";
  const Result<Photograph> whole = corner.take(four_samples(file));
  ASSERT_TRUE(whole);
  const std::uintmax_t size = fs::file_size(file);
  for (const std::uintmax_t kept :
       {std::uintmax_t(0), std::uintmax_t(9), size / 3, size / 2, size - 1, size}) {
    fs::resize_file(file, kept);
    const Result<Photograph> resumed = corner.take(four_samples(file));
    ASSERT_TRUE(resumed);
    expect_same(*whole, *resumed);
    EXPECT_LE(resumed->rays, whole->rays);
    EXPECT_EQ(resumed->rays == 0, kept == size);
    EXPECT_EQ(fs::file_size(file), size);
  }
}

TEST(Photograph, AnInterruptedOneSaysHowToGoOn) {
  const TestFolder folder;
  const Corner corner;
  const std::atomic<bool> interrupted = true;
  PhotographOptions options = four_samples(folder.path() / "photo.checkpoint");
  options.is_interrupted = &interrupted;
  const Result<Photograph> stopped = corner.take(options);
  ASSERT_FALSE(stopped);
  EXPECT_NE(to_string(stopped.errors()).find("the same command goes on"), std::string::npos);
  options.is_interrupted = nullptr;
  const Result<Photograph> resumed = corner.take(options);
  ASSERT_TRUE(resumed);
  expect_same(*resumed, *corner.take(four_samples()));
}

TEST(Photograph, TilesOfAnotherSceneOrOfOtherOptionsDoNotCount) {
  const TestFolder folder;
  Corner corner;
  const fs::path file = folder.path() / "photo.checkpoint";
  ASSERT_TRUE(corner.take(four_samples(file)));
  corner.scene.objects[1].world_from_model[3].x += 0.5f;
  const Result<Photograph> refused = corner.take(four_samples(file));
  ASSERT_FALSE(refused) << "the work of another photograph would be lost";
  EXPECT_NE(to_string(refused.errors()).find(file.string()), std::string::npos);
  PhotographOptions options = four_samples(file);
  options.replaces_checkpoint = true;
  const Result<Photograph> moved = corner.take(options);
  ASSERT_TRUE(moved);
  expect_same(*moved, *corner.take(four_samples()));
  options.paths.bounces = 1;
  EXPECT_GT(corner.take(options)->rays, 0u);
}

TEST(Photograph, WhatIsNoCheckpointStays) {
  const TestFolder folder;
  const fs::path file = folder.write("photo.checkpoint", "a text of somebody"), link = folder.path() / "link";
  EXPECT_FALSE(Corner().take(four_samples(file)));
  fs::create_symlink(file, link);
  PhotographOptions options = four_samples(link);
  options.replaces_checkpoint = true;
  EXPECT_FALSE(Corner().take(options));
  EXPECT_EQ(fs::file_size(file), 18u);
}

TEST(Photograph, ACheckpointThatCannotBeWrittenIsAnError) {
  const TestFolder folder;
  folder.write("file", "no folder");
  EXPECT_FALSE(Corner().take(four_samples(folder.path() / "file" / "photo.checkpoint")));
}

TEST(Photograph, DepthIsMeasuredAlongTheAxisAndAlphaIsWhereTheSceneIs) {
  Corner corner;
  corner.scene.objects.clear();
  // a wall at 10 m that fills the lower half of the picture: its depth is the same to its corners
  scene::add(corner.scene,
             scene::model_of(scene::quad({-50, 10, -50}, {50, 10, -50}, {50, 10, 0}, {-50, 10, 0}),
                             scene::matt({1, 1, 1})));
  corner.camera.world_from_camera = look_at({0, 0, 0}, {0, 1, 0});
  const Result<Photograph> photograph = corner.take(four_samples());
  ASSERT_TRUE(photograph);
  for (const int x : {0, photo_width / 2, photo_width - 1}) {
    EXPECT_NEAR(*photograph->depth_m.at(x, photo_height - 1), 10.0f, 1e-4f);
    EXPECT_EQ(*photograph->depth_m.at(x, 0), 0.0f);
    EXPECT_EQ(*photograph->alpha.at(x, photo_height - 1), 255);
    EXPECT_EQ(*photograph->alpha.at(x, 0), 0);
  }
}

TEST(Photograph, SeenPointsProjectToWhereTheyAreSeenAndHideBehindThings) {
  const Corner corner;
  const RayScene rays(corner.scene);
  Camera behind = corner.camera;
  behind.world_from_camera = look_at({-2, 8, 1.6f}, {0, 0, 1});
  const std::vector<scene::TakenPicture> pictures{{"front", corner.camera, photo_width, photo_height},
                                                  {"back", behind, photo_width, photo_height}};
  const auto points = seen_points(
      rays, pictures, {Image8(photo_width, photo_height, 3), Image8(photo_width, photo_height, 3)}, 8);
  int on_front_wall = 0;
  for (const scene::SeenPoint& point : points) {
    ASSERT_FALSE(point.pictures.empty());
    const glm::vec2 at = scene::projected(pictures[std::size_t(point.pictures.front())], point.position);
    EXPECT_TRUE(at.x > 0.0f && at.y > 0.0f && at.x < float(photo_width) && at.y < float(photo_height));
    if (std::abs(point.position.y + 1.0f) > 1e-4f || point.position.z < 0.01f) continue;
    ++on_front_wall;
    EXPECT_EQ(point.pictures, std::vector<int>{0});  // the camera behind the box does not see its front
  }
  EXPECT_GT(on_front_wall, 3);
}

}  // namespace
}  // namespace parvis::reference

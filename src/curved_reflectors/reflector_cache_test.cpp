#include "curved_reflectors/reflector_cache.h"

#include <gtest/gtest.h>

#include "base/files.h"
#include "base/test_folder.h"
#include "curved_reflectors/reflector_file.h"
#include "scene/test_scene.h"

namespace parvis::curved_reflectors {
namespace {
namespace fs = std::filesystem;

Reflector small_reflector() {
  Result<Reflector> made = make_reflector(scene::torus(1.0f, 0.4f, 12), "ring", 16);
  EXPECT_TRUE(made) << to_string(made.errors());
  return made ? *std::move(made) : Reflector();
}

void expect_equal(const Reflector& a, const Reflector& b) {
  EXPECT_EQ(a.mesh.mesh.positions, b.mesh.mesh.positions);
  EXPECT_EQ(a.mesh.mesh.indices, b.mesh.mesh.indices);
  EXPECT_EQ(a.mesh.neighbours, b.mesh.neighbours);
  EXPECT_EQ(a.remarks, b.remarks);
  ASSERT_EQ(a.patches.size(), b.patches.size());
  for (std::size_t i = 0; i < a.patches.size(); ++i) {
    EXPECT_EQ(a.patches[i].triangles, b.patches[i].triangles);
    EXPECT_EQ(a.patches[i].shows_once, b.patches[i].shows_once);
  }
  ASSERT_EQ(a.maps.size(), b.maps.size());
  for (std::size_t i = 0; i < a.maps.size(); ++i) {
    EXPECT_EQ(a.maps[i].texels.width, b.maps[i].texels.width);
    EXPECT_EQ(a.maps[i].texels.pixels, b.maps[i].texels.pixels);
    EXPECT_EQ(a.maps[i].window.axes, b.maps[i].window.axes);
    EXPECT_EQ(a.maps[i].starts, b.maps[i].starts);
  }
}

/// A script's place with a ring and a ball as mirrors.
class ReflectorCacheTest : public testing::Test {
 protected:
  ReflectorCacheTest() {
    scene_.file = folder_.path() / "room.xp";
    scene_.reflection.resolution = 4;
    scene::Material chrome;
    chrome.is_mirror_like = true;
    for (const Mesh& mesh : {scene::torus(1.0f, 0.4f, 12), scene::sphere(glm::vec3(0.0f), 1.0f, 12)}) {
      const int object = scene::add(scene_, scene::model_of(mesh, chrome), true);
      scene_.objects[std::size_t(object)].takes_reflection = true;
    }
  }
  fs::path file(std::size_t object) const { return ReflectorCache(scene_).file(scene_.objects[object]); }

  TestFolder folder_;
  scene::Scene scene_;
};

TEST(ReflectorFile, WhatIsWrittenIsRead) {
  const TestFolder folder;
  const Reflector written = small_reflector();
  ASSERT_TRUE(write_reflector_file(folder.path() / "a.reflector", written));
  const Result<Reflector> read = read_reflector_file(folder.path() / "a.reflector");
  ASSERT_TRUE(read) << to_string(read.errors());
  expect_equal(*read, written);
}

TEST(ReflectorFile, CutShortForeignOrOfAnotherVersionItIsRefusedWithTheReason) {
  const TestFolder folder;
  const fs::path file = folder.path() / "a.reflector";
  ASSERT_TRUE(write_reflector_file(file, small_reflector()));
  const std::string whole = *read_file(file);
  const auto complaint = [&](const std::string& bytes) {
    EXPECT_TRUE(write_file(file, bytes));
    const Result<Reflector> read = read_reflector_file(file);
    return read ? "" : to_string(read.errors());
  };
  for (std::size_t length = 8; length < whole.size(); length += whole.size() / 50)
    EXPECT_NE(complaint(whole.substr(0, length)).find("cut short or damaged"), std::string::npos);
  EXPECT_NE(complaint("PARVISR9" + whole.substr(8)).find("another version"), std::string::npos);
  EXPECT_NE(complaint("PARVISM1" + whole.substr(8)).find("no reflector"), std::string::npos);
}

TEST_F(ReflectorCacheTest, WhatIsBakedIsReadAndBakingGoesOnWhereItWasInterrupted) {
  ASSERT_TRUE(bake_reflectors(scene_));
  ASSERT_TRUE(fs::exists(file(0)));
  ASSERT_TRUE(fs::exists(file(1)));
  const Result<Reflector> kept = ReflectorCache(scene_).reflector(scene_.objects[0]);
  ASSERT_TRUE(kept);
  scene::Scene in_memory = scene_;
  in_memory.file.clear();
  EXPECT_TRUE(ReflectorCache(in_memory).file(scene_.objects[0]).empty());
  expect_equal(*kept, *ReflectorCache(in_memory).reflector(scene_.objects[0]));

  const fs::file_time_type before = fs::last_write_time(file(0));
  fs::remove(file(1));
  ASSERT_TRUE(bake_reflectors(scene_));
  EXPECT_TRUE(fs::exists(file(1)));
  EXPECT_EQ(fs::last_write_time(file(0)), before) << "what is kept stays";
}

TEST_F(ReflectorCacheTest, DamagedFilesAreMadeAnewAndOldOnesForgotten) {
  ASSERT_TRUE(bake_reflectors(scene_));
  const fs::path old_file = file(0);
  const std::string whole = *read_file(old_file);
  ASSERT_TRUE(write_file(old_file, whole.substr(0, whole.size() / 2)));
  EXPECT_TRUE(ReflectorCache(scene_).reflector(scene_.objects[0])) << "a warning, and the reflector";
  ASSERT_TRUE(bake_reflectors(scene_));
  EXPECT_EQ(*read_file(old_file), whole);
  scene_.reflection.resolution = 8;
  ASSERT_TRUE(bake_reflectors(scene_));
  EXPECT_FALSE(fs::exists(old_file));
  EXPECT_TRUE(fs::exists(file(0)));
}

}  // namespace
}  // namespace parvis::curved_reflectors

#include "reflections/reflector_maps/reflector_cache.h"

#include <gtest/gtest.h>

#include "base/files.h"
#include "base/test_folder.h"
#include "reflections/methods/settings.h"
#include "reflections/reflector_maps/reflector_file.h"
#include "scene/data/test_scene.h"

namespace parvis::reflector_maps {
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

/// A script's place with a ring and a ball as mirrors, the third object a ball of glass with a foot of
/// chrome.
class ReflectorCacheTest : public testing::Test {
 protected:
  ReflectorCacheTest() {
    scene_.file = folder_.path() / "room.xp";
    methods::settings(scene_).resolution = 4;
    methods::settings(scene_).method = "virtual_objects";
    scene::Material chrome, glass;
    chrome.is_mirror_like = glass.is_mirror_like = true;
    glass.ior = 1.5f;
    const auto add = [&](const std::shared_ptr<scene::Model>& model) {
      const int object = scene::add(scene_, model, true);
      scene_.objects[std::size_t(object)].takes_reflection = true;
    };
    for (const Mesh& mesh : {scene::torus(1.0f, 0.4f, 12), scene::sphere(glm::vec3(0.0f), 1.0f, 12)})
      add(scene::model_of(mesh, chrome));
    const std::shared_ptr<scene::Model> footed = scene::model_of(scene::sphere({0, 0, 2}, 1.0f, 12), glass);
    footed->parts.push_back({.object = "foot", .mesh = scene::box({-1, -1, 0}, {1, 1, 1}), .material = 1});
    footed->materials.push_back(chrome);
    add(footed);
  }
  ReflectorSource mirror(std::size_t object) const { return mirror_source(scene_, scene_.objects[object]); }
  ReflectorSource glass() const { return glass_sources(scene_.objects[2]).at(0).outside; }
  fs::path file(const ReflectorSource& source) const { return ReflectorCache(scene_).file(source); }

  TestFolder folder_;
  scene::Scene scene_;
};

TEST(ReflectorFile, WhatIsWrittenIsRead) {
  const Reflector written = small_reflector();
  const std::optional<Reflector> read = reflector_maps::reflector_of(bytes_of(written));
  ASSERT_TRUE(read);
  expect_equal(*read, written);
}

TEST(ReflectorFile, CutShortItIsRefused) {
  const std::string whole = bytes_of(small_reflector());
  for (std::size_t length = 0; length < whole.size(); length += 1 + whole.size() / 50)
    EXPECT_FALSE(reflector_maps::reflector_of(whole.substr(0, length))) << length;
}

TEST(ReflectorFile, WithIndicesThatLieItIsRefused) {
  const auto is_read = [&](const auto& spoil) {
    Reflector reflector = small_reflector();
    spoil(reflector);
    return bool(reflector_maps::reflector_of(bytes_of(reflector)));
  };
  EXPECT_TRUE(is_read([](Reflector&) {}));
  EXPECT_FALSE(is_read([](Reflector& r) { r.mesh.mesh.indices[0] = ~0u; }));
  EXPECT_FALSE(is_read([](Reflector& r) { r.mesh.neighbours[0][1] = 1u << 30; }));
  EXPECT_FALSE(is_read([](Reflector& r) { r.mesh.neighbours.pop_back(); }));
  EXPECT_FALSE(is_read([](Reflector& r) { r.mesh.mesh.normals.pop_back(); }));
  EXPECT_FALSE(is_read([](Reflector& r) { r.patches[0].triangles.push_back(1u << 30); }));
  EXPECT_FALSE(is_read([](Reflector& r) { r.maps[0].texels.width = 1 << 30; }));
  EXPECT_FALSE(is_read([](Reflector& r) { r.maps.resize(r.patches.size() + 1); }));
}

TEST_F(ReflectorCacheTest, TwoReflectorsFilesExchangedAreRebuilt) {
  ASSERT_TRUE(bake_reflectors(scene_));
  const std::string ring = *read_file(file(mirror(0))), ball = *read_file(file(mirror(1)));
  ASSERT_TRUE(write_file(file(mirror(0)), ball) && write_file(file(mirror(1)), ring));
  EXPECT_FALSE(ReflectorCache(scene_).stored(mirror(0)));
  ASSERT_TRUE(bake_reflectors(scene_));
  EXPECT_EQ(*read_file(file(mirror(0))), ring);
}

TEST_F(ReflectorCacheTest, EachFlippedByteIsReportedAndTheReflectorRebuilt) {
  ASSERT_TRUE(bake_reflectors(scene_));
  const fs::path path = file(mirror(0));
  const std::string whole = *read_file(path);
  for (std::size_t at = 0; at < whole.size(); at += 1 + whole.size() / 20) {
    std::string flipped = whole;
    flipped[at] = char(flipped[at] ^ 0x10);
    ASSERT_TRUE(write_file(path, flipped));
    testing::internal::CaptureStderr();
    EXPECT_FALSE(ReflectorCache(scene_).stored(mirror(0))) << at;
    EXPECT_NE(testing::internal::GetCapturedStderr().find("the reflector is rebuilt"), std::string::npos)
        << at;
  }
}

TEST_F(ReflectorCacheTest, AFileThatIsALinkIsNotFollowed) {
  ASSERT_TRUE(bake_reflectors(scene_));
  const fs::path path = file(mirror(0)), outside = folder_.path() / "outside";
  fs::rename(path, outside);
  fs::create_symlink(outside, path);
  EXPECT_FALSE(ReflectorCache(scene_).stored(mirror(0)));
  EXPECT_FALSE(bake_reflectors(scene_)) << "nothing is written through it";
}

TEST_F(ReflectorCacheTest, NothingIsReadOrWrittenThroughALink) {
  const fs::path elsewhere = fs::path(scene_.file).parent_path() / "elsewhere";
  fs::create_directory(elsewhere);
  fs::create_directory_symlink(elsewhere, fs::path(scene_.file).replace_extension(".baked"));
  EXPECT_FALSE(ReflectorCache(scene_).parts().keeps_parts());
  EXPECT_FALSE(bake_reflectors(scene_));
  EXPECT_TRUE(fs::is_empty(elsewhere));
}

TEST_F(ReflectorCacheTest, WhatIsBakedIsReadAndBakingGoesOnWhereItWasInterrupted) {
  ASSERT_TRUE(bake_reflectors(scene_));
  scene::Scene in_memory = scene_;
  in_memory.file.clear();
  EXPECT_TRUE(ReflectorCache(in_memory).file(mirror(0)).empty());
  for (const ReflectorSource& source : {mirror(0), mirror(1), mirror(2), glass()}) {
    ASSERT_TRUE(fs::exists(file(source)));
    const Result<Reflector> kept = ReflectorCache(scene_).reflector(source);
    ASSERT_TRUE(kept);
    expect_equal(*kept, *ReflectorCache(in_memory).reflector(source));
  }

  const fs::file_time_type before = fs::last_write_time(file(mirror(0)));
  fs::remove(file(mirror(1)));
  ASSERT_TRUE(bake_reflectors(scene_));
  EXPECT_TRUE(fs::exists(file(mirror(1))));
  EXPECT_EQ(fs::last_write_time(file(mirror(0))), before) << "what is kept stays";
}

TEST_F(ReflectorCacheTest, OfMethodsWithoutVirtualObjectsGlassAloneIsBaked) {
  methods::settings(scene_).method = "rerendered_cube_map";
  const Result<BakedReflectors> baked = bake_reflectors(scene_);
  ASSERT_TRUE(baked);
  EXPECT_EQ(baked->files, std::set{file(glass())});
  EXPECT_TRUE(fs::exists(file(glass())));
}

TEST_F(ReflectorCacheTest, WhatCannotBeMadeIsNotAmongWhatIsBaked) {
  scene_.objects.resize(1);
  auto flat = std::make_shared<scene::Model>(*scene_.objects[0].model);
  for (glm::vec3& position : flat->parts[0].mesh.positions) position = glm::vec3(position.x, 0.0f, 0.0f);
  scene_.objects.push_back(scene_.objects[0]);
  scene_.objects.back().model = flat;
  const Result<BakedReflectors> baked = bake_reflectors(scene_);
  ASSERT_TRUE(baked);
  EXPECT_EQ(baked->files, std::set{file(mirror(0))});
}

TEST_F(ReflectorCacheTest, DamagedFilesAreRebuiltAndOldOnesForgotten) {
  ASSERT_TRUE(bake_reflectors(scene_));
  const fs::path old_file = file(mirror(0));
  const std::string whole = *read_file(old_file);
  ASSERT_TRUE(write_file(old_file, whole.substr(0, whole.size() / 2)));
  EXPECT_TRUE(ReflectorCache(scene_).reflector(mirror(0))) << "a warning, and the reflector";
  ASSERT_TRUE(bake_reflectors(scene_));
  EXPECT_EQ(*read_file(old_file), whole);
  methods::settings(scene_).resolution = 8;
  const Result<BakedReflectors> baked = bake_reflectors(scene_);
  ASSERT_TRUE(baked);
  EXPECT_TRUE(fs::exists(old_file)) << "of another state, perhaps";
  forget_other_reflectors(*baked);
  EXPECT_FALSE(fs::exists(old_file));
  EXPECT_TRUE(fs::exists(file(mirror(0))));
  EXPECT_TRUE(fs::exists(file(glass())));
}

}  // namespace
}  // namespace parvis::reflector_maps

#include "scene/data/room_data.h"

#include <gtest/gtest.h>

#include "scene/data/scene.h"

namespace parvis::scene {
namespace {

struct Lanterns {
  static constexpr std::string_view name = "test.lanterns";
  static constexpr DataRole role = DataRole::static_content;
  int count = 3;
  std::vector<float> heights_m;

  void hash(ContentHash& hash) const {
    hash.add(count);
    hash.add(heights_m);
  }
};

struct Wind {
  static constexpr std::string_view name = "test.wind";
  static constexpr DataRole role = DataRole::dynamic_content;
  float speed = 0.0f;

  void hash(ContentHash& hash) const { hash.add(speed); }
};

std::uint64_t hash_of(const Scene& scene, std::initializer_list<DataRole> roles) {
  ContentHash hash;
  scene.room_data.hash(hash, [&](DataRole role) { return std::ranges::find(roles, role) != roles.end(); });
  return hash.value();
}

TEST(RoomData, IsFoundByItsTypeAndHasADefault) {
  const Scene empty;
  EXPECT_EQ(empty.data<Lanterns>().count, 3);
  Scene scene;
  scene.data<Lanterns>().count = 5;
  scene.data<Wind>().speed = 2.0f;
  EXPECT_EQ(std::as_const(scene).data<Lanterns>().count, 5);
  EXPECT_EQ(std::as_const(scene).data<Wind>().speed, 2.0f);
}

TEST(RoomData, OfACopyIsTheCopysOwn) {
  Scene scene;
  scene.data<Lanterns>().heights_m = {4.0f};
  Scene copy = scene;
  copy.data<Lanterns>().heights_m[0] = 6.0f;
  EXPECT_EQ(scene.data<Lanterns>().heights_m[0], 4.0f);
  scene = copy;
  EXPECT_EQ(scene.data<Lanterns>().heights_m[0], 6.0f);
  const Scene moved = std::move(copy);
  EXPECT_EQ(moved.data<Lanterns>().heights_m[0], 6.0f);
}

TEST(RoomData, CountsByContentNotByHowItWasSet) {
  Scene a, b;
  a.data<Lanterns>().count = 7, a.data<Wind>().speed = 1.0f;
  b.data<Wind>().speed = 1.0f, b.data<Lanterns>().count = 7;
  const std::initializer_list<DataRole> all{DataRole::static_content, DataRole::dynamic_content};
  EXPECT_EQ(hash_of(a, all), hash_of(b, all));
  b.data<Lanterns>().count = 8;
  EXPECT_NE(hash_of(a, all), hash_of(b, all));

  Scene untouched, read;
  EXPECT_EQ(read.data<Lanterns>().count, 3);
  EXPECT_EQ(hash_of(untouched, all), hash_of(read, all)) << "reading alone changes nothing";
}

TEST(RoomData, CountsOnlyWhereItsRoleIsWanted) {
  Scene still, windy;
  windy.data<Wind>().speed = 9.0f;
  EXPECT_EQ(hash_of(still, {DataRole::static_content}), hash_of(windy, {DataRole::static_content}));
  EXPECT_NE(hash_of(still, {DataRole::dynamic_content}), hash_of(windy, {DataRole::dynamic_content}));
}

}  // namespace
}  // namespace parvis::scene

#include "graphics/shading/sky_visibility.h"

#include <gtest/gtest.h>

#include "graphics/shading/test_axes.h"

namespace parvis::shading {
namespace {

/// The top of a block, as seen from above.
Mesh roof(float west, float east, float south, float north, float height_m) {
  Mesh mesh;
  mesh.positions = {
      {west, south, height_m}, {east, south, height_m}, {east, north, height_m}, {west, north, height_m}};
  mesh.indices = {0, 1, 2, 0, 2, 3};
  return mesh;
}

/// A street 16 m wide along y between rows 20 m high.
SkyVisibility street() {
  Heightfield heights({{-60, -100, 0}, {60, 100, 20}});
  heights.add(roof(-60, -8, -100, 100, 20), glm::mat4(1.0f));
  heights.add(roof(8, 60, -100, 100, 20), glm::mat4(1.0f));
  return make_sky_visibility(heights);
}

float share(const SkyVisibility& sky, vec3 position, vec3 normal) {
  return sky_share_of_normal(sky.at(sky_visibility_coordinates(sky.grid, position, normal)), normal);
}

TEST(SkyVisibility, AnEmptyPlaceIsOpen) {
  const SkyVisibility sky = make_sky_visibility(Heightfield(Bounds{}));
  for (const vec3 normal : {up, -up, vec3(1, 0, 0)}) EXPECT_NEAR(share(sky, {3, 4, 5}, normal), 1.0f, 0.01f);
}

TEST(SkyVisibility, AFlatPlaceIsOpen) {
  Heightfield heights({{-50, -50, 0}, {50, 50, 0.5f}});
  heights.add(roof(-50, 50, -50, 50, 0.2f), glm::mat4(1.0f));
  const SkyVisibility sky = make_sky_visibility(heights);
  EXPECT_NEAR(share(sky, {0, 0, 0.2f}, up), 1.0f, 0.02f);
  EXPECT_NEAR(share(sky, {10, 0, 1}, {0, 1, 0}), 1.0f, 0.02f);
}

TEST(SkyVisibility, AStreetSeesTheStripThatTheoryGives) {
  // The middle of an endless street sees sin(atan(half width / height)) of the cosine-weighted sky from its
  // ground; the first two bands and the walls' own light blur that.
  const float theory = 8.0f / std::sqrt(8.0f * 8.0f + 20.0f * 20.0f);
  EXPECT_NEAR(share(street(), {0, 0, 0}, up), theory, 0.15f);
}

TEST(SkyVisibility, ARenewedGridIsThatOfThePlaceAsItIsNow) {
  const Bounds place{{-200, -300, 0}, {200, 300, 20}};
  const auto heights_with = [&](bool has_block) {
    Heightfield heights(place);
    heights.add(roof(-200, -8, -300, 300, 20), glm::mat4(1.0f));
    if (has_block) heights.add(roof(20, 45, -30, 10, 12), glm::mat4(1.0f));
    return heights;
  };
  SkyVisibility sky = make_sky_visibility(heights_with(false));
  renew_sky_visibility(sky, heights_with(true), {{20, -30, 0}, {45, 10, 12}});
  EXPECT_EQ(sky.values, make_sky_visibility(heights_with(true)).values);
  renew_sky_visibility(sky, heights_with(false), {{20, -30, 0}, {45, 10, 12}});
  EXPECT_EQ(sky.values, make_sky_visibility(heights_with(false)).values);
}

TEST(SkyVisibility, WallsBrightenUpwardAndRoofsAreOpen) {
  const SkyVisibility sky = street();
  const vec3 east(1, 0, 0);
  const float low = share(sky, {-8, 0, 2}, east), middle = share(sky, {-8, 0, 10}, east),
              high = share(sky, {-8, 0, 19}, east);
  EXPECT_LT(low, middle);
  EXPECT_LT(middle, high);
  EXPECT_GT(share(sky, {-30, 0, 20}, up), 0.95f);
}

TEST(SkyVisibility, AGlossyStreetMirrorsMoreOfTheSkyAboveThanOfTheWalls) {
  const SkyVisibility sky = street();
  const vec4 cell = sky.at(sky_visibility_coordinates(sky.grid, {0, 0, 0}, up));
  EXPECT_GT(sky_share_of_direction(cell, up), sky_share_of_direction(cell, {1, 0, 0}) + 0.1f);
}

TEST(SkyVisibility, AStreetOfManyKilometresFitsATextureToItsEnd) {
  const float half_m = 15'000.0f;
  Heightfield heights({{-half_m, -24, 0}, {half_m, 24, 20}}, 1.0f, 40'000);
  heights.add(roof(-half_m, half_m, -24, -8, 20), glm::mat4(1.0f));
  heights.add(roof(-half_m, half_m, 8, 24, 20), glm::mat4(1.0f));
  const SkyVisibility sky = make_sky_visibility(heights);
  EXPECT_LE(sky.cells.x, 2048);  // what OpenGL 4.5 promises
  for (const float at_m : {500 - half_m, 0.0f, half_m - 500}) {
    EXPECT_NEAR(share(sky, {at_m, 0, 0}, up), share(street(), {0, 0, 0}, up), 0.05f) << at_m;
    EXPECT_GT(share(sky, {at_m, 0, 20}, up), 0.9f) << at_m;
  }
}

TEST(SkyVisibility, OutsideTheGridItsEdgeCounts) {
  EXPECT_NEAR(share(street(), {0, 0, 500}, up), 1.0f, 0.02f);
}

}  // namespace
}  // namespace parvis::shading

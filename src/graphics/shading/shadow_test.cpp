#include "graphics/shading/shadow.h"

#include <gtest/gtest.h>

#include "graphics/shading/test_axes.h"

namespace parvis::shading {
namespace {

constexpr int texels = 64;

/// The sun in the zenith over 64 m x 64 m, one texel per metre: a map that covers [0, 64]^2 and depth 0 at
/// 100 m of height, 1 at 0. West of x = 32 m stands a roof of 50 m.
SunShadow roof_in_the_west() {
  SunShadow shadow;
  mat4 uvz_from_world(0.0f);
  uvz_from_world[0][0] = uvz_from_world[1][1] = 1.0f / texels;
  uvz_from_world[2][2] = -0.01f;
  uvz_from_world[3] = vec4(0, 0, 1, 1);
  shadow.maps.uvz_from_world[0] = shadow.maps.uvz_from_world[1] = uvz_from_world;
  shadow.maps.texel_m = vec2(1.0f);
  shadow.maps.texel_uv = 1.0f / texels;
  for (ImageF& depth : shadow.depth) {
    depth = ImageF(texels, texels, 1, 1.0f);
    for (int y = 0; y < texels; ++y)
      for (int x = 0; x < texels / 2; ++x) *depth.at(x, y) = 0.5f;
  }
  return shadow;
}

float sun_at(const SunShadow& shadow, float x, float height_m = 10.0f) {
  return sun_visibility(shadow, {x, 20.0f, height_m}, up, up);
}

TEST(Shadow, LiesUnderTheRoofAndNotBesideIt) {
  const SunShadow shadow = roof_in_the_west();
  EXPECT_EQ(sun_at(shadow, 20), 0.0f);
  EXPECT_EQ(sun_at(shadow, 44), 1.0f);
  EXPECT_EQ(sun_at(shadow, 20, 60), 1.0f) << "above the roof";
}

/// A surface that faces the sun is looked up half a texel nearer to it.
TEST(Shadow, ASurfaceDoesNotShadeItself) {
  const SunShadow shadow = roof_in_the_west();
  EXPECT_EQ(sun_at(shadow, 20, 50), 1.0f);
  EXPECT_EQ(sun_at(shadow, 20, 49.6f), 1.0f);
  EXPECT_EQ(sun_at(shadow, 20, 49.4f), 0.0f);
}

/// A plane under a sun that is `tangent` times as far away aside as it is high: its map holds the plane
/// itself, and east of x = 40 m nothing.
struct SlopingSun {
  SunShadow shadow;
  vec3 to_sun;

  explicit SlopingSun(float tangent) : to_sun(glm::normalize(vec3(tangent, 0, 1))) {
    // x and y where the line to the sun crosses the ground; depth falls toward the sun
    mat4 uvz_from_world(0.0f);
    uvz_from_world[0][0] = uvz_from_world[1][1] = 1.0f / texels;
    uvz_from_world[2][0] = -tangent / texels;
    uvz_from_world[0][2] = -0.01f * to_sun.x, uvz_from_world[2][2] = -0.01f * to_sun.z;
    uvz_from_world[3] = vec4(0, 0, 0.8f, 1);
    shadow.maps.uvz_from_world[0] = shadow.maps.uvz_from_world[1] = uvz_from_world;
    shadow.maps.texel_m = vec2(to_sun.z);
    shadow.maps.texel_uv = 1.0f / texels;
    for (ImageF& depth : shadow.depth) {
      depth = ImageF(texels, texels, 1, 1.0f);
      for (int y = 0; y < texels; ++y)
        for (int x = 0; x < 40; ++x) *depth.at(x, y) = 0.8f - 0.01f * to_sun.x * (float(x) + 0.5f);
    }
  }
  float at(vec3 position) const { return sun_visibility(shadow, position, up, to_sun); }
};

/// Each texel of the filter is compared with the depth of the receiver's plane there.
TEST(Shadow, APlaneUnderALowSunDoesNotShadeItself) {
  for (const float tangent : {0.0f, 1.0f, -1.0f, 5.0f, -5.0f, 12.0f}) {
    const SlopingSun sun(tangent);
    for (float x = 4.0f; x < 36.0f; x += 0.37f)
      EXPECT_NEAR(sun.at({x, 20.3f, 0.0f}), 1.0f, 1e-5f) << "tangent " << tangent << " at " << x;
  }
}

/// The lookup does not leave the surface by texels: what lies under the plane by little is in shadow, up to
/// its edge.
TEST(Shadow, EdgesStayInPlaceUnderALowSun) {
  const float tangent = 3.0f;
  const SlopingSun sun(tangent);
  const float below_m = -8.0f;
  const auto under = [&](float x) {
    return sun.at({x + tangent * below_m, 20.3f, below_m});
  };  // under (x, y, 0)
  EXPECT_EQ(under(30.0f), 0.0f);
  EXPECT_NEAR(under(40.0f), 0.5f, 0.15f);
  EXPECT_EQ(under(42.0f), 1.0f);
}

/// The plane of a wall that the sun grazes lies metres below the ground a texel away; the ground casts no
/// shadow there.
TEST(Shadow, TheFootOfAGrazedWallIsLit) {
  const float tangent = 0.04f, wall_x = 40.3f, top_m = 20.0f;  // faces east; the sun stands nearly overhead
  SlopingSun sun(tangent);
  for (ImageF& depth : sun.shadow.depth)
    for (int y = 0; y < texels; ++y)
      for (int x = 0; x < texels; ++x) {
        const float u = float(x) + 0.5f;  // x where the line to the sun crosses the ground
        const float height_m = u > wall_x ? 0.0f : std::min((wall_x - u) / tangent, top_m);
        *depth.at(x, y) = 0.8f - 0.01f * glm::dot(sun.to_sun, vec3(u + tangent * height_m, 0, height_m));
      }
  const auto on_wall = [&](float height_m) {
    return sun_visibility(sun.shadow, {wall_x, 20.3f, height_m}, vec3(1, 0, 0), sun.to_sun);
  };
  for (float height_m = 0.5f; height_m < 19.0f; height_m += 0.7f)
    EXPECT_NEAR(on_wall(height_m), 1.0f, 1e-5f) << height_m << " m above the ground";
}

TEST(Shadow, ItsEdgeIsATentOverThreeTexels) {
  const SunShadow shadow = roof_in_the_west();
  EXPECT_EQ(sun_at(shadow, 30.0f), 0.0f);
  EXPECT_NEAR(sun_at(shadow, 32.0f), 0.5f, 1e-4f);
  EXPECT_EQ(sun_at(shadow, 34.0f), 1.0f);
  float before = 0.0f;
  for (int i = 0; i <= 40; ++i) {
    const float x = 30.0f + 0.1f * float(i), sun = sun_at(shadow, x);
    EXPECT_GE(sun, before - 1e-5f) << "at " << x;
    EXPECT_NEAR(sun + sun_at(shadow, 64.0f - x), 1.0f, 1e-4f) << "at " << x;
    before = sun;
  }
}

TEST(Shadow, OutsideTheMapsTheSunShines) {
  const SunShadow shadow = roof_in_the_west();
  for (const float x : {-5.0f, 0.5f, 63.5f, 70.0f}) EXPECT_EQ(sun_at(shadow, x), 1.0f) << "at " << x;
  EXPECT_EQ(sun_at(shadow, 20, -10), 1.0f) << "below the map";
}

TEST(Shadow, TheFineMapCountsWhereItReaches) {
  SunShadow shadow = roof_in_the_west();
  shadow.depth[shadow_near_map] = ImageF(texels, texels, 1, 1.0f);  // the roof has vanished from it
  EXPECT_EQ(sun_at(shadow, 20), 1.0f);
  shadow.maps.uvz_from_world[shadow_near_map][3].x = 2.0f;  // it lies elsewhere
  EXPECT_EQ(sun_at(shadow, 20), 0.0f);
}

TEST(Shadow, WithoutMapsTheSunShines) { EXPECT_EQ(sun_visibility({}, vec3(0.0f), up, up), 1.0f); }

}  // namespace
}  // namespace parvis::shading

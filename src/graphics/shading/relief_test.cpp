#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "graphics/shading/texture_frame.h"

namespace parvis::shading {
namespace {

/// A groove of depth 1 between x = 0.4 and x = 0.6 of the texture, and on its floor, from 0.5 on, a step to
/// 0.5.
struct Groove {
  bool has_step = false;

  float relief_depth(vec2 uv) const {
    if (uv.x < 0.4f || uv.x > 0.6f) return 0.0f;
    return has_step && uv.x > 0.5f ? 0.5f : 1.0f;
  }

#include "graphics/shading/relief.glsl"
};

/// A window of 1 m x 1.6 m: panes 12 cm deep, their frame and a bar between them 8 cm; depth 1 is 25 cm.
struct Window {
  float relief_depth(vec2 uv) const {
    if (uv.x < 0.0f || uv.x > 1.0f || uv.y < 0.0f || uv.y > 1.6f) return 0.0f;
    const bool is_frame = uv.x < 0.06f || uv.x > 0.94f || uv.y < 0.06f || uv.y > 1.54f;
    return is_frame || std::abs(uv.x - 0.5f) < 0.02f ? 0.32f : 0.48f;
  }

  /// Whether the light finds out, by small steps.
  bool is_lit(vec3 hit, vec2 uv_to_floor) const {
    constexpr int steps = 400;
    for (int i = 1; i < steps; ++i) {
      const float way = float(i) / float(steps);
      const vec2 at = vec2(hit.x, hit.y) + hit.z * way * uv_to_floor;
      if (relief_depth(at) < hit.z * (1.0f - way) - 0.005f) return false;
    }
    return true;
  }

#include "graphics/shading/relief.glsl"
};

/// The change of uv on the way to depth 1 in a direction so steep, turned at random.
vec2 random_way(Random& random, float min_degrees, float max_degrees) {
  const float turn = random.uniform(0.0f, 6.2831853f);
  const float along = 0.25f / std::tan(glm::radians(random.uniform(min_degrees, max_degrees)));
  return along * vec2(std::cos(turn), std::sin(turn));
}

TEST(Relief, AWindowHasNoLooseDarkPointsUnderAnySun) {
  Window window;
  Random random(1);
  constexpr float step_m = 0.01f;
  const auto light_at = [&](vec2 uv, vec2 view, vec2 sun) {
    return window.relief_light(window.relief_hit(uv, view), sun);
  };
  int deep = 0, dark = 0, loose = 0;
  for (int view_and_sun = 0; view_and_sun < 200; ++view_and_sun) {
    const vec2 view = random_way(random, 2.0f, 80.0f), sun = random_way(random, 8.0f, 70.0f);
    for (int i = 0; i < 200; ++i) {
      const vec2 uv(random.uniform(0.005f, 0.995f), random.uniform(0.005f, 1.595f));
      const vec3 hit = window.relief_hit(uv, view);
      deep += hit.z > window.relief_tolerance;
      if (window.relief_light(hit, sun) > 0.5f || !window.is_lit(hit, sun)) continue;
      ++dark;
      int lit = 0;
      for (const vec2 step : {vec2(step_m, 0), vec2(-step_m, 0), vec2(0, step_m), vec2(0, -step_m)})
        lit += light_at(uv + step, view, sun) > 0.5f;
      loose += lit >= 3;
    }
  }
  EXPECT_GT(deep, 30000);
  EXPECT_LT(dark, deep / 100) << "though the sun shines there";
  EXPECT_LE(loose, 1);
}

TEST(Relief, TheSurfaceItselfIsHitAtOnce) {
  const vec3 hit = Groove().relief_hit(vec2(0.3f, 0.5f), vec2(0.5f, 0.0f));
  EXPECT_EQ(hit, vec3(0.3f, 0.5f, 0.0f));
}

TEST(Relief, AFloorIsHitWhereItsDepthSays) {
  const vec3 hit = Groove().relief_hit(vec2(0.45f, 0.5f), vec2(0.1f, 0.02f));
  EXPECT_NEAR(hit.x, 0.55f, 1e-5f);
  EXPECT_NEAR(hit.y, 0.52f, 1e-5f);
  EXPECT_NEAR(hit.z, 1.0f, 1e-5f);
}

TEST(Relief, TheSideOfAnOpeningHidesItsFloor) {
  // Moves by 0.5 in u while it sinks by 1, and so is 0.2 deep at the groove's end, 0.1 away.
  const vec3 hit = Groove().relief_hit(vec2(0.5f, 0.5f), vec2(0.5f, 0.0f));
  EXPECT_NEAR(hit.z, 0.2f, 0.02f);
  EXPECT_NEAR(hit.x, 0.6f, 0.01f);
}

TEST(Relief, RaysStepDownToADeeperFloor) {
  Groove groove;
  groove.has_step = true;
  const vec3 hit = groove.relief_hit(vec2(0.55f, 0.5f), vec2(-0.12f, 0.0f));
  EXPECT_NEAR(hit.z, 1.0f, 1e-5f);
  EXPECT_NEAR(hit.x, 0.43f, 1e-5f);
}

TEST(Relief, LightComesInWhereTheOpeningLetsIt) {
  Groove groove;
  EXPECT_EQ(groove.relief_light(vec3(0.5f, 0.5f, 1.0f), vec2(0.05f, 0.0f)), 1.0f);
  EXPECT_EQ(groove.relief_light(vec3(0.5f, 0.5f, 1.0f), vec2(0.3f, 0.0f)), 0.0f);
  EXPECT_EQ(groove.relief_light(vec3(0.3f, 0.5f, 0.0f), vec2(0.3f, 0.0f)), 1.0f);
}

TEST(Relief, TheLitSideOfAnOpeningIsLitUpToItsEdge) {
  Groove groove;
  const vec2 to_sun(-0.1f, 0.0f);  // over the side that is looked at
  for (int i = 0; i < 200; ++i) {
    const vec3 hit = groove.relief_hit(vec2(0.5f + 0.0005f * float(i), 0.5f), vec2(1.2f, 0.0f));
    EXPECT_EQ(groove.relief_light(hit, to_sun), 1.0f) << hit.x << " " << hit.z;
  }
}

TEST(Relief, JointsOfBricksLieInNoShade) {
  Groove groove;
  const vec2 low_sun(8.0f, 0.0f);
  EXPECT_EQ(groove.relief_light(vec3(0.5f, 0.5f, 0.05f), low_sun), 1.0f);
  EXPECT_EQ(groove.relief_light(vec3(0.5f, 0.5f, 0.2f), low_sun), 0.0f) << "an opening does";
}

TEST(Relief, CoordinatesMoveAsTheTexturesEdgesSay) {
  // A texture of 4 by 2 metres on a wall that faces south; the view sinks at 45 degrees toward the east.
  TextureFrame frame{vec3(4, 0, 0), vec3(0, 0, 2), vec2(1, 0), vec2(0, -1)};
  const vec3 normal(0, -1, 0), direction = normalize(vec3(1, 1, 0));
  const vec2 moved = Groove().uv_through_relief(frame, normal, direction, 0.2f);
  EXPECT_NEAR(moved.x, 0.05f, 1e-5f);
  EXPECT_NEAR(moved.y, 0.0f, 1e-5f);
  frame.step_2 = frame.step_1;  // no area: no way
  EXPECT_EQ(Groove().uv_through_relief(frame, normal, direction, 0.2f), vec2(0.0f));
}

TEST(Relief, FarAwayThereIsNone) {
  EXPECT_EQ(Groove().relief_share(0.01f, 0.25f), 1.0f);
  EXPECT_EQ(Groove().relief_share(0.2f, 0.25f), 0.0f);
}

}  // namespace
}  // namespace parvis::shading

#include "graphics/shading/body_shade.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "graphics/shading/test_axes.h"

namespace parvis::shading {
namespace {

bool meets_box(vec3 p, vec3 direction, vec3 half_size) {
  float enters = 0.0f, leaves = 1e30f;
  for (int i = 0; i < 3; ++i) {
    const float a = (-half_size[i] - p[i]) / direction[i], b = (half_size[i] - p[i]) / direction[i];
    enters = std::max(enters, std::min(a, b)), leaves = std::min(leaves, std::max(a, b));
  }
  return enters < leaves;
}

/// The share of cosine-distributed rays about `normal` that meet the box.
float hidden_by_rays(vec3 p, vec3 normal, vec3 half_size) {
  constexpr int rays = 200000;
  Random random(7);
  const vec3 t = normalize(cross(std::abs(normal.z) < 0.9f ? up : vec3(1, 0, 0), normal)),
             b = cross(normal, t);
  int hits = 0;
  for (int i = 0; i < rays; ++i) {
    const float phi = 6.2831853f * random.uniform(), r2 = random.uniform(), r = std::sqrt(r2);
    hits += meets_box(p, r * std::cos(phi) * t + r * std::sin(phi) * b + std::sqrt(1.0f - r2) * normal,
                      half_size);
  }
  return float(hits) / float(rays);
}

const BodyShape car_shape{{{0.03f, 0.05f, 0.12f}, {0.97f, 0.95f, 1.0f}}, vec3(1.0f)};

Body car_at(vec3 place, float heading_rad, int object = 0) {
  const glm::mat4 world_from_model(vec4(std::cos(heading_rad), std::sin(heading_rad), 0, 0),
                                   vec4(-std::sin(heading_rad), std::cos(heading_rad), 0, 0),
                                   vec4(0, 0, 1, 0), vec4(place, 1));
  return *body_of({{-2.2f, -0.9f, 0}, {2.2f, 0.9f, 1.5f}}, car_shape, world_from_model, object);
}

TEST(BodyShade, OnTheGroundItIsWhatRaysSay) {
  const vec3 half_size(2.2f, 0.9f, 0.7f);
  // On the road: under the middle, under an edge, beside each side, off each corner.
  for (const vec3 p : {vec3(0, 0, -0.85f), vec3(2.1f, 0.2f, -0.85f), vec3(0.4f, 1.2f, -0.85f),
                       vec3(0.4f, -1.2f, -0.85f), vec3(3, 0.1f, -0.85f), vec3(-2.6f, 1.4f, -0.85f),
                       vec3(-2.6f, -1.4f, -0.85f), vec3(2.6f, -1.4f, -0.85f), vec3(2.6f, 1.4f, -0.85f)})
    EXPECT_NEAR(hidden_by_box(p, up, half_size), hidden_by_rays(p, up, half_size), 0.005f)  // 4 deviations
        << p.x << ", " << p.y;
}

TEST(BodyShade, OnWallsItIsWhatRaysSay) {
  const vec3 half_size(2.2f, 0.9f, 0.7f);
  for (const vec3 p : {vec3(0, 2, 0), vec3(1, 2.5f, 1.6f), vec3(-3, 2, -0.5f)})
    EXPECT_NEAR(hidden_by_box(p, {0, -1, 0}, half_size), hidden_by_rays(p, {0, -1, 0}, half_size), 0.005f);
  EXPECT_EQ(hidden_by_box({0, 2, 0}, {0, 1, 0}, half_size), 0.0f);  // it looks away
}

TEST(BodyShade, ACarDarkensTheRoadBelowItAndFadesOut) {
  const Body car = car_at({10, 20, 0}, 0.5f);
  EXPECT_LT(sky_share_beside(car, {10, 20, 0}, up), 0.1f);
  float before = 0.0f;
  for (float away_m = 0.0f; away_m < 6.0f; away_m += 0.25f) {
    const float share =
        sky_share_beside(car, vec3(10, 20, 0) + away_m * vec3(-std::sin(0.5f), std::cos(0.5f), 0), up);
    EXPECT_GE(share, before - 1e-4f) << away_m;
    before = share;
  }
  EXPECT_EQ(before, 1.0f);
}

TEST(BodyShade, TheGridFindsTheBodiesThatReachAPoint) {
  std::vector<Body> bodies;
  for (int i = 0; i < 20; ++i)
    bodies.push_back(car_at({-60.0f + 6.0f * float(i), 3.0f * float(i % 2), 0}, 0.3f, i));
  const BodyShade shade = make_body_shade(bodies, {0, 0, 2});
  Random random(3);
  for (int i = 0; i < 500; ++i) {
    const vec3 p(120.0f * random.uniform() - 60.0f, 20.0f * random.uniform() - 10.0f, 0.0f);
    float expected = 1.0f;
    for (const Body& body : bodies) expected *= sky_share_beside(body, p, up);
    EXPECT_NEAR(sky_share_beside_bodies(shade, p, up, -1), expected, 1e-5f);
  }
}

TEST(BodyShade, ABodyDoesNotShadeItself) {
  const Body car = car_at({0, 0, 0}, 0.0f, 5);
  const BodyShade shade = make_body_shade(std::span(&car, 1), {0, 0, 2});
  EXPECT_EQ(sky_share_beside_bodies(shade, {0, 0, 1}, up, 5), 1.0f);
  EXPECT_LT(sky_share_beside_bodies(shade, {0, 0, 0}, up, 6), 0.1f);
}

/// A car that drives through a wall: along the wall its shade never jumps, and it leaves the wall some light.
TEST(BodyShade, AWallThatABodyReachesIntoIsNotBlack) {
  for (const vec3 normal : {vec3(-1, 0, 0), vec3(0, -1, 0)}) {
    const Body car = car_at({0, 0, 0}, 0.0f);
    const vec3 along(normal.y, normal.x, 0), start = vec3(0.2f, 0.2f, 0.7f) - 4.0f * along;
    float before = 1.0f;
    for (float way_m = 0.0f; way_m < 8.0f; way_m += 0.01f) {
      const float share = sky_share_beside(car, start + way_m * along, normal);
      EXPECT_NEAR(share, before, 0.03f) << way_m << " m along";
      EXPECT_GT(share, 0.45f) << way_m << " m along";
      before = share;
    }
  }
}

/// So does the road that a car's box dips into.
TEST(BodyShade, AtABoxesFootTheShadeGoesOn) {
  const Body car = car_at({0, 0, 0}, 0.0f);
  float before = sky_share_beside(car, {0.1f, 0.1f, 0.1f}, up);
  for (float height_m = 0.1f; height_m < 0.7f; height_m += 0.005f) {
    const float share = sky_share_beside(car, {0.1f, 0.1f, height_m}, up);
    EXPECT_NEAR(share, before, 0.03f) << height_m;
    before = share;
  }
}

TEST(BodyShade, BodiesFadeBeforeTheyAreLeftOut) {
  float before = 0.0f;
  for (float away_m = 0.0f; away_m < 90.0f; away_m += 0.5f) {
    const Body car = car_at({away_m, 0, 0}, 0.0f);
    const float share =
        sky_share_beside_bodies(make_body_shade(std::span(&car, 1), {0, 0, 0}), {away_m, 0, 0}, up, -1);
    EXPECT_NEAR(share, before, away_m > 0.0f ? 0.06f : 1.0f) << away_m;
    before = share;
  }
  EXPECT_EQ(before, 1.0f);
}

TEST(BodyShade, AMultitudeFadesTowardItsFarthest) {
  std::vector<Body> crowd;
  for (int i = 0; i < max_bodies + 1; ++i) crowd.push_back(car_at({float(i), 0, 0}, 0.0f, i));
  const BodyShade shade = make_body_shade(crowd, {0, 0, 0});
  EXPECT_EQ(shade.bodies[0].coverage.z, 1.0f);
  EXPECT_GT(shade.bodies[max_bodies - 1].coverage.z, 0.0f);
  EXPECT_LT(shade.bodies[max_bodies - 1].coverage.z, 0.1f);
}

TEST(BodyShade, WhatIsHalfFilledHidesHalf) {
  BodyShape half = car_shape;
  half.coverage.z = 0.5f;
  const Body full = car_at({0, 0, 0}, 0.0f);
  const Body grid = *body_of({{-2.2f, -0.9f, 0}, {2.2f, 0.9f, 1.5f}}, half, glm::mat4(1.0f), 0);
  const float hidden = 1.0f - sky_share_beside(full, {0, 0, 0}, up);
  EXPECT_NEAR(1.0f - sky_share_beside(grid, {0, 0, 0}, up), 0.5f * hidden, 0.05f);
}

TEST(BodyShade, FarAwayAndWithoutBodiesAllIsOpen) {
  EXPECT_EQ(sky_share_beside_bodies(make_body_shade({}, {0, 0, 0}), {1, 2, 3}, up, -1), 1.0f);
  const Body car = car_at({0, 0, 0}, 0.0f);
  EXPECT_EQ(sky_share_beside_bodies(make_body_shade(std::span(&car, 1), {500, 0, 0}), {0, 0, 0}, up, -1),
            1.0f);
}

TEST(BodyShade, WhatNoBoxDescribesIsNoBody) {
  EXPECT_FALSE(body_of(Bounds{}, {}, glm::mat4(1.0f), 0));
  EXPECT_FALSE(body_of({{-100, -1, 0}, {100, 1, 1}}, {}, glm::mat4(1.0f), 0));
  EXPECT_FALSE(body_of({{-1, -1, 0}, {1, 1, 1}}, {}, glm::mat4(0.0f), 0));
}

}  // namespace
}  // namespace parvis::shading

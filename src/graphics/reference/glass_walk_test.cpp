#include "graphics/reference/glass_walk.h"

#include <gtest/gtest.h>

#include "graphics/reference/tracer.h"
#include "scene/data/test_scene.h"

namespace parvis::reference {
namespace {

using glm::vec3;

scene::Material solid_glass(float ior = 1.5f) {
  scene::Material glass;
  glass.ior = ior;
  glass.roughness = 0.0f;
  glass.is_mirror_like = true;
  return glass;
}

scene::Scene glass_scene(Mesh mesh, const scene::Material& glass = solid_glass()) {
  scene::Scene scene;
  scene.sun.irradiance = vec3(0.0f);
  scene::add(scene, scene::model_of(std::move(mesh), glass), true);
  scene.objects.back().takes_reflection = true;
  return scene;
}

/// The exits of a ray that hits glass first.
std::vector<GlassExit> through(const scene::Scene& scene, const Ray& ray) {
  const RayScene rays(scene);
  const std::optional<Hit> hit = rays.nearest_hit(ray);
  EXPECT_TRUE(hit);
  if (!hit) return {};
  return glass_exits(rays, *hit, shading_point(*hit, ray.direction, 0.0f), {ray, 0.0f, 0.0f});
}

vec3 sum_of_shares(const std::vector<GlassExit>& exits) {
  vec3 sum(0.0f);
  for (const GlassExit& exit : exits) sum += exit.share;
  return sum;
}

TEST(GlassWalk, APaneMovesARayAsideAndKeepsItsDirection) {
  const float thick = 0.3f, angle = 0.7f;
  const scene::Scene scene = glass_scene(scene::box({-50, -50, -thick}, {50, 50, 0}));
  const vec3 direction(std::sin(angle), 0.0f, -std::cos(angle));
  const std::vector<GlassExit> exits = through(scene, {vec3(0.0f) - direction, direction});
  ASSERT_FALSE(exits.empty());
  const Ray& out = exits.front().cone.ray;
  EXPECT_LT(glm::distance(out.direction, direction), 1e-5f);
  // t sin(a - b) / cos b, where b is the angle within
  const float inside = std::asin(std::sin(angle) / 1.5f);
  const vec3 aside = out.origin - glm::dot(out.origin, direction) * direction;
  EXPECT_NEAR(glm::length(aside), thick * std::sin(angle - inside) / std::cos(inside), 3e-4f);
}

TEST(GlassWalk, ABallGathersRaysInItsFocus) {
  for (const float ior : {1.33f, 1.5f, 1.8f}) {
    const scene::Scene scene = glass_scene(scene::sphere(vec3(0.0f), 1.0f, 256), solid_glass(ior));
    // Near the axis, and beside the seam of the mesh, where rays may pass between its triangles.
    const float height = 0.03f;
    const Ray out = through(scene, {{height, 0.001f, 5}, {0, 0, -1}}).front().cone.ray;
    const float to_axis = -out.origin.x / out.direction.x;
    EXPECT_NEAR(-(out.origin.z + to_axis * out.direction.z), ior / (2.0f * (ior - 1.0f)), 0.02f);
  }
}

TEST(GlassWalk, AConeNarrowsTowardTheFocus) {
  const scene::Scene scene = glass_scene(scene::sphere(vec3(0.0f), 1.0f, 256));
  const RayScene rays(scene);
  const Ray ray{{0.02f, 0.01f, 5}, {0, 0, -1}};
  const std::optional<Hit> hit = rays.nearest_hit(ray);
  ASSERT_TRUE(hit);
  constexpr float width_m = 0.01f;
  const Cone cone =
      glass_exits(rays, *hit, shading_point(*hit, ray.direction, width_m), {ray, width_m, 0.0f}).front().cone;
  EXPECT_NEAR(-cone.width_m / cone.spread, 0.5f, 0.05f) << "1.5 radii from the centre";
}

TEST(GlassWalk, ReflectsInsideWhereNoLightGetsOut) {
  // Into the end of a rod, flat upon its side: beyond the critical angle of 41.8 degrees there.
  const scene::Scene scene = glass_scene(scene::box({-1, -1, -20}, {1, 1, 0}));
  const float angle = 0.6f;
  const vec3 direction(std::sin(angle), 0.0f, -std::cos(angle));
  const std::vector<GlassExit> exits = through(scene, {vec3(0.0f) - direction, direction});
  ASSERT_FALSE(exits.empty());
  EXPECT_LT(exits.front().cone.ray.origin.z, -19.9f) << "out of the other end";
  EXPECT_NEAR(std::abs(exits.front().cone.ray.direction.x), std::sin(angle), 1e-4f);
  EXPECT_GT(exits.front().share.x, 0.9f);
}

TEST(GlassWalk, KeepsLightAndAbsorbsByBeersLaw) {
  scene::Material glass = solid_glass();
  const Mesh ball = scene::sphere(vec3(0.0f), 1.0f, 64);
  const Ray ray{{0.9f, 0, 5}, {0, 0, -1}};
  const vec3 clear = sum_of_shares(through(glass_scene(ball, glass), ray));
  EXPECT_LE(clear.x, 1.0f);
  EXPECT_GT(clear.x, 0.997f);
  glass.absorption_per_m = {0.0f, 0.5f, 2.0f};
  const vec3 tinted = through(glass_scene(ball, glass), {{0, 0, 5}, {0, 0, -1}}).front().share;
  const vec3 first = through(glass_scene(ball), {{0, 0, 5}, {0, 0, -1}}).front().share;
  EXPECT_NEAR(tinted.x / first.x, 1.0f, 1e-3f);
  EXPECT_NEAR(tinted.y / first.y, std::exp(-1.0f), 1e-3f);
  EXPECT_NEAR(tinted.z / first.z, std::exp(-4.0f), 1e-3f);
}

TEST(GlassWalk, WhatStandsInGlassIsSeenAndAHoleLetsRaysOn) {
  scene::Scene scene = glass_scene(scene::sphere(vec3(0.0f), 1.0f, 64));
  scene::add(scene, scene::model_of(scene::sphere(vec3(0.0f), 0.2f, 16), scene::matt(vec3(0.5f))));
  const std::vector<GlassExit> exits = through(scene, {{0, 0, 5}, {0, 0, -1}});
  ASSERT_EQ(exits.size(), 1u);
  EXPECT_NEAR(exits.front().cone.ray.origin.z, 1.0f, 2e-3f) << "the ray begins in the glass";
  const std::vector<GlassExit> open = through(glass_scene(scene::ground(1.0f)), {{0, 0, 5}, {0, 0, -1}});
  ASSERT_EQ(open.size(), 1u);
  EXPECT_LT(open.front().cone.ray.direction.z, -0.999f);
}

/// A white furnace: in light from everywhere glass cannot be seen.
TEST(GlassPicture, IsNoBrighterThanWhatLightsIt) {
  const scene::Scene scene = glass_scene(scene::sphere(vec3(0.0f), 1.0f, 64));
  const RayScene rays(scene);
  const shading::SkyLight sky = shading::make_sky_light(ImageF(32, 16, 3, 1.0f), 1.0f, 0.0f);
  Camera camera;
  camera.world_from_camera = look_at({0, -4, 0}, {0, 0, 0});
  const TracedPicture picture = trace_picture(rays, scene, sky, camera, 64, 64, {});
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x)
      for (int c = 0; c < 3; ++c) {
        ASSERT_LT(picture.radiance.at(x, y)[c], 1.015f);
        ASSERT_GT(picture.radiance.at(x, y)[c], 0.98f);
      }
  EXPECT_EQ(*picture.mirror_mask.at(32, 32), 255);
}

TEST(GlassPicture, ABallTurnsItsSurroundingsRound) {
  scene::Scene scene = glass_scene(scene::sphere(vec3(0.0f), 1.0f, 64));
  scene::Material red = scene::matt(vec3(0.0f)), green = red;
  red.emission = {1, 0, 0}, green.emission = {0, 1, 0};
  scene::add(scene, scene::model_of(scene::quad({0, 6, -9}, {9, 6, -9}, {9, 6, 9}, {0, 6, 9}), red));
  scene::add(scene, scene::model_of(scene::quad({-9, 6, -9}, {0, 6, -9}, {0, 6, 9}, {-9, 6, 9}), green));
  const RayScene rays(scene);
  const shading::SkyLight sky = shading::make_sky_light(ImageF(32, 16, 3, 0.0f), 1.0f, 0.0f);
  Camera camera;
  camera.world_from_camera = look_at({0, -4, 0}, {0, 0, 0});
  const TracedPicture picture = trace_picture(rays, scene, sky, camera, 65, 65, {});
  EXPECT_GT(picture.radiance.at(60, 2)[0], 0.9f) << "beside the ball: red to the right";
  EXPECT_GT(picture.radiance.at(36, 32)[1], 0.8f) << "within: green";
  EXPECT_LT(picture.radiance.at(36, 32)[0], 0.1f);
}

}  // namespace
}  // namespace parvis::reference

#include "reflections/reference_maps/height_pyramid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "base/random.h"
#include "graphics/reference/ray_scene.h"
#include "scene/data/test_scene.h"

namespace parvis::reference_maps {
namespace {

constexpr float reach_m = 500.0f;

/// Towers of chance heights on `cells` by `cells` squares of `cell_m`, some squares empty.
Mesh towers(int cells, float cell_m, std::uint64_t seed) {
  Mesh mesh = scene::quad({0, 0, 0}, {float(cells) * cell_m, 0, 0},
                          {float(cells) * cell_m, float(cells) * cell_m, 0}, {0, float(cells) * cell_m, 0});
  Random random(seed);
  for (int y = 0; y < cells; ++y)
    for (int x = 0; x < cells; ++x) {
      const float height = random.uniform(-20.0f, 15.0f);
      const glm::vec3 corner(float(x) * cell_m, float(y) * cell_m, 0.0f);
      if (height > 0.5f) append(mesh, scene::box(corner, corner + glm::vec3(cell_m, cell_m, height)));
    }
  return mesh;
}

HeightPyramid pyramid_of(const Mesh& mesh, float cell_m) {
  shading::Heightfield heightfield(mesh.bounds(), cell_m);
  heightfield.add(mesh, glm::mat4(1.0f));
  return HeightPyramid(heightfield);
}

struct TestRay {
  glm::vec3 origin, direction;
};

/// A ray from above the ground as bodywork casts them: most of them flat.
TestRay chance_ray(Random& random, float size_m) {
  const float turn = random.uniform(0.0f, 6.2831853f), rise = random.uniform(-0.6f, 0.6f);
  return {{random.uniform(-5.0f, size_m + 5.0f), random.uniform(-5.0f, size_m + 5.0f),
           random.uniform(0.1f, 18.0f)},
          glm::normalize(glm::vec3(std::cos(turn), std::sin(turn), rise))};
}

/// The nearest cell as a box without a bottom, tried one by one.
float brute_force(const HeightPyramid& pyramid, const TestRay& ray) {
  float nearest = reach_m;
  const ImageF& heights = pyramid.levels().front();
  for (int y = 0; y < pyramid.cells().y; ++y)
    for (int x = 0; x < pyramid.cells().x; ++x) {
      const glm::vec2 low = pyramid.origin() + pyramid.cell_m() * glm::vec2(x, y),
                      high = low + pyramid.cell_m();
      float from = 0.0f, to = reach_m;
      for (int axis = 0; axis < 2; ++axis) {
        const float a = (low[axis] - ray.origin[axis]) / ray.direction[axis];
        const float b = (high[axis] - ray.origin[axis]) / ray.direction[axis];
        from = std::max(from, std::min(a, b)), to = std::min(to, std::max(a, b));
      }
      if (from >= to) continue;
      const float height = *heights.at(x, y);
      const bool starts_below = from == 0.0f && ray.origin.z < height;
      if (starts_below) continue;
      if (ray.origin.z + from * ray.direction.z < height)
        nearest = std::min(nearest, from);
      else if (ray.origin.z + to * ray.direction.z < height)
        nearest = std::min(nearest, (height - ray.origin.z) / ray.direction.z);
    }
  return nearest;
}

TEST(HeightPyramid, WalksMeetWhatTryingEveryCellMeets) {
  for (const float cell_m : {0.25f, 1.0f, 2.5f}) {
    const HeightPyramid pyramid = pyramid_of(towers(37, cell_m, 3), cell_m);
    Random random(5);
    int hits = 0;
    for (int i = 0; i < 3000; ++i) {
      const TestRay ray = chance_ray(random, 37.0f * cell_m);
      const float expected = brute_force(pyramid, ray);
      const HeightHit hit = pyramid.walk(ray.origin, ray.direction, reach_m);
      const HeightHit by_levels = pyramid.walk_by_levels(ray.origin, ray.direction, reach_m);
      ASSERT_NEAR(hit.distance_m, expected, 2e-3f) << "cells of " << cell_m << " m, ray " << i;
      ASSERT_NEAR(by_levels.distance_m, expected, 2e-3f) << "cells of " << cell_m << " m, ray " << i;
      ASSERT_EQ(hit.kind == HitKind::nothing, expected == reach_m);
      hits += hit.kind != HitKind::nothing;
    }
    EXPECT_GT(hits, 500);
  }
}

TEST(HeightPyramid, TowersOnCellsAreHitWhereTheRayTracerHitsThem) {
  constexpr float cell_m = 2.0f;
  const Mesh mesh = towers(24, cell_m, 11);
  const HeightPyramid pyramid = pyramid_of(mesh, cell_m);
  scene::Scene scene;
  scene::Material material = scene::matt(glm::vec3(0.5f));
  scene::add(scene, scene::model_of(mesh, material));
  const reference::RayScene rays(scene);
  Random random(6);
  int compared = 0;
  for (int i = 0; i < 3000; ++i) {
    const TestRay ray = chance_ray(random, 24.0f * cell_m);
    const glm::ivec2 cell(glm::floor((glm::vec2(ray.origin) - pyramid.origin()) / cell_m));
    const bool is_over = std::min(cell.x, cell.y) >= 0 && std::max(cell.x, cell.y) < 24;
    if (!is_over || *pyramid.levels().front().at(cell.x, cell.y) > ray.origin.z) continue;
    const std::optional<reference::Hit> truth = rays.nearest_hit({ray.origin, ray.direction});
    const HeightHit hit = pyramid.walk_by_levels(ray.origin, ray.direction, reach_m);
    const glm::vec3 at = ray.origin + hit.distance_m * ray.direction;
    const bool is_on_margin = std::max(at.x, at.y) > 24.0f * cell_m;  // the last cells reach beyond the mesh
    if (!truth && is_on_margin) continue;
    ASSERT_EQ(hit.kind != HitKind::nothing, truth.has_value()) << "ray " << i;
    if (!truth) continue;
    ASSERT_NEAR(hit.distance_m, truth->distance_m, 2e-3f) << "ray " << i;
    ++compared;
  }
  EXPECT_GT(compared, 500);
}

// Section 4.2: "the entering point of the ray into the cell".
TEST(HeightPyramid, ThePapersWalkStopsWhereTheRayEntersAHigherCell) {
  const HeightPyramid pyramid = pyramid_of(towers(37, 1.0f, 3), 1.0f);
  Random random(8);
  int tops = 0;
  for (int i = 0; i < 3000; ++i) {
    const TestRay ray = chance_ray(random, 37.0f);
    const HeightHit exact = pyramid.walk(ray.origin, ray.direction, reach_m);
    const HeightHit entered = pyramid.walk_to_cell(ray.origin, ray.direction, reach_m);
    if (entered.kind == HitKind::nothing || entered.distance_m == 0.0f) continue;
    const glm::vec3 at = ray.origin + entered.distance_m * ray.direction;
    const glm::vec2 in_cell = glm::fract(glm::vec2(at));
    const float off_border =
        std::min(std::min(in_cell.x, 1.0f - in_cell.x), std::min(in_cell.y, 1.0f - in_cell.y));
    ASSERT_LT(off_border, 1e-3f) << "a hit lies on a cell's side";
    if (exact.kind == HitKind::side) {
      ASSERT_NEAR(entered.distance_m, exact.distance_m, 1e-3f);
    } else if (exact.kind == HitKind::top) {
      ASSERT_GT(entered.distance_m, exact.distance_m);
      ++tops;
    }
  }
  EXPECT_GT(tops, 30);
}

TEST(HeightPyramid, ARayAlongTheAxesOrOutOfThePlaceEnds) {
  const HeightPyramid pyramid = pyramid_of(towers(9, 1.0f, 2), 1.0f);
  for (const glm::vec3 direction :
       {glm::vec3(1, 0, 0), glm::vec3(0, -1, 0), glm::vec3(0, 0, 1), glm::vec3(-0.6f, 0, 0.8f)})
    EXPECT_EQ(pyramid.walk_by_levels({4.5f, 4.5f, 40.0f}, direction, reach_m).kind, HitKind::nothing);
  const HeightHit down = pyramid.walk_by_levels({4.5f, 4.5f, 40.0f}, {0, 0, -1}, reach_m);
  EXPECT_EQ(down.kind, HitKind::top);
  EXPECT_NEAR(down.distance_m, 40.0f - *pyramid.levels().front().at(4, 4), 1e-3f);
  EXPECT_EQ(pyramid.walk_by_levels({-50, -50, 3}, {-1, 0, 0}, reach_m).kind, HitKind::nothing);
}

TEST(HeightPyramid, AnEmptyPlaceIsHitNowhere) {
  const HeightPyramid pyramid{shading::Heightfield(Bounds{})};
  EXPECT_EQ(pyramid.walk_by_levels({0, 0, 1}, {1, 0, 0}, reach_m).kind, HitKind::nothing);
  EXPECT_EQ(pyramid.walk({0, 0, 1}, {0, 0, -1}, reach_m).kind, HitKind::nothing);
}

}  // namespace
}  // namespace parvis::reference_maps

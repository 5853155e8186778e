#include "graphics/render/foliage_levels.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "graphics/reference/metrics.h"
#include "graphics/reference/tracer.h"
#include "graphics/shading/tone_curve.h"
#include "scene/data/leaf_openness.h"
#include "scene/data/test_crown.h"

namespace parvis::render {
namespace {

using scene::crown, scene::crown_m, scene::leaf_m;

double area_m2(const Mesh& mesh) {
  double area = 0.0;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const glm::vec3 a = mesh.positions[mesh.indices[i]];
    area += 0.5 * double(glm::length(glm::cross(mesh.positions[mesh.indices[i + 1]] - a,
                                                mesh.positions[mesh.indices[i + 2]] - a)));
  }
  return area;
}

TEST(FoliageLevels, HaveEverFewerLeavesOverTheSameArea) {
  const Mesh whole = crown(6000);
  const std::vector<FoliageLevel> levels = foliage_levels(whole);
  ASSERT_EQ(levels.size(), std::size_t(max_foliage_levels));
  std::size_t finer = whole.indices.size();
  float error_m = 0.0f;
  std::uint64_t bytes = 0;
  for (const FoliageLevel& level : levels) {
    bytes += level.mesh.positions.size() * 32 + (level.vertices.size() + level.mesh.indices.size()) * 4;
    EXPECT_TRUE(check(level.mesh, "level"));
    EXPECT_NEAR(double(level.mesh.indices.size()) / double(finer), 2.0 / 3.0, 0.05);
    EXPECT_NEAR(area_m2(level.mesh) / area_m2(whole), 1.0, 1e-3);
    EXPECT_GT(level.error_m, error_m);
    ASSERT_EQ(level.vertices.size(), level.mesh.normals.size());
    for (std::size_t v = 0; v < level.vertices.size(); ++v)
      EXPECT_EQ(level.mesh.normals[v], whole.normals[level.vertices[v]]);
    finer = level.mesh.indices.size(), error_m = level.error_m;
  }
  EXPECT_LE(bytes, max_level_bytes(whole));
  EXPECT_GE(double(bytes), 0.9 * double(max_level_bytes(whole)));
}

/// Each eighth of the crown keeps its share of the leaves.
TEST(FoliageLevels, ThinOutEvenly) {
  const Mesh whole = crown(6000);
  const auto leaves_of_octants = [](const Mesh& mesh) {
    std::array<double, 8> count{};
    for (const glm::vec3 p : mesh.positions)
      count[std::size_t((p.x > 0.0f) + 2 * (p.y > 0.0f) + 4 * (p.z > 0.0f))] += 1.0;
    for (double& octant : count) octant /= double(mesh.positions.size());
    return count;
  };
  const auto wanted = leaves_of_octants(whole);
  for (const FoliageLevel& level : foliage_levels(whole)) {
    const auto found = leaves_of_octants(level.mesh);
    for (std::size_t octant = 0; octant < 8; ++octant) EXPECT_NEAR(found[octant], wanted[octant], 0.03);
  }
}

TEST(FoliageLevels, OfWhatHangsTogetherOrIsFewAreNone) {
  EXPECT_TRUE(foliage_levels(Mesh{}).empty());
  EXPECT_TRUE(foliage_levels(crown(100)).empty());
  EXPECT_TRUE(foliage_levels(scene::sphere({0, 0, 0}, 1.0f, 64)).empty());
}

/// A crown before the sky, at so many pixels per metre, by an eye that stands so far aside.
Image8 picture(const Mesh& foliage, float pixels_per_metre, float aside_m = 0.0f) {
  constexpr float away_m = 30.0f, seen_m = 2.4f * crown_m;
  scene::Scene place;
  scene::Material leaf = scene::matt({0.10f, 0.22f, 0.05f});
  leaf.is_double_sided = true;
  leaf.translucency = 0.3f;
  scene::add(place, scene::model_of(foliage, leaf));
  Camera camera;
  camera.world_from_camera = look_at({aside_m, -away_m, 0}, {aside_m, 0, 0});
  camera.vertical_fov = 2.0f * std::atan(0.5f * seen_m / away_m);
  const reference::RayScene rays(place);
  const shading::SkyLight sky = shading::make_sky_light({}, 1.0f, 0.0f);
  reference::TraceOptions options;
  options.samples_per_pixel = 64;
  options.progress.clear();
  const int size = int(pixels_per_metre * seen_m);
  return shading::tone_mapped_picture(
      reference::trace_picture(rays, place, sky, camera, size, size, options).radiance, 1.0f);
}

/// Leaves of a level, shrunk to the size that they have in the mesh.
Mesh shrunk(const Mesh& level) {
  Mesh mesh = level;
  for (std::size_t i = 0; i < mesh.positions.size(); i += 4) {
    const float size = leaf_m / glm::distance(mesh.positions[i], mesh.positions[i + 1]);
    const glm::vec3 middle = 0.5f * (mesh.positions[i] + mesh.positions[i + 2]);
    for (std::size_t corner = i; corner < i + 4; ++corner)
      mesh.positions[corner] = middle + size * (mesh.positions[corner] - middle);
  }
  return mesh;
}

/// Each where it is drawn first: an error of a quarter of a pixel.
TEST(FoliageLevels, LookMoreLikeTheMeshThanLeavesThatOnlyBecomeFewer) {
  const Mesh whole = crown(6000);
  double all_enlarged = 0.0, all_fewer = 0.0;
  for (const FoliageLevel& level : foliage_levels(whole)) {
    const float pixels_per_metre = 0.25f / level.error_m;
    const Image8 truth = picture(whole, pixels_per_metre);
    const auto flip_of = [&](const Mesh& mesh) {
      return reference::compare(picture(mesh, pixels_per_metre), truth)->flip;
    };
    const double enlarged = flip_of(level.mesh), only_fewer = flip_of(shrunk(level.mesh));
    fmt::print("{} leaves, {:.1f} pixels per metre: FLIP {:.4f}, not enlarged {:.4f}\n",
               level.mesh.positions.size() / 4, pixels_per_metre, enlarged, only_fewer);
    all_enlarged += enlarged, all_fewer += only_fewer;
  }
  EXPECT_LT(all_enlarged, 0.65 * all_fewer);
}

/// No level pops up: where it takes the place of the one before, the picture changes less than by a step of
/// the eye that moves it by two pixels. The coarsest level in place of the mesh changes it more.
TEST(FoliageLevels, ChangeThePictureLessThanAStepOfTheEye) {
  const Mesh whole = crown(6000);
  const std::vector<FoliageLevel> levels = foliage_levels(whole);
  const Mesh* finer = &whole;
  for (const FoliageLevel& level : levels) {
    const float pixels_per_metre = 0.25f / level.error_m;
    const Image8 before = picture(*finer, pixels_per_metre);
    const double change = reference::compare(picture(level.mesh, pixels_per_metre), before)->flip;
    const double step =
        reference::compare(picture(*finer, pixels_per_metre, 2.0f / pixels_per_metre), before)->flip;
    fmt::print("{} leaves: FLIP {:.4f}, of a step {:.4f}\n", level.mesh.positions.size() / 4, change, step);
    EXPECT_LT(change, step);
    finer = &level.mesh;
  }
  const float near = 0.25f / levels.front().error_m;
  const Image8 before = picture(whole, near);
  EXPECT_GT(reference::compare(picture(levels.back().mesh, near), before)->flip,
            reference::compare(picture(whole, near, 2.0f / near), before)->flip);
}

/// The fraction of each vertex that is seen from outside at most.
std::vector<float> max_seen_of(const Mesh& foliage) {
  scene::Scene place;
  scene::add(place, scene::model_of(foliage, scene::leaf_material({0.10f, 0.22f, 0.05f}, 0.3f)));
  scene::find_leaf_openness(place);
  const std::span<const float> found = place.data<scene::LeafOpenness>().max_seen(*place.objects[0].model, 0);
  return {found.begin(), found.end()};
}

std::size_t leaves_of(const Mesh& mesh) { return mesh.positions.size() / 4; }

/// The first level is drawn until leaves are 32 pixels large. As many leaves less that hide others open
/// holes.
TEST(FoliageLevels, LeaveOutWhatACrownHides) {
  const Mesh whole = crown(6000);
  const std::vector<FoliageLevel> levels = foliage_levels(whole, max_seen_of(whole));
  ASSERT_EQ(levels.size(), std::size_t(max_foliage_levels));
  const Mesh& shown = levels.front().mesh;
  EXPECT_LT(double(leaves_of(shown)), 0.67 * double(leaves_of(whole)));
  EXPECT_NEAR(double(leaves_of(levels[1].mesh)) / double(leaves_of(shown)), 2.0 / 3.0, 0.05);
  const float pixels_per_metre = 0.25f / levels.front().error_m;
  const Image8 truth = picture(whole, pixels_per_metre);
  const auto flip_of = [&](const Mesh& mesh) {
    return reference::compare(picture(mesh, pixels_per_metre), truth)->flip;
  };
  Mesh fewer;
  for (std::size_t i = 0; i < whole.indices.size(); i += 6)
    if ((i / 6 * leaves_of(shown)) % leaves_of(whole) < leaves_of(shown))
      fewer.indices.insert(fewer.indices.end(), &whole.indices[i], &whole.indices[i] + 6);
  fewer.positions = whole.positions, fewer.normals = whole.normals, fewer.uvs = whole.uvs;
  const double hidden_left_out = flip_of(shown), others_left_out = flip_of(fewer);
  fmt::print("{} leaves, {:.1f} pixels per metre: FLIP {:.4f}, others left out {:.4f}\n", leaves_of(shown),
             pixels_per_metre, hidden_left_out, others_left_out);
  EXPECT_LT(hidden_left_out, 0.3 * others_left_out);
}

}  // namespace
}  // namespace parvis::render

#include "reflections/reflector_maps/reflector_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <numeric>

#include "base/random.h"
#include "base/test_data.h"
#include "base/test_directions.h"
#include "formats/meshes/assimp_reader.h"
#include "reflections/reflection_search/reflection_search.h"
#include "reflections/reflection_search/test_exact_reflection.h"
#include "reflections/reflector_maps/surface_rays.h"
#include "reflections/reflector_maps/test_reflectors.h"
#include "scene/data/test_scene.h"

namespace parvis::reflector_maps {
using namespace reflection_search;
namespace {

using Search = ReflectionSearch<ReflectorMap>;

constexpr double degree = 0.017453292519943295;

/// The ball without what lies below `height`.
Mesh open_ball(float height, int rings = 64) {
  Mesh mesh = ellipsoid_mesh(glm::vec3(1.0f), rings);
  std::vector<std::uint32_t> kept;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    float top = -1.0f;
    for (std::size_t k = 0; k < 3; ++k) top = std::max(top, mesh.positions[mesh.indices[i + k]].z);
    if (top > height) kept.insert(kept.end(), &mesh.indices[i], &mesh.indices[i] + 3);
  }
  mesh.indices = kept;
  return mesh;
}

Mesh turned_inside_out(Mesh mesh) {
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
    std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
  for (glm::vec3& normal : mesh.normals) normal = -normal;
  return mesh;
}

ReflectorMesh ordered(const Mesh& mesh) {
  Result<ReflectorMesh> made = reflector_mesh(mesh, "kettle");
  EXPECT_TRUE(made) << to_string(made.errors());
  return *std::move(made);
}

/// Each triangle in one patch, and seen from its centre before all others, from the side that the patch's
/// kind says.
void expect_whole(const ReflectorMesh& mesh, const std::vector<ReflectorPatch>& patches) {
  std::vector<int> times(mesh.neighbours.size());
  for (const ReflectorPatch& patch : patches) {
    const SurfaceRays rays(mesh, patch.triangles);
    for (const std::uint32_t t : patch.triangles) {
      ++times[t];
      const auto [a, b, c] = mesh.corners(t);
      const glm::vec3 to_middle = (a + b + c) / 3.0f - patch.centre;
      EXPECT_EQ(glm::dot(glm::cross(b - a, c - a), to_middle) > 0.0f, patch.is_convex);
      const std::optional<MetSurface> met = rays.along(patch.centre, to_middle);
      EXPECT_TRUE(met && glm::distance(met->position, patch.centre) > 0.99f * glm::length(to_middle));
    }
  }
  EXPECT_EQ(std::count(times.begin(), times.end(), 1), std::ptrdiff_t(times.size()));
}

TEST(ReflectorMesh, TurnsAllTrianglesOutward) {
  const Mesh ball = ellipsoid_mesh(glm::vec3(1.0f), 16);
  Mesh broken = ball;
  for (std::size_t i = 0; i < broken.indices.size(); i += 9)
    std::swap(broken.indices[i], broken.indices[i + 1]);
  for (std::size_t i = 0; i < broken.normals.size(); i += 2) broken.normals[i] = -broken.normals[i];
  for (std::size_t i = 0; i < broken.normals.size(); i += 5) broken.normals[i] = glm::vec3(0.0f);
  for (const Mesh& mesh : {ball, turned_inside_out(ball), broken}) {
    const ReflectorMesh made = ordered(mesh);
    EXPECT_EQ(made.open_edges, 0u);
    for (std::size_t t = 0; t < made.neighbours.size(); ++t) {
      const auto [a, b, c] = made.corners(t);
      ASSERT_GT(glm::dot(glm::cross(b - a, c - a), a + b + c), 0.0f);
      for (const glm::vec3& normal : made.normals(t)) ASSERT_GT(glm::dot(normal, a + b + c), 0.0f);
    }
  }
}

TEST(ReflectorMesh, AnOpenOneKeepsTheSideOfItsNormals) {
  const ReflectorMesh bowl = ordered(turned_inside_out(open_ball(0.0f)));
  for (std::size_t t = 0; t < bowl.neighbours.size(); ++t) {
    const auto [a, b, c] = bowl.corners(t);
    ASSERT_LT(glm::dot(glm::cross(b - a, c - a), a + b + c), 0.0f);
  }
  EXPECT_GT(bowl.open_edges, 100u);
}

TEST(ReflectorPatches, ABallIsOneAndABowlHasAConcaveInside) {
  const ReflectorMesh ball = ordered(ellipsoid_mesh({1, 0.6f, 0.8f}));
  std::vector<ReflectorPatch> patches = reflector_patches(ball);
  ASSERT_EQ(patches.size(), 1u);
  EXPECT_TRUE(patches[0].is_convex);
  expect_whole(ball, patches);

  Mesh bowl = open_ball(0.0f);
  append(bowl, turned_inside_out(open_ball(0.0f)), glm::scale(glm::mat4(1.0f), glm::vec3(0.95f)));
  const ReflectorMesh made = ordered(bowl);
  patches = reflector_patches(made);
  ASSERT_EQ(patches.size(), 2u);
  EXPECT_NE(patches[0].is_convex, patches[1].is_convex);
  expect_whole(made, patches);
}

/// A ring about z of radius 1.
Mesh torus(float thickness) {
  Mesh mesh;
  constexpr int around = 48, across = 24;
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < across; ++j) {
      const float turn = 6.2831853f * float(i) / around, tilt = 6.2831853f * float(j) / across;
      const glm::vec3 out(std::cos(turn), std::sin(turn), 0.0f);
      const glm::vec3 normal = std::cos(tilt) * out + std::sin(tilt) * glm::vec3(0, 0, 1);
      mesh.positions.push_back(out + thickness * normal);
      mesh.normals.push_back(normal);
      mesh.uvs.emplace_back(0.0f);
      const auto at = [&](int a, int b) { return std::uint32_t((a % around) * across + b % across); };
      for (const std::uint32_t v :
           {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j), at(i + 1, j + 1), at(i, j + 1)})
        mesh.indices.push_back(v);
    }
  return mesh;
}

/// A ring sees no centre whole: it is cut until each part does.
TEST(ReflectorPatches, ATorusIsCutIntoPartsThatACentreSees) {
  const ReflectorMesh made = ordered(torus(0.4f));
  const std::vector<ReflectorPatch> patches = reflector_patches(made);
  EXPECT_GT(patches.size(), 1u);
  EXPECT_LT(patches.size(), 20u);
  expect_whole(made, patches);
}

TEST(ReflectorMap, HoldsTheSurfaceOfABall) {
  const Reflector ball = reflector(ellipsoid_mesh(glm::vec3(1.0f)));
  ASSERT_EQ(ball.maps.size(), 1u);
  EXPECT_TRUE(ball.remarks.empty() ||
              ball.remarks[0].find("without area") != std::string::npos);  // the poles' slivers
  Random random(1);
  for (int i = 0; i < 2000; ++i) {
    const glm::vec3 d = random_direction(random);
    const auto [position, normal] = ball.maps[0].surface(3.0f * d);
    // The mesh has 96 rings: its triangles lie up to 0.001 within the ball.
    ASSERT_LT(glm::distance(position, glm::normalize(position)), 0.002f);
    ASSERT_LT(glm::distance(normal, glm::normalize(position)), 0.01f);
    ASSERT_EQ(ball.maps[0].surface_kind(d), kind_surface);
  }
}

TEST(ReflectorMap, AnOpenOneIsClosedForTheSearchAndReflectsNothingThere) {
  const Reflector dome = reflector(open_ball(0.0f));
  ASSERT_EQ(dome.maps.size(), 1u);
  const ReflectorMap& map = dome.maps[0];
  ASSERT_FALSE(dome.remarks.empty());
  Random random(2);
  for (int i = 0; i < 1000; ++i) {
    const auto [position, normal] = map.surface(random_direction(random));
    ASSERT_TRUE(std::isfinite(glm::length(position)));
    ASSERT_NEAR(glm::length(normal), 1.0f, 1e-4f);
  }
  Search search{map};
  const auto above = search.search_patch({{0, 0, 4}, {3, 0, 3}, map.window.centre}, search.patch_kind(), -1);
  EXPECT_TRUE(search.is_found(above));
  EXPECT_GT(above.point.position.z, 0.5f);
  const auto below =
      search.search_patch({{0.5f, 0, -4}, {3, 0, -3}, map.window.centre}, search.patch_kind(), -1);
  EXPECT_FALSE(search.is_found(below)) << "the point would lie on the part that is not there";
}

/// Vertices that the body does reflect, from chance places of its surface; what is found is judged on the
/// fine mesh.
struct Judged {
  int found = 0, told = 0, silently_wrong = 0;
};

Judged judge(const Mesh& source, float reach) {
  const ReflectorMesh mesh = ordered(source);
  const glm::vec3 middle = mesh.mesh.bounds().centre();
  const float radius = mesh.mesh.bounds().radius();
  Random random(3);
  Judged judged;
  for (const ReflectorPatch& patch : reflector_patches(mesh)) {
    std::vector<std::uint32_t> shown = patch.triangles;
    shown.insert(shown.end(), patch.around.begin(), patch.around.end());
    const SurfaceRays rays(mesh, shown);
    const ReflectorMap map = reflector_map(mesh, patch, 256);
    Search search{map};
    for (std::size_t i = 0; i < 1 + patch.triangles.size() / 20; ++i) {
      const std::uint32_t t = patch.triangles[std::size_t(random.index(int(patch.triangles.size())))];
      const auto [a, b, c] = mesh.corners(t);
      const auto [na, nb, nc] = mesh.normals(t);
      const glm::vec3 at = (a + b + c) / 3.0f, normal = glm::normalize(na + nb + nc),
                      to_viewer = random_direction(random);
      if (glm::dot(to_viewer, normal) < 0.2f) continue;
      const glm::vec3 viewer = at + 4.0f * radius * to_viewer,
                      vertex = at + reach * radius * glm::reflect(-to_viewer, normal);
      const auto found = search.search_patch({viewer, vertex, map.window.centre}, search.patch_kind(), -1);
      if (!search.is_found(found)) {
        ++judged.told;
        continue;
      }
      ++judged.found;
      const std::optional<MetSurface> met = rays.along(map.window.centre, found.point.direction);
      judged.silently_wrong +=
          !met || bisector_angle(met->position, met->normal, viewer, vertex) > degree ? 1 : 0;
    }
  }
  EXPECT_GT(judged.found + judged.told, 50) << glm::distance(middle, glm::vec3(0.0f));
  return judged;
}

TEST(ReflectorMap, SearchesAreRightOnTheFineMeshOrTold) {
  for (const glm::vec3 radii : {glm::vec3(1.0f), glm::vec3(1, 0.6f, 0.8f), glm::vec3(2, 0.9f, 0.6f)}) {
    const Judged judged = judge(ellipsoid_mesh(radii), 1.0f);
    EXPECT_EQ(judged.silently_wrong, 0);
    EXPECT_LT(judged.told, judged.found / 50);
  }
}

TEST(ReflectorMap, RealBodiesReflectRightOrTell) {
  for (const char* name : {"reflectors/teapot.obj", "reflectors/spot.obj"}) {
    const std::optional<std::filesystem::path> file = shared_data(name);
    if (!file) GTEST_SKIP() << "skipped: shared data absent";
    Errors warnings;
    const Result<scene::Model> model = scene::read_with_assimp(*file, formats::UpAxis::file, warnings);
    ASSERT_TRUE(model) << to_string(model.errors());
    const Judged judged = judge(model->parts[0].mesh, 1.5f);
    EXPECT_EQ(judged.silently_wrong, 0) << name;
    EXPECT_LT(judged.told, judged.found / 5) << name;
  }
}

/// A point of a profile, to be turned about z: position and normal, how far off the axis and how high.
struct ProfilePoint {
  glm::vec2 position, normal;
};

Mesh turned(const std::vector<ProfilePoint>& profile) {
  constexpr int around = 256;
  Mesh mesh;
  for (int i = 0; i <= around; ++i)
    for (const auto& [position, normal] : profile) {
      const float turn = 6.2831853f * float(i % around) / around;
      const glm::vec3 out(std::cos(turn), std::sin(turn), 0.0f), up(0, 0, 1);
      mesh.normals.push_back(normal.x * out + normal.y * up);
      mesh.positions.push_back(position.x * out + position.y * up);
      mesh.uvs.emplace_back(0.0f);
    }
  const std::size_t width = profile.size();
  const auto at = [&](std::size_t i, std::size_t k) { return std::uint32_t(i * width + k); };
  for (std::size_t i = 0; i < around; ++i)
    for (std::size_t k = 0; k + 1 < width; ++k)
      for (const std::uint32_t v :
           {at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k), at(i + 1, k + 1), at(i, k + 1)})
        mesh.indices.push_back(v);
  return mesh;
}

/// The upper part of a ring of radius 1, as the rims of pans have.
Mesh rim(float thickness) {
  std::vector<ProfilePoint> profile;
  for (int k = 0; k <= 16; ++k) {
    const float tilt = 0.4f + 2.34f * float(k) / 16.0f;
    const glm::vec2 normal(std::cos(tilt), std::sin(tilt));
    profile.push_back({glm::vec2(1.0f, 0.0f) + thickness * normal, normal});
  }
  return turned(profile);
}

/// A cone with waves down its side, convex and concave by turns.
Mesh wavy_cone() {
  constexpr float wave = 0.01f, frequency = 30.0f;
  std::vector<ProfilePoint> profile;
  for (int k = 0; k <= 64; ++k) {
    const float down = 0.6f * float(k) / 64.0f;
    const float slope = 1.0f + wave * frequency * std::cos(frequency * down);
    profile.push_back(
        {{0.4f + down + wave * std::sin(frequency * down), -down}, glm::normalize(glm::vec2(1.0f, slope))});
  }
  return turned(profile);
}

TEST(ReflectorMap, AThinRimIsABandOfDirectionsAndShowsWhatItMirrors) {
  const Reflector ring = reflector(rim(0.015f));
  ASSERT_EQ(ring.maps.size(), 1u);
  const ReflectorMap& map = ring.maps[0];
  EXPECT_EQ(map.window.extent, 0.0f);
  Search search{map};
  const SurfaceRays rays(ring.mesh, ring.patches[0].triangles);
  Random random(5);
  int shown = 0, found = 0;
  while (shown < 300) {
    const float turn = random.uniform(0.0f, 6.2831853f);
    const glm::vec3 out(std::cos(turn), std::sin(turn), 0.0f);
    const std::optional<MetSurface> at =
        rays.along(map.window.centre, out + random.uniform(-0.01f, 0.01f) * out - map.window.centre);
    const glm::vec3 viewer = 4.0f * random_direction(random);
    if (!at || glm::dot(glm::normalize(viewer - at->position), at->normal) < 0.3f) continue;
    ++shown;
    const glm::vec3 vertex =
        at->position + 1.5f * glm::reflect(glm::normalize(at->position - viewer), at->normal);
    for (int layer = 0; layer < search.layer_count; ++layer) {
      const auto point = search.search_patch({viewer, vertex, map.window.centre}, search.patch_kind(), layer);
      if (!search.is_found(point) || glm::distance(point.point.position, at->position) > 0.01f) continue;
      ++found;
      break;
    }
  }
  EXPECT_GT(found, 280);
}

/// A direction that a map does not hold is looked up where its window ends. The surface there goes on over
/// neighbouring patches, yet is not what lies beyond.
TEST(ReflectorMap, BeyondAWindowIsNoSurface) {
  Random random(6);
  int windows = 0, bands = 0;
  for (const Mesh& mesh : {torus(0.4f), wavy_cone()})
    for (const ReflectorMap& map : reflector(mesh).maps) {
      if (map.is_whole_body()) continue;
      ++(map.window.extent > 0.0f ? windows : bands);
      for (int i = 0; i < 2000; ++i) {
        const glm::vec3 d = random_direction(random);
        const glm::vec3 looked_up = window_direction(map.window, window_uv(map.window, d));
        if (glm::distance(d, looked_up) < 1e-3f) continue;
        ASSERT_EQ(map.surface_kind(d), kind_closed);
      }
    }
  EXPECT_GT(windows, 0);
  EXPECT_GT(bands, 0);
}

TEST(HostileMesh, IsRefusedByNameOrHasADefinedMap) {
  const auto refused = [](const Mesh& mesh, const std::string& words) {
    const Result<Reflector> made = make_reflector(mesh, "kettle", 32);
    ASSERT_FALSE(made) << words;
    EXPECT_NE(to_string(made.errors()).find("kettle"), std::string::npos);
    EXPECT_NE(to_string(made.errors()).find(words), std::string::npos) << to_string(made.errors());
  };
  refused(Mesh{}, "has an area");
  Mesh flat = scene::quad({0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0});
  flat.normals.assign(4, glm::vec3(0, 0, 1));
  refused(flat, "has an area");
  Mesh infinite = scene::ground(1.0f);
  infinite.positions[0].x = std::numeric_limits<float>::infinity();
  refused(infinite, "inf");
  Mesh short_of_normals = scene::ground(1.0f);
  short_of_normals.normals.pop_back();
  refused(short_of_normals, "normals");

  Mesh one = scene::ground(1.0f);
  one.indices.resize(3);
  Mesh fan;  // three leaves on one edge
  for (const glm::vec3 tip : {glm::vec3(1, 0, 0), glm::vec3(-1, 1, 0), glm::vec3(-1, -1, 0)})
    append(fan, scene::quad({0, 0, 0}, tip, tip + glm::vec3(0, 0, 1), {0, 0, 1}));
  Mesh without_normals = scene::box(glm::vec3(-1.0f), glm::vec3(1.0f));
  for (glm::vec3& normal : without_normals.normals) normal = glm::vec3(0.0f);
  Mesh holed = ellipsoid_mesh(glm::vec3(1.0f), 24);
  holed.indices.erase(holed.indices.begin() + 3000, holed.indices.begin() + 3060);
  for (const Mesh& mesh : {one, fan, without_normals, holed}) {
    const Reflector made = reflector(mesh);
    ASSERT_FALSE(made.maps.empty());
    for (const ReflectorMap& map : made.maps)
      for (const float value : map.texels.pixels) ASSERT_TRUE(std::isfinite(value));
  }
}

TEST(HostileMesh, OfTooManyPatchesTheLargestStay) {
  Mesh crowd;
  for (int i = 0; i < 6; ++i)
    append(crowd, scene::sphere({3.0f * float(i), 0, 0}, 1.0f + 0.1f * float(i), 12));
  const Result<Reflector> made = make_reflector(crowd, "kettle", 32, 4);
  ASSERT_TRUE(made);
  EXPECT_EQ(made->maps.size(), 4u);
  EXPECT_NE(made->remarks.back().find("environment map"), std::string::npos);
  EXPECT_NEAR(made->maps[0].window.centre.x, 15.0f, 0.1f);
}

}  // namespace
}  // namespace parvis::reflector_maps

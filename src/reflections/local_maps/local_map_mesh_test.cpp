#include "reflections/local_maps/local_map_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "base/random.h"
#include "reflections/local_maps/local_map_faces.h"
#include "reflections/local_maps/local_map_weights.h"
#include "reflections/methods/cube_map.h"
#include "scene/data/test_scene.h"

namespace parvis::local_maps {
namespace {

constexpr int tile_side = 128;

glm::vec3 random_direction(Random& random) {
  glm::vec3 d(0.0f);
  while (glm::length(d) < 0.1f) d = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
  return glm::normalize(d);
}

/// A street between two rows of houses of different heights, 12 m apart.
HeightPyramid street() {
  Bounds bounds;
  bounds.add(glm::vec3(-60, -60, 0));
  bounds.add(glm::vec3(60, 60, 20));
  shading::Heightfield heights(bounds);
  heights.add(scene::ground(60.0f), glm::mat4(1.0f));
  Random random(3);
  for (float x = -60.0f; x < 60.0f; x += 10.0f)
    for (const float y : {-20.0f, 6.0f})
      heights.add(scene::box({x, y, 0}, {x + 10, y + 14, random.uniform(5, 18)}), glm::mat4(1.0f));
  return HeightPyramid(heights);
}

FaceTask task_of(int face, MeshRule rule = {}) {
  return {{0.3f, -0.2f, 1.0f}, face, tile_side, glm::vec2(0.0f), 0, rule};
}

TEST(LocalMapFaces, AreThoseOfTheCubeMapsThatAreDrawn) {
  for (int face = 0; face < 6; ++face) {
    const glm::mat4 clip_from_world = methods::face_view(face, glm::vec3(0.0f), tile_side, 0).clip_from_world;
    for (const glm::vec2 place : {glm::vec2(0.3f, -0.8f), glm::vec2(-0.6f, 0.1f), glm::vec2(0.99f, 0.98f)}) {
      const glm::vec3 direction = direction_on_face(place, face);
      const glm::vec4 clip = clip_from_world * glm::vec4(direction, 1.0f);
      EXPECT_LT(glm::distance(glm::vec2(clip) / clip.w, place), 1e-5f) << "face " << face;
      const glm::vec3 back = place_on_faces(3.0f * direction);
      EXPECT_EQ(int(back.z), face);
      EXPECT_LT(glm::distance(glm::vec2(back), place), 1e-5f);
    }
  }
}

TEST(LocalMapFaces, ATexelShowsTheDirectionThatIsLookedUpThere) {
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const glm::vec3 direction = random_direction(random);
    const glm::vec2 texel = texel_on_tiles(direction, tile_side, local_map_border);
    const int face = int(place_on_faces(direction).z);
    const glm::vec2 in_tile = texel - tile_corner(face, tile_side);
    ASSERT_GE(std::min(in_tile.x, in_tile.y), float(local_map_border) - 1e-3f);
    ASSERT_LE(std::max(in_tile.x, in_tile.y), float(tile_side - local_map_border) + 1e-3f);
    const glm::vec3 shown = direction_on_face(place_of_texel(in_tile, tile_side, local_map_border), face);
    ASSERT_LT(glm::distance(glm::normalize(shown), direction), 1e-4f);
  }
}

/// The paper says so, but its own formula gives less beyond either map, and nothing one length on.
TEST(LocalMapWeights, SumToOneWhereverThePointLies) {
  Random random(2);
  const glm::vec3 a(0, 0, 1), b(20, 5, 1);
  for (int i = 0; i < 2000; ++i) {
    const glm::vec3 met = 60.0f * random_direction(random) * random.uniform();
    const glm::vec2 projected = projected_weights(met, a, b);
    ASSERT_NEAR(projected.x + projected.y, 1.0f, 1e-5f);
    const glm::vec2 validities(random.uniform() < 0.5f ? 0.0f : random.uniform(),
                               random.uniform() < 0.5f ? 0.0f : random.uniform());
    const glm::vec2 weights = valid_weights(projected, validities);
    ASSERT_NEAR(weights.x + weights.y, 1.0f, 1e-5f);
    ASSERT_GE(std::min(weights.x, weights.y), 0.0f);
  }
  const glm::vec2 beyond = projected_weights(a + 1.5f * (b - a), a, b);
  EXPECT_EQ(beyond, glm::vec2(0.0f, 1.0f)) << "1 - D of both, clamped, would be 0 and 0.5";
  EXPECT_EQ(projected_weights(a, a, a).x, 1.0f) << "one map twice";
}

TEST(LocalMapWeights, FollowThePlaceBetweenTheMaps) {
  const glm::vec2 weights = projected_weights({5, 9, -3}, {0, 0, 1}, {20, 0, 1});
  EXPECT_FLOAT_EQ(weights.x, 0.75f);
  EXPECT_EQ(valid_weights(weights, {1.0f, 1.0f}), weights);
}

TEST(LocalMapWeights, AMapThatDoesNotSeeThePointHasNoShare) {
  EXPECT_EQ(valid_weights({0.9f, 0.1f}, {0.0f, 1.0f}), glm::vec2(0.0f, 1.0f));
  EXPECT_EQ(valid_weights({1.0f, 0.0f}, {0.0f, 1.0f}), glm::vec2(0.0f, 1.0f)) << "beyond the other map, too";
  EXPECT_EQ(valid_weights({0.4f, 0.6f}, {0.0f, 0.0f}), glm::vec2(0.0f, 1.0f))
      << "seen by none: the highest weight before the test";
}

/// Shoelace areas of the triangles that hold a pixel's middle: each must be held once.
TEST(LocalMapMesh, CoversEachTexelOnce) {
  const HeightPyramid heights = street();
  FaceMesh mesh;
  for (int face = 0; face < 6; ++face)
    for (const float smallest : {1.0f, 3.0f, 100.0f}) {
      make_face_mesh(heights, task_of(face, {10, 0.2f, smallest}), mesh);
      std::vector<int> covered(tile_side * tile_side);
      double area = 0.0;
      for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        glm::dvec2 p[3];
        for (std::size_t k = 0; k < 3; ++k) p[k] = mesh.vertices[mesh.indices[i + k]].texel;
        const auto edge = [](glm::dvec2 from, glm::dvec2 to, glm::dvec2 at) {
          return (to.x - from.x) * (at.y - from.y) - (to.y - from.y) * (at.x - from.x);
        };
        area += 0.5 * edge(p[0], p[1], p[2]);
        ASSERT_GT(edge(p[0], p[1], p[2]), 0.0) << "turns round as its neighbours do, and is no line";
        const glm::dvec2 low = glm::min(p[0], glm::min(p[1], p[2])),
                         high = glm::max(p[0], glm::max(p[1], p[2]));
        for (int y = int(low.y); y < int(std::ceil(high.y)); ++y)
          for (int x = int(low.x); x < int(std::ceil(high.x)); ++x) {
            const glm::dvec2 middle(x + 0.5137, y + 0.5071);  // on no edge
            covered[std::size_t(y * tile_side + x)] += edge(p[0], p[1], middle) > 0.0 &&
                                                       edge(p[1], p[2], middle) > 0.0 &&
                                                       edge(p[2], p[0], middle) > 0.0;
          }
      }
      EXPECT_NEAR(area, tile_side * tile_side, 0.01);
      EXPECT_EQ(std::ranges::count(covered, 1), tile_side * tile_side)
          << "face " << face << ", quads of " << smallest;
    }
}

/// Every side inside the tile belongs to two triangles: no corner lies on another's side.
TEST(LocalMapMesh, HasNoCrack) {
  FaceMesh mesh;
  for (int face = 0; face < 6; ++face) {
    make_face_mesh(street(), task_of(face), mesh);
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
      for (std::size_t k = 0; k < 3; ++k) ++sides[{mesh.indices[i + k], mesh.indices[i + (k + 1) % 3]}];
    for (const auto& [side, count] : sides) {
      ASSERT_EQ(count, 1);
      const glm::vec2 a = mesh.vertices[side.first].texel, b = mesh.vertices[side.second].texel;
      const bool is_at_rim = (a.x == b.x && (a.x == 0.0f || a.x == float(tile_side))) ||
                             (a.y == b.y && (a.y == 0.0f || a.y == float(tile_side)));
      ASSERT_EQ(sides.contains({side.second, side.first}), !is_at_rim);
    }
  }
}

TEST(LocalMapMesh, IsSplitWhereDepthsDifferAndNoFurtherThanAllowed) {
  const HeightPyramid heights = street();
  FaceMesh mesh;
  make_face_mesh(heights, task_of(4, {10, 1e9f, 1.0f}), mesh);
  EXPECT_EQ(mesh.vertices.size(), 121u);
  EXPECT_EQ(mesh.indices.size(), 600u);
  std::size_t last = 121;
  for (const float smallest : {6.0f, 3.0f, 1.5f}) {
    make_face_mesh(heights, task_of(0, {10, 0.2f, smallest}), mesh);
    EXPECT_GT(mesh.vertices.size(), last);
    last = mesh.vertices.size();
    float minimum = 1e9f;
    for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
      const std::size_t next = i % 3 == 2 ? i - 2 : i + 1;
      const glm::vec2 side = mesh.vertices[mesh.indices[i]].texel - mesh.vertices[mesh.indices[next]].texel;
      minimum = std::min(minimum, glm::length(side));
    }
    EXPECT_GE(minimum, smallest * 0.7f) << "a fan's spokes are half a quad's diagonal";
  }
}

TEST(LocalMapMesh, CornersLieWhereTheirRaysEnd) {
  FaceMesh mesh;
  make_face_mesh(street(), task_of(2), mesh);
  float nearest_m = sky_distance_m;
  for (const LocalMapVertex& vertex : mesh.vertices) {
    const glm::vec3 from_centre = vertex.met - task_of(2).centre;
    EXPECT_NEAR(from_centre.y, vertex.ahead_m, 1e-4f * vertex.ahead_m) << "this face looks north";
    nearest_m = std::min(nearest_m, glm::length(from_centre));
    const glm::vec2 place = place_of_texel(vertex.texel, tile_side, local_map_border);
    EXPECT_LT(glm::distance(from_centre / vertex.ahead_m, direction_on_face(place, 2)), 1e-3f);
    if (vertex.met.z < 4.0f && vertex.met.z > 0.5f) {
      EXPECT_NEAR(vertex.met.y, 6.0f, 1.0f) << "a wall";
    }
  }
  EXPECT_NEAR(mesh.nearest_m, nearest_m, 1e-3f);
}

TEST(LocalMapMesh, WhereNothingStandsItIsAllSky) {
  FaceMesh mesh;
  const HeightPyramid nothing{shading::Heightfield(Bounds{})};
  make_face_mesh(nothing, task_of(5), mesh);
  EXPECT_EQ(mesh.vertices.size(), 121u);
  for (const LocalMapVertex& vertex : mesh.vertices) EXPECT_GT(vertex.ahead_m, 0.5f * sky_distance_m);
}

}  // namespace
}  // namespace parvis::local_maps

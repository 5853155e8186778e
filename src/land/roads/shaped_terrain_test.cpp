#include "land/roads/shaped_terrain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "land/roads/paving.h"
#include "land/roads/road_beds.h"
#include "land/roads/road_builder.h"
#include "scene/data/surroundings.h"
#include "scene/data/test_scene.h"

namespace parvis::scene {
namespace {

constexpr float rise = 0.2f;  // of the hillside, to the north

/// A hillside in squares with sides of `cell_m`, from `west_m` on.
Mesh hillside(float west_m, float east_m, float cell_m, float lift_m = 0.0f) {
  constexpr float half_m = 60.0f;
  Mesh mesh;
  const glm::ivec2 cells(glm::round(glm::vec2(east_m - west_m, 2.0f * half_m) / cell_m));
  for (int y = 0; y <= cells.y; ++y)
    for (int x = 0; x <= cells.x; ++x) {
      const glm::vec2 p(west_m + cell_m * float(x), -half_m + cell_m * float(y));
      mesh.positions.emplace_back(p, rise * p.y + lift_m);
      mesh.uvs.push_back(p);
    }
  const std::uint32_t row = std::uint32_t(cells.x) + 1;
  for (std::uint32_t y = 0; y < std::uint32_t(cells.y); ++y)
    for (std::uint32_t x = 0; x + 1 < row; ++x) {
      const std::uint32_t a = y * row + x;
      mesh.indices.insert(mesh.indices.end(), {a, a + 1, a + row, a + 1, a + row + 1, a + row});
    }
  fill_normals(mesh);
  return mesh;
}

int add_part(Scene& scene, Mesh mesh, const char* name) {
  auto model = model_of(std::move(mesh), matt(glm::vec3(0.5f)));
  model->parts.front().object = name;
  return add(scene, model);
}

const Mesh& mesh_of(const Scene& scene, std::size_t object) {
  return scene.objects[object].model->parts.front().mesh;
}

/// The highest surface of a mesh at a place.
std::optional<float> height_of(const Mesh& mesh, glm::vec2 p) {
  std::optional<float> highest_m;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const auto at = [&](std::size_t k) { return mesh.positions[mesh.indices[i + k]]; };
    const glm::vec2 a(at(0)), ab = glm::vec2(at(1)) - a, ac = glm::vec2(at(2)) - a, ap = p - a;
    const float area = ab.x * ac.y - ab.y * ac.x;
    if (area == 0.0f) continue;
    const float v = (ap.x * ac.y - ap.y * ac.x) / area, w = (ab.x * ap.y - ab.y * ap.x) / area;
    if (v < -1e-4f || w < -1e-4f || v + w > 1.0f + 1e-4f) continue;
    const float z = (1.0f - v - w) * at(0).z + v * at(1).z + w * at(2).z;
    highest_m = std::max(highest_m.value_or(z), z);
  }
  return highest_m;
}

/// Area in plan, without triangles that face down.
double plan_m2(const Mesh& mesh) {
  double sum = 0.0;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const auto at = [&](std::size_t k) { return mesh.positions[mesh.indices[i + k]]; };
    sum += std::max(0.5 * double(glm::cross(at(1) - at(0), at(2) - at(0)).z), 0.0);
  }
  return sum;
}

/// A street along the middle of the hillside, at height 0.
std::vector<Road> street(float west_m = -200.0f, float east_m = 200.0f, float z = 0.0f) {
  Road road;
  road.path = {{west_m, 0, z}, {east_m, 0, z}};
  return {road};
}

TEST(ShapedTerrain, AStreetAcrossAHillsideIsLevelFromSideToSide) {
  for (const float cell_m : {1.0f, 4.0f, 40.0f}) {
    Scene scene;
    const auto hill = std::size_t(add_part(scene, hillside(-80, 80, cell_m), "TINRelief"));
    const double before_m2 = plan_m2(mesh_of(scene, hill));
    ASSERT_TRUE(shape_terrain(scene, street()));
    const Mesh& mesh = mesh_of(scene, hill);
    ASSERT_TRUE(check(mesh, "terrain").ok());
    for (const float x : {-31.0f, 0.5f, 47.3f})
      for (const float y : {-5.8f, -3.0f, 0.0f, 3.0f, 5.8f})
        EXPECT_NEAR(height_of(mesh, {x, y}).value_or(99.0f), 0.0f, 0.05f) << cell_m << ": " << x << " " << y;
    EXPECT_LT(*height_of(mesh, {0.5f, 9.0f}), rise * 9.0f - 0.4f) << "cut, control: 1.8 m";
    EXPECT_GT(*height_of(mesh, {0.5f, -9.0f}), rise * -9.0f + 0.4f) << "filled";
    EXPECT_NEAR(*height_of(mesh, {0.5f, 35.0f}), rise * 35.0f, 1e-3f);
    EXPECT_NEAR(plan_m2(mesh), before_m2, 1e-4 * before_m2) << "neither gaps nor folds";
  }
}

TEST(ShapedTerrain, NeverRisesThroughThePaving) {
  Scene scene;
  const auto hill = std::size_t(add_part(scene, hillside(-80, 80, 8), "TINRelief"));
  Road other;
  other.path = {{10, -50, rise * -50.0f}, {10, 50, rise * 50.0f}};
  std::vector<Road> roads = street(-70, 70);
  roads.push_back(other);
  scene.roads = *build_road_graph(roads);
  ASSERT_TRUE(shape_terrain(scene, roads));
  pave(scene);
  Mesh paving;
  for (const Part& part : scene.objects.back().model->parts) append(paving, part.mesh);
  constexpr float bent_m =
      0.02f;  // of paving, whose rows lie a metre apart, where a street of 20 % is crossed
  int paved = 0;
  for (float x = -60.0f; x < 61.0f; x += 1.7f)
    for (float y = -40.0f; y < 41.0f; y += 1.3f)
      if (const auto paved_m = height_of(paving, {x, y})) {
        EXPECT_LT(*height_of(mesh_of(scene, hill), {x, y}), *paved_m + bent_m) << x << " " << y;
        ++paved;
      }
  EXPECT_GT(paved, 500);
}

/// The highest surfaces of a mesh at places 20 cm from each other, NaN where there is none.
class HeightsAround {
 public:
  HeightsAround(const Mesh& mesh, glm::vec2 low, int side)
      : low_(low), side_(side), heights_m_(std::size_t(side) * std::size_t(side), std::nanf("")) {
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
      const auto at = [&](std::size_t k) { return mesh.positions[mesh.indices[i + k]]; };
      note(at(0), at(1), at(2));
    }
  }

  /// The largest height of this mesh over another one; -1 where they share no place.
  float highest_over(const HeightsAround& below) const {
    float highest_m = -1.0f;
    for (std::size_t i = 0; i < heights_m_.size(); ++i)
      if (heights_m_[i] - below.heights_m_[i] > highest_m) highest_m = heights_m_[i] - below.heights_m_[i];
    return highest_m;
  }

 private:
  static constexpr float step_m = 0.2f;

  void note(glm::vec3 a, glm::vec3 b, glm::vec3 c) {
    const glm::vec3 normal = glm::cross(b - a, c - a);
    if (std::abs(normal.z) < 1e-9f) return;
    const auto cell_of = [&](glm::vec2 p) { return (p - low_) / step_m; };
    const glm::ivec2 first(glm::max(
        glm::ceil(cell_of(glm::min(glm::vec2(a), glm::min(glm::vec2(b), glm::vec2(c))))), glm::vec2(0.0f)));
    const glm::ivec2 last(
        glm::min(glm::floor(cell_of(glm::max(glm::vec2(a), glm::max(glm::vec2(b), glm::vec2(c))))),
                 glm::vec2(side_ - 1)));
    for (int y = first.y; y <= last.y; ++y)
      for (int x = first.x; x <= last.x; ++x) {
        const glm::vec2 p = low_ + step_m * glm::vec2(x, y);
        const auto side_of = [&](glm::vec3 from, glm::vec3 to) {
          return ((to.x - from.x) * (p.y - from.y) - (to.y - from.y) * (p.x - from.x)) / normal.z;
        };
        if (std::min({side_of(a, b), side_of(b, c), side_of(c, a)}) < 0.0f) continue;
        float& known_m = heights_m_[std::size_t(y) * std::size_t(side_) + std::size_t(x)];
        const float height_m = a.z - (normal.x * (p.x - a.x) + normal.y * (p.y - a.y)) / normal.z;
        if (!(known_m >= height_m)) known_m = height_m;
      }
  }

  glm::vec2 low_;
  int side_;
  std::vector<float> heights_m_;
};

/// A street across the hillside, and another one that crosses it at this angle, on the terrain shaped for
/// both.
void pave_crossing(Scene& scene, float angle_deg) {
  const glm::vec2 along(std::cos(glm::radians(angle_deg)), std::sin(glm::radians(angle_deg)));
  Road other;
  for (const float end_m : {-50.0f, 50.0f})
    other.path.emplace_back(10.0f + end_m * along.x, end_m * along.y, rise * end_m * along.y);
  std::vector<Road> roads = street(-70, 70);
  roads.push_back(other);
  scene.roads = *build_road_graph(roads);
  ASSERT_TRUE(shape_terrain(scene, roads));
  pave(scene);
}

TEST(ShapedTerrain, PavementsStayBelowTheAsphaltOfCrossings) {
  for (const float angle_deg : {90.0f, 30.0f}) {
    Scene scene;
    add_part(scene, hillside(-80, 80, 8), "TINRelief");
    pave_crossing(scene, angle_deg);
    const auto heights_of = [&](const char* name) {
      Mesh layer;
      for (const Part& part : scene.objects.back().model->parts)
        if (part.object == name) append(layer, part.mesh);
      return HeightsAround(layer, {-8.0f, -18.0f}, 180);
    };
    const HeightsAround asphalt = heights_of("carriageway");
    // Layers lie 1.5 cm and 3 cm below the asphalt: of a bent ground, rows a metre apart take nearly all.
    constexpr float hair_m = 0.003f;
    EXPECT_LT(heights_of("kerb").highest_over(asphalt), hair_m) << angle_deg;
    EXPECT_LT(heights_of("pavement").highest_over(asphalt), hair_m) << angle_deg;
    EXPECT_GT(asphalt.highest_over(heights_of("kerb")), hair_m) << "control: they overlap, " << angle_deg;
  }
}

TEST(ShapedTerrain, StaysBelowThePavementsOfObliqueCrossings) {
  Scene scene;
  const auto hill = std::size_t(add_part(scene, hillside(-80, 80, 8), "TINRelief"));
  pave_crossing(scene, 60.0f);
  Mesh paving;
  for (const Part& part : scene.objects.back().model->parts) append(paving, part.mesh);
  const HeightsAround paved(paving, {-8.0f, -18.0f}, 180), ground(mesh_of(scene, hill), {-8.0f, -18.0f}, 180);
  constexpr float bent_m = 0.02f;  // as on a street of 20 % that is crossed at right angles
  EXPECT_LT(ground.highest_over(paved), bent_m) << "in the corner that the pavement goes round, too";
  EXPECT_GT(ground.highest_over(paved), -0.1f) << "control: they overlap";
}

TEST(ShapedTerrain, LeavesNoGapBetweenTiles) {
  Scene scene;
  const auto west = std::size_t(add_part(scene, hillside(-80, 0, 20), "TINRelief")),
             east = std::size_t(add_part(scene, hillside(0, 80, 20), "TINRelief"));
  ASSERT_TRUE(shape_terrain(scene, street()));
  const auto seam = [&](std::size_t object) {
    std::set<std::pair<float, float>> points;
    for (const glm::vec3& p : mesh_of(scene, object).positions)
      if (p.x == 0.0f) points.emplace(p.y, p.z);
    return points;
  };
  EXPECT_GT(seam(west).size(), 15u);
  EXPECT_EQ(seam(west), seam(east));
}

TEST(ShapedTerrain, ADeadEndInsideOneTriangleIsFound) {
  Scene scene;
  const auto hill = std::size_t(add_part(
      scene, quad({-300, -300, -60}, {300, -300, -60}, {300, 300, 60}, {-300, 300, 60}), "TINRelief"));
  std::vector<Road> roads = street(100, 150);
  for (glm::vec3& point : roads.front().path) point.y = -50.0f, point.z = -10.0f;
  ASSERT_TRUE(shape_terrain(scene, roads));
  for (const float y : {-55.0f, -50.0f, -45.0f})
    EXPECT_NEAR(height_of(mesh_of(scene, hill), {125.0f, y}).value_or(99.0f), -10.0f, 0.05f) << y;
}

TEST(ShapedTerrain, NormalsAreThoseOfTheNewGround) {
  Scene scene;
  const auto hill = std::size_t(add_part(scene, hillside(-80, 80, 1), "TINRelief"));
  ASSERT_TRUE(shape_terrain(scene, street()));
  const Mesh& mesh = mesh_of(scene, hill);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    if (std::abs(mesh.positions[i].y) < 5.0f && std::abs(mesh.positions[i].x) < 70.0f) {
      EXPECT_GT(mesh.normals[i].z, 0.999f) << "control: 0.98 on the hillside";
    }
}

TEST(ShapedTerrain, EvenGroundAndOtherSurfacesStayAsTheyAre) {
  Scene scene;
  const auto level =
      std::size_t(add_part(scene, quad({-80, -60, 0}, {80, -60, 0}, {80, 60, 0}, {-80, 60, 0}), "TINRelief"));
  ASSERT_TRUE(shape_terrain(scene, street()));
  EXPECT_EQ(mesh_of(scene, level).indices.size(), 6u);
  Scene squares;
  const auto square = std::size_t(add_part(squares, hillside(-80, 80, 4), "TransportSquare"));
  const auto model = squares.objects[square].model;
  ASSERT_TRUE(shape_terrain(squares, street()));
  EXPECT_EQ(squares.objects[square].model, model);
}

TEST(ShapedTerrain, IsNotRaisedUnderABridgeButCutWhereARampStandsInTheHill) {
  Scene scene;
  const auto hill = std::size_t(add_part(scene, hillside(-80, 80, 4), "TINRelief"));
  add_part(scene, quad({-80, -7, 0.3f}, {80, -7, 0.3f}, {80, 7, 0.3f}, {-80, 7, 0.3f}), "Bridge");
  ASSERT_TRUE(shape_terrain(scene, street(-200, 200, 0.3f)));
  EXPECT_NEAR(*height_of(mesh_of(scene, hill), {0.5f, -5.0f}), rise * -5.0f, 0.05f);
  EXPECT_LT(*height_of(mesh_of(scene, hill), {0.5f, 5.0f}), 0.3f) << "control: 1 m";
  EXPECT_TRUE(road_beds(scene, street(-200, 200, 9.0f), Terrain::surveyed).front().points.front().kind ==
              Bed::none);
}

TEST(ShapedTerrain, GeneratedGroundStaysBelowWhatWasSurveyed) {
  Scene scene;
  const auto hill = std::size_t(add_part(scene, hillside(-80, 80, 4), "TINRelief")),
             below = std::size_t(add_part(scene, hillside(-80, 80, 4, -0.4f), "TINRelief near"));
  ASSERT_TRUE(shape_terrain(scene, street()));
  for (float y = -25.0f; y < 26.0f; y += 0.7f)
    EXPECT_LT(*height_of(mesh_of(scene, below), {0.5f, y}), *height_of(mesh_of(scene, hill), {0.5f, y})) << y;
}

TEST(ShapedTerrain, GeneratedGroundIsNotBentWhereItLeavesLevelGroundThatCoversIt) {
  for (const float depth_m : {0.4f, 0.1f}) {
    Scene scene;
    add_part(scene, quad({-80, -60, 0}, {0, -60, 0}, {0, 60, 0}, {-80, 60, 0}), "LandUse");
    const float z = -depth_m;
    add_part(scene, quad({-80, -60, z}, {-3, -60, z}, {-3, 60, z}, {-80, 60, z}), "TINRelief near");
    const auto rim = std::size_t(
        add_part(scene, quad({-3, -60, -0.008f}, {80, -60, -0.008f}, {80, 60, -0.008f}, {-3, 60, -0.008f}),
                 "TINRelief near"));
    ASSERT_TRUE(shape_terrain(scene, street(-70, 2)));
    const bool is_even = mesh_of(scene, rim).indices.size() == 6u;
    EXPECT_EQ(is_even, depth_m == 0.4f) << "control: ground just below the cover is cut";
  }
}

TEST(ShapedTerrain, GeneratedGroundDoesNotRiseThroughATrenchButCoversATunnel) {
  for (const bool is_tunnel : {false, true}) {
    Scene scene;
    const auto plane = std::size_t(
        add_part(scene, quad({-80, -60, -0.4f}, {80, -60, -0.4f}, {80, 60, -0.4f}, {-80, 60, -0.4f}),
                 "TINRelief near"));
    add_part(scene, quad({-80, -7, -5}, {80, -7, -5}, {80, 7, -5}, {-80, 7, -5}), "Road ramp");
    if (is_tunnel)
      add_part(scene, quad({-80, -7, -0.5f}, {80, -7, -0.5f}, {80, 7, -0.5f}, {-80, 7, -0.5f}), "Tunnel");
    ASSERT_TRUE(shape_terrain(scene, street(-200, 200, -5.0f)));
    for (const float y : {-6.0f, 0.0f, 6.0f}) {
      const float height_m = *height_of(mesh_of(scene, plane), {0.5f, y});
      EXPECT_TRUE(is_tunnel ? std::abs(height_m + 0.4f) < 1e-4f : height_m < -5.0f)
          << is_tunnel << ": " << height_m;
    }
  }
}

TEST(ShapedTerrain, SurveyedGroundIsNotDugOutOverARoadDeepBelowIt) {
  Scene scene;
  const auto hill = std::size_t(add_part(scene, hillside(-80, 80, 4), "TINRelief"));
  add_part(scene, quad({-80, -7, -9}, {80, -7, -9}, {80, 7, -9}, {-80, 7, -9}), "Road");
  const auto model = scene.objects[hill].model;
  ASSERT_TRUE(shape_terrain(scene, street(-200, 200, -9.0f)));
  EXPECT_EQ(scene.objects[hill].model, model);
}

TEST(ShapedTerrain, TheLandAroundAPlaceKeepsItsModel) {
  Scene scene;
  const auto land = std::size_t(add_part(scene, hillside(-80, 80, 4), "TINRelief around"));
  const auto model = scene.objects[land].model;
  scene.data<ItemsOf<Surroundings>>().add({model}, 0);
  ASSERT_TRUE(shape_terrain(scene, street()));
  EXPECT_EQ(scene.objects[land].model, model);
}

TEST(ShapedTerrain, StandsWhereItsObjectIsPlaced) {
  Scene scene;
  auto model = model_of(hillside(-80, 80, 4), matt(glm::vec3(0.5f)));
  model->parts.front().object = "TINRelief";
  glm::mat4 placed(1.0f);
  placed[3] = {0, 0, 30, 1};
  const auto hill = std::size_t(add(scene, model, false, placed));
  ASSERT_TRUE(shape_terrain(scene, street(-200, 200, 30.0f)));
  EXPECT_NEAR(*height_of(mesh_of(scene, hill), {0.5f, 5.0f}), 0.0f, 0.05f);
}

}  // namespace
}  // namespace parvis::scene

#include "land/roads/paving.h"

#include <gtest/gtest.h>

#include "base/mesh.h"
#include "land/roads/road_builder.h"

namespace parvis::scene {
namespace {

/// A slope that rises by a tenth to the east, and a roof 9 m above it.
Scene hillside() {
  auto model = std::make_shared<Model>();
  model->materials.emplace_back();
  for (const float lift : {0.0f, 9.0f}) {
    Part part;
    part.mesh.positions = {
        {-50, -50, -5 + lift}, {150, -50, 15 + lift}, {150, 50, 15 + lift}, {-50, 50, -5 + lift}};
    part.mesh.indices = {0, 1, 2, 0, 2, 3};
    model->parts.push_back(part);
  }
  Scene scene;
  scene.objects.emplace_back().model = model;
  Road road;
  road.path = {{0, 0, 1}, {100, 0, 9}};  // hardly right
  Road other;
  other.path = {{50, -40, 5}, {50, 40, 5}};
  scene.roads = *build_road_graph(std::vector{road, other});
  return scene;
}

TEST(Paving, LiesOnTheGround) {
  Scene scene = hillside();
  pave(scene);
  ASSERT_EQ(scene.objects.size(), 2u);
  for (const Part& part : scene.objects[1].model->parts) {
    EXPECT_TRUE(check(part.mesh, part.object).ok());
    for (const glm::vec3& p : part.mesh.positions) EXPECT_NEAR(p.z, 0.1f * p.x + 0.05f, 0.04f);
    for (const glm::vec3& n : part.mesh.normals) EXPECT_GT(n.z, 0.98f);
  }
  for (const Lane& lane : scene.roads.lanes)
    for (const glm::vec3& p : lane.points) EXPECT_NEAR(p.z, 0.1f * p.x + 0.06f, 0.03f);
}

TEST(Paving, HasMarkings) {
  Scene scene = hillside();
  pave(scene);
  EXPECT_EQ(scene.objects[1].model->parts.size(), 4u);
}

TEST(Paving, WithoutGroundLanesKeepTheirHeight) {
  Scene scene = hillside();
  scene.objects.clear();
  const float z = scene.roads.lanes[0].points[0].z;
  pave(scene);
  EXPECT_NEAR(scene.roads.lanes[0].points[0].z, z + 0.06f, 1e-4f);
}

/// Whether a triangle of a mesh lies over a point in plan.
bool covers(const Mesh& mesh, glm::vec2 p) {
  for (std::size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
    bool is_inside = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::vec2 a(mesh.positions[mesh.indices[t + k]]),
          b(mesh.positions[mesh.indices[t + (k + 1) % 3]]);
      is_inside &= (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x) >= -1e-4f;
    }
    if (is_inside) return true;
  }
  return false;
}

TEST(Paving, LanesThatEndInABendLeaveNoWedgeOpen) {
  int tried = 0;
  for (const float bend_m : {26.0f, 28.0f, 30.0f, 32.0f}) {  // where the ramp's crossing begins, or near it
    Road street, ramp;
    street.path = {{0, -150, 0}, {0, 150, 0}}, ramp.path = {{-60, 50, 0}, {-11, bend_m, 0}, {0, 0, 0}};
    street.is_one_way = ramp.is_one_way = true;
    Scene scene;
    scene.roads = *build_road_graph(std::vector{street, ramp});
    const RoadGraph roads = scene.roads;
    pave(scene);
    const auto& parts = scene.objects.back().model->parts;
    const auto asphalt = std::ranges::find(parts, "carriageway", &Part::object);
    ASSERT_NE(asphalt, parts.end());
    for (const Lane& lane : roads.lanes) {
      if (lane.crossing >= 0 || lane.next.empty()) continue;
      const glm::vec3 end = lane.points.back(),
                      ahead = glm::normalize(end - lane.points[lane.points.size() - 2]);
      for (const float side : {-1.0f, 1.0f})
        for (int degrees = -60; degrees <= 60; degrees += 5, ++tried) {
          const float angle = glm::radians(float(degrees)), aside_m = side * (0.5f * lane.width_m + 0.2f);
          const glm::vec2 out(ahead.y, -ahead.x);
          const glm::vec2 at =
              glm::vec2(end) + aside_m * (std::cos(angle) * out) + 0.1f * std::sin(angle) * glm::vec2(ahead);
          EXPECT_TRUE(covers(asphalt->mesh, at)) << bend_m << " " << side << " " << degrees;
        }
    }
  }
  EXPECT_GT(tried, 100);
}

std::size_t triangles_of_paving(const Scene& scene) { return scene.objects.back().model->triangle_count(); }

/// The largest height of the paving over the slope of `hillside`, less that of its paint.
float highest_m(const Scene& scene) {
  float highest = 0.0f;
  for (const Part& part : scene.objects.back().model->parts)
    for (const glm::vec3& p : part.mesh.positions) highest = std::max(highest, p.z - 0.1f * p.x - 0.07f);
  return highest;
}

void add_block(Scene& scene, glm::vec3 low, glm::vec3 high, const Material& material) {
  auto model = std::make_shared<Model>();
  model->materials.push_back(material);
  Part part;
  part.mesh.positions = {
      {low.x, low.y, high.z}, {high.x, low.y, high.z}, {high.x, high.y, high.z}, {low.x, high.y, high.z}};
  part.mesh.indices = {0, 1, 2, 0, 2, 3};
  model->parts.push_back(part);
  scene.objects.emplace_back().model = model;
}

TEST(Paving, FollowsTheGroundAndNothingElse) {
  Scene scene = hillside();
  Material leaves;
  leaves.alpha_mode = Alpha::cutout;
  add_block(scene, {20, -6, 2}, {32, 6, 4.2f}, leaves);   // a crown over the street
  add_block(scene, {60, 1, 6}, {64.5f, 2.8f, 7.5f}, {});  // a parked van
  add_block(scene, {70, -4, 7}, {72, -3.4f, 7.6f}, {});   // a bench on the pavement
  add_block(scene, {80, -30, 8}, {100, 30, 9.8f}, {});    // of another scenario
  scene.objects.back().is_visible = false;
  pave(scene);
  EXPECT_LT(highest_m(scene), 0.05f);
}

TEST(Paving, ASlabAsWideAsTheStreetIsGround) {
  Scene scene = hillside();
  add_block(scene, {-20, -30, 0}, {40, 30, 4.2f}, {});
  pave(scene);
  EXPECT_GT(highest_m(scene), 2.0f) << "control: wide, solid and visible";
}

/// A street on level ground and another one, on the deck of a bridge, across it.
TEST(Paving, AStreetBelowABridgeStaysOnTheGround) {
  auto model = std::make_shared<Model>();
  model->materials.emplace_back();
  const auto add_level = [&](const char* name, glm::vec2 low, glm::vec2 high, float z) {
    Part part;
    part.object = name;
    part.mesh.positions = {{low, z}, {high.x, low.y, z}, {high, z}, {low.x, high.y, z}};
    part.mesh.indices = {0, 1, 2, 0, 2, 3};
    model->parts.push_back(part);
  };
  add_level("LandUse", {-100, -100}, {100, 100}, 0.0f);
  add_level("Bridge", {-6, -90}, {6, 90}, 5.4f);
  for (const float x : {-6.0f, 5.0f}) add_level("Bridge", {x, -90}, {x + 1.0f, 90}, 6.4f);  // parapets
  Scene scene;
  scene.objects.emplace_back().model = model;
  Road below, above;
  below.path = {{-80, 0, 0}, {80, 0, 0}};
  above.path = {{0, -80, 5.4f}, {0, 80, 5.4f}};
  scene.roads = *build_road_graph(std::vector{below});
  const std::size_t lanes_below = scene.roads.lanes.size();
  const RoadGraph bridge = *build_road_graph(std::vector{above});
  for (Lane lane : bridge.lanes) {
    for (int& next : lane.next) next += int(lanes_below);
    scene.roads.lanes.push_back(lane);
  }
  pave(scene);
  for (const Part& part : scene.objects.back().model->parts)
    for (const glm::vec3& p : part.mesh.positions)
      EXPECT_TRUE(std::abs(p.z) < 0.1f || std::abs(p.z - 5.4f) < 0.1f) << p.x << " " << p.y << " " << p.z;
  for (std::size_t i = 0; i < scene.roads.lanes.size(); ++i)
    for (const glm::vec3& p : scene.roads.lanes[i].points)
      EXPECT_NEAR(p.z, i < lanes_below ? 0.06f : 5.46f, 0.01f) << "lane " << i;
}

TEST(Paving, DoesNotChangeTheLengthsThatTrafficCountsBy) {
  Scene bare = hillside(), paved = hillside();
  lay_lanes(bare);
  pave(paved);
  ASSERT_EQ(bare.roads.lanes.size(), paved.roads.lanes.size());
  for (std::size_t i = 0; i < bare.roads.lanes.size(); ++i) {
    ASSERT_EQ(bare.roads.lanes[i].points.size(), paved.roads.lanes[i].points.size());
    for (std::size_t k = 0; k < bare.roads.lanes[i].points.size(); ++k)
      EXPECT_LT(glm::distance(bare.roads.lanes[i].points[k] + glm::vec3(0, 0, 0.06f),
                              paved.roads.lanes[i].points[k]),
                1e-4f);
  }
}

TEST(Paving, LanesThatLieOnTheGroundStayAsTheyAre) {
  Scene scene = hillside();
  for (Lane& lane : scene.roads.lanes)
    for (glm::vec3& p : lane.points) p.z = 0.1f * p.x;
  const RoadGraph before = scene.roads;
  lay_lanes(scene);
  for (std::size_t i = 0; i < before.lanes.size(); ++i)
    EXPECT_EQ(scene.roads.lanes[i].points, before.lanes[i].points);
}

TEST(Paving, DrivewaysHaveNeitherPavementsNorDashes) {
  Scene scene = hillside();
  for (Lane& lane : scene.roads.lanes) lane.speed_limit = 15.0f / 3.6f;
  pave(scene);
  ASSERT_EQ(scene.objects.back().model->parts.size(), 1u);
  EXPECT_EQ(scene.objects.back().model->parts[0].object, "carriageway");
}

TEST(Paving, TakesFewTrianglesWhereTheGroundIsEven) {
  Scene scene = hillside();
  pave(scene);
  EXPECT_LT(triangles_of_paving(scene), 3500u) << "four lanes of 300 m and their crossing";
}

TEST(Paving, NeedsRoads) {
  Scene scene = hillside();
  scene.roads = {};
  pave(scene);
  EXPECT_EQ(scene.objects.size(), 1u);
}

}  // namespace
}  // namespace parvis::scene

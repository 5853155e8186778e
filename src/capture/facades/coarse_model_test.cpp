// The coarse model of a place that is known: points on its surfaces, seen from cameras that see them.
#include "capture/facades/coarse_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/random.h"

namespace parvis::facades {
namespace {

using photographs::PhotographSet;

/// A courtyard open to the south: three walls 10 m high around 20 m x 16 m, a roof over the northern one, the
/// ground. Points with 2 cm of noise, some of them anywhere; each is observed by the cameras in front of it.
PhotographSet courtyard(int points_per_surface, bool has_gate = false) {
  PhotographSet set;
  for (int i = 0; i < 8; ++i) {
    Camera camera;
    const float turn = float(i) * 0.7f;
    camera.world_from_camera = look_at({-6.0f + 1.7f * float(i), -6.0f + 1.5f * float(i % 3), 1.6f},
                                       {-8.0f + 16.0f * float(i % 2), 8.0f * std::cos(turn), 3.0f});
    camera.vertical_fov = 0.9f;
    set.photographs.push_back(photographs::photograph_of(camera, fmt::format("{}.jpg", i), 1200, 900));
  }
  Random random(3);
  const auto noise = [&] { return 0.02 * (double(random.uniform()) + double(random.uniform()) - 1.0) * 2.0; };
  const auto add = [&](glm::dvec3 p) {
    photographs::SparsePoint point;
    point.position_in_world = p + glm::dvec3(noise(), noise(), noise());
    for (int k = 0; k < 8; k += 2) point.observations.push_back({k, {0.0, 0.0}});
    set.points.push_back(point);
  };
  for (int i = 0; i < points_per_surface; ++i) {
    const double a = double(random.uniform()), b = double(random.uniform());
    const glm::dvec3 north(-10.0 + 20.0 * a, 8.0, 10.0 * b);
    if (!has_gate || std::abs(north.x) > 3.0) add(north);
    if (has_gate && i % 2) add({-2.5 + 5.0 * a, 30.0, 6.0 * b});  // seen through the gate
    add({-10.0, -8.0 + 16.0 * a, 10.0 * b});
    add({10.0, -8.0 + 16.0 * a, 10.0 * b});
    if (i % 2) add({-10.0 + 20.0 * a, 8.0 + 4.0 * b, 10.0 + 4.0 * b});  // 45 degrees
    if (i % 3 == 0) add({-10.0 + 20.0 * a, -8.0 + 16.0 * b, 0.0});
    if (i % 10 == 0) add({-9.0 + 18.0 * a, -7.0 + 14.0 * b, 8.0 * double(random.uniform())});
  }
  return set;
}

const CoarseSurface* find(const CoarseModel& model, const std::string& name) {
  const auto found = std::ranges::find(model.surfaces, name, &CoarseSurface::name);
  return found == model.surfaces.end() ? nullptr : &*found;
}

glm::dvec3 normal_of(const CoarseSurface& s) {
  return glm::normalize(glm::cross(s.corners[1] - s.corners[0], s.corners[2] - s.corners[0]));
}

TEST(CoarseModel, FindsTheCourtyardsWallsRoofAndGround) {
  const auto model = propose_coarse_model(courtyard(1500));
  ASSERT_TRUE(model) << to_string(model.errors());
  int walls = 0, roofs = 0;
  for (const CoarseSurface& surface : model->surfaces) {
    walls += surface.kind == SurfaceKind::wall;
    roofs += surface.kind == SurfaceKind::roof;
    const glm::dvec3 normal = normal_of(surface);
    for (const glm::dvec3& corner : surface.corners) {
      if (surface.kind == SurfaceKind::ground) {
        EXPECT_NEAR(corner.z, 0.0, 0.1);
      }
      if (surface.kind == SurfaceKind::wall) {
        EXPECT_NEAR(normal.z, 0.0, 0.01);
        const double off_wall =
            std::min({std::abs(corner.y - 8.0), std::abs(corner.x - 10.0), std::abs(corner.x + 10.0)});
        EXPECT_LT(off_wall, 0.1);
        EXPECT_LT(corner.z, 10.5);
      }
    }
    if (surface.kind == SurfaceKind::wall) {
      EXPECT_LT(glm::dot(normal, surface.corners[0]), 0.0) << surface.name << " looks into the courtyard";
      EXPECT_NEAR(surface.corners[0].z, 0.0, 0.1) << surface.name << " stands on the ground";
      EXPECT_NEAR(surface.corners[3].z, 10.0, 0.4) << surface.name;
    }
  }
  EXPECT_EQ(walls, 3);
  EXPECT_EQ(roofs, 1);
  ASSERT_TRUE(find(*model, "ground"));
  const CoarseSurface* roof = find(*model, "roof_1");
  ASSERT_TRUE(roof);
  EXPECT_NEAR(normal_of(*roof).z, std::sqrt(0.5), 0.03);
  EXPECT_NEAR(roof->corners[0].z, 10.0, 0.2) << "it begins where the wall ends";
}

TEST(CoarseModel, WallsMeetAtTheirCorners) {
  const auto model = propose_coarse_model(courtyard(1500));
  ASSERT_TRUE(model);
  for (const double x : {-10.0, 10.0}) {
    int ends = 0;
    for (const CoarseSurface& surface : model->surfaces)
      for (const std::size_t corner : {0u, 1u})
        ends += surface.kind == SurfaceKind::wall &&
                glm::distance(surface.corners[corner], glm::dvec3(x, 8.0, 0.0)) < 0.15;
    EXPECT_EQ(ends, 2) << "two walls end at the corner at x = " << x;
  }
}

TEST(CoarseModel, TheGroundHasOneCornerWhereWallsMeet) {
  for (const int points : {1100, 1300, 1500}) {
    const auto model = propose_coarse_model(courtyard(points));
    ASSERT_TRUE(model) << to_string(model.errors());
    const CoarseSurface* ground = find(*model, "ground");
    ASSERT_TRUE(ground);
    const std::vector<glm::dvec3>& corners = ground->corners;
    EXPECT_GE(corners.size(), 4u);
    for (std::size_t i = 0; i < corners.size(); ++i)
      EXPECT_GT(glm::distance(corners[i], corners[(i + 1) % corners.size()]), 0.01) << i;
  }
}

TEST(CoarseModel, AGateStaysOpen) {
  const auto model = propose_coarse_model(courtyard(1500, true));
  ASSERT_TRUE(model) << to_string(model.errors());
  for (const CoarseSurface& surface : model->surfaces) {
    if (surface.kind != SurfaceKind::wall || std::abs(surface.corners[0].y - 8.0) > 0.2 ||
        std::abs(surface.corners[1].y - 8.0) > 0.2)
      continue;
    const double low = std::min(surface.corners[0].x, surface.corners[1].x),
                 high = std::max(surface.corners[0].x, surface.corners[1].x);
    EXPECT_TRUE(high < -2.0 || low > 2.0) << surface.name << " closes the gate: " << low << " to " << high;
  }
}

/// Adds points with 2 cm of noise that the named photographs observe.
void add_patch(PhotographSet& set, int count, glm::dvec3 corner, glm::dvec3 u, glm::dvec3 v,
               std::initializer_list<int> photographs) {
  Random random(11);
  const auto noise = [&] { return 0.04 * double(random.uniform()) - 0.02; };
  for (int i = 0; i < count; ++i) {
    photographs::SparsePoint point;
    point.position_in_world = corner + double(random.uniform()) * u + double(random.uniform()) * v +
                              glm::dvec3(noise(), noise(), noise());
    for (const int k : photographs) point.observations.push_back({k, {0.0, 0.0}});
    set.points.push_back(point);
  }
}

/// Photographs from given places, without points.
PhotographSet photographs_from(std::initializer_list<glm::vec3> places) {
  PhotographSet set;
  for (const glm::vec3& place : places) {
    Camera camera;
    camera.world_from_camera = look_at(place, place + glm::vec3(0.0f, 1.0f, 0.0f));
    set.photographs.push_back(
        photographs::photograph_of(camera, fmt::format("{}.jpg", set.photographs.size()), 1200, 900));
  }
  return set;
}

TEST(CoarseModel, ASurfaceThatIsLookedThroughFromBehindIsFalse) {
  PhotographSet set = photographs_from({{-6, -4, 1.6f}, {-5, 4, 1.6f}, {6, -4, 1.6f}, {5, 4, 1.6f}});
  add_patch(set, 1000, {-10, -8, 0}, {0, 16, 0}, {0, 0, 8}, {2, 3});  // seen through x = 0, from x > 0
  add_patch(set, 300, {0, -4, 1}, {0, 5, 0}, {0, 0, 2.5}, {0, 1});    // leaves, say
  add_patch(set, 400, {-10, -8, 0}, {20, 0, 0}, {0, 16, 0}, {0, 1, 2, 3});
  const auto model = propose_coarse_model(set);
  ASSERT_TRUE(model) << to_string(model.errors());
  int walls = 0;
  for (const CoarseSurface& surface : model->surfaces) {
    if (surface.kind != SurfaceKind::wall) continue;
    ++walls;
    EXPECT_NEAR(surface.corners[0].x, -10.0, 0.2) << surface.name;
  }
  EXPECT_EQ(walls, 1);
}

TEST(CoarseModel, StairsBeforeAPortalAreNoRoof) {
  PhotographSet set = photographs_from({{-4, -6, 1.6f}, {-1, -7, 1.7f}, {2, -7, 1.6f}, {5, -6, 1.7f}});
  const auto seen = {0, 1, 2, 3};
  const double rise = std::tan(0.436);  // 25 degrees
  add_patch(set, 700, {-10, -8, 0}, {20, 0, 0}, {0, 10, 0}, seen);
  add_patch(set, 600, {-5, 2, 0}, {10, 0, 0}, {0, 4, 4.0 * rise}, seen);
  add_patch(set, 1200, {-10, 6, 0}, {20, 0, 0}, {0, 0, 9}, seen);
  // Of the portal behind, what happens to lie in the stairs' plane.
  add_patch(set, 60, {-2, 6.5, 4.5 * rise}, {4, 0, 0}, {0, 2, 2.0 * rise}, seen);
  const auto model = propose_coarse_model(set);
  ASSERT_TRUE(model) << to_string(model.errors());
  EXPECT_FALSE(find(*model, "roof_1"));
  const CoarseSurface* stairs = find(*model, "slope_1");
  ASSERT_TRUE(stairs);
  EXPECT_EQ(stairs->kind, SurfaceKind::slope);
  for (const glm::dvec3& corner : stairs->corners) EXPECT_LT(corner.y, 6.1) << "it ends at the wall";
  EXPECT_NEAR(stairs->corners[0].z, 0.0, 0.3);
  EXPECT_NEAR(stairs->corners[2].z, 4.0 * rise, 0.2);
}

TEST(CoarseModel, AWallIsContinuedOnlyWhereNothingIsSeenThroughIt) {
  PhotographSet set = photographs_from({{-6, -8, 1.6f}, {-2, -9, 1.6f}, {2, -8, 1.6f}, {6, -9, 1.6f}});
  add_patch(set, 1500, {-10, 8, 3}, {20, 0, 0}, {0, 0, 9}, {0, 1, 2, 3});  // it stands on posts
  add_patch(set, 600, {-10, 14, 0}, {20, 0, 0}, {0, 0, 3}, {0, 1, 2, 3});  // seen between them
  add_patch(set, 400, {-10, -9, 0}, {20, 0, 0}, {0, 23, 0}, {0, 1, 2, 3});
  const auto model = propose_coarse_model(set);
  ASSERT_TRUE(model) << to_string(model.errors());
  const CoarseSurface* wall = find(*model, "wall_1");
  ASSERT_TRUE(wall);
  EXPECT_NEAR(wall->corners[0].y, 8.0, 0.2);
  EXPECT_NEAR(wall->corners[0].z, 3.0, 0.4) << "the passage below it stays open";
}

TEST(CoarseModel, WhereNoGroundIsFoundTheHintForItIsNamed) {
  PhotographSet set = photographs_from({{-6, -8, 1.6f}, {-2, -9, 1.6f}, {2, -8, 1.6f}, {6, -9, 1.6f}});
  add_patch(set, 1500, {-10, 8, 0}, {20, 0, 0}, {0, 0, 9}, {0, 1, 2, 3});
  const auto model = propose_coarse_model(set);
  ASSERT_TRUE(model) << to_string(model.errors());
  EXPECT_TRUE(find(*model, "ground"));
  EXPECT_NE(to_string(model->notes).find("plane ground"), std::string::npos) << to_string(model->notes);
}

TEST(CoarseModel, TooFewPointsAreAnError) {
  PhotographSet set = courtyard(100);
  set.points.resize(5);
  const auto model = propose_coarse_model(set);
  ASSERT_FALSE(model);
  EXPECT_NE(to_string(model.errors()).find("parvis facade calibrate"), std::string::npos);
}

CoarseModel one_wall() {
  CoarseModel model;
  model.surfaces.push_back(
      {"wall_1", SurfaceKind::wall, {{0, 0, 0}, {10, 0, 0}, {10, 0, 5}, {0, 0, 5}}, 100});
  model.surfaces.push_back(
      {"wall_2", SurfaceKind::wall, {{0, 0, 0}, {0, -10, 0}, {0, -10, 5}, {0, 0, 5}}, 50});
  return model;
}

TEST(CoarseHints, MoveEdgesAndAddPlanes) {
  CoarseModel model = one_wall();
  const Status applied =
      apply_hints(model,
                  "# corrections\ntop wall_1 7.5\nleft wall_1 -2 0.3\nright wall_1 12 0  # to the corner\n"
                  "remove wall_2\nrename wall_1 town_hall\n"
                  "plane annex 0 0 0  4 0 0  4 3 3  0 3 3\n",
                  "hints.txt");
  ASSERT_TRUE(applied) << to_string(applied.errors());
  ASSERT_EQ(model.surfaces.size(), 2u);
  EXPECT_EQ(model.surfaces[0].name, "town_hall");
  EXPECT_LT(glm::distance(model.surfaces[0].corners[2], glm::dvec3(12, 0, 7.5)), 1e-9);
  EXPECT_LT(glm::distance(model.surfaces[0].corners[0], glm::dvec3(-2, 0, 0)), 1e-9);
  EXPECT_EQ(model.surfaces[1].kind, SurfaceKind::roof);
  EXPECT_EQ(meshes_of(model).size(), 2u);
  EXPECT_EQ(meshes_of(model)[1].mesh.triangle_count(), 2u);
}

TEST(CoarseHints, EveryWrongLineIsNamedAndNothingChanges) {
  CoarseModel model = one_wall();
  const Status applied =
      apply_hints(model,
                  "remove wall_1\ntop wall_9 3\nraise wall_1 3\ntop wall_2\nplane a 0 0 0 1 0 0\n"
                  "plane b 0 0 0  4 0 0  4 3 3  0 3 9\nplane c 0 0 0  4 0 0  1 1 0  0 4 0\ntop wall_2 x\n",
                  "h");
  ASSERT_FALSE(applied);
  EXPECT_EQ(applied.errors().size(), 7u) << to_string(applied.errors());
  EXPECT_NE(to_string(applied.errors()).find("h:2: wall_9 is no surface; there are wall_2"),
            std::string::npos);
  EXPECT_NE(to_string(applied.errors()).find("h:7: the polygon is concave"), std::string::npos)
      << to_string(applied.errors());
  EXPECT_EQ(model.surfaces.size(), 2u);
}

}  // namespace
}  // namespace parvis::facades

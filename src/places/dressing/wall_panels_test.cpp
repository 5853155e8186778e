#include "places/dressing/wall_panels.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/mesh.h"
#include "places/dressing/test_walls.h"

namespace parvis::dressing {
namespace {

std::vector<ModelTriangle> triangles_of(const Mesh& mesh) {
  scene::Model model;
  model.materials.emplace_back();
  model.parts.emplace_back();
  model.parts.front().mesh = mesh;
  return take_triangles(model, "*", [](const scene::Part&, glm::vec3) { return true; });
}

TEST(WallPanels, AWallNarrowerThanItsStepsAreSoughtWithIsAPanel) {
  Mesh post;
  add_quad(post, {0, 0, 1}, {0.03f, 0, 1}, {0.03f, 0, 4}, {0, 0, 4});
  const std::vector<WallPanel> panels = wall_panels(triangles_of(post));
  ASSERT_EQ(panels.size(), 1u);
  EXPECT_EQ(panels[0].triangles.size(), 2u);
  EXPECT_NEAR(panels[0].high.x - panels[0].low.x, 0.03f, 1e-6f);
  EXPECT_EQ(panels[0].low.y, 1.0f);
  EXPECT_EQ(panels[0].high.y, 4.0f);
}

/// A wall in one piece whose top goes up and down by a metre every two metres.
Mesh battlements(int teeth) {
  Mesh mesh;
  for (int i = 0; i < 2 * teeth; ++i) {
    const float x = 2.0f * float(i), top = i % 2 == 0 ? 6.0f : 5.0f;
    add_quad(mesh, {x, 0, 0}, {x + 2, 0, 0}, {x + 2, 0, top}, {x, 0, top});
    const std::uint32_t shared = mesh.indices[mesh.indices.size() - 6];  // the foot of the tooth before
    if (i > 0) mesh.indices[mesh.indices.size() - 6] = mesh.indices[mesh.indices.size() - 3] = shared - 3;
  }
  return mesh;
}

TEST(WallPanels, AnyNumberOfStepsGivesPanelsWithTheirOwnTriangles) {
  constexpr int teeth = 300;
  const std::vector<WallPanel> panels = wall_panels(triangles_of(battlements(teeth)));
  ASSERT_EQ(panels.size(), std::size_t(2 * teeth));
  for (const WallPanel& panel : panels) {
    EXPECT_NEAR(panel.high.x - panel.low.x, 2.0f, 1e-3f);
    EXPECT_EQ(panel.triangles.size(), 2u);
  }
}

TEST(WallPanels, AWallOfMoreStepsThanAnyHouseIsLeftWhole) {
  constexpr int teeth = 2500;
  const std::vector<ModelTriangle> walls = triangles_of(battlements(teeth));
  const std::vector<WallPanel> panels = wall_panels(walls);
  ASSERT_EQ(panels.size(), 1u);
  EXPECT_EQ(panels[0].triangles.size(), walls.size()) << "nothing is lost";
  EXPECT_NEAR(panels[0].high.x - panels[0].low.x, 4.0f * float(teeth), 0.01f);
  EXPECT_EQ(panels[0].low.y, 0.0f);
  EXPECT_EQ(panels[0].high.y, 6.0f);
  EXPECT_EQ(panels[0].eaves_m, 5.0f);
}

TEST(WallPanels, WestIsOneHeading) {
  // Two polygons of one wall, one above the other: atan2 returns 180 degrees for one and -180 for the other.
  Mesh wall;
  add_quad(wall, {0, 10, 0}, {0.0001f, 0, 0}, {0.0001f, 0, 3}, {0, 10, 3});
  add_quad(wall, {0.0001f, 10, 3}, {0, 0, 3}, {0, 0, 9}, {0.0001f, 10, 9});
  const std::vector<WallPanel> panels = wall_panels(triangles_of(wall));
  ASSERT_EQ(panels.size(), 1u);
  EXPECT_LT(panels[0].normal.x, -0.99f);
  EXPECT_NEAR(panels[0].high.y - panels[0].low.y, 9.0f, 1e-3f);
}

/// Rows of houses whose fronts and backs have three windows each.
struct Town {
  std::vector<ModelTriangle> walls;
  std::vector<glm::vec3> windows;

  explicit Town(int houses) {
    Mesh mesh;
    const int per_row = int(std::sqrt(float(houses)));
    for (int i = 0; i < houses; ++i) {
      const glm::vec3 corner(7.0f * float(i % per_row), 25.0f * float(i / per_row), 0.0f);
      const std::array<glm::vec3, 4> plan{corner, corner + glm::vec3(7, 0, 0), corner + glm::vec3(7, 9, 0),
                                          corner + glm::vec3(0, 9, 0)};
      for (std::size_t k = 0; k < 4; ++k) {
        const glm::vec3 a = plan[k], b = plan[(k + 1) % 4], top(0, 0, 4 + i % 7);
        add_quad(mesh, a, b, b + top, a + top);
        for (const float place : {0.2f, 0.5f, 0.8f})
          if (k % 2 == 0) windows.push_back(glm::mix(a, b, place) + glm::vec3(0, 0, 2));
      }
    }
    walls = triangles_of(mesh);
  }
};

TEST(WallPanels, OpeningsOfATownAreFound) {
  const Town town(1250);
  for (const WallPanel& panel : wall_panels(town.walls, town.windows))
    EXPECT_EQ(panel.has_openings, std::abs(panel.normal.y) > 0.5f);
}

}  // namespace
}  // namespace parvis::dressing

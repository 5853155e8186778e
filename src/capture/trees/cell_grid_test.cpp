#include "capture/trees/cell_grid.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/random.h"

namespace parvis::trees {
namespace {

/// Every cell of the grid but those for which `is_left_out`.
template <class LeftOut>
CellGrid filled(const Bounds& box, int branching, int side, LeftOut is_left_out) {
  std::vector<glm::u16vec3> cells;
  for (int z = 0; z < side; ++z)
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x)
        if (!is_left_out(glm::ivec3(x, y, z))) cells.emplace_back(x, y, z);
  return CellGrid(box, branching, side, std::move(cells));
}

glm::vec3 random_direction(Random& random) {
  glm::vec3 d;
  do d = {random.uniform(-1.0f, 1.0f), random.uniform(-1.0f, 1.0f), random.uniform(-1.0f, 1.0f)};
  while (glm::length(d) > 1.0f || glm::length(d) < 0.1f);
  return glm::normalize(d);
}

/// Length of a ray within a box, metres.
float chord(const Bounds& box, const ViewRay& ray) {
  glm::vec3 direction = ray.direction;
  const glm::vec2 span = box_distances(box, ray.origin, inverse_of(direction));
  return std::max(0.0f, span.y - span.x);
}

class Walk : public testing::TestWithParam<std::pair<int, int>> {};  // branching, side

TEST_P(Walk, GivesEachCellTheLengthOfItsChord) {
  const auto [branching, side] = GetParam();
  const Bounds box{{-1.0f, 2.0f, 0.5f}, {1.5f, 3.0f, 4.5f}};
  const CellGrid grid =
      filled(box, branching, side, [](glm::ivec3 p) { return (p.x * 7 + p.y * 3 + p.z * 5) % 4 == 0; });
  Random random(3);
  for (int i = 0; i < 200; ++i) {
    const glm::vec3 target =
        glm::mix(box.min, box.max, glm::vec3(random.uniform(), random.uniform(), random.uniform()));
    glm::vec3 direction = random_direction(random);
    if (i % 10 == 0) direction = glm::vec3(i % 3 == 0, i % 3 == 1, i % 3 == 2);  // along an axis
    const ViewRay ray{target - 9.0f * direction, direction};
    std::vector<float> lengths(grid.size(), 0.0f);
    float last = 0.0f;
    grid.walk(ray, [&](std::size_t cell, float enter, float leave) {
      EXPECT_GE(enter, last - 1e-4f) << "front to back";
      last = leave, lengths[cell] += leave - enter;
      return true;
    });
    for (std::size_t cell = 0; cell < grid.size(); ++cell)
      ASSERT_NEAR(lengths[cell], chord(grid.bounds(cell), ray), 2e-4f) << "ray " << i << ", cell " << cell;
  }
}

INSTANTIATE_TEST_SUITE_P(Grids, Walk,
                         testing::Values(std::pair{3, 3}, std::pair{3, 9}, std::pair{3, 27}, std::pair{2, 4},
                                         std::pair{2, 16}));

TEST(CellGrid, EndsAWalkWhenToldTo) {
  const CellGrid grid = filled({glm::vec3(0.0f), glm::vec3(1.0f)}, 3, 9, [](glm::ivec3) { return false; });
  int visits = 0;
  grid.walk({{-1.0f, 0.5f, 0.5f}, {1.0f, 0.0f, 0.0f}},
            [&](std::size_t, float, float) { return ++visits < 4; });
  EXPECT_EQ(visits, 4);
}

TEST(CellGrid, HasNoCellsBehindARaysOrigin) {
  const CellGrid grid = filled({glm::vec3(0.0f), glm::vec3(1.0f)}, 3, 9, [](glm::ivec3) { return false; });
  int visits = 0;
  grid.walk({{1.5f, 0.5f, 0.5f}, {1.0f, 0.0f, 0.0f}},
            [&](std::size_t, float, float) { return ++visits > 0; });
  EXPECT_EQ(visits, 0);
}

TEST(CellGrid, FindsItsCells) {
  const CellGrid grid =
      filled({glm::vec3(0.0f), glm::vec3(1.0f)}, 3, 27, [](glm::ivec3 p) { return p.x % 2 == 1; });
  for (std::size_t i = 0; i < grid.size(); ++i) ASSERT_EQ(grid.cell_at(grid.cells()[i]), int(i));
  EXPECT_EQ(grid.cell_at({1, 0, 0}), no_cell);
  EXPECT_EQ(grid.cell_at({-1, 0, 0}), no_cell);
  EXPECT_EQ(grid.cell_at({27, 0, 0}), no_cell);
}

}  // namespace
}  // namespace parvis::trees

#include "base/disjoint_sets.h"

#include <gtest/gtest.h>

namespace parvis {
namespace {

TEST(DisjointSets, JoinsPairByPair) {
  DisjointSets sets(4);
  EXPECT_EQ(sets.add(), 4u);
  sets.join(0, 1), sets.join(3, 4), sets.join(1, 3);
  for (const std::size_t i : {0u, 1u, 3u}) EXPECT_EQ(sets.root(i), 4u);
  EXPECT_EQ(sets.root(2), 2u);
}

TEST(TrianglesAtCorners, BelongTogetherWhereTheyShareACorner) {
  TrianglesAtCorners triangles(0.01f);
  const auto at = [](float x) { return std::array<glm::vec3, 3>{{{x, 0, 0}, {x + 1, 0, 0}, {x, 0, 1}}}; };
  for (const float x : {0.0f, 5.0f, 1.001f, 1e9f})
    triangles.add(at(x));  // 1e11 steps: more than an int holds
  EXPECT_EQ(triangles.root(0), triangles.root(2));
  EXPECT_NE(triangles.root(0), triangles.root(1));
  EXPECT_NE(triangles.root(3), triangles.root(0));
}

}  // namespace
}  // namespace parvis

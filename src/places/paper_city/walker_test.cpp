#include "places/paper_city/walker.h"

#include <gtest/gtest.h>

namespace parvis::city {
namespace {

/// Bounds of the parts of this name, or of all, at a time of the walk.
Bounds bounds_at(const scene::Model& model, float time_s, const std::string& name = {}) {
  const std::vector<glm::mat4> pose = scene::pose_at(model, model.animations.front(), time_s);
  Bounds bounds;
  for (const scene::Part& part : model.parts)
    if (name.empty() || part.object == name)
      for (const glm::vec3& position : part.mesh.positions)
        bounds.add(glm::vec3(pose[std::size_t(part.node)] * glm::vec4(position, 1.0f)));
  return bounds;
}

TEST(Walker, IsAsTallAsPeopleAndOfFewTriangles) {
  for (const scene::Model& walker : city_walkers()) {
    const Bounds bounds = scene::bounds(walker);
    EXPECT_NEAR(bounds.max.z, 1.75f, 0.01f);
    EXPECT_NEAR(bounds.min.z, 0.0f, 0.01f);
    EXPECT_LT(bounds.size().y, 0.7f);
    EXPECT_GE(walker.triangle_count(), 500u);
    EXPECT_LE(walker.triangle_count(), 1500u);
    for (const scene::Part& part : walker.parts) EXPECT_TRUE(check(part.mesh, part.object));
  }
}

TEST(Walker, WalksForEverWithAFootOnTheGround) {
  const scene::Model walker = city_walkers().front();
  const float duration_s = walker.animations.front().duration_s;
  for (int i = 0; i <= 20; ++i) {
    const Bounds feet = bounds_at(walker, duration_s * float(i) / 20.0f, "shoe");
    EXPECT_NEAR(feet.min.z, 0.0f, 0.07f) << "a shoe's tip dips where its leg is spread";
  }
  EXPECT_LT(glm::distance(bounds_at(walker, 0.0f).max, bounds_at(walker, duration_s).max), 1e-4f);
}

TEST(Walker, StepsAsFarAsItGoes) {
  const scene::Model walker = city_walkers().front();
  const float quarter_s = 0.25f * walker.animations.front().duration_s;
  const Bounds spread = bounds_at(walker, quarter_s, "shoe"), together = bounds_at(walker, 0.0f, "thigh");
  EXPECT_GT(spread.size().x, 0.8f);
  EXPECT_LT(together.size().x, 0.3f);
  EXPECT_NEAR(spread.size().x - 0.26f, 0.5f * walking_speed_m_s * 4.0f * quarter_s, 0.2f)
      << "two steps a turn, less a shoe's length";
}

}  // namespace
}  // namespace parvis::city

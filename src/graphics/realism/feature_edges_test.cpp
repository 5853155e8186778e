#include "graphics/realism/feature_edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "scene/data/test_scene.h"

namespace parvis::realism {
namespace {

using scene::box, scene::matt, scene::model_of, scene::quad, scene::sphere;

long always_drawn(const PartEdges& part) {
  return std::ranges::count(part.edges, true, &Edge::is_drawn_always);
}

TEST(FeatureEdges, ABoxHasTwelveAndNoDiagonals) {
  const std::vector<PartEdges> parts =
      feature_edges(*model_of(box({0, 0, 0}, {1, 2, 3}), matt(glm::vec3(0.5f))));
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_EQ(parts[0].edges.size(), 12u);
  EXPECT_EQ(always_drawn(parts[0]), 12);
  EXPECT_NEAR(parts[0].spacing_m, 22.0f / 24.0f, 1e-4f) << "22 m2 of surface, 4 (1 + 2 + 3) m of edges";
}

TEST(FeatureEdges, ABallHasOutlinesAlone) {
  const std::vector<PartEdges> parts =
      feature_edges(*model_of(sphere(glm::vec3(0.0f), 1.0f), matt(glm::vec3(0.5f))));
  EXPECT_EQ(always_drawn(parts[0]), 0);
  EXPECT_GT(parts[0].edges.size(), 1000u);
  EXPECT_TRUE(std::isinf(parts[0].spacing_m));
}

/// Two squares side by side in one plane: of one material they are one surface.
TEST(FeatureEdges, ABorderOfMaterialsIsDrawnAndASeamIsNot) {
  scene::Model model = *model_of(quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}), matt(glm::vec3(0.5f)));
  model.parts.push_back(model.parts[0]);
  model.parts[1].mesh = quad({1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0});
  const auto all = [&] {
    const std::vector<PartEdges> parts = feature_edges(model);
    return parts[0].edges.size() + parts[1].edges.size();
  };
  EXPECT_EQ(all(), 6u);
  model.materials.push_back(matt(glm::vec3(0.2f)));
  model.parts[1].material = 1;
  EXPECT_EQ(all(), 7u);
}

TEST(FeatureEdges, LeavesHaveNone) {
  scene::Material leaf = matt(glm::vec3(0.5f));
  leaf.alpha_mode = scene::Alpha::cutout;
  EXPECT_TRUE(
      feature_edges(*model_of(quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}), leaf))[0].edges.empty());
}

}  // namespace
}  // namespace parvis::realism

#include "scene/data/leaf_openness.h"

#include <gtest/gtest.h>

#include "scene/data/test_crown.h"

namespace parvis::scene {
namespace {

/// Mean over the vertices that a condition chooses.
template <class Condition>
float mean_openness(const Mesh& mesh, std::span<const float> openness, const Condition& is_chosen) {
  float sum = 0.0f, count = 0.0f;
  for (std::size_t i = 0; i < openness.size(); ++i)
    if (is_chosen(mesh.positions[i])) sum += openness[i], count += 1.0f;
  EXPECT_GT(count, 0.0f);
  return sum / count;
}

Scene with_foliage(const Mesh& mesh, const Material& material) {
  Scene scene;
  add(scene, model_of(mesh, material));
  find_leaf_openness(scene);
  return scene;
}

std::span<const float> openness_in(const Scene& scene) {
  return scene.data<LeafOpenness>().of(*scene.objects[0].model, 0);
}

TEST(LeafOpenness, FallsFromTheTopToTheMiddleAndTheBottom) {
  const Mesh mesh = crown(6000);
  const Scene scene = with_foliage(mesh, leaf_material({0.1f, 0.2f, 0.05f}, 0.3f));
  const std::span<const float> openness = openness_in(scene);
  ASSERT_EQ(openness.size(), mesh.positions.size());
  const float middle =
      mean_openness(mesh, openness, [](glm::vec3 p) { return glm::length(p) < 0.3f * crown_m; });
  const float top = mean_openness(mesh, openness, [](glm::vec3 p) { return p.z > 0.85f * crown_m; });
  const float bottom = mean_openness(mesh, openness, [](glm::vec3 p) { return p.z < -0.85f * crown_m; });
  EXPECT_LT(middle, 0.5f * top);
  EXPECT_LT(bottom, 0.5f * top);
  EXPECT_GT(top, 0.5f);
}

/// The sky is seen from the top alone, a crown from below, too.
TEST(LeafOpenness, WhatIsSeenFromOutsideIsTheSkinOfACrown) {
  const Mesh mesh = crown(6000);
  const Scene scene = with_foliage(mesh, leaf_material({0.1f, 0.2f, 0.05f}, 0.3f));
  const std::span<const float> seen = scene.data<LeafOpenness>().max_seen(*scene.objects[0].model, 0);
  ASSERT_EQ(seen.size(), mesh.positions.size());
  EXPECT_LT(mean_openness(mesh, seen, [](glm::vec3 p) { return glm::length(p) < 0.3f * crown_m; }), 0.2f);
  for (const float side : {-1.0f, 1.0f})
    EXPECT_GT(mean_openness(mesh, seen, [&](glm::vec3 p) { return side * p.z > 0.95f * crown_m; }), 0.6f);
  EXPECT_TRUE(LeafOpenness().max_seen(*scene.objects[0].model, 0).empty());
}

TEST(LeafOpenness, OfThinFoliageIsLarger) {
  const Material leaf = leaf_material({0.1f, 0.2f, 0.05f}, 0.3f);
  const auto everywhere = [](glm::vec3) { return true; };
  const Mesh dense = crown(6000), thin = crown(600);
  EXPECT_GT(mean_openness(thin, openness_in(with_foliage(thin, leaf)), everywhere),
            1.5f * mean_openness(dense, openness_in(with_foliage(dense, leaf)), everywhere));
}

TEST(LeafOpenness, HolesOfThePictureLetThrough) {
  const Mesh mesh = crown(6000);
  Scene scene;
  Material leaf = leaf_material({0.1f, 0.2f, 0.05f}, 0.3f);
  leaf.base_colour_texture = 0;
  auto model = std::make_shared<Model>(*model_of(mesh, leaf));
  Image8 tenth(10, 10, 4, 0);
  for (int x = 0; x < 10; ++x) tenth.at(x, 0)[3] = 255;
  model->textures.push_back({"tenth", tenth, true, scene::Wrap::clamp, scene::Wrap::clamp});
  add(scene, model);
  find_leaf_openness(scene);
  const auto everywhere = [](glm::vec3) { return true; };
  EXPECT_GT(mean_openness(mesh, openness_in(scene), everywhere),
            1.5f * mean_openness(mesh, openness_in(with_foliage(mesh, leaf_material({}, 0.3f))), everywhere));
}

TEST(LeafOpenness, ATreeAmongAThousandHasThatOfTheTreeAlone) {
  const Mesh tree = crown(2000);
  Mesh town;
  for (int i = 0; i < 12; ++i)
    append(town, tree, glm::translate(glm::mat4(1.0f), {50.0f * float(i % 4), 50.0f * float(i / 4), 0.0f}));
  const Material leaf = leaf_material({0.1f, 0.2f, 0.05f}, 0.3f);
  const Scene alone = with_foliage(tree, leaf), among = with_foliage(town, leaf);
  float off = 0.0f;
  for (std::size_t i = 0; i < tree.positions.size(); ++i)
    off += std::abs(openness_in(among)[5 * tree.positions.size() + i] - openness_in(alone)[i]);
  EXPECT_LT(off / float(tree.positions.size()), 0.05f);
}

TEST(LeafOpenness, WhatIsNoFoliageHasNone) {
  const Scene scene = with_foliage(crown(100), matt({0.5f, 0.5f, 0.5f}));
  EXPECT_TRUE(openness_in(scene).empty());
  EXPECT_TRUE(LeafOpenness().of(*scene.objects[0].model, 0).empty());
}

}  // namespace
}  // namespace parvis::scene

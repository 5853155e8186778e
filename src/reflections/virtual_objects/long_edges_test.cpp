#include "reflections/virtual_objects/long_edges.h"

#include <gtest/gtest.h>

#include <map>

#include "scene/data/test_scene.h"

namespace parvis::virtual_objects {
namespace {

constexpr std::size_t maximum = 100000;

float area(const Mesh& mesh) {
  float sum = 0.0f;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const glm::vec3 a = mesh.positions[mesh.indices[i]];
    sum += 0.5f * glm::length(glm::cross(mesh.positions[mesh.indices[i + 1]] - a,
                                         mesh.positions[mesh.indices[i + 2]] - a));
  }
  return sum;
}

/// Edges that do not run once in each direction, by position: rims and cracks.
std::size_t open_edges(const Mesh& mesh) {
  using Place = std::array<float, 3>;
  std::map<std::pair<Place, Place>, int> runs;
  const auto place = [&](std::uint32_t v) {
    const glm::vec3 p = mesh.positions[v];
    return Place{p.x, p.y, p.z};
  };
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
    for (std::size_t k = 0; k < 3; ++k) {
      const Place a = place(mesh.indices[i + k]), b = place(mesh.indices[i + (k + 1) % 3]);
      ++runs[{a, b}], --runs[{b, a}];
    }
  return std::size_t(std::count_if(runs.begin(), runs.end(), [](const auto& run) { return run.second > 0; }));
}

TEST(LongEdges, AreDividedNearAReflectorWithoutCracks) {
  const std::array<ReflectorBall, 1> balls{{{{0.5f, 0.2f, 3.0f}, 0.5f}}};
  const Mesh box = scene::box({-1, -1, 0}, {1, 1, 2});
  const Mesh divided = with_short_edges(box, glm::mat4(1.0f), balls, maximum);
  EXPECT_GT(divided.indices.size(), 10 * box.indices.size());
  EXPECT_EQ(divided.positions.size(), divided.normals.size());
  EXPECT_EQ(divided.positions.size(), divided.uvs.size());
  EXPECT_NEAR(area(divided), area(box), 1e-3f);
  EXPECT_EQ(open_edges(divided), 0u);
  // Far from the reflector pieces may be longer.
  float near_edge = 0.0f, far_edge = 0.0f;
  for (std::size_t i = 0; i < divided.indices.size(); ++i) {
    const glm::vec3 a = divided.positions[divided.indices[i]],
                    b = divided.positions[divided.indices[i % 3 == 2 ? i - 2 : i + 1]];
    float& edge = a.z > 1.9f && b.z > 1.9f ? near_edge : far_edge;
    edge = std::max(edge, glm::distance(a, b));
  }
  EXPECT_LT(near_edge, 0.36f);
  EXPECT_GT(far_edge, near_edge);
}

TEST(LongEdges, StayWhereNoReflectorIsNearOrThereIsNoRoom) {
  const Mesh box = scene::box({-1, -1, 0}, {1, 1, 2});
  const std::array<ReflectorBall, 1> far_off{{{{0, 0, 500}, 0.5f}}}, near_by{{{{0, 0, 3}, 0.5f}}};
  EXPECT_EQ(with_short_edges(box, glm::mat4(1.0f), {}, maximum).indices, box.indices);
  EXPECT_EQ(with_short_edges(box, glm::mat4(1.0f), far_off, maximum).indices, box.indices);
  const Mesh few = with_short_edges(box, glm::mat4(1.0f), near_by, 100);
  EXPECT_LE(few.triangle_count(), 100u);
  EXPECT_EQ(open_edges(few), 0u);
}

TEST(LongEdges, OfASceneAreDividedWhereItsReflectorsAre) {
  scene::Scene scene;
  scene::add(scene, scene::model_of(scene::ground(4.0f), scene::matt(glm::vec3(0.5f))));
  const std::shared_ptr<const scene::Model> ground = scene.objects[0].model;
  divide_long_edges(scene);
  EXPECT_EQ(scene.objects[0].model, ground) << "nothing reflects";
  scene::Material chrome;
  chrome.is_mirror_like = true;
  const int mirror = scene::add(scene, scene::model_of(scene::sphere({0, 0, 1}, 1.0f, 8), chrome), true);
  scene.objects[std::size_t(mirror)].takes_reflection = true;
  divide_long_edges(scene);
  EXPECT_GT(scene.objects[0].model->parts[0].mesh.triangle_count(), 100u);
  EXPECT_EQ(ground->parts[0].mesh.triangle_count(), 2u) << "the model itself stays";
}

}  // namespace
}  // namespace parvis::virtual_objects

// A ray scene that is updated agrees with a new one.
#include "graphics/reference/ray_scene.h"

#include <gtest/gtest.h>

#include <limits>

#include "base/random.h"
#include "scene/data/test_scene.h"

namespace parvis::reference {
namespace {

/// Distances of 2,000 rays from all sides through the middle of the place; infinite where they hit nothing.
std::vector<float> distances(const RayScene& rays) {
  Random random(5);
  std::vector<float> found;
  for (int i = 0; i < 2000; ++i) {
    const auto point = [&](float half) {
      return half * (2.0f * glm::vec3(random.uniform(), random.uniform(), random.uniform()) - 1.0f);
    };
    const glm::vec3 from = 20.0f * glm::normalize(point(1.0f)), to = point(4.0f);
    const std::optional<Hit> hit = rays.nearest_hit({from, glm::normalize(to - from)});
    found.push_back(hit ? hit->distance_m : std::numeric_limits<float>::infinity());
  }
  return found;
}

void expect_same(const RayScene& updated, const scene::Scene& scene, const char* what) {
  const std::vector<float> ours = distances(updated), fresh = distances(RayScene(scene));
  std::size_t hits = 0;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    hits += std::isfinite(fresh[i]);
    if (std::isfinite(ours[i]) || std::isfinite(fresh[i])) {
      EXPECT_NEAR(ours[i], fresh[i], 1e-4f) << what;
    }
  }
  EXPECT_GT(hits, 100u) << what;
}

scene::Scene three_things() {
  scene::Scene scene;
  scene::add(scene, scene::model_of(scene::ground(6.0f), scene::matt(glm::vec3(0.5f))));
  scene::add(scene, scene::model_of(scene::box({-1, -1, 0}, {1, 1, 2}), scene::matt(glm::vec3(0.5f))), true);
  scene::add(scene, scene::model_of(scene::sphere({0, 0, 1}, 1.0f), scene::matt(glm::vec3(0.5f))), true);
  return scene;
}

TEST(RayScene, UpdatesAgreeWithANewScene) {
  scene::Scene scene = three_things();
  RayScene rays(scene);
  expect_same(rays, scene, "as built");
  const std::vector<float> before = distances(rays);

  scene.objects[1].world_from_model = glm::translate(glm::mat4(1.0f), {2, 1, 0.5f});
  EXPECT_EQ(distances(rays), before) << "nothing is taken over before update";
  rays.update(scene);
  EXPECT_NE(distances(rays), before);
  expect_same(rays, scene, "moved");

  scene.objects[2].is_visible = false;
  rays.update(scene);
  expect_same(rays, scene, "hidden");

  scene.objects[2].is_visible = true;
  scene.objects[2].world_from_model = glm::scale(glm::mat4(1.0f), {-2.0f, 1.0f, 1.0f});
  rays.update(scene);
  expect_same(rays, scene, "shown, mirrored and stretched");

  scene.objects[1].world_from_model = glm::scale(glm::mat4(1.0f), {1.0f, 1.0f, 0.0f});
  rays.update(scene);
  expect_same(rays, scene, "flattened: left out");
}

TEST(RayScene, HiddenObjectsAppear) {
  scene::Scene scene = three_things();
  scene.objects[1].is_visible = false;
  RayScene rays(scene);
  scene.objects[1].is_visible = true;
  rays.update(scene);
  expect_same(rays, scene, "shown");
}

/// A skinned body: its mesh changes in place, and may be elsewhere in memory.
TEST(RayScene, BentMeshesAreFollowed) {
  scene::Scene scene = three_things();
  auto deforming = std::make_shared<scene::Model>(*scene.objects[2].model);
  deforming->parts[0].deformation = std::make_shared<const scene::Deformation>();
  scene.objects[2].model = deforming;
  scene.objects[2].deformed_meshes = {deforming->parts[0].mesh};
  RayScene rays(scene);
  for (const float height : {2.0f, 0.5f, 3.0f}) {
    for (std::size_t i = 0; i < deforming->parts[0].mesh.positions.size(); ++i)
      scene.objects[2].deformed_meshes[0].positions[i] =
          deforming->parts[0].mesh.positions[i] * glm::vec3(1, 1, height);
    rays.update(scene);
    expect_same(rays, scene, "deformed");
  }
  scene.objects[2].deformed_meshes = {deforming->parts[0].mesh};
  rays.update(scene);
  expect_same(rays, scene, "at rest again");
}

/// What rooms draw by themselves is described for each picture; here it wanders, in a mesh of its own each
/// time.
TEST(RayScene, TracedThingsAreFollowed) {
  class Plain final : public scene::TracedSurface {
    scene::TracedPoint point(const scene::TracedHit& hit) const override { return {.normal = hit.normal}; }
  };
  scene::Scene scene = three_things();
  float east_m = -3.0f;
  int count = 1;
  scene.traced_kinds = {{"wanderer", [](const scene::Scene&) { return 3; },
                         [&](const scene::Scene&, scene::TracedScene& traced) {
                           for (int i = 0; i < count; ++i) {
                             const glm::vec3 at(east_m, 2.0f * float(i) - 2.0f, 3.0f);
                             traced.add(std::make_shared<Mesh>(scene::box(at - 0.5f, at + 0.5f)),
                                        std::make_shared<Plain>(), glm::mat4(1.0f), {.thing = i});
                           }
                         }}};
  RayScene rays(scene);
  expect_same(rays, scene, "as built");
  for (const int now : {3, 2, 1, 3}) {
    east_m += 1.0f, count = now;
    rays.update(scene);
    expect_same(rays, scene, "wandered");
  }
  EXPECT_EQ(rays.triangle_count(), RayScene(scene).triangle_count());
}

}  // namespace
}  // namespace parvis::reference

#include "reflections/reflector_maps/patch_bounds.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "reflections/reflector_maps/reflector_map.h"
#include "scene/data/test_scene.h"

namespace parvis::reflector_maps {
namespace {

Reflector reflector_of(const Mesh& mesh) {
  Result<Reflector> made = make_reflector(mesh, "test", 16);
  EXPECT_TRUE(made) << to_string(made.errors());
  return made ? *std::move(made) : Reflector();
}

// Culling must not change the picture: whatever a patch mirrors to a viewer passes.
TEST(PatchBounds, LetPassWhatThePatchMirrors) {
  Random random(3);
  int reflections = 0;
  for (const Mesh& mesh : {scene::sphere(glm::vec3(0.0f), 1.0f, 24), scene::torus(1.0f, 0.4f, 24),
                           scene::box(glm::vec3(-1.0f), glm::vec3(1.0f))}) {
    const Reflector reflector = reflector_of(mesh);
    for (const ReflectorPatch& patch : reflector.patches) {
      const PatchBounds bounds = patch_bounds(reflector.mesh, patch);
      for (int i = 0; i < 300; ++i) {
        const std::uint32_t t =
            patch.triangles[std::size_t(random.uniform() * float(patch.triangles.size() - 1))];
        const auto p = reflector.mesh.corners(t);
        const auto n = reflector.mesh.normals(t);
        const float u = random.uniform(), v = random.uniform() * (1.0f - u);
        const glm::vec3 at = p[0] + u * (p[1] - p[0]) + v * (p[2] - p[0]);
        const glm::vec3 normal = glm::normalize(n[0] + u * (n[1] - n[0]) + v * (n[2] - n[0]));
        const glm::vec3 to_viewer(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
        if (glm::dot(to_viewer, normal) <= 0.0f) continue;
        const glm::vec3 viewer = at + random.uniform(0.1f, 5.0f) * to_viewer;
        const glm::vec3 vertex = at + random.uniform(0.1f, 5.0f) * glm::reflect(-to_viewer, normal);
        ++reflections;
        ASSERT_TRUE(bounds.may_be_seen(viewer));
        ASSERT_TRUE(bounds.may_show(viewer, vertex, 0.0f));
      }
    }
  }
  EXPECT_GT(reflections, 1500);
}

TEST(PatchBounds, HoldBackWhatFacesAwayAndWhatIsMirroredElsewhere) {
  const Reflector flat = reflector_of(scene::ground(1.0f));
  const PatchBounds bounds = patch_bounds(flat.mesh, flat.patches.front());
  EXPECT_FALSE(bounds.may_be_seen({3, 0, -5}));
  const glm::vec3 viewer(10, 0, 8);
  EXPECT_TRUE(bounds.may_be_seen(viewer));
  EXPECT_TRUE(bounds.may_show(viewer, {-20, 0, 16}, 1.0f));
  EXPECT_FALSE(bounds.may_show(viewer, {20, 0, 16}, 1.0f));
  EXPECT_FALSE(bounds.may_show(viewer, {-20, 0, -16}, 1.0f)) << "it lies behind the mirror";
}

TEST(PatchBounds, LetPassEverythingNearAPatchAndARoundBody) {
  const Reflector ball = reflector_of(scene::sphere(glm::vec3(0.0f), 1.0f, 24));
  const PatchBounds bounds = patch_bounds(ball.mesh, ball.patches.front());
  EXPECT_TRUE(bounds.may_be_seen({0, 0, -5}));
  EXPECT_TRUE(bounds.may_be_seen({0, 0, 0.5f}));
  EXPECT_TRUE(bounds.may_show({0, 0, 5}, {0, 0, -5}, 0.1f));
}

}  // namespace
}  // namespace parvis::reflector_maps

#include "graphics/render/frustum.h"

#include <gtest/gtest.h>

#include "base/camera.h"
#include "base/random.h"

namespace parvis::render {
namespace {

/// Does any of many points of the box lie in the clip volume?
bool has_a_visible_point(const glm::mat4& clip_from_world, const Bounds& box) {
  for (int x = 0; x <= 6; ++x)
    for (int y = 0; y <= 6; ++y)
      for (int z = 0; z <= 6; ++z) {
        const glm::vec3 p = box.min + box.size() * glm::vec3(x, y, z) / 6.0f;
        const glm::vec4 clip = clip_from_world * glm::vec4(p, 1.0f);
        if (glm::all(glm::lessThanEqual(glm::abs(glm::vec3(clip)), glm::vec3(clip.w)))) return true;
      }
  return false;
}

TEST(Frustum, KeepsAllThatBruteForceSeesAndLittleElse) {
  Random random(7);
  Camera camera;
  camera.world_from_camera = look_at({1, 2, 3}, {10, -4, 2});
  camera.far_m = 100.0f;
  const glm::mat4 clip_from_world = camera.clip_from_camera(1.6f) * camera.camera_from_world();
  const Frustum frustum(clip_from_world);
  int seen = 0, kept = 0;
  for (int i = 0; i < 20000; ++i) {
    const glm::vec3 centre(random.uniform(-120, 120), random.uniform(-120, 120), random.uniform(-60, 60));
    const glm::vec3 half(random.uniform(0, 4), random.uniform(0, 4), random.uniform(0, 4));
    const Bounds box{centre - half, centre + half};
    const bool is_seen = has_a_visible_point(clip_from_world, box), is_kept = frustum.may_see(box);
    EXPECT_LE(is_seen, is_kept);
    seen += is_seen, kept += is_kept;
  }
  EXPECT_GT(seen, 300);
  EXPECT_LT(kept, seen + seen / 4);
}

TEST(Frustum, AnEmptyBoxIsNotSeen) {
  Camera camera;
  EXPECT_FALSE(Frustum(camera.clip_from_camera(1.0f)).may_see(Bounds{}));
}

}  // namespace
}  // namespace parvis::render

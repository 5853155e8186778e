#include "graphics/reference/scene_key.h"

#include <gtest/gtest.h>

#include "scene/data/test_scene.h"

namespace parvis::reference {
namespace {

template <scene::DataRole its_role>
struct Thing {
  static constexpr std::string_view name = its_role == scene::DataRole::static_content    ? "test.lantern"
                                           : its_role == scene::DataRole::dynamic_content ? "test.banner"
                                                                                          : "test.setting";
  static constexpr scene::DataRole role = its_role;
  int count = 0;

  void hash(ContentHash& hash) const { hash.add(count); }
};

struct Changes {
  bool key, static_key;
};

/// Which keys a room's data of that role changes.
template <scene::DataRole role>
Changes changes_by() {
  scene::Scene bare;
  scene::add(bare, scene::model_of(scene::ground(5.0f), scene::matt(glm::vec3(0.5f))));
  scene::Scene with = bare;
  with.data<Thing<role>>().count = 2;
  return {scene_key(with) != scene_key(bare), fixed_scene_key(with) != fixed_scene_key(bare)};
}

TEST(SceneKey, DependsOnWhatRoomsLetBeSeen) {
  const Changes at_rest = changes_by<scene::DataRole::static_content>();
  EXPECT_TRUE(at_rest.key && at_rest.static_key);
  const Changes moving = changes_by<scene::DataRole::dynamic_content>();
  EXPECT_TRUE(moving.key && !moving.static_key);
  const Changes setting = changes_by<scene::DataRole::settings>();
  EXPECT_FALSE(setting.key || setting.static_key);
}

TEST(SceneKey, OfShapesDoesNotKnowTheLight) {
  scene::Scene noon;
  scene::add(noon, scene::model_of(scene::ground(5.0f), scene::matt(glm::vec3(0.5f))));
  scene::Scene evening = noon;
  evening.sun.irradiance *= 0.1f, evening.sky.intensity *= 0.2f;
  EXPECT_EQ(fixed_shape_key(evening), fixed_shape_key(noon));
  EXPECT_NE(fixed_scene_key(evening), fixed_scene_key(noon));
  evening.objects.front().world_from_model[3].x = 1.0f;
  EXPECT_NE(fixed_shape_key(evening), fixed_shape_key(noon));
}

}  // namespace
}  // namespace parvis::reference

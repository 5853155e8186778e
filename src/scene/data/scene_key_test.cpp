#include "scene/data/scene_key.h"

#include <gtest/gtest.h>

#include "scene/data/test_scene.h"

namespace parvis::scene {
namespace {

template <DataRole its_role>
struct Thing {
  static constexpr std::string_view name = its_role == DataRole::static_content    ? "test.lantern"
                                           : its_role == DataRole::dynamic_content ? "test.banner"
                                                                                   : "test.setting";
  static constexpr DataRole role = its_role;
  int count = 0;

  void hash(ContentHash& hash) const { hash.add(count); }
};

struct Changes {
  bool key, static_key;
};

/// Which keys a room's data of that role changes.
template <DataRole role>
Changes changes_by() {
  Scene bare;
  add(bare, model_of(ground(5.0f), matt(glm::vec3(0.5f))));
  Scene with = bare;
  with.data<Thing<role>>().count = 2;
  return {scene_key(with) != scene_key(bare), fixed_scene_key(with) != fixed_scene_key(bare)};
}

TEST(SceneKey, DependsOnWhatRoomsLetBeSeen) {
  const Changes at_rest = changes_by<DataRole::static_content>();
  EXPECT_TRUE(at_rest.key && at_rest.static_key);
  const Changes moving = changes_by<DataRole::dynamic_content>();
  EXPECT_TRUE(moving.key && !moving.static_key);
  const Changes setting = changes_by<DataRole::settings>();
  EXPECT_FALSE(setting.key || setting.static_key);
}

TEST(SceneKey, KnowsThePaintOfAnObject) {
  Scene plain;
  add(plain, model_of(ground(5.0f), matt(glm::vec3(0.5f))));
  Scene painted = plain, same = plain;
  painted.objects[0].paint = std::make_shared<const std::vector<Material>>(1, matt({0.5f, 0.1f, 0.1f}));
  same.objects[0].paint = std::make_shared<const std::vector<Material>>(*painted.objects[0].paint);
  EXPECT_NE(scene_key(painted), scene_key(plain));
  EXPECT_EQ(scene_key(painted), scene_key(same)) << "equal paints, wherever they lie in memory";
}

TEST(SceneKey, KnowsWhatIsABackdrop) {
  const auto key_of = [](bool casts_shadow, bool is_backdrop) {
    const std::shared_ptr<Model> model = model_of(ground(5.0f), matt(glm::vec3(0.5f)));
    model->parts[0].casts_shadow = casts_shadow, model->parts[0].is_backdrop = is_backdrop;
    Scene scene;
    add(scene, model);
    return scene_key(scene);
  };
  EXPECT_NE(key_of(false, true), key_of(false, false));
  EXPECT_NE(key_of(true, false), key_of(false, false));
}

TEST(SceneKey, OfShapesDoesNotKnowTheLight) {
  Scene noon;
  add(noon, model_of(ground(5.0f), matt(glm::vec3(0.5f))));
  Scene evening = noon;
  evening.sun.irradiance *= 0.1f, evening.sky.intensity *= 0.2f;
  EXPECT_EQ(fixed_shape_key(evening), fixed_shape_key(noon));
  EXPECT_NE(fixed_scene_key(evening), fixed_scene_key(noon));
  evening.objects.front().world_from_model[3].x = 1.0f;
  EXPECT_NE(fixed_shape_key(evening), fixed_shape_key(noon));
}

}  // namespace
}  // namespace parvis::scene

// Objects that come while a scene runs are drawn as if they had been there from the beginning.
#include <gtest/gtest.h>

#include "graphics/gl/test_context.h"
#include "graphics/light/sun_and_sky.h"
#include "graphics/render/test_renderer.h"
#include "scene/data/deformation.h"
#include "scene/data/leaf_openness.h"
#include "scene/data/test_crown.h"
#include "scene/data/test_scene.h"

namespace parvis::render {
namespace {

using scene::add, scene::box, scene::ground, scene::matt, scene::model_of, scene::quad, scene::sphere;

class NewObjectsTest : public gl::ContextTest {
 protected:
  static ImageF drawn(Renderer& renderer, const scene::Scene& scene) {
    Camera camera;
    camera.world_from_camera = look_at({3, -14, 4}, {0, 0, 1});
    renderer.begin_frame(scene, camera);
    renderer.prepare_main_view(camera, 320, 200);
    renderer.draw_main_view();
    return renderer.read_radiance();
  }
  /// The largest difference of a channel, and how many pixels differ by more than `much`.
  static std::pair<float, int> difference(const ImageF& a, const ImageF& b, float much) {
    float largest = 0.0f;
    int count = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
      const float d = std::abs(a.pixels[i] - b.pixels[i]);
      largest = std::max(largest, d);
      count += d > much;
    }
    return {largest, count};
  }
  static void expect_as_fresh(Renderer& renderer, const scene::Scene& scene, const char* what) {
    const ImageF ours = drawn(renderer, scene), fresh = drawn(*renderer_of(scene, light::sun_and_sky), scene);
    // The grid in which the sky's visibility is kept begins elsewhere where the place has other bounds.
    const auto [largest, count] = difference(ours, fresh, 0.02f);
    EXPECT_LT(count, 40) << what << ", at most " << largest;
  }

  static scene::Scene place() {
    scene::Scene scene;
    scene.sun.direction_to_sun = glm::normalize(glm::vec3(0.5f, -0.4f, 0.8f));
    add(scene, model_of(ground(20), matt(glm::vec3(0.4f))));
    add(scene, model_of(box({-8, 4, 0}, {8, 6, 7}), matt({0.6f, 0.4f, 0.3f})));
    add(scene, model_of(box({-1, -1, 0}, {1, 1, 1}), matt({0.2f, 0.3f, 0.6f})), true,
        glm::translate(glm::mat4(1.0f), glm::vec3(5, -3, 0)));
    return scene;
  }
  /// A material with features that none of the place has.
  static scene::Material checked() {
    scene::Material material = matt({0.8f, 0.8f, 0.8f});
    material.clear_coat = 0.5f, material.is_double_sided = true;
    return material;
  }
};

TEST_F(NewObjectsTest, AreDrawnWithTheirShadowsAndTheirShade) {
  scene::Scene scene = place();
  const auto renderer = renderer_of(scene, light::sun_and_sky);
  const ImageF before = drawn(*renderer, scene);
  const auto bench = model_of(box({-1, -0.3f, 0}, {1, 0.3f, 0.9f}), matt({0.7f, 0.2f, 0.1f}));
  add(scene, bench, false, glm::translate(glm::mat4(1.0f), glm::vec3(-2, -4, 0)));
  EXPECT_GT(difference(drawn(*renderer, scene), before, 0.05f).second, 300);
  expect_as_fresh(*renderer, scene, "one");
  add(scene, bench, false, glm::translate(glm::mat4(1.0f), glm::vec3(1, -5, 0)));
  add(scene, model_of(sphere({0, 0, 1}, 1.0f), checked()), false);
  expect_as_fresh(*renderer, scene, "a second of a model, and another material");
  add(scene, model_of(box({-0.5f, -0.5f, 0}, {0.5f, 0.5f, 2}), matt({0.1f, 0.5f, 0.2f})), true,
      glm::translate(glm::mat4(1.0f), glm::vec3(-5, -2, 0)));
  expect_as_fresh(*renderer, scene, "one that moves");
}

TEST_F(NewObjectsTest, AreHiddenAndMovedLikeOthers) {
  scene::Scene scene = place();
  const auto renderer = renderer_of(scene, light::sun_and_sky);
  const ImageF before = drawn(*renderer, scene);
  const int bench = add(scene, model_of(box({-1, -0.3f, 0}, {1, 0.3f, 0.9f}), matt({0.7f, 0.2f, 0.1f})));
  drawn(*renderer, scene);
  scene.objects[std::size_t(bench)].world_from_model[3] = {-3, -5, 0, 1};
  expect_as_fresh(*renderer, scene, "moved");
  scene.objects[std::size_t(bench)].is_visible = false;
  EXPECT_EQ(difference(drawn(*renderer, scene), before, 1e-3f).second, 0) << "as if it had never been there";
  scene.objects[std::size_t(bench)].is_visible = true;
  scene.objects[std::size_t(bench)].world_from_model[3] = {2, -3, 0, 1};
  expect_as_fresh(*renderer, scene, "another in its place");
}

TEST_F(NewObjectsTest, MayBeLeavesAndCarryPaint) {
  scene::Scene scene = place();
  const auto renderer = renderer_of(scene, light::sun_and_sky);
  const int crown = add(scene, model_of(scene::crown(2000), scene::leaf_material({0.2f, 0.5f, 0.1f}, 0.4f)));
  scene.objects[std::size_t(crown)].world_from_model[3] = {-3, -2, 2, 1};
  find_leaf_openness(scene);
  expect_as_fresh(*renderer, scene, "leaves");
  add(scene, scene.objects[2].model, true, glm::translate(glm::mat4(1.0f), glm::vec3(2, -6, 0)));
  scene.objects.back().paint =
      std::make_shared<const std::vector<scene::Material>>(1, matt({0.9f, 0.8f, 0.1f}));
  expect_as_fresh(*renderer, scene, "paint");
}

TEST_F(NewObjectsTest, DeformBesideOthersThatDeform) {
  scene::Scene scene = place();
  const auto deforming = [] {
    auto model = model_of(box({-1, -1, 0}, {1, 1, 2}), matt({0.5f, 0.1f, 0.5f}));
    model->parts[0].deformation = std::make_shared<const scene::Deformation>();
    return model;
  };
  const auto place_one = [&](float x, float stretch) {
    const int object = add(scene, deforming(), true, glm::translate(glm::mat4(1.0f), glm::vec3(x, -3, 0)));
    scene::Object& made = scene.objects[std::size_t(object)];
    made.deformed_meshes = {made.model->parts[0].mesh};
    for (glm::vec3& position : made.deformed_meshes[0].positions) position.z *= stretch;
    return object;
  };
  const int first = place_one(-5, 1.5f);
  const auto renderer = renderer_of(scene, light::sun_and_sky);
  drawn(*renderer, scene);
  place_one(0, 0.5f);
  expect_as_fresh(*renderer, scene, "a second one");
  for (glm::vec3& position : scene.objects[std::size_t(first)].deformed_meshes[0].positions)
    position.z *= 0.4f;
  for (glm::vec3& position : scene.objects.back().deformed_meshes[0].positions) position.z *= 2.0f;
  expect_as_fresh(*renderer, scene, "both deform");
}

}  // namespace
}  // namespace parvis::render

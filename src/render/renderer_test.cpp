#include "render/renderer.h"

#include <gtest/gtest.h>

namespace parvis::render {
namespace {

Mesh quad(glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d) {
  Mesh mesh;
  mesh.positions = {a, b, c, d};
  mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  mesh.indices = {0, 1, 2, 0, 2, 3};
  mesh.normals.assign(4, glm::normalize(glm::cross(b - a, c - a)));
  return mesh;
}

TEST(Renderer, Draws) {
  Result<gl::Context> context = gl::Context::create_headless();
  ASSERT_TRUE(context) << to_string(context.errors());
  auto model = std::make_shared<scene::Model>();
  model->materials.push_back({});
  model->parts.push_back(
      {"ground", quad({-20, -20, 0}, {20, -20, 0}, {20, 20, 0}, {-20, 20, 0}), 0, 0, true});
  model->parts.push_back({"wall", quad({-2, 0, 0}, {2, 0, 0}, {2, 0, 3}, {-2, 0, 3}), 0, 0, true});
  scene::Scene scene;
  scene.objects.push_back({"place", model, glm::mat4(1.0f), {}, false, false});
  auto renderer = Renderer::create(scene);
  ASSERT_TRUE(renderer) << to_string(renderer.errors());
  Camera camera;
  camera.world_from_camera = look_at({4, -8, 3}, {0, 0, 1});
  (*renderer)->begin_frame(scene, camera);
  (*renderer)->prepare_main_view(camera, 640, 360);
  (*renderer)->draw_main_view();
  EXPECT_EQ((*renderer)->read_picture(1.0f).width, 640);
}

}  // namespace
}  // namespace parvis::render

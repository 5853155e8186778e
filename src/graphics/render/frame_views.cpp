#include "graphics/render/frame_views.h"

#include <cassert>

namespace parvis::render {

Camera middle_of(std::span<const EyeView> eyes) {
  Camera middle = eyes.front().camera;
  if (eyes.size() == 1) return middle;
  glm::vec3 position(0.0f), forward(0.0f);
  for (const EyeView& eye : eyes) {
    position += eye.camera.position_in_world() / float(eyes.size());
    forward += eye.camera.forward_in_world();
  }
  if (glm::length(forward) < 1e-3f) forward = middle.forward_in_world();  // walls all around
  const glm::vec3 up(middle.world_from_camera[1]);
  const bool is_upright = glm::length(glm::cross(up, forward)) > 1e-3f;
  middle.world_from_camera =
      look_at(position, position + forward, is_upright ? up : glm::vec3(middle.world_from_camera[0]));
  return middle;
}

Status draw_frame(Renderer& renderer, const scene::Scene& scene, std::span<const EyeView> eyes,
                  const FrameSteps& steps) {
  assert(!eyes.empty());
  const auto end_pass = [&](const char* pass) {
    if (steps.end_pass) steps.end_pass(pass);
  };
  if (Status status = renderer.reserve_eyes(eyes.size()); !status) return status;
  renderer.begin_frame(scene, middle_of(eyes));
  end_pass("shadows");
  for (std::size_t i = 0; i < eyes.size(); ++i) {
    renderer.select_eye(i);
    renderer.prepare_main_view(eyes[i].camera, eyes[i].width, eyes[i].height, steps.subjects,
                               steps.shown_objects);
    if (steps.reflect) steps.reflect(eyes[i].camera);
    end_pass("reflections");
    renderer.draw_main_view();
    end_pass("picture");
  }
  renderer.select_eye(0);
  return Ok{};
}

}  // namespace parvis::render

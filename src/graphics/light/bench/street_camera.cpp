#include "graphics/light/bench/street_camera.h"

#include <algorithm>
#include <cmath>

namespace parvis::bench {

Camera street_camera(const scene::Scene& city, int number, Random& random) {
  Camera camera = city.cameras[std::size_t(number) % std::min<std::size_t>(city.cameras.size(), 5)].camera;
  const float turn = random.uniform(0.0f, 6.2831853f);
  const float east = random.uniform(-2.0f, 2.0f);
  const float north = random.uniform(-2.0f, 2.0f);
  const glm::vec3 eye = camera.position_in_world() + glm::vec3(east, north, 0.0f);
  camera.world_from_camera = look_at(eye, eye + glm::vec3(std::cos(turn), std::sin(turn), -0.05f));
  return camera;
}

}  // namespace parvis::bench

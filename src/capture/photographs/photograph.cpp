#include "capture/photographs/photograph.h"

#include <algorithm>
#include <optional>

namespace parvis::photographs {
namespace {

/// x right, y up, looking along -z, to x right, y downward, looking along +z; its own inverse.
glm::dmat4 half_turn_about_x() {
  glm::dmat4 turn(1.0);
  turn[1][1] = turn[2][2] = -1.0;
  return turn;
}

/// The inverse of a rigid transform.
glm::dmat4 rigid_inverse(const glm::dmat4& m) {
  const glm::dmat3 rotation = glm::transpose(glm::dmat3(m));
  glm::dmat4 inverse(rotation);
  inverse[3] = glm::dvec4(-(rotation * glm::dvec3(m[3])), 1.0);
  return inverse;
}

glm::dvec3 position_in_camera(const Photograph& photograph, glm::dvec3 position_in_world) {
  return glm::transpose(glm::dmat3(photograph.world_from_camera)) *
         (position_in_world - photograph.position_in_world());
}

}  // namespace

const Photograph* find(const PhotographSet& set, const std::string& name) {
  const auto found = std::ranges::find(set.photographs, name, &Photograph::name);
  return found == set.photographs.end() ? nullptr : &*found;
}

std::optional<glm::dvec2> pixel_of_world(const Photograph& photograph, glm::dvec3 position_in_world) {
  return pixel_of(photograph.lens, position_in_camera(photograph, position_in_world));
}

std::optional<glm::dvec3> direction_in_world(const Photograph& photograph, glm::dvec2 pixel) {
  const std::optional<glm::dvec3> direction = direction_of(photograph.lens, pixel);
  if (!direction) return std::nullopt;
  return glm::dmat3(photograph.world_from_camera) * *direction;
}

double distance_along_axis(const Photograph& photograph, glm::dvec3 position_in_world) {
  return glm::dot(photograph.forward_in_world(), position_in_world - photograph.position_in_world());
}

Camera camera_of(const Photograph& photograph) {
  Camera camera;
  camera.world_from_camera = glm::mat4(photograph.world_from_camera);
  camera.vertical_fov = float(vertical_fov(photograph.lens));
  return camera;
}

Photograph photograph_of(const Camera& camera, std::string name, int width, int height) {
  Photograph photograph;
  photograph.name = std::move(name);
  photograph.lens = centred_lens(width, height, double(camera.vertical_fov));
  photograph.world_from_camera = glm::dmat4(camera.world_from_camera);
  return photograph;
}

glm::dmat4 opencv_from_world(const Photograph& photograph) {
  return half_turn_about_x() * rigid_inverse(photograph.world_from_camera);
}

glm::dmat4 world_from_camera_of_opencv(const glm::dmat4& opencv_from_world) {
  return rigid_inverse(opencv_from_world) * half_turn_about_x();
}

}  // namespace parvis::photographs

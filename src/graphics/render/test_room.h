// A room with six differently coloured walls that shine by themselves, and mirrors in it: what a mirror must
// show is then a matter of geometry.
#pragma once

#include <array>

#include "scene/data/test_scene.h"

namespace parvis::render {

/// Radiance of the walls at +x, -x, +y, -y, +z, -z.
inline constexpr std::array<glm::vec3, 6> wall_colours{
    {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {0, 1, 1}, {1, 0, 1}}};

/// A cube of half size `half_m` about the origin, seen from within.
inline std::shared_ptr<scene::Model> room_model(float half_m) {
  auto room = std::make_shared<scene::Model>();
  for (int wall = 0; wall < 6; ++wall) {
    glm::vec3 out(0.0f), u(0.0f);
    out[wall / 2] = wall % 2 == 0 ? half_m : -half_m;
    u[(wall / 2 + 1) % 3] = half_m;
    const glm::vec3 v = glm::cross(u, out / half_m);
    scene::Material lamp = scene::matt(glm::vec3(0.0f));
    lamp.metallic = 1.0f;  // black metal: nothing but its own light
    lamp.emission = wall_colours[std::size_t(wall)];
    room->materials.push_back(lamp);
    room->parts.push_back(
        {"wall", scene::quad(out - u - v, out + u - v, out + u + v, out - u + v), wall, 0, false});
  }
  return room;
}

/// The wall of the room that a ray from within meets, and how clearly (metres to the next wall's hit).
struct WallHit {
  int wall;
  float lead_m;
};

inline WallHit wall_met(float half_m, glm::vec3 from, glm::vec3 direction) {
  WallHit hit{-1, 0.0f};
  float nearest = 1e30f, second = 1e30f;
  for (int axis = 0; axis < 3; ++axis) {
    if (direction[axis] == 0.0f) continue;
    const float side = direction[axis] > 0.0f ? half_m : -half_m;
    const float distance = (side - from[axis]) / direction[axis];
    second = std::min(second, std::max(distance, nearest));
    if (distance < nearest) nearest = distance, hit.wall = 2 * axis + (direction[axis] > 0.0f ? 0 : 1);
  }
  hit.lead_m = (second - nearest) * glm::length(direction);
  return hit;
}

/// A mirror box of half size `half_m` about its own origin.
inline std::shared_ptr<scene::Model> mirror_box(float half_m) {
  scene::Material chrome;
  chrome.base_colour = glm::vec3(1.0f);
  chrome.metallic = 1.0f;
  chrome.roughness = 0.0f;
  chrome.is_mirror_like = true;
  return scene::model_of(scene::box(glm::vec3(-half_m), glm::vec3(half_m)), chrome);
}

/// Adds a mirror that moves; returns its index.
inline int add_mirror(scene::Scene& scene, glm::vec3 position, float half_m = 0.5f) {
  const int object = scene::add(scene, mirror_box(half_m), true, glm::translate(glm::mat4(1.0f), position));
  scene.objects[std::size_t(object)].takes_reflection = true;
  return object;
}

/// The room alone, without any other light.
inline scene::Scene room_scene(float half_m) {
  scene::Scene scene;
  scene.sun.irradiance = glm::vec3(0.0f);
  scene::add(scene, room_model(half_m));
  return scene;
}

}  // namespace parvis::render

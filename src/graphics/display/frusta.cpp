#include "graphics/display/frusta.h"

#include <algorithm>
#include <limits>

namespace parvis::display {
namespace {

constexpr double min_distance_m = 0.01;
/// The widest angle of a curved wall from the axis, 80 degrees: beyond it a picture has no use.
constexpr double widest_tangent = 5.7;

/// The orthonormal axes of a wall's picture: right, up, and towards the eye.
glm::dmat3 axes_of(const Wall& wall, glm::dvec3 eye) {
  if (!wall.is_curved) {
    const glm::dvec3 right = glm::normalize(wall.lower_right - wall.lower_left);
    const glm::dvec3 towards = glm::normalize(glm::cross(right, wall.upper_left - wall.lower_left));
    return {right, glm::cross(towards, right), towards};
  }
  glm::dvec3 middle(0.0);
  for (const SurfaceVertex& vertex : wall.surface)
    middle += glm::dvec3(vertex.point) / double(wall.surface.size());
  const glm::dvec3 towards = glm::normalize(eye - middle);
  const glm::dvec3 above = std::abs(towards.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
  const glm::dvec3 right = glm::normalize(glm::cross(above, towards));
  return {right, glm::cross(towards, right), towards};
}

/// Edges of the picture of a wall as tangents: left, right, bottom, top.
glm::dvec4 edges_of(const Wall& wall, glm::dvec3 eye, const glm::dmat3& axes) {
  const auto tangents = [&](glm::dvec3 point) {
    const glm::dvec3 seen = glm::transpose(axes) * (point - eye);
    return -seen.z > 1e-9 ? glm::dvec2(seen) / -seen.z : glm::dvec2(std::numeric_limits<double>::infinity());
  };
  if (!wall.is_curved) {
    const glm::dvec2 from = tangents(wall.lower_left), right = tangents(wall.lower_right),
                     up = tangents(wall.upper_left);
    return {from.x, right.x, from.y, up.y};
  }
  glm::dvec4 edges(1e9, -1e9, 1e9, -1e9);
  for (const SurfaceVertex& vertex : wall.surface) {
    const glm::dvec2 at = tangents(vertex.point);
    edges = {std::min(edges[0], at.x), std::max(edges[1], at.x), std::min(edges[2], at.y),
             std::max(edges[3], at.y)};
  }
  return edges;
}

/// The pixels of one eye's picture.
glm::ivec2 picture_size(const Wall& wall, Stereo stereo, bool is_pair) {
  glm::ivec2 size = wall.pixels;
  if (is_pair && stereo == Stereo::side_by_side) size.x = (size.x + 1) / 2;
  if (is_pair && stereo == Stereo::top_bottom) size.y = (size.y + 1) / 2;
  // The plane picture of a curved wall has fewer pixels to the degree in its middle than the wall has.
  constexpr float finer = 1.3f;
  return wall.is_curved ? glm::ivec2(glm::round(finer * glm::vec2(size))) : size;
}

}  // namespace

bool is_before(const Wall& wall, glm::dvec3 eye) {
  const glm::dmat3 axes = axes_of(wall, eye);
  if (!wall.is_curved) return glm::dot(axes[2], eye - wall.lower_left) >= min_distance_m;
  const glm::dvec4 edges = edges_of(wall, eye, axes);
  return std::max({-edges[0], edges[1], -edges[2], edges[3]}) < widest_tangent;
}

glm::dmat4 world_from_room(const Display& display, const Camera& view) {
  const glm::dmat4 pose(view.world_from_camera);
  glm::dvec3 right = glm::normalize(glm::dvec3(pose[0])), up(0.0, 0.0, 1.0);
  if (!display.is_upright)
    up = glm::normalize(glm::dvec3(pose[1]));
  else  // the camera's own right is level unless it is rolled
    right = glm::length(glm::dvec2(right)) > 1e-6 ? glm::normalize(glm::dvec3(glm::dvec2(right), 0.0))
                                                  : glm::dvec3(1.0, 0.0, 0.0);
  const glm::dvec3 ahead = glm::cross(up, right);
  glm::dmat4 result(glm::dvec4(display.scale * right, 0.0), glm::dvec4(display.scale * ahead, 0.0),
                    glm::dvec4(display.scale * up, 0.0), glm::dvec4(0.0, 0.0, 0.0, 1.0));
  result[3] = glm::dvec4(glm::dvec3(pose[3]) - glm::dvec3(result * glm::dvec4(display.eye, 0.0)), 1.0);
  return result;
}

Camera wall_camera(const Wall& wall, glm::dvec3 eye, const glm::dmat4& world_from_room, const Camera& view) {
  if (!wall.is_curved) {
    const glm::dvec3 towards = axes_of(wall, eye)[2];
    const double distance_m = glm::dot(towards, eye - wall.lower_left);
    eye += std::max(min_distance_m - distance_m, 0.0) * towards;
  }
  const glm::dmat3 axes = axes_of(wall, eye);
  glm::dvec4 edges = edges_of(wall, eye, axes);
  if (wall.is_curved) edges = glm::clamp(edges, -widest_tangent, widest_tangent);
  Camera camera;
  camera.near_m = view.near_m, camera.far_m = view.far_m;
  camera.off_axis = FrustumTangents{float(edges[0]), float(edges[1]), float(edges[2]), float(edges[3])};
  for (int axis = 0; axis < 3; ++axis)
    camera.world_from_camera[axis] =
        glm::vec4(glm::vec3(glm::normalize(glm::dvec3(world_from_room * glm::dvec4(axes[axis], 0.0)))), 0.0f);
  camera.world_from_camera[3] = glm::vec4(glm::vec3(world_from_room * glm::dvec4(eye, 1.0)), 1.0f);
  return camera;
}

std::vector<WallPicture> pictures_of(const Display& display, const Head& head, const Camera& view,
                                     std::span<const std::size_t> only) {
  const glm::dmat4 from_room = world_from_room(display, view);
  std::vector<WallPicture> pictures;
  for (std::size_t i = 0; i < display.walls.size(); ++i) {
    if (!only.empty() && std::ranges::find(only, i) == only.end()) continue;
    const Wall& wall = display.walls[i];
    const bool is_pair = display.stereo != Stereo::none && wall.eye == Eye::both;
    for (const Eye eye : is_pair ? std::vector{Eye::left, Eye::right} : std::vector{wall.eye}) {
      const double aside = eye == Eye::both ? 0.0 : eye == Eye::left ? -0.5 : 0.5;
      const glm::dvec3 at = head.position + aside * display.eye_separation_m * head.right;
      WallPicture picture{
          i, eye, wall_camera(wall, at, from_room, view), picture_size(wall, display.stereo, is_pair), {}};
      const float aspect = float(picture.size.x) / float(picture.size.y);
      // In double precision: the scene may be far from its origin, the room is not.
      picture.clip_from_room =
          glm::mat4(glm::dmat4(picture.camera.clip_from_camera(aspect)) *
                    glm::inverse(glm::dmat4(picture.camera.world_from_camera)) * from_room);
      pictures.push_back(std::move(picture));
    }
  }
  return pictures;
}

}  // namespace parvis::display

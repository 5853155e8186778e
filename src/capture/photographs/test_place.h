// For tests: a street corner of two walls and a ground, with paint that features can be found in, and
// photographs of it.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>
#include <string>

#include "base/image.h"
#include "capture/photographs/photograph.h"

namespace parvis::photographs {

/// Blotches of several sizes, each with a colour of its own: a hash of place and size.
inline glm::vec3 test_paint(glm::dvec2 at, int seed) {
  glm::vec3 colour(0.0f);
  float weight = 0.5f;
  for (const double size_m : {1.3, 0.5, 0.21, 0.09}) {
    const auto hashed = [&](double x, double y, int channel) {
      std::uint64_t h =
          std::uint64_t(std::int64_t(x) * 73856093) ^ std::uint64_t(std::int64_t(y) * 19349663) ^
          std::uint64_t(std::int32_t(std::uint32_t(seed) * 83492791u + std::uint32_t(channel) * 2654435u +
                                     std::uint32_t(size_m * 1000) * 97u));
      h ^= h >> 33, h *= 0xff51afd7ed558ccdull, h ^= h >> 33, h *= 0xc4ceb9fe1a85ec53ull, h ^= h >> 33;
      return float(h & 0xffff) / 65535.0f;
    };
    const glm::dvec2 cell = at / size_m, corner = glm::floor(cell);
    const glm::vec2 f(cell - corner);
    for (int c = 0; c < 3; ++c)
      colour[c] +=
          weight *
          glm::mix(glm::mix(hashed(corner.x, corner.y, c), hashed(corner.x + 1, corner.y, c), f.x),
                   glm::mix(hashed(corner.x, corner.y + 1, c), hashed(corner.x + 1, corner.y + 1, c), f.x),
                   f.y);
    weight *= 0.8f;
  }
  return glm::clamp(colour * 0.75f - 0.2f, 0.0f, 1.0f);
}

/// The first surface along a ray: a wall in the plane y = 0, one in x = 0, 6 m high, and the ground z = 0.
/// Distance and colour (sRGB, 0..1).
inline glm::vec3 test_place_along(glm::dvec3 origin, glm::dvec3 direction, int seed) {
  double nearest = std::numeric_limits<double>::infinity();
  glm::vec3 colour(0.6f, 0.7f, 0.9f);
  const int others[3][2] = {{1, 2}, {0, 2}, {0, 1}};
  for (int axis = 0; axis < 3; ++axis) {
    const double t = -origin[axis] / direction[axis];
    const glm::dvec3 p = origin + t * direction;
    if (!(t > 1e-6) || t >= nearest || (axis < 2 && (p.z > 6.0 || p.z < 0.0))) continue;
    nearest = t;
    colour = test_paint({p[others[axis][0]], p[others[axis][1]]}, seed + axis);
  }
  return colour;
}

/// The photograph's picture of the place with this seed: another seed is another place.
inline Image8 test_picture(const Photograph& photograph, int seed) {
  Image8 image(photograph.lens.width, photograph.lens.height, 3);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const auto direction = direction_in_world(photograph, {x + 0.5, y + 0.5});
      if (!direction) continue;
      const glm::vec3 colour = test_place_along(photograph.position_in_world(), *direction, seed);
      for (int c = 0; c < 3; ++c) image.at(x, y)[c] = std::uint8_t(255.0f * colour[c] + 0.5f);
    }
  return image;
}

/// Photographs along a curve in front of the corner, hand-held: pitched, hardly rolled.
inline PhotographSet test_photographs(int count, int width, int height) {
  PhotographSet set;
  for (int i = 0; i < count; ++i) {
    const double turn = 0.35 + 0.9 * i / std::max(count - 1, 1);
    Camera camera;
    camera.world_from_camera =
        look_at({float(9.0 * std::cos(turn)), float(9.0 * std::sin(turn)), 1.6f + 0.1f * float(i % 2)},
                {0.5f, 0.5f, 2.0f + 0.5f * float(i % 3)});
    camera.vertical_fov = 0.8f;
    set.photographs.push_back(photograph_of(camera, "place_" + std::to_string(i) + ".png", width, height));
  }
  return set;
}

}  // namespace parvis::photographs

#include "places/kitchen/kitchen_light.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "base/colour.h"
#include "synthesis/sky_picture.h"

namespace parvis::kitchen {
namespace {

constexpr int view_px = 512;
const glm::vec3 room_middle(0.0f, -1.1f, 1.35f);  // that the room's light is seen from
const glm::vec3 daylight(2.5f, 2.75f, 3.0f);

struct Wall {
  glm::vec3 at;
  int axis;  ///< across which it stands
};

/// Where a ray from the middle meets the room's walls, floor or ceiling.
Wall met_wall(glm::vec3 direction) {
  const glm::vec3 low(-room_east_m, room_south_m, 0.0f), high(room_east_m, 0.0f, room_height_m);
  float nearest = 1e9f;
  int axis = 0;
  for (int i = 0; i < 3; ++i) {
    if (std::abs(direction[i]) < 1e-6f) continue;
    const float distance = ((direction[i] > 0.0f ? high[i] : low[i]) - room_middle[i]) / direction[i];
    if (distance < nearest) nearest = distance, axis = i;
  }
  return {room_middle + nearest * direction, axis};
}

float softly_within(float at, float low, float high) {
  return glm::smoothstep(low - 0.04f, low + 0.04f, at) * glm::smoothstep(high + 0.04f, high - 0.04f, at);
}

glm::vec3 radiance_from(glm::vec3 direction) {
  const Wall wall = met_wall(direction);
  const glm::vec3 p = wall.at, window(-room_east_m, 0.5f * (window_south_m + window_north_m), 1.6f);
  // Bounced light falls off from the window, and from the patch of sun below it.
  const float away = glm::distance(p, window);
  const glm::vec3 bounced = glm::vec3(1.0f, 0.95f, 0.88f) * (0.42f + 0.5f / (0.6f + 0.5f * away * away));
  if (wall.axis == 2)
    return (p.z > 1.0f ? glm::vec3(0.86f, 0.85f, 0.83f) : glm::vec3(0.38f, 0.31f, 0.23f)) * bounced;
  const bool is_west = wall.axis == 0 && p.x < 0.0f;
  const float below =
      glm::mix(0.55f, 1.0f, glm::smoothstep(0.6f, 1.2f, p.z));  // cupboards, and what stands about
  const glm::vec3 plain = glm::vec3(0.8f, 0.76f, 0.68f) * below * bounced;
  if (!is_west) return plain;
  const float open =
      softly_within(p.y, window_south_m, window_north_m) * softly_within(p.z, window_foot_m, window_top_m);
  return glm::mix(plain, daylight, open);
}

}  // namespace

ImageF room_light_picture(int width_px) {
  ImageF picture(width_px, width_px / 2, 3);
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < width_px; ++x) {
      const float polar = (float(y) + 0.5f) / float(picture.height) * glm::pi<float>();
      const float azimuth = ((float(x) + 0.5f) / float(width_px) - 0.5f) * 2.0f * glm::pi<float>();
      const glm::vec3 direction(std::sin(polar) * std::sin(azimuth), std::sin(polar) * std::cos(azimuth),
                                std::cos(polar));
      const glm::vec3 radiance = radiance_from(direction);
      for (int c = 0; c < 3; ++c) picture.at(x, y)[c] = radiance[c];
    }
  return picture;
}

Image8 window_view_picture(std::uint64_t seed) {
  // From the hillside: 60 degrees of the sky picture to either side of the west.
  const ImageF sky = synthesis::sky_picture(3 * view_px, glm::vec3(-0.88f, -0.14f, 0.45f), seed);
  ImageF view(view_px, view_px, 3);
  for (int y = 0; y < view_px; ++y)
    for (int x = 0; x < view_px; ++x) {
      const int column = sky.width / 4 - view_px / 2 + x, row = sky.height / 2 - (2 * view_px) / 3 + y;
      for (int c = 0; c < 3; ++c)
        view.at(x, y)[c] =
            std::min(sky.at(column, std::clamp(row, 0, sky.height - 1))[c] / window_view_radiance, 1.0f);
    }
  Image8 encoded = srgb8_from_linear(view), picture(view_px, view_px, 4, 255);
  for (int y = 0; y < view_px; ++y)
    for (int x = 0; x < view_px; ++x) std::copy_n(encoded.at(x, y), 3, picture.at(x, y));
  return picture;
}

}  // namespace parvis::kitchen

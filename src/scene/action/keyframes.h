// Motion between keyframes: where a thing or a camera is at which time.
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace parvis::action {

struct Keyframe {
  double time_s = 0.0;
  glm::vec3 position{0.0f};
  float heading = 0.0f, pitch = 0.0f;  ///< radians; heading clockwise from above
  float field_of_view = 0.0f;          ///< radians; of cameras
};

/// The motion through `keys` (at least one, times ascending) at a time, which is held at the ends. Passes
/// exactly through every key; positions between run on a cubic Hermite spline with the tangents of Catmull
/// and Rom for unequal times, or straight; angles turn the shorter way, evenly.
Keyframe between(const std::vector<Keyframe>& keys, double time_s, bool is_smooth);

/// Direction of travel, of unit length; zero where it stands still for good.
glm::vec3 direction_at(const std::vector<Keyframe>& keys, double time_s, bool is_smooth);

}  // namespace parvis::action

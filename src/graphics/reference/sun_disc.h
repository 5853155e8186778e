// The sun as a disc of its true angular size.
#pragma once

#include <cmath>
#include <glm/glm.hpp>

#include "graphics/reference/frame.h"
#include "graphics/shading/sun.h"
#include "scene/data/scene.h"

namespace parvis::reference {

class SunDisc {
 public:
  explicit SunDisc(const scene::Sun& sun)
      : frame_(glm::normalize(sun.direction_to_sun)),
        radiance_(sun.irradiance / shading::sun_solid_angle_sr),
        shines_(sun.irradiance != glm::vec3(0.0f)) {}

  bool shines() const { return shines_; }
  /// Even over the disc, so that a plane which faces it has the scene's irradiance.
  glm::vec3 radiance() const { return radiance_; }
  glm::vec3 to_middle() const { return frame_.normal; }

  bool contains(glm::vec3 direction) const {
    const glm::vec3 chord = direction - frame_.normal;
    return glm::dot(chord, chord) < 2.0f * depth();
  }
  /// A direction to the disc from two uniform numbers; each has `density()`.
  glm::vec3 direction(glm::vec2 uniform) const {
    const float w = uniform.x * depth(), radius = std::sqrt(w * (2.0f - w)), turn = 6.2831853f * uniform.y;
    return frame_.in_world({radius * std::cos(turn), radius * std::sin(turn), 1.0f - w});
  }
  /// The probability density per steradian.
  static float density() { return 1.0f / shading::sun_solid_angle_sr; }

 private:
  /// 1 minus the cosine of the disc's radius, to five digits.
  static float depth() { return 0.5f * shading::sun_radius_rad * shading::sun_radius_rad; }

  Frame frame_;
  glm::vec3 radiance_;
  bool shines_;
};

}  // namespace parvis::reference

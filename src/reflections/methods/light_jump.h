// Sudden changes of light, as from day to night, after which maps of the light before must not be shown.
#pragma once

#include <algorithm>
#include <optional>

#include "base/colour.h"
#include "graphics/render/renderer.h"

namespace parvis::methods {

/// Notes how bright sun and sky are from frame to frame.
class LightJump {
 public:
  /// True if they are four times brighter or darker than when this was true last, or asked first: two stops.
  bool has_come(const render::Renderer& renderer, const scene::Scene& scene) {
    constexpr float jump = 4.0f, min_brightness = 1e-4f;  // darker than any night
    const float now = std::max(luminance(scene.sun.irradiance) + luminance(renderer.sky().irradiance_sh[0]),
                               min_brightness);
    const float ratio = now / brightness_.value_or(now);
    const bool is_jump = std::max(ratio, 1.0f / ratio) > jump;
    if (!brightness_ || is_jump) brightness_ = now;
    return is_jump;
  }

 private:
  std::optional<float> brightness_;
};

}  // namespace parvis::methods

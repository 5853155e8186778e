// The sun's shadow maps of shading/shadow.glsl: the fixed place from far (drawn once), the fixed place near
// the viewer (drawn again when the viewer has gone some way), and what moves (every frame).
#pragma once

#include <array>
#include <functional>

#include "base/bounds.h"
#include "base/image.h"
#include "gl/objects.h"
#include "render/view.h"
#include "shading/shadow.h"

namespace parvis::render {

class SunShadowMaps {
 public:
  /// `fixed` bounds all that does not move, in the world.
  SunShadowMaps(glm::vec3 to_sun, const Bounds& fixed);

  /// Calls `draw` for each map that must be drawn for a viewer at `position`; for all of them when the sun
  /// has moved.
  void update(glm::vec3 position, glm::vec3 to_sun, const std::function<void(const View&)>& draw);

  /// Units 5 to 7.
  void bind() const;
  const shading::ShadowMaps& maps() const { return maps_; }
  glm::vec3 texel_uv() const;
  /// A copy for the ray tracer.
  shading::SunShadow read_back() const;

 private:
  struct Map {
    gl::Texture depth;
    gl::Framebuffer framebuffer;
    int size;
  };
  void turn_to(glm::vec3 to_sun);
  View aim(int map, glm::vec3 centre, float half_width_m);

  Bounds fixed_;
  glm::vec3 to_sun_;
  glm::mat3 sun_from_world_;  ///< rows: right, up, toward the sun
  Bounds fixed_in_sun_;
  std::array<Map, 3> targets_;
  shading::ShadowMaps maps_{};
  bool far_is_drawn_ = false;
  glm::vec3 near_centre_{1e30f};
};

}  // namespace parvis::render

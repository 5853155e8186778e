// The light of the sky and the sun by one of several models, behind one interface: that of the thesis's
// pfSkyModel (appendix A.2) in Parvis's frame (x east, y north, z up; the thesis has x south, y east, z
// up).
#pragma once

#include <array>
#include <functional>
#include <glm/glm.hpp>
#include <memory>

#include "base/result.h"
#include "graphics/light/air.h"
#include "graphics/light/solar_position.h"
#include "graphics/shading/sun.h"

namespace parvis::light {

/// `atmosphere` is precomputed scattering (atmosphere.h), `preetham` the model of the thesis (preetham.glsl).
enum class SkyKind : unsigned char { atmosphere, preetham };
inline constexpr std::array sky_kind_names{"atmosphere", "preetham"};

/// Turbidity that the models are defined for.
inline constexpr double min_turbidity = 1.0, max_turbidity = 64.0;

/// All radiances are CIE XYZ in W/m2/sr weighted by the eye: 683 times Y is a luminance in cd/m2. None is
/// ever negative.
class SkyModel {
 public:
  virtual ~SkyModel() = default;

  /// The sky's radiance in a unit direction, without the sun's disc (pfSkyModel::getSkySpectralRadiance).
  virtual glm::vec3 sky_radiance_xyz(glm::vec3 direction) const = 0;

  /// Unit vector to the sun's centre (getSunPosition).
  glm::vec3 to_sun() const { return to_sun_; }
  /// The irradiance on a plane that faces the sun; it fades while the sun sets.
  glm::vec3 sun_irradiance_xyz() const { return sun_irradiance_; }
  /// Mean over the disc (getSunSpectralRadiance).
  glm::vec3 sun_radiance_xyz() const { return sun_irradiance_ / shading::sun_solid_angle_sr; }

  /// How much of the light from a direction arrives, 0 to 1.
  using Visibility = std::function<float(glm::vec3 direction)>;
  /// Irradiance on a surface with unit `normal` from sky and sun (getSpectralRadiance): the sum of the
  /// appendix, with `samples` directions of low discrepancy over the hemisphere about the normal. The sky's
  /// solid angle is 2 pi: the 4 pi of the text counts directions of the whole sphere.
  glm::vec3 irradiance_xyz(glm::vec3 normal, int samples = 256, const Visibility& visibility = {}) const;

 protected:
  SkyModel(glm::vec3 to_sun, glm::vec3 sun_irradiance) : to_sun_(to_sun), sun_irradiance_(sun_irradiance) {}

 private:
  glm::vec3 to_sun_, sun_irradiance_;
};

/// The sky of an instant. Refused where the turbidity or the ground's albedo are out of range. What depends
/// on the air alone is kept for the next sky with the same air.
Result<std::shared_ptr<const SkyModel>> make_sky(SkyKind kind, const Air& air, const SolarPosition& sun);

}  // namespace parvis::light

#include "graphics/light/sky_model.h"

#include <cmath>
#include <memory>
#include <mutex>

#include "graphics/light/preetham.h"
#include "graphics/light/sky_view.h"

namespace parvis::light {
namespace {

class AtmosphereSky : public SkyModel {
 public:
  AtmosphereSky(const Atmosphere& atmosphere, glm::vec3 to_sun, glm::vec3 sun_irradiance,
                float sunlight_share)
      : SkyModel(to_sun, sun_irradiance), view_(atmosphere, to_sun), share_(sunlight_share) {}
  glm::vec3 sky_radiance_xyz(glm::vec3 direction) const override {
    return share_ * view_.radiance_xyz(direction);
  }

 private:
  SkyView view_;
  float share_;  ///< of sunlight at one astronomical unit
};

class PreethamSky : public SkyModel {
 public:
  PreethamSky(float turbidity, glm::vec3 to_sun, glm::vec3 sun_irradiance)
      : SkyModel(to_sun, sun_irradiance), turbidity_(turbidity) {}
  glm::vec3 sky_radiance_xyz(glm::vec3 direction) const override {
    return preetham_radiance_xyz(direction, to_sun(), turbidity_);
  }

 private:
  float turbidity_;
};

/// The atmosphere of an air takes a second: the last one is kept.
std::shared_ptr<const Atmosphere> atmosphere_of(const Air& air) {
  static std::mutex mutex;
  static std::shared_ptr<const Atmosphere> last;
  const std::lock_guard lock(mutex);
  if (!last || !(last->air() == air)) last = std::make_shared<Atmosphere>(air);
  return last;
}

}  // namespace

glm::vec3 SkyModel::irradiance_xyz(glm::vec3 normal, int samples, const Visibility& visibility) const {
  const glm::vec3 side = std::abs(normal.z) < 0.9f ? glm::vec3(0, 0, 1) : glm::vec3(1, 0, 0);
  const glm::vec3 tangent = glm::normalize(glm::cross(side, normal)), bitangent = glm::cross(normal, tangent);
  glm::vec3 sum(0.0f);
  for (int i = 0; i < samples; ++i) {
    const float cosine = (float(i) + 0.5f) / float(samples),
                turn = 2.39996323f * float(i);  // even in solid angle
    const float sine = std::sqrt(1.0f - cosine * cosine);
    const glm::vec3 direction =
        cosine * normal + sine * (std::cos(turn) * tangent + std::sin(turn) * bitangent);
    const float seen = visibility ? visibility(direction) : 1.0f;
    if (seen > 0.0f) sum += seen * cosine * sky_radiance_xyz(direction);
  }
  sum *= 6.2831853f / float(samples);
  const float facing = glm::dot(normal, to_sun_);
  if (facing > 0.0f && sun_irradiance_ != glm::vec3(0.0f))
    sum += (visibility ? visibility(to_sun_) : 1.0f) * facing * sun_irradiance_;
  return sum;
}

Result<std::shared_ptr<const SkyModel>> make_sky(SkyKind kind, const Air& air, const SolarPosition& sun) {
  if (!(air.turbidity >= min_turbidity && air.turbidity <= max_turbidity))
    return error("turbidity={} is not from {} (pure air) to {} (fog); clear days have 2 to 6", air.turbidity,
                 min_turbidity, max_turbidity);
  if (!(air.ground_albedo >= 0.0 && air.ground_albedo <= 1.0))
    return error("an albedo of the ground of {} is not from 0 to 1", air.ground_albedo);
  const glm::vec3 to_sun(sun.direction());
  const float share = float(1.0 / (sun.distance_au * sun.distance_au));
  const Spectrum direct = sunlight(AirCoefficients(air), ground_radius_m + 1.0, double(to_sun.z));
  const glm::vec3 irradiance = share * glm::vec3(xyz(direct));
  if (kind == SkyKind::preetham)
    return std::shared_ptr<const SkyModel>(
        std::make_shared<PreethamSky>(float(air.turbidity), to_sun, irradiance));
  return std::shared_ptr<const SkyModel>(
      std::make_shared<AtmosphereSky>(*atmosphere_of(air), to_sun, irradiance, share));
}

}  // namespace parvis::light

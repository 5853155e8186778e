// The default sky: sunlight scattered any number of times by air, haze and ozone over a spherical earth.
//
// After Bruneton and Neyret 2008, Precomputed Atmospheric Scattering (revised 2017), and Hillaire 2020, A
// Scalable and Production Ready Sky and Atmosphere Rendering Technique. Departures: spectra of eight bands
// instead of three; the light that was scattered more than once is kept as spherical harmonics of second
// order at each height and sun elevation instead of Bruneton's table of four dimensions or Hillaire's
// isotropic one, so that it needs 0.1 MB, is computed in a second on a processor, and is still good at
// twilight, when the light comes from one side. Orders are added until they no longer matter.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "graphics/light/air.h"

namespace parvis::light {

/// Columns of air along rays from any height to the top of the atmosphere; the same for any turbidity.
class AirColumns {
 public:
  static const AirColumns& table();
  /// Columns from radius `r` in a direction that does not hit the ground; below the horizon as at the
  /// horizon.
  Densities to_top(double r, double mu) const;

 private:
  AirColumns();
  static constexpr int heights = 64, cosines = 192;
  std::vector<glm::vec3> columns_;
};

/// Transmittance of the sun's light at radius `r` when it stands `sun_mu` (cosine) above, setting disc
/// included.
Spectrum sunlight(const AirCoefficients& air, double r, double sun_mu);

/// Precomputed single and multiple scattering of clear air (Bruneton 2017): tables for all sun elevations.
class Atmosphere {
 public:
  explicit Atmosphere(const Air& air);

  /// The parameters that the tables were computed for.
  const Air& air() const { return air_; }
  /// The scattering and absorption coefficients of that air.
  const AirCoefficients& coefficients() const { return coefficients_; }

  /// Radiance along a ray, as a fraction of the sun's irradiance per steradian. Haze that scattered sunlight
  /// once is kept apart, without its phase function: its glare about the sun is too narrow for a table of
  /// directions.
  struct View {
    Spectrum radiance, haze_once;
  };
  /// The radiance seen from a height above the ground in a unit direction, in a frame with z up.
  View view(double height_m, glm::dvec3 direction, glm::dvec3 to_sun, int steps = 48) const;

  /// How many orders of scattering were added.
  int orders() const { return orders_; }

 private:
  /// Harmonics up to second order that are even in y, of directions in the frame of a point: z up, the sun in
  /// the xz plane on the side of +x.
  static constexpr int harmonics = 6;
  using Field = std::array<Spectrum, harmonics>;

  struct Place {
    double r, sun_mu;
  };
  Place place_of(int height, int sun) const;
  Field field_at(double r, double sun_mu) const;
  Spectrum ground_light(glm::dvec3 normal, glm::dvec3 to_sun) const;
  /// The air along a ray, which is the same wherever the sun stands.
  struct Step {
    double t = 0.0, length_m = 0.0, r = 0.0;
    Spectrum molecules, haze;  ///< what they scatter here, as it arrives where the ray begins
  };
  struct Ray {
    std::vector<Step> steps;
    bool meets_ground = false;
    double length_m = 0.0;
    Spectrum left;  ///< of what lies behind
  };
  Ray ray_from(double r, double mu, int steps) const;
  /// Sums over rays in all directions, each weighted by the harmonics of its direction.
  template <class Light>
  Field projected(const Place& place, int turns, const Light& light) const;
  Spectrum scattered_again(const Place& place, const Ray& ray, double z, double turn) const;
  void add_orders();

  static constexpr int heights = 16, suns = 40;
  Air air_;
  AirCoefficients coefficients_;
  std::vector<Field> fields_;  ///< radiance of all orders, projected
  int orders_ = 1;
};

}  // namespace parvis::light

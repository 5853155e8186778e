// What the atmosphere is made of: air molecules, haze and ozone in spherical layers above a ground. Its
// constants are shared by the tables of `Atmosphere` and by the brute-force integration that they are judged
// by.
#pragma once

#include <cmath>
#include <glm/glm.hpp>

#include "graphics/light/spectrum.h"
#include "graphics/shading/glsl.h"

namespace parvis::light {

inline constexpr double ground_radius_m = 6'360'000.0, top_radius_m = 6'460'000.0;

/// Densities at a height, relative to where each is greatest, or columns of them along a ray in metres.
struct Densities {
  double molecules = 0.0, haze = 0.0, ozone = 0.0;
};

/// Exponential in height for molecules (8 km) and haze (1.2 km); ozone a tent from 10 to 40 km (Bruneton
/// 2017).
Densities densities_at(double height_m);

/// Parameters of a clear sky beside the sun.
struct Air {
  /// Turbidity after Linke as Preetham uses it: 1 is pure air, 2 to 3 a clear day, 10 haze, 30 and more mist.
  double turbidity = 3.0;
  double ground_albedo = 0.2;

  bool operator==(const Air&) const = default;
};

using shading::sqrt;
#include "graphics/light/haze.glsl"

/// The part of what haze intercepts that it scatters; the rest is absorbed.
inline constexpr float haze_albedo = 0.92f;

/// Coefficients per metre where the densities are 1.
struct AirCoefficients {
  Spectrum molecules;  ///< scattering (nothing is absorbed)
  Spectrum haze_scattering, haze_extinction;
  Spectrum ozone;  ///< absorption

  explicit AirCoefficients(const Air& air);
  /// Extinction per metre at these densities.
  Spectrum extinction(const Densities& d) const {
    return float(d.molecules) * molecules + float(d.haze) * haze_extinction + float(d.ozone) * ozone;
  }
};

/// Rayleigh's phase function, per steradian, of the cosine between the directions before and after.
inline float molecule_phase(float cosine) { return 0.05968310f * (1.0f + cosine * cosine); }

/// How far a ray of unit direction cosine `mu` to the vertical runs from radius `r` to the top of the air, or
/// to the ground.
double distance_to_top(double r, double mu);
double distance_to_ground(double r, double mu);  ///< only where it meets the ground
/// True if a ray from radius `r` in a direction of cosine `mu` to the vertical hits the ground.
bool meets_ground(double r, double mu);

/// The share of the sun's disc that stands above the horizon of a place at radius `r`.
double visible_disc(double r, double sun_mu);

}  // namespace parvis::light

#include "graphics/light/air.h"

#include <algorithm>
#include <cmath>

#include "graphics/shading/sun.h"

namespace parvis::light {
namespace {

constexpr double molecule_scale_m = 8000.0, haze_scale_m = 1200.0;
/// 300 Dobson units, in a tent of 15 km at half its height; molecules per m3 at its top.
constexpr double ozone_density = 300.0 * 2.687e20 / 15000.0;

}  // namespace

Densities densities_at(double height_m) {
  return {std::exp(-height_m / molecule_scale_m), std::exp(-height_m / haze_scale_m),
          std::max(0.0, 1.0 - std::abs(height_m - 25000.0) / 15000.0)};
}

AirCoefficients::AirCoefficients(const Air& air) {
  // Preetham, Shirley and Smits 1999, appendix 1: turbidity to Angstrom's coefficients, the optical depth of
  // the haze.
  const double beta = std::max(0.0, 0.04608365822050 * air.turbidity - 0.04586025928522);
  const Spectrum cross_section = ozone_cross_section();
  for (int band = 0; band < band_count; ++band) {
    const double micrometres = 1e-3 * wavelength_nm(band);
    molecules[band] = float(1.24062e-6 * std::pow(micrometres, -4.0));  // Penndorf 1957, as in Bruneton 2017
    haze_extinction[band] = float(beta * std::pow(micrometres, -1.3) / haze_scale_m);
    haze_scattering[band] = haze_albedo * haze_extinction[band];
    ozone[band] = float(ozone_density * double(cross_section[band]));
  }
}

double distance_to_top(double r, double mu) {
  return -r * mu + std::sqrt(std::max(0.0, r * r * (mu * mu - 1.0) + top_radius_m * top_radius_m));
}

double distance_to_ground(double r, double mu) {
  return std::max(
      0.0, -r * mu - std::sqrt(std::max(0.0, r * r * (mu * mu - 1.0) + ground_radius_m * ground_radius_m)));
}

bool meets_ground(double r, double mu) {
  return mu < 0.0 && r * r * (mu * mu - 1.0) + ground_radius_m * ground_radius_m >= 0.0;
}

double visible_disc(double r, double sun_mu) {
  const double ratio = std::min(ground_radius_m / r, 1.0);
  const double horizon = std::acos(-std::sqrt(1.0 - ratio * ratio));  // angle from the zenith
  const double above = (horizon - std::acos(std::clamp(sun_mu, -1.0, 1.0))) / double(shading::sun_radius_rad);
  if (above >= 1.0) return 1.0;
  if (above <= -1.0) return 0.0;
  // the segment of a circle
  return 0.5 + (std::asin(above) + above * std::sqrt(1.0 - above * above)) / 3.14159265358979;
}

}  // namespace parvis::light

#include "life/propagation/road_emission.h"

#include <algorithm>

namespace parvis::propagation {
namespace {

constexpr double reference_km_h = 70.0, min_km_h = 20.0;
constexpr std::size_t rolling_categories = 3;

/// Tyre noise falls by this per degree above 20 °C, dB.
constexpr std::array<double, rolling_categories> per_degree_db{0.08, 0.04, 0.04};

/// Braking and acceleration at junctions, dB at the junction: rolling and propulsion (2.2.17, 2.2.18).
struct JunctionGain {
  std::array<double, rolling_categories> rolling, propulsion;
};
constexpr JunctionGain at_lights{{-4.5, -4.0, -4.0}, {5.5, 9.0, 9.0}};
constexpr JunctionGain at_roundabout{{-4.4, -2.3, -2.3}, {3.1, 6.7, 6.7}};

/// Propulsion on gradients (2.2.13 to 2.2.15), dB.
double gradient_gain(std::size_t category, double percent, double km_h) {
  const double up = std::clamp(percent, 0.0, 12.0), down = std::clamp(-percent, 0.0, 12.0), v = km_h / 100.0;
  switch (category) {
    case 0:
      return down > 6.0 ? down - 6.0 : up > 2.0 ? v * (up - 2.0) / 1.5 : 0.0;
    case 1:
      return down > 4.0 ? (km_h - 20.0) / 100.0 * (down - 4.0) / 0.7 : v * up;
    case 2:
      return down > 4.0 ? (km_h - 10.0) / 100.0 * (down - 4.0) / 0.5 : v * up / 0.8;
    default:
      return 0.0;
  }
}

/// Studded tyres (2.2.6 to 2.2.8), dB.
double studded_gain(const RoadCoefficients& coefficients, const RoadTraffic& traffic, std::size_t band,
                    double km_h) {
  const double fraction = traffic.studded_fraction * traffic.studded_months / 12.0;
  if (fraction <= 0.0) return 0.0;
  const double gain =
      coefficients.studded_a[band] +
      coefficients.studded_b[band] * std::log10(std::clamp(km_h, 50.0, 90.0) / reference_km_h);
  return level(1.0 - fraction + fraction * energy(gain));
}

/// Sound power of one vehicle of a category, dB.
double vehicle_db(const RoadCoefficients& coefficients, const RoadSurface& surface,
                  const RoadTraffic& traffic, std::size_t category, std::size_t band) {
  const VehicleCoefficients& c = coefficients.vehicles[category];
  const double km_h = std::max(traffic.speed_km_h[category], min_km_h),
               ratio = std::log10(km_h / reference_km_h);
  double propulsion = c.propulsion_a[band] + c.propulsion_b[band] * (km_h - reference_km_h) / reference_km_h +
                      gradient_gain(category, traffic.gradient_percent, km_h);
  if (category >= rolling_categories) return propulsion;
  double rolling = c.rolling_a[band] + c.rolling_b[band] * ratio + surface.alpha[category][band] +
                   surface.beta[category] * ratio + per_degree_db[category] * (20.0 - traffic.celsius);
  if (category == 0) rolling += studded_gain(coefficients, traffic, band, km_h);
  propulsion += std::min(surface.alpha[category][band], 0.0);
  if (traffic.junction != Junction::none) {
    const JunctionGain& gain = traffic.junction == Junction::roundabout ? at_roundabout : at_lights;
    const double nearness = std::max(1.0 - std::abs(traffic.junction_m) / 100.0, 0.0);
    rolling += gain.rolling[category] * nearness, propulsion += gain.propulsion[category] * nearness;
  }
  return level(energy(rolling) + energy(propulsion));
}

}  // namespace

Octaves road_power_db(const RoadCoefficients& coefficients, const RoadSurface& surface,
                      const RoadTraffic& traffic) {
  Octaves result;
  for (std::size_t band = 0; band < octaves; ++band) {
    double sum = 0.0;
    for (std::size_t category = 0; category < vehicle_categories; ++category) {
      const double km_h = std::max(traffic.speed_km_h[category], min_km_h);
      if (const double flow = traffic.flow_per_h[category]; flow > 0.0)
        sum += energy(vehicle_db(coefficients, surface, traffic, category, band)) * flow / (1000.0 * km_h);
    }
    result[band] = level(sum);
  }
  return result;
}

Octaves vehicle_power_db(const RoadCoefficients& coefficients, VehicleCategory category, double speed_km_h) {
  RoadTraffic alone;
  alone.speed_km_h.fill(speed_km_h);
  Octaves result;
  for (std::size_t band = 0; band < octaves; ++band)
    result[band] = vehicle_db(coefficients, {}, alone, std::size_t(category), band);
  return result;
}

}  // namespace parvis::propagation

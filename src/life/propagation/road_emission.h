// Sound power of road traffic: CNOSSOS-EU, 2.2 of the Directive's annex, with the coefficients of Delegated
// Directive (EU) 2021/1226.
#pragma once

#include <array>

#include "life/propagation/octaves.h"

namespace parvis::propagation {

/// Categories of vehicles: 1, 2, 3, 4a and 4b.
inline constexpr std::size_t vehicle_categories = 5;
/// Names of the categories.
enum class VehicleCategory { light, medium, heavy, moped, motorcycle };

/// One number for each category.
using ByCategory = std::array<double, vehicle_categories>;

/// Coefficients of rolling and propulsion noise, dB: A + B lg(v/70) and A + B (v - 70)/70. Two-wheelers have
/// no rolling noise.
struct VehicleCoefficients {
  Octaves rolling_a{}, rolling_b{}, propulsion_a{}, propulsion_b{};
};

/// A set of coefficients.
struct RoadCoefficients {
  std::array<VehicleCoefficients, vehicle_categories> vehicles;
  Octaves studded_a{}, studded_b{};  ///< studded tyres of light vehicles
};

/// The coefficients in force.
extern const RoadCoefficients road_coefficients_2020;

/// A road's surface against the reference, an average of dense asphalt: α in dB and β, for light, medium and
/// heavy vehicles.
struct RoadSurface {
  std::array<Octaves, 3> alpha{};
  std::array<double, 3> beta{};
};

/// Traffic that crosses a road.
enum class Junction { none, crossing_with_lights, roundabout };

/// Traffic of an hour on a road and what else its noise depends on.
struct RoadTraffic {
  ByCategory flow_per_h{};                    ///< vehicles per hour
  ByCategory speed_km_h{50, 50, 50, 50, 50};  ///< mean speeds; below 20 km/h the value at 20 holds
  double gradient_percent = 0.0;              ///< uphill in the direction of travel positive
  double celsius = 20.0;                      ///< of the air
  Junction junction = Junction::none;         ///< the nearest one
  double junction_m = 1e9;                    ///< distance to it
  double studded_fraction = 0.0;              ///< of light vehicles, in winter
  double studded_months = 0.0;                ///< per year
};

/// Sound power level per metre of road in dB re 1 pW/m, all categories together; `silence_db` without
/// traffic.
Octaves road_power_db(const RoadCoefficients& coefficients, const RoadSurface& surface,
                      const RoadTraffic& traffic);

/// Sound power level of one vehicle that passes at a speed, dB re 1 pW, on the reference surface.
Octaves vehicle_power_db(const RoadCoefficients& coefficients, VehicleCategory category, double speed_km_h);

}  // namespace parvis::propagation

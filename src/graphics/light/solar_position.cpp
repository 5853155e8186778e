// Reda and Andreas 2004, section 3 (steps 3.1 to 3.14); names are theirs. No departure: refraction is left
// out where the whole disc is below the horizon, as in NREL's spa.c.
#include "graphics/light/solar_position.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "graphics/light/solar_terms.h"

namespace parvis::light {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr double j2000 = 2451545.0;
constexpr double disc_radius_deg = 0.26667;
constexpr double refraction_at_horizon_deg = 0.5667;

double wrapped_degrees(double angle_deg) { return angle_deg - 360.0 * std::floor(angle_deg / 360.0); }

/// Step 3.2: the sum of a table, in its unit of 1e-8.
double periodic_sum(std::span<const PeriodicTerm> terms, double millennia) {
  double sum = 0.0;
  for (const PeriodicTerm& term : terms)
    sum +=
        term.amplitude * std::cos(term.phase + term.frequency * millennia) * std::pow(millennia, term.power);
  return 1e-8 * sum;
}

/// Nutation in degrees.
struct Nutation {
  double longitude, obliquity;
};

/// Step 3.4.
Nutation nutation(double t) {
  const auto cubic = [t](double a, double b, double c, double d) {
    return degree * (a + t * (b + t * (c + t * d)));
  };
  const double arguments[] = {
      cubic(297.85036, 445267.111480, -0.0019142, 1.0 / 189474.0),  // elongation of the moon
      cubic(357.52772, 35999.050340, -0.0001603, -1.0 / 300000.0),  // anomaly of the sun
      cubic(134.96298, 477198.867398, 0.0086972, 1.0 / 56250.0),    // anomaly of the moon
      cubic(93.27191, 483202.017538, -0.0036825, 1.0 / 327270.0),   // latitude of the moon
      cubic(125.04452, -1934.136261, 0.0020708, 1.0 / 450000.0)};   // node of its orbit
  Nutation sum{0.0, 0.0};
  for (const NutationTerm& term : nutation_terms) {
    double x = 0.0;
    for (int i = 0; i < 5; ++i) x += double(term.multiples[i]) * arguments[i];
    sum.longitude += (term.a + term.b * t) * std::sin(x);
    sum.obliquity += (term.c + term.d * t) * std::cos(x);
  }
  return {sum.longitude / 36e6, sum.obliquity / 36e6};
}

/// Step 3.5, in degrees, without nutation.
double mean_obliquity(double millennia) {
  constexpr double coefficients[] = {84381.448, -4680.93, -1.55, 1999.25, -51.38, -249.67,
                                     -39.05,    7.12,     27.87, 5.79,    2.45};
  double sum = 0.0;
  for (auto c = std::rbegin(coefficients); c != std::rend(coefficients); ++c)
    sum = sum * millennia / 10.0 + *c;
  return sum / 3600.0;
}

/// Step 3.14.3, in degrees.
double refraction(double elevation_deg, const Observer& observer) {
  if (elevation_deg < -(disc_radius_deg + refraction_at_horizon_deg)) return 0.0;
  const double angle = degree * (elevation_deg + 10.3 / (elevation_deg + 5.11));
  return observer.pressure_mbar / 1010.0 * 283.0 / (273.0 + observer.temperature_c) * 1.02 /
         (60.0 * std::tan(angle));
}

}  // namespace

glm::dvec3 SolarPosition::direction() const {
  const double a = degree * azimuth_deg, z = degree * zenith_deg;
  return {std::sin(z) * std::sin(a), std::sin(z) * std::cos(a), std::cos(z)};
}

double julian_day(int year, int month, int day, double hours_ut) {
  if (month < 3) --year, month += 12;
  const double days =
      std::floor(365.25 * (year + 4716)) + std::floor(30.6001 * (month + 1)) + day - 1524.5 + hours_ut / 24.0;
  const double century = std::floor(year / 100.0);
  const double gregorian = days + 2.0 - century + std::floor(century / 4.0);
  return days < 2299160.5 ? days : gregorian;
}

double delta_t_s(double year) {
  const double y = std::clamp(year, 1961.0, 2150.0);
  if (y < 1986.0) {
    const double t = y - 1975.0;
    return 45.45 + t * (1.067 + t * (-1.0 / 260.0 - t / 718.0));
  }
  const double t = y - 2000.0;
  if (y < 2005.0)
    return 63.86 + t * (0.3345 + t * (-0.060374 + t * (0.0017275 + t * (0.000651814 + t * 0.00002373599))));
  if (y < 2050.0) return 62.92 + t * (0.32217 + t * 0.005589);
  const double centuries = (y - 1820.0) / 100.0;
  return -20.0 + 32.0 * centuries * centuries - 0.5628 * (2150.0 - y);
}

SolarPosition solar_position(double julian_day_ut, double delta_t, const Observer& observer) {
  const double century = (julian_day_ut - j2000) / 36525.0;
  const double ephemeris_century = century + delta_t / 86400.0 / 36525.0,
               millennia = ephemeris_century / 10.0;

  // 3.2, 3.3: the earth about the sun, and so the sun about the earth
  const double theta = periodic_sum(longitude_terms, millennia) / degree + 180.0;
  const double beta = -periodic_sum(latitude_terms, millennia);
  const double distance = periodic_sum(radius_terms, millennia);

  // 3.4 to 3.7: apparent longitude
  const Nutation delta = nutation(ephemeris_century);
  const double epsilon = degree * (mean_obliquity(millennia) + delta.obliquity);
  const double aberration = -20.4898 / (3600.0 * distance);
  const double lambda = degree * (theta + delta.longitude + aberration);

  // 3.8: sidereal time at Greenwich
  const double mean_sidereal = 280.46061837 + 360.98564736629 * (julian_day_ut - j2000) +
                               century * century * (0.000387933 - century / 38710000.0);
  const double sidereal = wrapped_degrees(mean_sidereal) + delta.longitude * std::cos(epsilon);

  // 3.9 to 3.11: right ascension, declination, local hour angle
  const double alpha =
      std::atan2(std::sin(lambda) * std::cos(epsilon) - std::tan(beta) * std::sin(epsilon), std::cos(lambda));
  const double declination =
      std::asin(std::sin(beta) * std::cos(epsilon) + std::cos(beta) * std::sin(epsilon) * std::sin(lambda));
  const double hour_angle = degree * wrapped_degrees(sidereal + observer.longitude_deg - alpha / degree);

  // 3.12, 3.13: as seen from the surface of the flattened earth
  const double phi = degree * observer.latitude_deg, parallax = degree * 8.794 / (3600.0 * distance);
  const double u = std::atan(0.99664719 * std::tan(phi)), height = observer.elevation_m / 6378140.0;
  const double x = std::cos(u) + height * std::cos(phi),
               y = 0.99664719 * std::sin(u) + height * std::sin(phi);
  const double across = std::cos(declination) - x * std::sin(parallax) * std::cos(hour_angle);
  const double delta_alpha = std::atan2(-x * std::sin(parallax) * std::sin(hour_angle), across);
  const double seen_declination =
      std::atan2((std::sin(declination) - y * std::sin(parallax)) * std::cos(delta_alpha), across);
  const double seen_hour_angle = hour_angle - delta_alpha;

  // 3.14, 3.15: zenith and azimuth
  const double elevation = std::asin(std::sin(phi) * std::sin(seen_declination) +
                                     std::cos(phi) * std::cos(seen_declination) * std::cos(seen_hour_angle)) /
                           degree;
  const double from_south =
      std::atan2(std::sin(seen_hour_angle),
                 std::cos(seen_hour_angle) * std::sin(phi) - std::tan(seen_declination) * std::cos(phi));
  return {wrapped_degrees(from_south / degree + 180.0), 90.0 - elevation - refraction(elevation, observer),
          elevation, distance};
}

}  // namespace parvis::light

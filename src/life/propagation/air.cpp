#include "life/propagation/air.h"

namespace parvis::propagation {

double absorption_db_per_m(double frequency_hz, const Air& air) {
  constexpr double reference_k = 293.15, triple_point_k = 273.16;
  const double kelvin = air.celsius + 273.15, relative = kelvin / reference_k;
  const double f2 = frequency_hz * frequency_hz;
  // Molar concentration of water vapour in percent, then the relaxation frequencies of oxygen and nitrogen.
  const double vapour =
      air.humidity_percent * std::pow(10.0, 4.6151 - 6.8346 * std::pow(triple_point_k / kelvin, 1.261));
  const double oxygen_hz = 24.0 + 4.04e4 * vapour * (0.02 + vapour) / (0.391 + vapour);
  const double nitrogen_hz =
      (9.0 + 280.0 * vapour * std::exp(-4.170 * (std::cbrt(1.0 / relative) - 1.0))) / std::sqrt(relative);
  const double oxygen = 0.01275 * std::exp(-2239.1 / kelvin) / (oxygen_hz + f2 / oxygen_hz);
  const double nitrogen = 0.1068 * std::exp(-3352.0 / kelvin) / (nitrogen_hz + f2 / nitrogen_hz);
  return 8.686 * f2 * (1.84e-11 * std::sqrt(relative) + std::pow(relative, -2.5) * (oxygen + nitrogen));
}

Octaves absorption_db_per_m(const Air& air) {
  Octaves absorption;
  for (std::size_t i = 0; i < octaves; ++i)
    absorption[i] = absorption_db_per_m(1000.0 * std::pow(10.0, 0.3 * (double(i) - 4.0)), air);
  return absorption;
}

}  // namespace parvis::propagation

// Where the sun stands: the Solar Position Algorithm of NREL (Reda and Andreas 2004, NREL/TP-560-34302), with
// all of its terms. Its authors give 0.0003 degrees between the years -2000 and 6000.
#pragma once

#include <glm/glm.hpp>

namespace parvis::light {

/// A place on the earth and the state of its air, which refracts the light of a low sun.
struct Observer {
  double latitude_deg = 0.0;   ///< north positive, -90 to 90
  double longitude_deg = 0.0;  ///< east positive, -180 to 180
  double elevation_m = 0.0;
  double pressure_mbar = 1010.0;
  double temperature_c = 10.0;
};

/// The sun as it is seen from a place.
struct SolarPosition {
  double azimuth_deg = 0.0;              ///< from north, clockwise: 90 is east; 0 to 360
  double zenith_deg = 0.0;               ///< of the centre of the disc, refracted by the air
  double geometric_elevation_deg = 0.0;  ///< without refraction: what sunrise and twilight are defined by
  double distance_au = 1.0;              ///< from the earth: irradiance goes by its inverse square

  /// Elevation above the horizon, with the refraction that the zenith angle has.
  double elevation_deg() const { return 90.0 - zenith_deg; }
  /// Unit vector to the sun: x east, y north, z up.
  glm::dvec3 direction() const;
};

/// Days since noon of 1 January 4713 BC, universal time. Months and days count from 1; `hours_ut` may lie
/// outside the day. Dates up to 4 October 1582 are Julian, later ones Gregorian.
double julian_day(int year, int month, int day, double hours_ut);

/// Terrestrial time minus universal time in seconds: polynomials of Espenak and Meeus (Five Millennium Canon
/// of Solar Eclipses, NASA/TP-2006-214141), from 1961 to 2150; outside, those of the nearest year.
double delta_t_s(double year);

/// The sun at a Julian day of universal time.
SolarPosition solar_position(double julian_day_ut, double delta_t_s, const Observer& observer);

}  // namespace parvis::light

// Time and place as a planner writes them - a day of a year, the clock of a time zone, latitude and longitude
// - and what the sun does then: where it stands, when it rises and sets.
#pragma once

#include <optional>

#include "base/result.h"
#include "graphics/light/solar_position.h"

namespace parvis::light {

/// Years in which `delta_t_s` is more than an extrapolation.
inline constexpr int min_year = 1961, max_year = 2150;

/// An instant at a place. `check` says whether it is one; the other functions expect that.
struct PlaceAndTime {
  double latitude_deg = 43.70, longitude_deg = 7.27;  ///< north and east positive; Nice
  double time_zone_h = 1.0;                           ///< clock minus universal time
  int year = 2026;
  int day_of_year = 172;        ///< 1 to 365, or 366 in a leap year
  double time_of_day_h = 12.0;  ///< of the clock; 14.25 is a quarter past two
  double true_north_deg = 0.0;  ///< clockwise from the y axis: the north of a map's grid is another

  bool operator==(const PlaceAndTime&) const = default;
};

/// True for leap years of the Gregorian calendar.
bool is_leap_year(int year);
/// 365, or 366 in a leap year.
int days_in_year(int year);
/// The day of the year of a date; months and days count from 1.
int day_of_year(int year, int month, int day);
/// Every value that is out of range, what it may be, and what is probably meant.
Status check(const PlaceAndTime& when);

/// The Julian day of the moment, in universal time.
double julian_day(const PlaceAndTime& when);
/// The sun's position at that place and time, by solar_position; its azimuth counts from the y axis.
SolarPosition sun_of(const PlaceAndTime& when);

/// The moment when the clock of `day` shows `hour`, which may be below 0 or from 24 on: it is then on the day
/// before or after.
PlaceAndTime at_hour(PlaceAndTime day, double hour);

/// Elevation of the sun's centre, without refraction, when its upper edge appears at a level horizon.
inline constexpr double sunrise_elevation_deg = -0.8333;
inline constexpr double civil_twilight_elevation_deg = -6.0;

/// When the sun passes an elevation on a day, by the clock; hours may be below 0 or above 24 where the clock
/// is far from the sun. The day is that of the sun's highest position between 0 and 24 o'clock. Where it does
/// not set after it rises, but has set between 0 o'clock and then, that is its setting, and likewise its
/// rising.
struct DaylightHours {
  std::optional<double> rise_h, set_h;  ///< absent where it does not pass
  double noon_h = 12.0;                 ///< when it stands highest
  double noon_elevation_deg = 0.0;      ///< geometric

  /// True if the night lies between midnight and the sun's rise alone: it sets before it rises.
  bool sets_first() const { return rise_h && set_h && *set_h < *rise_h; }
  /// When the time above the elevation ends that `rise_h` or noon lies in; of a day that sets first it is the
  /// setting of the next night.
  double end_h() const { return sets_first() ? *set_h + 24.0 : set_h.value_or(noon_h + 12.0); }
  /// When that time begins.
  double begin_h() const { return rise_h.value_or(noon_h - 12.0); }
  /// True if the sun stays below the elevation all day.
  bool is_polar_night(double elevation_deg = sunrise_elevation_deg) const {
    return !rise_h && !set_h && noon_elevation_deg < elevation_deg;
  }
};

/// The hours of daylight, to within a second.
DaylightHours daylight_hours(PlaceAndTime day, double elevation_deg = sunrise_elevation_deg);

}  // namespace parvis::light

#include "graphics/light/day_light_time.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace parvis::light {
namespace {

double elevation_at(PlaceAndTime when, double hours) {
  when.time_of_day_h = hours;
  return sun_of(when).geometric_elevation_deg;
}

/// Where `value` is greatest between two hours, of which it has one maximum: golden section search.
template <class Function>
double highest(double from, double to, Function&& value) {
  constexpr double ratio = 0.6180339887498949;
  double left = to - ratio * (to - from), right = from + ratio * (to - from);
  double at_left = value(left), at_right = value(right);
  while (to - from > 1e-4) {
    if (at_left > at_right) {
      to = right, right = left, at_right = at_left;
      left = to - ratio * (to - from), at_left = value(left);
    } else {
      from = left, left = right, at_left = at_right;
      right = from + ratio * (to - from), at_right = value(right);
    }
  }
  return 0.5 * (from + to);
}

/// When the sun passes `elevation_deg` between two hours; nothing where it is on one side at both.
std::optional<double> passing(const PlaceAndTime& day, double from, double to, double elevation_deg) {
  const bool is_up = elevation_at(day, from) > elevation_deg;
  if ((elevation_at(day, to) > elevation_deg) == is_up) return std::nullopt;
  while (to - from > 1e-5) {
    const double middle = 0.5 * (from + to);
    ((elevation_at(day, middle) > elevation_deg) == is_up ? from : to) = middle;
  }
  return 0.5 * (from + to);
}

}  // namespace

bool is_leap_year(int year) { return (year % 4 == 0 && year % 100 != 0) || year % 400 == 0; }
int days_in_year(int year) { return is_leap_year(year) ? 366 : 365; }

int day_of_year(int year, int month, int day) {
  return int(std::lround(julian_day(year, month, day, 0.0) - julian_day(year, 1, 1, 0.0))) + 1;
}

Status check(const PlaceAndTime& when) {
  Errors errors;
  const auto expect = [&](bool is_good, const char* name, double value, const std::string& expected) {
    if (!is_good || !std::isfinite(value)) errors.push_back(error("{}={} is not {}", name, value, expected));
  };
  expect(std::abs(when.latitude_deg) <= 90.0, "latitude", when.latitude_deg,
         "between -90 (south pole) and 90 degrees (north pole)");
  expect(std::abs(when.longitude_deg) <= 180.0, "longitude", when.longitude_deg,
         "between -180 (west) and 180 degrees (east positive)");
  expect(when.time_zone_h >= -12.0 && when.time_zone_h <= 14.0, "time zone", when.time_zone_h,
         "between -12 and 14 hours (clock minus universal time, east positive)");
  expect(when.year >= min_year && when.year <= max_year, "year", when.year,
         fmt::format("from {} to {}", min_year, max_year));
  expect(when.day_of_year >= 1 && when.day_of_year <= days_in_year(when.year), "day", when.day_of_year,
         fmt::format("from 1 (1 January) to {} (31 December {})", days_in_year(when.year), when.year));
  expect(when.time_of_day_h >= 0.0 && when.time_of_day_h < 24.0, "time of day", when.time_of_day_h,
         "from 0 to below 24 hours (14.25 is 14:15)");
  if (!errors.empty()) return errors;
  return Ok{};
}

double julian_day(const PlaceAndTime& when) {
  return julian_day(when.year, 1, 1, when.time_of_day_h - when.time_zone_h) + double(when.day_of_year - 1);
}

SolarPosition sun_of(const PlaceAndTime& when) {
  SolarPosition sun =
      solar_position(julian_day(when), delta_t_s(when.year + (when.day_of_year - 0.5) / 365.25),
                     {.latitude_deg = when.latitude_deg, .longitude_deg = when.longitude_deg});
  sun.azimuth_deg = std::fmod(sun.azimuth_deg + when.true_north_deg + 360.0, 360.0);
  return sun;
}

PlaceAndTime at_hour(PlaceAndTime day, double hour) {
  const double days = std::floor(hour / 24.0);
  day.time_of_day_h = hour - 24.0 * days;
  day.day_of_year += int(days);
  if (day.day_of_year < 1) {
    --day.year;
    day.day_of_year += days_in_year(day.year);
  } else if (day.day_of_year > days_in_year(day.year)) {
    day.day_of_year -= days_in_year(day.year);
    ++day.year;
  }
  return day;
}

DaylightHours daylight_hours(PlaceAndTime day, double elevation_deg) {
  // The sun culminates within half an hour of mean noon at the place, and once between two lower
  // culminations.
  const double mean_noon = 12.0 + day.time_zone_h - day.longitude_deg / 15.0;
  const double centre = mean_noon - 24.0 * std::floor(mean_noon / 24.0);
  const auto height = [&](double hours) { return elevation_at(day, hours); };
  const auto depth = [&](double hours) { return -elevation_at(day, hours); };
  DaylightHours result;
  result.noon_h = highest(centre - 1.5, centre + 1.5, height);
  result.noon_elevation_deg = elevation_at(day, result.noon_h);
  const double before = highest(result.noon_h - 13.5, result.noon_h - 10.5, depth);
  const double after = highest(result.noon_h + 10.5, result.noon_h + 13.5, depth);
  result.rise_h = passing(day, before, result.noon_h, elevation_deg);
  result.set_h = passing(day, result.noon_h, after, elevation_deg);
  // A night about midnight that is shorter than the day is long lies on one date.
  if (!result.set_h && result.rise_h)
    if (const auto set_h = passing(day, before - 12.0, before, elevation_deg); set_h && *set_h >= 0.0)
      result.set_h = set_h;
  if (!result.rise_h && result.set_h)
    if (const auto rise_h = passing(day, after, after + 12.0, elevation_deg); rise_h && *rise_h < 24.0)
      result.rise_h = rise_h;
  return result;
}

}  // namespace parvis::light

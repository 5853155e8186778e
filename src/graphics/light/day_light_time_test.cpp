#include "graphics/light/day_light_time.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <optional>

#include "base/test_data.h"

namespace parvis::light {
namespace {

/// How far the event that falls on the date by universal time is from `expected_h`: far from Greenwich it may
/// belong to the daylight of the day before or after.
double minutes_off(PlaceAndTime when, std::optional<double> DaylightHours::*event, double expected_h) {
  double minimum = 1e9;
  const int date = when.day_of_year;
  for (const int shift : {-1, 0, 1}) {
    when.day_of_year = date + shift;
    const std::optional<double> hours = daylight_hours(when, civil_twilight_elevation_deg).*event;
    if (hours) minimum = std::min(minimum, 60.0 * std::abs(*hours + 24.0 * shift - expected_h));
  }
  return minimum;
}

TEST(DayLightTime, NamesWhatIsOutOfRange) {
  PlaceAndTime when;
  EXPECT_TRUE(check(when));
  when = {.latitude_deg = 91.0,
          .longitude_deg = 270.0,
          .time_zone_h = 15.0,
          .year = 2026,
          .day_of_year = 366,
          .time_of_day_h = 24.5};
  const Status status = check(when);
  ASSERT_FALSE(status);
  ASSERT_EQ(status.errors().size(), 5u) << to_string(status.errors());
  EXPECT_EQ(status.errors()[0].message,
            "latitude=91 is not between -90 (south pole) and 90 degrees (north pole)");
  EXPECT_EQ(status.errors()[3].message, "day=366 is not from 1 (1 January) to 365 (31 December 2026)");
  EXPECT_EQ(status.errors()[4].message, "time of day=24.5 is not from 0 to below 24 hours (14.25 is 14:15)");
  EXPECT_TRUE(check({.year = 2024, .day_of_year = 366}));
  EXPECT_FALSE(check({.day_of_year = 0}));
  EXPECT_FALSE(check({.year = 1800}));
  EXPECT_FALSE(check({.latitude_deg = std::nan("")}));
}

TEST(DayLightTime, DaysOfTheYear) {
  EXPECT_EQ(day_of_year(2026, 1, 1), 1);
  EXPECT_EQ(day_of_year(2026, 3, 21), 80);
  EXPECT_EQ(day_of_year(2024, 12, 31), 366);
  EXPECT_EQ(days_in_year(2100), 365);
  EXPECT_EQ(days_in_year(2000), 366);
}

TEST(DayLightTime, TheThesissExampleHasTheSunInTheWest) {
  // Longitude is east positive. Read as west positive, as the code does that the thesis used, 7.27 puts the
  // sun elsewhere.
  const SolarPosition sun = sun_of({43.70, 7.27, 0.0, 2003, 130, 16.0});
  EXPECT_NEAR(sun.azimuth_deg, 267.0, 4.0);
  EXPECT_GT(sun.elevation_deg(), 25.0);
  EXPECT_LT(sun.direction().x, -0.7);  // west is -x
  const SolarPosition west_positive = sun_of({43.70, -7.27, 0.0, 2003, 130, 16.0});
  const double off = std::acos(glm::dot(sun.direction(), west_positive.direction())) * 57.29577951;
  EXPECT_NEAR(off, 14.3, 0.5);
}

TEST(DayLightTime, TwilightOfTheUsNavalObservatory) {
  const auto file = shared_data("sun/sunrise_usno_reference_testdata_civil.csv");
  if (!file) GTEST_SKIP() << "../shared/data/sun is absent";
  std::ifstream lines(*file);
  int rows = 0, days_without_night = 0;
  for (std::string line; std::getline(lines, line);) {
    int year = 0, month = 0, day = 0, rise_hour = 0, rise_minute = 0, set_hour = 0, set_minute = 0;
    double latitude = 0.0, longitude = 0.0;
    char type[16] = "";
    const int fields =
        std::sscanf(line.c_str(), "%d-%d-%dT12:00:00Z,%lf,%lf,%15[A-Z_],%d:%d,%d:%d", &year, &month, &day,
                    &latitude, &longitude, type, &rise_hour, &rise_minute, &set_hour, &set_minute);
    if (fields < 6) continue;
    ++rows;
    const PlaceAndTime when{latitude, longitude, 0.0, year, day_of_year(year, month, day), 12.0};
    const DaylightHours hours = daylight_hours(when, civil_twilight_elevation_deg);
    if (std::string(type) == "ALL_DAY") {
      EXPECT_FALSE(hours.rise_h || hours.set_h || hours.is_polar_night(civil_twilight_elevation_deg)) << line;
      ++days_without_night;
      continue;
    }
    ASSERT_EQ(fields, 10) << line;
    // To the minute, and a little for its rounding.
    EXPECT_LT(minutes_off(when, &DaylightHours::rise_h, rise_hour + rise_minute / 60.0), 1.1) << line;
    EXPECT_LT(minutes_off(when, &DaylightHours::set_h, set_hour + set_minute / 60.0), 1.1) << line;
  }
  EXPECT_GT(rows, 100);
  RecordProperty("rows", rows);
  EXPECT_GT(days_without_night, 0);
}

TEST(DayLightTime, PolarNightAndDay) {
  PlaceAndTime tromso{69.65, 18.96, 1.0, 2026, day_of_year(2026, 12, 21), 12.0};
  EXPECT_TRUE(daylight_hours(tromso).is_polar_night());
  tromso.day_of_year = day_of_year(2026, 6, 21);
  const DaylightHours midsummer = daylight_hours(tromso);
  EXPECT_FALSE(midsummer.rise_h || midsummer.set_h || midsummer.is_polar_night());
  const DaylightHours equinox = daylight_hours({.day_of_year = 80});
  ASSERT_TRUE(equinox.rise_h && equinox.set_h);
  EXPECT_NEAR(*equinox.set_h - *equinox.rise_h, 12.15, 0.1);
  EXPECT_NEAR(equinox.noon_elevation_deg, 90.0 - 43.7, 0.4);
}

TEST(DayLightTime, ANightOfOneDateHasItsSunsetBeforeItsSunrise) {
  // Longyearbyen's last night of spring: the sun sets after midnight, and rises before two.
  PlaceAndTime day{78.2232, 15.6267, 2.0, 2026, day_of_year(2026, 4, 18), 12.0};
  const DaylightHours spring = daylight_hours(day);
  ASSERT_TRUE(spring.rise_h && spring.set_h);
  EXPECT_NEAR(*spring.set_h, 13.0 / 60.0, 0.1);
  EXPECT_NEAR(*spring.rise_h, 1.0 + 39.0 / 60.0, 0.1);
  EXPECT_TRUE(spring.sets_first());
  int nights = 0;  // every date has at least one of the two until the sun stays up, and none then
  for (int date = 100; date < 125; ++date) {
    day.day_of_year = date;
    const DaylightHours hours = daylight_hours(day);
    if (hours.rise_h && hours.set_h) ++nights;
    EXPECT_FALSE(hours.is_polar_night()) << date;
    if (date < 108) {
      EXPECT_TRUE(hours.rise_h && hours.set_h) << date;
    }
    if (date > 112) {
      EXPECT_FALSE(hours.rise_h || hours.set_h) << date;
    }
  }
  EXPECT_GE(nights, 8);
}

TEST(DayLightTime, TheSunTurnsWithTheNorthOfTheMap) {
  PlaceAndTime when{.latitude_deg = 69.04, .longitude_deg = 20.79, .day_of_year = 80, .time_of_day_h = 14.0};
  const double azimuth_deg = sun_of(when).azimuth_deg, elevation_deg = sun_of(when).elevation_deg();
  when.true_north_deg = 5.8;
  EXPECT_NEAR(sun_of(when).azimuth_deg, azimuth_deg + 5.8, 1e-9);
  EXPECT_NEAR(sun_of(when).elevation_deg(), elevation_deg, 1e-12);
}

TEST(DayLightTime, HoursBeyondMidnightAreOfTheNeighbouringDay) {
  const PlaceAndTime leap{.year = 2028, .day_of_year = 366};
  EXPECT_EQ(at_hour(leap, 23.5), (PlaceAndTime{.year = 2028, .day_of_year = 366, .time_of_day_h = 23.5}));
  EXPECT_EQ(at_hour(leap, 25.0), (PlaceAndTime{.year = 2029, .day_of_year = 1, .time_of_day_h = 1.0}));
  EXPECT_EQ(at_hour({.year = 2029, .day_of_year = 1}, -1.0),
            (PlaceAndTime{.year = 2028, .day_of_year = 366, .time_of_day_h = 23.0}));
  EXPECT_EQ(at_hour({.year = 2026, .day_of_year = 80}, 24.0),
            (PlaceAndTime{.year = 2026, .day_of_year = 81, .time_of_day_h = 0.0}));
}

}  // namespace
}  // namespace parvis::light

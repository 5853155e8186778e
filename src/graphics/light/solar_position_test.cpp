// Against NREL's own program (tables in ../shared/data/sun) and the worked example of its report.
#include "graphics/light/solar_position.h"

#include <gtest/gtest.h>

#include "base/test_data.h"
#include "graphics/light/test_sun_tables.h"

namespace parvis::light {
namespace {

TEST(SolarPosition, JulianDaysOfTheReport) {
  // Reda and Andreas 2004, table A4.1
  EXPECT_DOUBLE_EQ(julian_day(2000, 1, 1, 12.0), 2451545.0);
  EXPECT_DOUBLE_EQ(julian_day(1999, 1, 1, 0.0), 2451179.5);
  EXPECT_DOUBLE_EQ(julian_day(1988, 6, 19, 12.0), 2447332.0);
  EXPECT_DOUBLE_EQ(julian_day(1600, 12, 31, 0.0), 2305812.5);
  EXPECT_DOUBLE_EQ(julian_day(837, 4, 10, 7.2), 2026871.8);
  EXPECT_DOUBLE_EQ(julian_day(-4712, 1, 1, 12.0), 0.0);
}

TEST(SolarPosition, TheExampleOfTheReport) {
  const Observer observer{39.742476, -105.1786, 1830.14, 820.0, 11.0};
  const SolarPosition sun =
      solar_position(julian_day(2003, 10, 17, 12.508333333333333 + 7.0), 67.0, observer);
  EXPECT_NEAR(sun.azimuth_deg, 194.340241, 1e-5);
  EXPECT_NEAR(sun.zenith_deg, 50.111622, 1e-5);
  EXPECT_NEAR(sun.distance_au, 0.9965422974, 1e-9);
}

TEST(SolarPosition, EveryRowOfNrel) {
  const auto file = shared_data("sun/spa_azimuth_zenith.csv");
  if (!file) GTEST_SKIP() << "../shared/data/sun is absent";
  const std::vector<SunRow> rows = read_sun_rows(*file);
  ASSERT_GT(rows.size(), 200u);
  EXPECT_LE(max_error_deg(rows), 0.0003);
  RecordProperty("rows", int(rows.size()));
  RecordProperty("max_error_deg", fmt::format("{:.7f}", max_error_deg(rows)));
  // A control: two minutes late, every row but those at the pole is wrong.
  EXPECT_GT(max_error_deg(rows, 2.0 / 60.0), 0.3);
}

TEST(SolarPosition, DeltaTIsContinuous) {
  for (const double year : {1986.0, 2005.0, 2050.0})
    EXPECT_NEAR(delta_t_s(year - 1e-6), delta_t_s(year + 1e-6), 0.5) << year;
  EXPECT_NEAR(delta_t_s(2003.8), 64.5, 0.5);
}

TEST(SolarPosition, RefractionRaisesALowSunAndNoneBelowTheHorizon) {
  const Observer nice{43.70, 7.27};
  for (double hours = 0.0; hours < 24.0; hours += 0.05) {
    const SolarPosition sun = solar_position(julian_day(2026, 6, 21, hours), 69.0, nice);
    const double raised = sun.elevation_deg() - sun.geometric_elevation_deg;
    EXPECT_GE(raised, -1e-3);
    EXPECT_LE(raised, 0.7);
    if (sun.geometric_elevation_deg < -0.9) {
      EXPECT_NEAR(raised, 0.0, 1e-9);
    }
    EXPECT_NEAR(glm::length(sun.direction()), 1.0, 1e-12);
  }
}

}  // namespace
}  // namespace parvis::light

#include "places/dressing/clock_of_place.h"

#include <gtest/gtest.h>

#include "base/test_folder.h"

namespace parvis::dressing {
namespace {

TEST(ClockOfPlace, SummersHaveTheClockOfTheNearestZone) {
  const TestFolder zones;
  zones.write("zone1970.tab",
              "# of tests\nXA\t+5155+00424\tCanals\nXB\t+3020-09745\tRanches\tmostly\n"
              "XC\t-3352+15113\tHarbour\nXD\t+2743+08519\tMountains\nXE\t+1300-05900\tIslands\n");
  zones.write("Canals", "TZif2\n\x01binary\nCET-1CEST,M3.5.0,M10.5.0/3\n");
  zones.write("Ranches", "TZif2\nCST6CDT,M3.2.0,M11.1.0\n");
  zones.write("Harbour", "TZif2\nAEST-10AEDT,M10.1.0,M4.1.0/3\n");
  zones.write("Mountains", "TZif2\n<+0545>-5:45\n");
  zones.write("Islands", "TZif2\nnonsense\n");
  EXPECT_EQ(summer_clock_h({4.48, 51.92}, zones.path()), 2.0);
  EXPECT_EQ(summer_clock_h({-97.7, 30.3}, zones.path()), -5.0);
  EXPECT_EQ(summer_clock_h({151.0, -33.0}, zones.path()), 11.0);
  EXPECT_EQ(summer_clock_h({85.0, 27.0}, zones.path()), 5.75);
  EXPECT_EQ(summer_clock_h({-59.0, 13.0}, zones.path()), -4.0) << "by the sun where the rule is none";
  EXPECT_EQ(summer_clock_h({10.0, 48.0}, zones.path() / "none"), 1.0);
}

}  // namespace
}  // namespace parvis::dressing

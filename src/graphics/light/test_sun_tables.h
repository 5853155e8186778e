// Reads the tables of the sun that tests and the bench compare with: rows of NREL's own program.
#pragma once

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "base/test_data.h"
#include "graphics/light/solar_position.h"
#include "graphics/light/test_worse.h"

namespace parvis::light {

/// One instant and place of `spa_azimuth_zenith.csv` and where NREL's program puts the sun.
struct SunRow {
  int year, month, day;
  double hours_ut, latitude_deg, longitude_deg, azimuth_deg, zenith_deg;
};

/// Lines that are no rows (comments) are passed over.
inline std::vector<SunRow> read_sun_rows(const std::filesystem::path& file) {
  std::vector<SunRow> rows;
  std::ifstream lines(file);
  for (std::string line; std::getline(lines, line);) {
    SunRow row{};
    int hour = 0, minute = 0, second = 0;
    if (std::sscanf(line.c_str(), "%d-%d-%dT%d:%d:%dZ,%lf,%lf,%lf,%lf", &row.year, &row.month, &row.day,
                    &hour, &minute, &second, &row.latitude_deg, &row.longitude_deg, &row.azimuth_deg,
                    &row.zenith_deg) != 10)
      continue;
    row.hours_ut = hour + minute / 60.0 + second / 3600.0;
    rows.push_back(row);
  }
  return rows;
}

/// The largest difference of azimuth or zenith over all rows, each shifted by `late_h` (a control); NaN where
/// one is no number.
inline double max_error_deg(const std::vector<SunRow>& rows, double late_h = 0.0) {
  double maximum = 0.0;
  for (const SunRow& row : rows) {
    const Observer observer{row.latitude_deg, row.longitude_deg, 0.0, 1000.0,
                            10.0};  // as the file's head says
    const SolarPosition sun =
        solar_position(julian_day(row.year, row.month, row.day, row.hours_ut + late_h), 0.0, observer);
    const double azimuth = std::abs(std::remainder(sun.azimuth_deg - row.azimuth_deg, 360.0));
    maximum = worse(maximum, worse(azimuth, std::abs(sun.zenith_deg - row.zenith_deg)));
  }
  return maximum;
}

}  // namespace parvis::light

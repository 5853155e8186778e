// Dates of command lines.
#pragma once

#include <cstdio>
#include <string>
#include <utility>

#include "base/result.h"
#include "graphics/light/day_light_time.h"

namespace parvis {

/// The year and the day of it, from 1 on, of a date as 2026-03-21. Errors: it is none, or out of range.
inline Result<std::pair<int, int>> read_date(const std::string& text) {
  int year = 0, month = 0, day = 0;
  char rest = 0;
  const bool is_date = std::sscanf(text.c_str(), "%4d-%2d-%2d%c", &year, &month, &day, &rest) == 3;
  constexpr int days[] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  const bool is_month = is_date && month >= 1 && month <= 12;
  const int last = is_month ? days[month - 1] + (month == 2 && light::is_leap_year(year) ? 1 : 0) : 0;
  if (!is_month || day < 1 || day > last || year < light::min_year || year > light::max_year)
    return error("{} is not a date from {} to {} as 2026-03-21", text, light::min_year, light::max_year);
  return std::pair{year, light::day_of_year(year, month, day)};
}

}  // namespace parvis

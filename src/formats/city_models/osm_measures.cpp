#include "formats/city_models/osm_measures.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace parvis::scene {

std::optional<double> metres_in(const std::string& text) {
  constexpr double longest_m = 2000.0, foot_m = 0.3048;  // no building is as high
  double value = 0.0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (problem != std::errc() || !(std::abs(value) < longest_m)) return std::nullopt;
  return *end == '\'' ? value * foot_m : value;
}

std::optional<double> degrees_in(const std::string& text) {
  constexpr std::array<const char*, 16> points{"N", "NNE", "NE", "ENE", "E", "ESE", "SE", "SSE",
                                               "S", "SSW", "SW", "WSW", "W", "WNW", "NW", "NNW"};
  if (const auto point = std::ranges::find(points, text); point != points.end())
    return 22.5 * double(point - points.begin());
  double value = 0.0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  return problem == std::errc() && std::abs(value) <= 360.0 ? std::optional(value) : std::nullopt;
}

double metres_or(const OsmTags& tags, const char* height, const char* levels, double otherwise) {
  if (const auto given = metres_in(tag(tags, height))) return *given;
  if (const auto given = metres_in(tag(tags, levels))) return *given * osm_level_m;
  return otherwise;
}

}  // namespace parvis::scene

#include "places/dressing/clock_of_place.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include "base/files.h"

namespace parvis::dressing {
namespace {

/// ISO 6709 as the database writes it: "+5155+00424", with seconds or without.
std::optional<glm::dvec2> place_of(std::string_view text) {
  const std::size_t second = text.find_first_of("+-", 1);
  if (second == std::string_view::npos) return std::nullopt;
  const auto degrees_of = [](std::string_view part, std::size_t whole_digits) {
    const auto number = [&](std::size_t at, std::size_t count) {
      int value = 0;
      if (at + count <= part.size()) std::from_chars(part.data() + at, part.data() + at + count, value);
      return double(value);
    };
    const double value =
        number(1, whole_digits) + number(1 + whole_digits, 2) / 60.0 + number(3 + whole_digits, 2) / 3600.0;
    return part.starts_with('-') ? -value : value;
  };
  return glm::dvec2(degrees_of(text.substr(second), 3), degrees_of(text.substr(0, second), 2));
}

glm::dvec3 on_sphere(glm::dvec2 deg) {
  const glm::dvec2 angle = glm::radians(deg);
  return {std::cos(angle.y) * std::cos(angle.x), std::cos(angle.y) * std::sin(angle.x), std::sin(angle.y)};
}

/// The name of the zone whose city is nearest; empty without a database.
std::string nearest_zone(glm::dvec2 place_deg, const std::filesystem::path& zones) {
  const Result<std::string> table = read_file(zones / "zone1970.tab");
  std::string nearest;
  double best = -2.0;  // cosine of the distance
  for (std::string_view rest = table ? std::string_view(*table) : std::string_view(); !rest.empty();) {
    const std::string_view line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(line.size() + 1, rest.size()));
    const std::size_t place = line.find('\t'), name = line.find('\t', place + 1);
    if (line.starts_with('#') || name == std::string_view::npos) continue;
    const std::optional<glm::dvec2> deg = place_of(line.substr(place + 1, name - place - 1));
    if (!deg) continue;
    const double cosine = glm::dot(on_sphere(*deg), on_sphere(place_deg));
    if (cosine > best) best = cosine, nearest = line.substr(name + 1, line.find('\t', name + 1) - name - 1);
  }
  return nearest;
}

/// Takes a name ("CET", "<+03>") and hours west of Greenwich ("-1", "-5:30") from the front of a rule of
/// POSIX (IEEE 1003.1, 8.3). Nothing where there is no name; hours are absent where the rule leaves them out.
struct RulePart {
  std::optional<double> west_h;
};
std::optional<RulePart> take_part(std::string_view& rule) {
  const std::size_t name_end =
      rule.starts_with('<')
          ? rule.find('>') + 1
          : std::size_t(std::ranges::find_if(rule, [](unsigned char c) { return !std::isalpha(c); }) -
                        rule.begin());
  if (name_end == 0 || name_end > rule.size()) return std::nullopt;
  rule.remove_prefix(name_end);
  RulePart part;
  const bool is_negative = rule.starts_with('-');
  if (is_negative || rule.starts_with('+')) rule.remove_prefix(1);
  int hours = 0, minutes = 0;
  const auto [end, problem] = std::from_chars(rule.data(), rule.data() + rule.size(), hours);
  if (problem != std::errc()) return part;
  rule.remove_prefix(std::size_t(end - rule.data()));
  if (rule.starts_with(':')) {
    const auto [minutes_end, none] = std::from_chars(rule.data() + 1, rule.data() + rule.size(), minutes);
    rule.remove_prefix(std::size_t(minutes_end - rule.data()));
  }
  const double west_h = hours + minutes / 60.0;
  part.west_h = is_negative ? -west_h : west_h;
  return part;
}

/// Hours of a rule such as "CET-1CEST,M3.5.0,M10.5.0/3" in summer, else those that it always has.
std::optional<double> summer_hours(std::string_view rule) {
  const std::optional<RulePart> standard = take_part(rule);
  if (!standard || !standard->west_h) return std::nullopt;
  const std::optional<RulePart> summer = take_part(rule);
  if (!summer) return -*standard->west_h;
  return summer->west_h ? -*summer->west_h : 1.0 - *standard->west_h;
}

}  // namespace

double summer_clock_h(glm::dvec2 place_deg, const std::filesystem::path& zones) {
  constexpr double degrees_per_hour = 15.0;
  const double by_the_sun = std::floor(place_deg.x / degrees_per_hour + 0.5);
  const std::string zone = nearest_zone(place_deg, zones);
  const Result<std::string> file =
      zone.empty() ? Result<std::string>(error("no zone")) : read_file(zones / zone);
  if (!file || !file->ends_with('\n')) return by_the_sun;
  const std::string_view text(*file);  // TZif, RFC 8536: the rule is the last line
  const std::size_t begin = text.rfind('\n', text.size() - 2) + 1;
  return summer_hours(text.substr(begin, text.size() - 1 - begin)).value_or(by_the_sun);
}

}  // namespace parvis::dressing

#include "formats/city_models/osm_measures.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <string_view>

namespace parvis::scene {
namespace {

constexpr double metres_per_foot = 0.3048, inch_m = 0.0254;

struct Unit {
  std::string_view name;
  double m;
};
/// Those of lower case, longest first where one begins with another.
constexpr std::array<Unit, 27> units{{{"metres", 1.0},
                                      {"meters", 1.0},
                                      {"metre", 1.0},
                                      {"meter", 1.0},
                                      {"mm", 1e-3},
                                      {"cm", 1e-2},
                                      {"km", 1e3},
                                      {"mtr", 1.0},
                                      {"mi", 1609.344},
                                      {"m", 1.0},
                                      {"feet", metres_per_foot},
                                      {"foot", metres_per_foot},
                                      {"ft", metres_per_foot},
                                      {"yards", 0.9144},
                                      {"yard", 0.9144},
                                      {"yd", 0.9144},
                                      {"inches", inch_m},
                                      {"inch", inch_m},
                                      {"in", inch_m},
                                      {"''", inch_m},
                                      {"'", metres_per_foot},
                                      {"\"", inch_m},
                                      {"′", metres_per_foot},
                                      {"″", inch_m},
                                      {"’", metres_per_foot},
                                      {"”", inch_m},
                                      {"´", metres_per_foot}}};

void skip_blanks(std::string_view& text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.front()))) text.remove_prefix(1);
}

/// Takes a number from the front; its decimals may stand after a comma.
std::optional<double> take_number(std::string_view& text) {
  skip_blanks(text);
  if (text.starts_with('+')) text.remove_prefix(1);
  std::string plain(text.substr(0, 32));
  const auto is_digit = [&](std::size_t i) {
    return i < plain.size() && std::isdigit(static_cast<unsigned char>(plain[i]));
  };
  if (const std::size_t comma = plain.find(','); comma != std::string::npos && is_digit(comma + 1))
    plain[comma] = '.';
  double value = 0.0;
  const auto [end, problem] = std::from_chars(plain.data(), plain.data() + plain.size(), value);
  if (problem != std::errc() || !std::isfinite(value)) return std::nullopt;
  text.remove_prefix(std::size_t(end - plain.data()));
  return value;
}

const Unit* take_unit(std::string_view& text) {
  skip_blanks(text);
  std::string lower(text.substr(0, 8));
  std::ranges::transform(lower, lower.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  const auto found =
      std::ranges::find_if(units, [&](const Unit& each) { return lower.starts_with(each.name); });
  if (found == units.end()) return nullptr;
  text.remove_prefix(found->name.size());
  return &*found;
}

/// A value is followed by another one, a remark, or nothing; letters would be a unit that nobody knows.
bool ends_value(std::string_view text) {
  skip_blanks(text);
  return text.empty() || !(std::isalnum(static_cast<unsigned char>(text.front())) || text.front() == '%' ||
                           static_cast<unsigned char>(text.front()) >= 128);
}

}  // namespace

std::optional<double> metres_in(const std::string& text) {
  constexpr double longest_m = 2000.0;  // no building is as high
  std::string_view rest(text);
  const std::optional<double> first = take_number(rest);
  if (!first) return std::nullopt;
  const Unit* unit = take_unit(rest);
  double length_m = *first * (unit ? unit->m : 1.0);
  if (unit && unit->m == metres_per_foot) {  // inches may follow
    std::string_view after = rest;
    const std::optional<double> inches = take_number(after);
    const Unit* inch = inches ? take_unit(after) : nullptr;
    const bool are_inches = inches && *inches >= 0.0 && (inch ? inch->m == inch_m : after.empty());
    if (are_inches) length_m += std::copysign(*inches * inch_m, length_m), rest = after;
  }
  return ends_value(rest) && std::abs(length_m) < longest_m ? std::optional(length_m) : std::nullopt;
}

std::optional<double> number_in(const std::string& text) {
  std::string_view rest(text);
  const std::optional<double> number = take_number(rest);
  return number && ends_value(rest) ? number : std::nullopt;
}

std::optional<double> degrees_in(const std::string& text) {
  constexpr std::array<std::string_view, 16> points{"N", "NNE", "NE", "ENE", "E", "ESE", "SE", "SSE",
                                                    "S", "SSW", "SW", "WSW", "W", "WNW", "NW", "NNW"};
  constexpr std::array<std::string_view, 8> words{"NORTH", "NORTHEAST", "EAST", "SOUTHEAST",
                                                  "SOUTH", "SOUTHWEST", "WEST", "NORTHWEST"};
  std::string upper;
  for (const unsigned char c : text)
    if (c != ' ' && c != '-' && c != '_') upper += char(std::toupper(c));
  if (const auto point = std::ranges::find(points, upper); point != points.end())
    return 22.5 * double(point - points.begin());
  if (const auto word = std::ranges::find(words, upper); word != words.end())
    return 45.0 * double(word - words.begin());
  std::string_view rest(text);
  const std::optional<double> value = take_number(rest);
  skip_blanks(rest);
  for (const std::string_view unit : {"°", "degrees", "degree", "deg"})
    if (rest.starts_with(unit)) {
      rest.remove_prefix(unit.size());
      break;
    }
  return value && ends_value(rest) && std::abs(*value) <= 360.0 ? value : std::nullopt;
}

double metres_or(const OsmTags& tags, const char* height, const char* levels, double otherwise) {
  if (const auto given = metres_in(tag(tags, height))) return *given;
  if (const auto given = number_in(tag(tags, levels)); given && std::abs(*given) < max_levels)
    return *given * osm_level_m;
  return otherwise;
}

double metres_within(const OsmTags& tags, const char* key, double min_m, double max_m, double otherwise) {
  const double given = metres_in(tag(tags, key)).value_or(otherwise);
  return given > min_m && given < max_m ? given : otherwise;
}

void account_for_measures(const OsmFile& osm, FileAccount& account) {
  struct Key {
    std::string_view name;
    std::optional<double> (*read)(const std::string&);
    const char* expected;
  };
  constexpr std::size_t max_shown = 40;
  constexpr const char* length = "a length (12, 12.5 m, 1250 cm, 40', 6'4\", 40 ft)";
  constexpr const char* count = "a number";
  constexpr const char* direction = "degrees or a point of the compass (90, ENE)";
  constexpr std::array<Key, 13> keys{{{"height", metres_in, length},
                                      {"min_height", metres_in, length},
                                      {"roof:height", metres_in, length},
                                      {"width", metres_in, length},
                                      {"building:levels", number_in, count},
                                      {"building:min_level", number_in, count},
                                      {"roof:levels", number_in, count},
                                      {"roof:angle", degrees_in, "degrees"},
                                      {"roof:direction", degrees_in, direction},
                                      {"lanes", number_in, count},
                                      {"lanes:forward", number_in, count},
                                      {"lanes:backward", number_in, count},
                                      {"layer", number_in, count}}};
  const auto look = [&](const char* type, OsmId id, const OsmTags& tags) {
    for (const auto& [name, value] : tags) {
      const auto key = std::ranges::find(keys, name, &Key::name);
      if (key != keys.end() && !value.empty() && !key->read(value))
        account.left_out("tags " + name, fmt::format("cannot be read; expected {}", key->expected),
                         fmt::format("{} {}: {}", type, id, value.substr(0, max_shown)));
    }
  };
  for (const OsmNode& node : osm.tagged_nodes) look("node", node.id, node.tags);
  for (const OsmWay& way : osm.ways) look("way", way.id, way.tags);
  for (const OsmRelation& relation : osm.relations) look("relation", relation.id, relation.tags);
}

}  // namespace parvis::scene

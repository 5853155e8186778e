#include "formats/ifc/ifc_curves.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <numbers>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace parvis::scene {
namespace {

using glm::dvec3;

constexpr std::string_view curve_name = "IFCINDEXEDPOLYCURVE", list_name = "IFCCARTESIANPOINTLIST";
constexpr double arc_step = std::numbers::pi / 24.0;

/// An instance in the text, "#12=IFCWALL(...)".
struct Instance {
  std::int64_t id = 0;
  std::string_view keyword, attributes;
  std::size_t begin = 0, end = 0;  ///< in the text, without the semicolon
};

bool is_name(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

void skip_blanks(std::string_view text, std::size_t& at) {
  while (at < text.size() && std::isspace(static_cast<unsigned char>(text[at]))) ++at;
}

/// Calls use(instance) for each statement that is an instance, in order.
template <class Use>
void each_instance(std::string_view text, const Use& use) {
  std::size_t begin = 0;
  bool is_text = false;
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (text[at] == '\'') is_text = !is_text;
    if (is_text) continue;
    if (text.substr(at, 2) == "/*") {
      const std::size_t end = text.find("*/", at + 2);
      if (end == std::string_view::npos) return;
      const bool is_between = text.find_first_not_of(" \t\r\n", begin) == at;
      at = end + 1;
      if (is_between) begin = end + 2;
      continue;
    }
    if (text[at] != ';') continue;
    Instance instance;
    instance.begin = begin, instance.end = at;
    begin = at + 1;
    skip_blanks(text, instance.begin);
    std::size_t next = instance.begin;
    if (next >= at || text[next] != '#') continue;
    const auto [id_end, problem] = std::from_chars(text.data() + next + 1, text.data() + at, instance.id);
    next = std::size_t(id_end - text.data());
    skip_blanks(text, next);
    if (problem != std::errc() || next >= at || text[next] != '=') continue;
    skip_blanks(text, ++next);
    const std::size_t first = next;
    while (next < at && is_name(text[next])) ++next;
    instance.keyword = text.substr(first, next - first);
    const std::size_t open = text.find('(', next);
    if (open >= at) continue;
    instance.attributes = text.substr(open + 1, text.rfind(')', at) - open - 1);
    use(instance);
  }
}

/// All numbers of a text, in order; those of `close` are counted as points end.
std::vector<double> numbers_in(std::string_view text) {
  std::vector<double> numbers;
  for (std::size_t at = 0; at < text.size();) {
    double value = 0.0;
    const auto [end, problem] = std::from_chars(text.data() + at, text.data() + text.size(), value);
    if (problem == std::errc()) numbers.push_back(value);
    at = problem == std::errc() ? std::size_t(end - text.data()) : at + 1;
  }
  return numbers;
}

/// The points of a list, "((0.,0.),(6.,0.))", and what follows it.
struct PointList {
  std::size_t dimensions = 2;
  std::vector<dvec3> points;
};

PointList list_of(const Instance& instance) {
  PointList list{instance.keyword.ends_with("3D") ? std::size_t(3) : std::size_t(2), {}};
  const std::size_t end = instance.attributes.find("))");
  const std::vector<double> numbers = numbers_in(instance.attributes.substr(0, end));
  for (std::size_t i = 0; i + list.dimensions <= numbers.size(); i += list.dimensions)
    list.points.emplace_back(numbers[i], numbers[i + 1], list.dimensions == 3 ? numbers[i + 2] : 0.0);
  return list;
}

/// Appends the arc from the last of `points`, which is `a`, through `b` to `c`; straight where they lie on a
/// line.
void append_arc(dvec3 a, dvec3 b, dvec3 c, std::vector<dvec3>& points) {
  const dvec3 ab = b - a, ac = c - a, axis = glm::cross(ab, ac);
  const double area2 = glm::dot(axis, axis);
  if (area2 > 1e-18 * glm::dot(ab, ab) * glm::dot(ac, ac)) {
    const dvec3 centre =
        a +
        (glm::cross(axis, ab) * glm::dot(ac, ac) + glm::cross(ac, axis) * glm::dot(ab, ab)) / (2.0 * area2);
    const dvec3 x = a - centre, y = glm::cross(axis / std::sqrt(area2), x);
    const auto angle_of = [&](dvec3 point) {
      const double angle = std::atan2(glm::dot(point - centre, y), glm::dot(point - centre, x));
      return angle > 0.0 ? angle : angle + 2.0 * std::numbers::pi;
    };
    double from = 0.0;
    for (const dvec3 end : {b, c}) {
      const double to = angle_of(end);
      const int steps = std::max(1, int(std::ceil((to - from) / arc_step)));
      for (int i = 1; i < steps; ++i) {
        const double angle = from + (to - from) * i / steps;
        points.push_back(centre + std::cos(angle) * x + std::sin(angle) * y);
      }
      points.push_back(end);
      from = to;
    }
    return;
  }
  points.push_back(b), points.push_back(c);
}

/// The points along a curve: `attributes` are its list, its segments or "$", and whether it crosses itself.
std::optional<std::vector<dvec3>> points_along(std::string_view attributes, const std::vector<dvec3>& list) {
  const std::size_t first = attributes.find("IFC");
  if (first == std::string_view::npos) return list.size() >= 2 ? std::optional(list) : std::nullopt;
  std::vector<dvec3> points;
  for (std::size_t at = first; at < attributes.size(); at = attributes.find("IFC", at + 3)) {
    const bool is_arc = attributes.substr(at).starts_with("IFCARCINDEX");
    const std::size_t open = attributes.find('(', at), close = attributes.find(')', at);
    if (open == std::string_view::npos || close == std::string_view::npos) return std::nullopt;
    std::vector<dvec3> corners;
    for (const double number : numbers_in(attributes.substr(open, close - open))) {
      if (!(number >= 1.0 && number <= double(list.size()))) return std::nullopt;
      corners.push_back(list[std::size_t(number) - 1]);
    }
    if (corners.size() < 2 || (is_arc && corners.size() != 3)) return std::nullopt;
    if (points.empty() || points.back() != corners.front()) points.push_back(corners.front());
    if (is_arc)
      append_arc(corners[0], corners[1], corners[2], points);
    else
      points.insert(points.end(), corners.begin() + 1, corners.end());
  }
  return points.size() >= 2 ? std::optional(points) : std::nullopt;
}

std::optional<std::int64_t> reference_in(std::string_view attributes) {
  const std::size_t hash = attributes.find('#');
  std::int64_t id = 0;
  if (hash == std::string_view::npos) return std::nullopt;
  const auto [end, problem] =
      std::from_chars(attributes.data() + hash + 1, attributes.data() + attributes.size(), id);
  return problem == std::errc() ? std::optional(id) : std::nullopt;
}

/// A number as STEP writes it: with a point.
std::string step_number(double value) {
  std::string text = fmt::format("{:.12g}", value);
  if (const std::size_t exponent = std::min(text.find('e'), text.size()); text.find('.') == std::string::npos)
    text = fmt::format("{}.{}", text.substr(0, exponent), text.substr(exponent));
  std::ranges::replace(text, 'e', 'E');
  return text;
}

}  // namespace

std::string with_plain_curves(std::string text) {
  if (text.find(curve_name) == std::string::npos) return text;
  std::unordered_map<std::int64_t, Instance> lists;
  std::vector<Instance> curves;
  std::int64_t last_id = 0;
  each_instance(text, [&](const Instance& instance) {
    last_id = std::max(last_id, instance.id);
    if (instance.keyword.starts_with(list_name)) lists.emplace(instance.id, instance);
    if (instance.keyword == curve_name) curves.push_back(instance);
  });
  std::string plain;
  plain.reserve(text.size());
  std::size_t done = 0;
  for (const Instance& curve : curves) {
    const auto list = lists.find(reference_in(curve.attributes).value_or(-1));
    if (list == lists.end()) continue;
    const PointList given = list_of(list->second);
    const auto points = points_along(curve.attributes, given.points);
    if (!points) continue;
    plain.append(text, done, curve.begin - done);
    std::string line;
    for (const dvec3& point : *points) {
      plain +=
          fmt::format("#{}=IFCCARTESIANPOINT(({},{}", ++last_id, step_number(point.x), step_number(point.y));
      plain += given.dimensions == 3 ? fmt::format(",{}));\n", step_number(point.z)) : "));\n";
      line += fmt::format("{}#{}", line.empty() ? "" : ",", last_id);
    }
    plain += fmt::format("#{}=IFCPOLYLINE(({}))", curve.id, line);
    done = curve.end;
  }
  return plain.append(text, done);
}

}  // namespace parvis::scene

// The hint file of a coarse model: one correction per line.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <sstream>

#include "capture/facades/coarse_model.h"

namespace parvis::facades {
namespace {

constexpr std::size_t max_corners = 64;
constexpr std::size_t max_problems = 20;  // of a file of hints: no more are reported

CoarseSurface* find(CoarseModel& model, const std::string& name) {
  const auto found = std::ranges::find(model.surfaces, name, &CoarseSurface::name);
  return found == model.surfaces.end() ? nullptr : &*found;
}

/// Some of them, for a message.
std::string names_of(const CoarseModel& model) {
  constexpr std::size_t enough = 10;
  std::string names;
  for (std::size_t i = 0; i < std::min(enough, model.surfaces.size()); ++i)
    names += (names.empty() ? "" : ", ") + model.surfaces[i].name;
  return model.surfaces.size() > enough ? names + ", ..." : names;
}

/// The words behind the name as numbers; nothing where one is none.
std::optional<std::vector<double>> numbers_of(std::istringstream& words) {
  std::vector<double> numbers;
  for (std::string word; words >> word;) {
    double number = 0.0;
    const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (code != std::errc() || end != word.data() + word.size() || !std::isfinite(number))
      return std::nullopt;
    numbers.push_back(number);
  }
  return numbers;
}

/// Corners 0 and 1 are the lower edge, 2 and 3 the upper one above 1 and 0 (coarse_model.cpp).
bool is_rectangle_of_wall(const CoarseSurface& surface) {
  return surface.kind == SurfaceKind::wall && surface.corners.size() == 4;
}

/// Moves a wall's upper or lower edge along its sides to the height `z`.
void set_height(CoarseSurface& wall, bool is_top, double z) {
  for (const auto& [low, high] : {std::pair(0, 3), std::pair(1, 2)}) {
    const glm::dvec3 below = wall.corners[std::size_t(low)], above = wall.corners[std::size_t(high)];
    wall.corners[std::size_t(is_top ? high : low)] =
        below + (above - below) * ((z - below.z) / (above.z - below.z));
  }
}

/// Moves a wall's left or right end along its edges to where it is nearest to (x, y).
void set_end(CoarseSurface& wall, bool is_right, glm::dvec2 place) {
  const glm::dvec3 edge = wall.corners[1] - wall.corners[0];
  const glm::dvec2 level(edge);
  const double t = glm::dot(place - glm::dvec2(wall.corners[0]), level) / glm::dot(level, level);
  const glm::dvec3 moved = is_right ? edge * (t - 1.0) : edge * t;
  for (const int corner : is_right ? std::array{1, 2} : std::array{0, 3})
    wall.corners[std::size_t(corner)] += moved;
}

/// A polygon's problem, or nothing: fewer than three corners, not flat, not convex.
std::string problem_of(const std::vector<glm::dvec3>& corners) {
  if (corners.size() < 3 || corners.size() > max_corners)
    return "expected 3 to 64 corners of three numbers each";
  glm::dvec3 normal(0.0);
  for (std::size_t i = 0; i < corners.size(); ++i)
    normal += glm::cross(corners[i], corners[(i + 1) % corners.size()]);
  const double size = std::sqrt(glm::length(normal));
  if (!(size > 1e-6)) return "the corners enclose no area";
  normal = glm::normalize(normal);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const glm::dvec3 &a = corners[i], &b = corners[(i + 1) % corners.size()],
                     &c = corners[(i + 2) % corners.size()];
    if (std::abs(glm::dot(normal, a - corners[0])) > 0.01 * size)
      return "the corners do not lie in one plane";
    if (glm::dot(glm::cross(b - a, c - b), normal) < -1e-9 * size * size)
      return "the polygon is concave; divide it";
  }
  return "";
}

std::string set_plane(CoarseModel& model, const std::string& name, const std::vector<double>& numbers) {
  CoarseSurface surface{name, SurfaceKind::wall, {}, 0};
  for (std::size_t i = 0; i + 2 < numbers.size(); i += 3)
    surface.corners.push_back({numbers[i], numbers[i + 1], numbers[i + 2]});
  if (numbers.size() % 3 != 0) return "expected 3 to 64 corners of three numbers each";
  if (std::string problem = problem_of(surface.corners); !problem.empty()) return problem;
  const glm::dvec3 normal = glm::normalize(
      glm::cross(surface.corners[1] - surface.corners[0], surface.corners[2] - surface.corners[0]));
  if (normal.z > 0.94)
    surface.kind = SurfaceKind::ground;
  else if (normal.z > 0.25)
    surface.kind = SurfaceKind::roof;
  if (CoarseSurface* old = find(model, name))
    *old = std::move(surface);
  else
    model.surfaces.push_back(std::move(surface));
  return "";
}

/// Applies one line; what is wrong with it, or nothing.
std::string apply_line(CoarseModel& model, const std::string& line) {
  std::istringstream words(line);
  std::string verb, name;
  words >> verb >> name;
  if (name.empty()) return "expected a surface's name behind \"" + verb + "\"";
  if (verb == "rename") {
    std::string fresh, more;
    words >> fresh >> more;
    CoarseSurface* surface = find(model, name);
    if (!surface) return name + " is no surface; there are " + names_of(model);
    if (fresh.empty() || !more.empty() || find(model, fresh))
      return "expected one new name that no other surface has";
    surface->name = fresh;
    return "";
  }
  const std::optional<std::vector<double>> numbers = numbers_of(words);
  if (!numbers) return "expected numbers behind the name";
  if (verb == "plane") return set_plane(model, name, *numbers);
  CoarseSurface* surface = find(model, name);
  if (!surface) return name + " is no surface; there are " + names_of(model);
  if (verb == "remove") {
    model.surfaces.erase(model.surfaces.begin() + (surface - model.surfaces.data()));
    return numbers->empty() ? "" : "expected nothing behind the name";
  }
  const bool is_height = verb == "top" || verb == "bottom", is_end = verb == "left" || verb == "right";
  if (!is_height && !is_end)
    return "\"" + verb + "\" is no hint; expected remove, rename, top, bottom, left, right or plane";
  if (!is_rectangle_of_wall(*surface)) return name + " is no wall with four corners; give it by plane";
  if (is_height && numbers->size() != 1) return "expected one height in metres";
  if (is_end && numbers->size() != 2) return "expected X and Y of the wall's end";
  if (is_height) set_height(*surface, verb == "top", (*numbers)[0]);
  if (is_end) set_end(*surface, verb == "right", {(*numbers)[0], (*numbers)[1]});
  return "";
}

}  // namespace

Status apply_hints(CoarseModel& model, const std::string& text, const std::string& file) {
  CoarseModel changed = model;
  Errors problems;
  std::istringstream lines(text);
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    line = line.substr(0, line.find('#'));
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    if (const std::string problem = apply_line(changed, line); !problem.empty())
      problems.push_back(error_at({file, number, 0}, "{}", problem));
    if (problems.size() >= max_problems) break;
  }
  if (!problems.empty()) return problems;
  model = std::move(changed);
  return Ok{};
}

}  // namespace parvis::facades

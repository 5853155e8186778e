#include "planning/sun_hours/sun_ground.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <span>

#include "base/known_names.h"
#include "base/plan_polygon.h"
#include "scene/data/model_parts.h"
#include "scene/data/name_pattern.h"

namespace parvis::sun_hours {
namespace {

constexpr std::size_t max_corners = 1'000;
constexpr double min_area_m2 = 1e-3;

/// Whether `point`, which lies on the line through the others, lies between them.
bool is_between(glm::dvec2 a, glm::dvec2 b, glm::dvec2 point) {
  return glm::dot(a - point, b - point) <= 0.0;
}

/// Two sides cross or touch.
bool meet(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c, glm::dvec2 d) {
  const double c_side = twice_area(a, b, c), d_side = twice_area(a, b, d), a_side = twice_area(c, d, a),
               b_side = twice_area(c, d, b);
  if (c_side * d_side < 0.0 && a_side * b_side < 0.0) return true;
  return (c_side == 0.0 && is_between(a, b, c)) || (d_side == 0.0 && is_between(a, b, d)) ||
         (a_side == 0.0 && is_between(c, d, a)) || (b_side == 0.0 && is_between(c, d, b));
}

/// Names of what stands in the scene, for messages.
std::set<std::string> names_in(const scene::Scene& scene) {
  std::set<std::string> names;
  std::set<const scene::Model*> seen;
  const auto add = [&](const std::string& name) {
    if (!name.empty()) names.insert(name);
  };
  for (const scene::Object& object : scene.objects) {
    add(object.name);
    if (!seen.insert(object.model.get()).second) continue;
    for (const scene::Part& part : object.model->parts) {
      add(part.object);
      add(object.model->materials[std::size_t(part.material)].name);
    }
  }
  scene::for_each_traced_kind(scene, [&](const scene::TracedKind& kind, int /*first_thing*/) {
    if (kind.is_recorded) add(kind.name);
  });
  return names;
}

}  // namespace

Result<std::vector<glm::dvec2>> checked_outline(std::vector<glm::dvec2> corners) {
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  while (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
  const std::size_t count = corners.size();
  if (count < 3 || count > max_corners)
    return error("an outline has 3 to {} corners; this one has {}", max_corners, count);
  const auto corner = [&](std::size_t i) { return corners[i % count]; };
  double sum = 0.0;
  for (std::size_t i = 0; i < count; ++i) sum += twice_area(corner(0), corner(i), corner(i + 1));
  // Sides that follow each other share a corner: they must not lie over each other. Others must not meet.
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dvec2 here = corner(i + 1), before = corner(i), after = corner(i + 2);
    const bool turns_back =
        twice_area(before, here, after) == 0.0 && glm::dot(before - here, after - here) > 0.0;
    if (turns_back)
      return error("the outline goes back over itself at its corner {}: \"{:g} {:g}\"", (i + 1) % count + 1,
                   here.x, here.y);
    for (std::size_t k = i + 2; k < count; ++k)
      if ((k + 1) % count != i && meet(corner(i), corner(i + 1), corner(k), corner(k + 1)))
        return error(
            "the outline crosses itself: its side from corner {} to {} meets that from corner {} to {}; give "
            "the corners in their order around the ground",
            i + 1, i + 2, k + 1, (k + 1) % count + 1);
  }
  if (!(std::abs(sum) >= 2.0 * min_area_m2)) return error("the outline has no area");
  return corners;
}

std::vector<std::uint8_t> cells_inside(const std::vector<glm::dvec2>& outline, glm::dvec2 corner,
                                       double cell_m, int columns, int rows) {
  std::vector<std::uint8_t> inside(std::size_t(columns) * std::size_t(rows), 0);
  for (int row = 0; row < rows; ++row) {
    const std::vector<double> crossings = crossings_of_line(
        std::span<const std::vector<glm::dvec2>>(&outline, 1), corner.y + (row + 0.5) * cell_m);
    for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
      const auto column_at = [&](double place) {
        return int(std::clamp(std::ceil((place - corner.x) / cell_m - 0.5), 0.0, double(columns)));
      };
      for (int column = column_at(crossings[i]); column < column_at(crossings[i + 1]); ++column)
        inside[std::size_t(row) * std::size_t(columns) + std::size_t(column)] = 1;
    }
  }
  return inside;
}

Result<NamedSurfaces> NamedSurfaces::find(const scene::Scene& scene, const std::vector<std::string>& names) {
  NamedSurfaces found;
  found.parts_.reserve(scene.objects.size());
  for (const scene::Object& object : scene.objects)
    found.parts_.emplace_back(object.model->parts.size(), std::uint8_t(0));
  for (const std::string& name : names) {
    bool is_known = false;
    std::map<const scene::Model*, std::vector<std::size_t>> in_models;
    for (std::size_t o = 0; o < scene.objects.size(); ++o) {
      const scene::Object& object = scene.objects[o];
      std::vector<std::uint8_t>& flags = found.parts_[o];
      if (name.empty()) break;  // most parts have no name: that means none of them
      if (scene::matches(name, object.name)) {
        std::ranges::fill(flags, std::uint8_t(1));
        is_known = true;
        continue;
      }
      const auto [parts, is_new] = in_models.try_emplace(object.model.get());
      if (is_new) parts->second = scene::matching_parts(*object.model, name);
      for (const std::size_t part : parts->second) flags[part] = 1;
      is_known = is_known || !parts->second.empty();
    }
    scene::for_each_traced_kind(scene, [&](const scene::TracedKind& kind, int first_thing) {
      if (!kind.is_recorded || !scene::matches(name, kind.name)) return;
      const std::size_t first = std::size_t(first_thing) - scene.objects.size(),
                        end = first + std::size_t(kind.count(scene));
      found.things_.resize(std::max(found.things_.size(), end), 0);
      std::fill(found.things_.begin() + std::ptrdiff_t(first), found.things_.begin() + std::ptrdiff_t(end),
                std::uint8_t(1));
      is_known = true;
    });
    if (is_known) continue;
    const std::set<std::string> known = names_in(scene);
    return error("nothing in the scene is called \"{}\"{}", name,
                 names_that_exist(name, std::vector(known.begin(), known.end())));
  }
  return found;
}

bool NamedSurfaces::has(const reference::PlacedPart& place) const {
  const auto object = std::size_t(place.object);
  if (object < parts_.size()) return parts_[object][std::size_t(place.part)] != 0;
  const std::size_t thing = object - parts_.size();
  return thing < things_.size() && things_[thing] != 0;
}

}  // namespace parvis::sun_hours

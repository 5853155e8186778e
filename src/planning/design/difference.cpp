#include "planning/design/difference.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

namespace parvis::design {
namespace {

constexpr double same_foot_m = 0.05, same_length_m = 1e-4, same_angle_deg = 0.01;

bool looks_alike(const PlacedObject& a, const PlacedObject& b) {
  return glm::distance(a.size_m, b.size_m) < same_length_m && glm::distance(a.colour, b.colour) < 1e-3f &&
         a.material == b.material;
}

double turned_deg(const PlacedObject& a, const PlacedObject& b) {
  return std::abs(std::remainder(a.heading_deg - b.heading_deg, 360.0));
}

/// The counterpart of each object of `after`, an index into `before`.
std::vector<std::optional<std::size_t>> counterparts(const std::vector<PlacedObject>& before,
                                                     const std::vector<PlacedObject>& after) {
  std::vector<std::optional<std::size_t>> found(after.size());
  std::vector<bool> is_taken(before.size(), false);
  const auto match = [&](const auto& is_same) {
    for (std::size_t i = 0; i < after.size(); ++i)
      for (std::size_t k = 0; k < before.size() && !found[i]; ++k)
        if (!is_taken[k] && before[k].kind == after[i].kind && is_same(before[k], after[i]))
          found[i] = k, is_taken[k] = true;
  };
  match([](const PlacedObject& a, const PlacedObject& b) { return a.name == b.name; });
  match([](const PlacedObject& a, const PlacedObject& b) {
    return glm::distance(a.position, b.position) < same_foot_m &&
           glm::distance(a.size_m, b.size_m) < same_foot_m;
  });
  return found;
}

}  // namespace

std::vector<Difference> differences(const std::vector<PlacedObject>& before,
                                    const std::vector<PlacedObject>& after) {
  const std::vector<std::optional<std::size_t>> found = counterparts(before, after);
  std::vector<Difference> all;
  for (std::size_t k = 0; k < before.size(); ++k)
    if (std::ranges::find(found, std::optional(k)) == found.end())
      all.push_back({Differs::removed, before[k], {}});
  for (std::size_t i = 0; i < after.size(); ++i) {
    if (!found[i]) {
      all.push_back({Differs::added, {}, after[i]});
      continue;
    }
    const PlacedObject& old = before[*found[i]];
    const double moved_m = glm::distance(old.position, after[i].position);
    if (moved_m > same_length_m || turned_deg(old, after[i]) > same_angle_deg)
      all.push_back({Differs::moved, old, after[i], moved_m});
    else if (!looks_alike(old, after[i]))
      all.push_back({Differs::changed, old, after[i]});
  }
  return all;
}

const char* name_of(Differs how) {
  constexpr std::array names{"added", "removed", "moved", "changed"};
  return names[std::size_t(how)];
}

std::string line_of(const Difference& difference) {
  const PlacedObject& object = difference.shown();
  std::string line = fmt::format("{:<8} {:<14} {:<18} ", name_of(difference.how), object.kind, object.name);
  if (difference.how == Differs::moved) line += fmt::format("by {:.2f} m to ", difference.moved_m);
  line += fmt::format("{:.3f},{:.3f} heading {:g}", object.position.x, object.position.y, object.heading_deg);
  if (difference.how == Differs::changed)
    line += fmt::format(", {:g} x {:g} x {:g} m (was {:g} x {:g} x {:g})", object.size_m.x, object.size_m.y,
                        object.size_m.z, difference.before.size_m.x, difference.before.size_m.y,
                        difference.before.size_m.z);
  return line;
}

}  // namespace parvis::design

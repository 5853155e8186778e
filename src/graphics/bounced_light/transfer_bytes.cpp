// A transfer as bytes, and whether bytes from a file are one.
#include <algorithm>
#include <cmath>

#include "base/sealed_file.h"
#include "graphics/bounced_light/transfer.h"

namespace parvis::bounced_light {
namespace {

bool is_finite(glm::vec3 value) {
  return std::isfinite(value.x) && std::isfinite(value.y) && std::isfinite(value.z);
}

bool is_finite(const Patch& patch) {
  return is_finite(patch.position) && is_finite(patch.normal) && is_finite(patch.albedo);
}

void append(std::string& bytes, const Patch& patch) {  // by member: a copy would hold what lies between them
  for (const glm::vec3 value : {patch.position, patch.normal, patch.albedo}) append_value(bytes, value);
  append_value(bytes, patch.sees_sky);
}

Patch take_patch(Taker& taker) {
  Patch patch;
  for (glm::vec3* value : {&patch.position, &patch.normal, &patch.albedo}) *value = taker.take<glm::vec3>();
  patch.sees_sky = taker.take<decltype(patch.sees_sky)>();
  return patch;
}

}  // namespace

std::string Transfer::to_bytes() const {
  std::string bytes;
  append_value(bytes, grid_);
  append_value(bytes, cells_);
  append_value(bytes, rays_);
  append_values(bytes, air_);
  append_values(bytes, seen_);
  append_values(bytes, is_air_);
  append_value(bytes, std::uint32_t(patches_.size()));
  for (const Patch& patch : patches_) append(bytes, patch);
  append_values(bytes, lit_points_);
  return bytes;
}

std::optional<Transfer> Transfer::from_bytes(std::string_view bytes) {
  Taker taker(bytes);
  Transfer result;
  result.grid_ = taker.take<shading::BouncedGrid>();
  result.cells_ = taker.take<glm::ivec3>();
  result.rays_ = taker.take<int>();
  result.air_ = taker.take_values<std::uint32_t>();
  result.seen_ = taker.take_values<std::int32_t>();
  result.is_air_ = taker.take_values<std::uint8_t>();
  for (auto left = taker.take<std::uint32_t>(); left > 0 && !taker.has_ended_early(); --left)
    result.patches_.push_back(take_patch(taker));
  result.lit_points_ = taker.take_values<glm::vec3>();
  if (!taker.is_at_end() || !result.is_consistent()) return std::nullopt;
  result.find_walls();
  return result;
}

bool Transfer::is_consistent() const {
  constexpr int max_cells_along = 1 << 20;
  const auto is_count = [](int value) { return value >= 0 && value <= max_cells_along; };
  if (!is_count(cells_.x) || !is_count(cells_.y) || !is_count(cells_.z) || rays_ < 0) return false;
  const std::size_t layer = std::size_t(cells_.x) * std::size_t(cells_.y);
  const auto is_place = [&](std::uint32_t cell) { return cell < is_air_.size() && is_air_[cell] != 0; };
  const auto is_patch = [&](std::int32_t patch) {
    return patch >= -1 && patch < std::int64_t(patches_.size());
  };
  return layer * std::size_t(cells_.z) == is_air_.size() && is_finite(grid_.origin) &&
         is_finite(grid_.size_m) && glm::all(glm::greaterThan(grid_.size_m, glm::vec3(0.0f))) &&
         std::isfinite(grid_.lift_m) && grid_.layers == float(cells_.z) &&
         seen_.size() == air_.size() * std::size_t(rays_) && std::ranges::all_of(air_, is_place) &&
         std::ranges::all_of(seen_, is_patch) &&
         std::ranges::all_of(patches_, [](const Patch& patch) { return is_finite(patch); }) &&
         lit_points_.size() == lit_points_per_patch * patches_.size() &&
         std::ranges::all_of(lit_points_, [](glm::vec3 point) { return is_finite(point); });
}

}  // namespace parvis::bounced_light

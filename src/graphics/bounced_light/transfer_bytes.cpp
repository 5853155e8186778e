// A transfer as bytes, and whether bytes from a file are one.
#include <algorithm>
#include <cmath>
#include <functional>

#include "base/sealed_file.h"
#include "graphics/bounced_light/transfer.h"

namespace parvis::bounced_light {
namespace {

bool is_finite(glm::vec3 value) {
  return std::isfinite(value.x) && std::isfinite(value.y) && std::isfinite(value.z);
}

bool is_unit(glm::vec3 direction) { return std::abs(glm::length(direction) - 1.0f) < 1e-3f; }

void append(std::string& bytes, const Patch& patch) {  // by member: a copy would hold what lies between them
  for (const glm::vec3 value : {patch.position, patch.normal, patch.albedo}) append_value(bytes, value);
  append_value(bytes, patch.sees_sky);
}

Patch take_patch(ByteReader& reader) {
  Patch patch;
  for (glm::vec3* value : {&patch.position, &patch.normal, &patch.albedo}) *value = reader.take<glm::vec3>();
  patch.sees_sky = reader.take<decltype(patch.sees_sky)>();
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
  ByteReader reader(bytes);
  Transfer result;
  result.grid_ = reader.take<shading::BouncedGrid>();
  result.cells_ = reader.take<glm::ivec3>();
  result.rays_ = reader.take<int>();
  result.air_ = reader.take_values<std::uint32_t>();
  result.seen_ = reader.take_values<std::int32_t>();
  result.is_air_ = reader.take_values<std::uint8_t>();
  for (auto left = reader.take<std::uint32_t>(); left > 0 && !reader.has_ended_early(); --left)
    result.patches_.push_back(take_patch(reader));
  result.lit_points_ = reader.take_values<glm::vec3>();
  if (!reader.is_at_end() || !result.is_consistent()) return std::nullopt;
  result.find_walls();
  return result;
}

/// Checks a transfer read from bytes, which is used without further checks: sizes, indices, all that becomes
/// a cell.
bool Transfer::is_consistent() const {
  constexpr int max_cells_along = 1 << 20;
  const auto is_count = [](int value) { return value >= 0 && value <= max_cells_along; };
  if (!is_count(cells_.x) || !is_count(cells_.y) || !is_count(cells_.z)) return false;
  if (rays_ < (air_.empty() ? 0 : 1) || rays_ > max_rays) return false;
  const std::size_t layer = std::size_t(cells_.x) * std::size_t(cells_.y);
  const auto is_place = [&](std::uint32_t cell) { return cell < is_air_.size() && is_air_[cell] != 0; };
  const auto is_seen = [&](std::int32_t patch) {
    return patch >= -1 && patch < std::int64_t(patches_.size());
  };
  const auto is_inside = [&](glm::vec3 point) {
    const glm::vec3 share = (point - grid_.origin) / grid_.size_m;
    return glm::all(glm::greaterThanEqual(share, glm::vec3(0.0f))) &&
           glm::all(glm::lessThanEqual(share, glm::vec3(1.0f)));
  };
  const auto is_patch = [&](const Patch& patch) {
    return is_inside(patch.position) && is_unit(patch.normal) && is_finite(patch.albedo);
  };
  const float smallest_m = std::min({grid_.size_m.x, grid_.size_m.y, grid_.size_m.z});
  return layer * std::size_t(cells_.z) == is_air_.size() && grid_.layers == float(cells_.z) &&
         is_finite(grid_.origin) && is_finite(grid_.size_m) && smallest_m > 0.0f && grid_.lift_m >= 0.0f &&
         grid_.lift_m <= smallest_m && std::ranges::all_of(air_, is_place) &&
         std::ranges::adjacent_find(air_, std::ranges::greater_equal{}) == air_.end() &&
         std::size_t(std::ranges::count(is_air_, 0)) + air_.size() == is_air_.size() &&
         seen_.size() == air_.size() * std::size_t(rays_) && std::ranges::all_of(seen_, is_seen) &&
         std::ranges::all_of(patches_, is_patch) &&
         lit_points_.size() == lit_points_per_patch * patches_.size() &&
         std::ranges::all_of(lit_points_, is_inside);
}

}  // namespace parvis::bounced_light

#include "places/car_bodies/wheel_arches.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace parvis::car_bodies {
namespace {

constexpr float probe_fraction = 0.3f;      // of the height: every arch is open here
constexpr float max_arch_fraction = 0.75f;  // of the height: no arch rises above
constexpr float min_inset_m = 0.06f;        // of an arch behind the skin beside it
constexpr float skin_reach_m = 0.6f;        // along the car, in which the skin is looked for
constexpr float min_arch_m = 0.4f, max_arch_m = 1.3f;
constexpr float min_radius_m = 0.2f, max_radius_m = 0.8f;
constexpr float gap_m = 0.04f;            // between tyre and arch
constexpr float tyre_fraction = 0.82f;    // of the arch's radius
constexpr float width_fraction = 0.6f;    // of the tyre's radius
constexpr float max_clearance_m = 0.22f;  // between the road and the lowest point of the body

/// How far out the skin of doors and wings lies about a column.
float skin_depth(const SideView& side, int column) {
  const int reach = int(skin_reach_m / SideView::cell_m);
  std::vector<float> depths;
  for (int c = std::max(0, column - reach); c <= std::min(side.columns() - 1, column + reach); ++c)
    for (int row = side.row_at(0.3f); row < side.row_at(0.6f); ++row)
      if (side.depth(c, row) > 0.0f) depths.push_back(side.depth(c, row));
  if (depths.empty()) return 0.0f;
  const auto high = depths.begin() + std::ptrdiff_t(0.8 * double(depths.size()));
  std::nth_element(depths.begin(), high, depths.end());
  return *high;
}

/// The upper edge of the opening in a column at the height of the axles; 0: there is none.
float arch_top(const SideView& side, int column, float skin_m) {
  int row = side.row_at(probe_fraction);
  const auto is_open = [&] { return side.depth(column, row) < skin_m - min_inset_m; };
  if (!is_open()) return 0.0f;
  const int last = side.row_at(max_arch_fraction);
  while (row < last && is_open()) ++row;
  return row < last ? side.z(row) : 0.0f;
}

struct Arch {
  glm::vec2 centre{0.0f};  // x, z
  float radius = 0.0f, top = 0.0f, skin = 0.0f;
};

/// The circle through points by least squares of the equation of the circle, which is linear in its centre.
Arch circle_through(std::span<const glm::vec2> points) {
  glm::dvec2 mean(0.0);
  for (const glm::vec2& point : points) mean += glm::dvec2(point) / double(points.size());
  double uu = 0, vv = 0, uv = 0, u3 = 0, v3 = 0;
  for (const glm::vec2& point : points) {
    const glm::dvec2 d = glm::dvec2(point) - mean;
    const double squared = glm::dot(d, d);
    uu += d.x * d.x, vv += d.y * d.y, uv += d.x * d.y, u3 += d.x * squared, v3 += d.y * squared;
  }
  const double determinant = uu * vv - uv * uv;
  Arch arch;
  if (!(std::abs(determinant) > 1e-12)) return arch;
  const glm::dvec2 centre = 0.5 * glm::dvec2(u3 * vv - v3 * uv, v3 * uu - u3 * uv) / determinant;
  arch.centre = glm::vec2(mean + centre);
  arch.radius = float(std::sqrt(glm::dot(centre, centre) + (uu + vv) / double(points.size())));
  for (const glm::vec2& point : points) arch.top = std::max(arch.top, point.y);
  return arch;
}

std::vector<Arch> find_arches(const SideView& side) {
  std::vector<Arch> arches;
  std::vector<glm::vec2> edge;
  float skin_sum = 0.0f;
  for (int column = 0; column <= side.columns(); ++column) {
    const float skin = column < side.columns() ? skin_depth(side, column) : 0.0f;
    const float top = column < side.columns() ? arch_top(side, column, skin) : 0.0f;
    if (top > 0.0f) {
      edge.emplace_back(side.x(column), top);
      skin_sum += skin;
      continue;
    }
    const float width_m = float(edge.size()) * SideView::cell_m;
    if (width_m >= min_arch_m && width_m <= max_arch_m) {
      Arch arch = circle_through(edge);
      arch.skin = skin_sum / float(edge.size());
      if (arch.radius >= min_radius_m && arch.radius <= max_radius_m) arches.push_back(arch);
    }
    edge.clear();
    skin_sum = 0.0f;
  }
  return arches;
}

}  // namespace

std::optional<WheelFit> fit_wheels(const SideView& side) {
  const std::vector<Arch> arches = find_arches(side);
  if (arches.size() < 2) return std::nullopt;
  const Arch &first = arches.front(), &last = arches.back();
  const float top = 0.5f * (first.top + last.top) - gap_m;
  WheelFit fit;
  fit.left_x = first.centre.x, fit.right_x = last.centre.x;
  // Never so small that the body would reach below the road, nor so large that it would stand on stilts: the
  // circle through a flat arch is larger than its wheel.
  const float body_m = top - side.bounds().min.z;
  fit.radius = std::clamp(tyre_fraction * 0.5f * (first.radius + last.radius), 0.5f * body_m,
                          0.5f * (body_m + max_clearance_m));
  fit.axle_z = top - fit.radius;
  fit.width = width_fraction * fit.radius;
  fit.track = 2.0f * (std::min(first.skin, last.skin) - 0.5f * fit.width - 0.01f);
  return fit;
}

bool faces_back(const SideView& side) {
  double sum = 0.0, count = 0.0;
  for (int row = side.row_at(0.75f); row < side.rows(); ++row)
    for (int column = 0; column < side.columns(); ++column)
      if (side.depth(column, row) > 0.0f) sum += double(side.x(column)), ++count;
  return count > 0.0 && sum / count > double(side.bounds().centre().x);
}

}  // namespace parvis::car_bodies

#include "capture/facades/plane_patch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace parvis::facades {
namespace {

constexpr int rim_width = 4;  ///< points of the rim that a shift must fit
constexpr float max_rim_difference =
    0.02f;  ///< mean square per channel beyond which a shift does not fit at all
constexpr float max_irregularity = 0.05f;  ///< of shifts of which little is known
constexpr std::size_t max_sample_points = 800;
constexpr std::size_t max_rim_points = 200;  ///< compared per shift: more cost time and decide nothing
constexpr std::array<glm::ivec2, 4> neighbours = {glm::ivec2(1, 0), glm::ivec2(-1, 0), glm::ivec2(0, 1),
                                                  glm::ivec2(0, -1)};

struct Group {
  std::vector<glm::ivec2> points, rim;
  glm::ivec2 low{std::numeric_limits<int>::max()}, high{std::numeric_limits<int>::lowest()};
};

std::vector<Group> missing_groups(const PlaneGrid& grid) {
  std::vector<Group> groups;
  std::vector<char> is_visited(grid.colours.size(), 0);
  for (int y = 0; y < grid.height; ++y)
    for (int x = 0; x < grid.width; ++x) {
      if (!grid.is_missing[grid.index(x, y)] || is_visited[grid.index(x, y)]) continue;
      Group& group = groups.emplace_back();
      group.points.push_back({x, y});
      is_visited[grid.index(x, y)] = 1;
      for (std::size_t k = 0; k < group.points.size(); ++k)
        for (const glm::ivec2& step : neighbours) {
          const glm::ivec2 p = group.points[k] + step;
          if (!grid.contains(p.x, p.y) || !grid.is_missing[grid.index(p.x, p.y)] ||
              is_visited[grid.index(p.x, p.y)])
            continue;
          is_visited[grid.index(p.x, p.y)] = 1;
          group.points.push_back(p);
        }
      for (const glm::ivec2& p : group.points)
        group.low = glm::min(group.low, p), group.high = glm::max(group.high, p);
    }
  return groups;
}

/// Known points within rim_width of the group.
void find_rim(const PlaneGrid& grid, Group& group) {
  const glm::ivec2 origin = group.low - rim_width, size = group.high - group.low + 1 + 2 * rim_width;
  std::vector<char> is_near(std::size_t(size.x) * std::size_t(size.y), 0);
  const auto near_at = [&](int x, int y) -> char& {
    return is_near[std::size_t(y - origin.y) * std::size_t(size.x) + std::size_t(x - origin.x)];
  };
  for (const glm::ivec2& p : group.points)
    for (int dy = -rim_width; dy <= rim_width; ++dy)
      for (int dx = -rim_width; dx <= rim_width; ++dx) near_at(p.x + dx, p.y + dy) = 1;
  for (int y = std::max(group.low.y - rim_width, 0); y <= std::min(group.high.y + rim_width, grid.height - 1);
       ++y)
    for (int x = std::max(group.low.x - rim_width, 0);
         x <= std::min(group.high.x + rim_width, grid.width - 1); ++x)
      if (near_at(x, y) && grid.is_known[grid.index(x, y)]) group.rim.push_back({x, y});
}

/// Mean square difference at the rim; nothing where the shift leads to unknown points.
std::optional<float> misfit(const PlaneGrid& grid, const Group& group, glm::ivec2 shift,
                            float worth_beating) {
  for (const glm::ivec2& p : group.points) {
    const glm::ivec2 q = p + shift;
    if (!grid.contains(q.x, q.y) || !grid.is_known[grid.index(q.x, q.y)]) return std::nullopt;
  }
  const std::size_t step = std::max<std::size_t>(group.rim.size() / max_rim_points, 1);
  float sum = 0.0f, count = 0.0f, all = 0.0f;
  for (std::size_t k = 0; k < group.rim.size(); k += step, ++all) {
    const glm::ivec2 p = group.rim[k], q = p + shift;
    if (!grid.contains(q.x, q.y) || !grid.is_known[grid.index(q.x, q.y)]) continue;
    const glm::vec3 d = grid.colours[grid.index(p.x, p.y)] - grid.colours[grid.index(q.x, q.y)];
    sum += glm::dot(d, d) / 3.0f, ++count;
    if (sum > worth_beating * float(group.rim.size() / step + 1)) return std::nullopt;
  }
  if (count < 0.7f * all || count == 0.0f) return std::nullopt;
  return sum / count;
}

/// Known points spread over the plane.
std::vector<glm::ivec2> sample_points(const PlaneGrid& grid) {
  std::vector<glm::ivec2> known, sample;
  for (int y = 0; y < grid.height; ++y)
    for (int x = 0; x < grid.width; ++x)
      if (grid.is_known[grid.index(x, y)]) known.push_back({x, y});
  const std::size_t step = std::max<std::size_t>(known.size() / max_sample_points, 1) | 1;
  for (std::size_t k = 0; k < known.size(); k += step) sample.push_back(known[k]);
  return sample;
}

/// Mean square difference of the whole plane from itself under a shift: small where the plane repeats (He and
/// Sun's dominant shifts). The rim alone rarely sees enough to say where the next window is.
float irregularity(const PlaneGrid& grid, const std::vector<glm::ivec2>& sample, glm::ivec2 shift) {
  float sum = 0.0f, count = 0.0f;
  for (const glm::ivec2& p : sample) {
    const glm::ivec2 q = p + shift;
    if (!grid.contains(q.x, q.y) || !grid.is_known[grid.index(q.x, q.y)]) continue;
    const glm::vec3 d = grid.colours[grid.index(p.x, p.y)] - grid.colours[grid.index(q.x, q.y)];
    sum += glm::dot(d, d) / 3.0f, ++count;
  }
  return count >= 0.1f * float(sample.size()) ? sum / count : max_irregularity;
}

/// The irregularity of each shift of a plane, computed when a group first asks for it.
class Irregularities {
 public:
  explicit Irregularities(const PlaneGrid& grid)
      : grid_(grid),
        sample_(sample_points(grid)),
        known_(std::size_t(2 * grid.width) * std::size_t(2 * grid.height), -1.0f) {}

  float of(glm::ivec2 shift) {
    float& known = known_[std::size_t(shift.y + grid_.height) * std::size_t(2 * grid_.width) +
                          std::size_t(shift.x + grid_.width)];
    if (known < 0.0f) known = irregularity(grid_, sample_, shift);
    return known;
  }

 private:
  const PlaneGrid& grid_;
  std::vector<glm::ivec2> sample_;
  std::vector<float> known_;
};

std::optional<glm::ivec2> best_shift(const PlaneGrid& grid, const Group& group,
                                     Irregularities& irregularities) {
  std::optional<glm::ivec2> best;
  float minimum = max_rim_difference + max_irregularity;
  for (int dy = -group.low.y; dy + group.high.y < grid.height; ++dy)
    for (int dx = -group.low.x; dx + group.high.x < grid.width; ++dx) {
      const std::optional<float> rim = misfit(grid, group, {dx, dy}, std::min(minimum, max_rim_difference));
      if (!rim || *rim >= std::min(minimum, max_rim_difference)) continue;
      if (const float all = *rim + irregularities.of({dx, dy}); all < minimum)
        minimum = all, best = glm::ivec2(dx, dy);
    }
  return best;
}

/// Values of a harmonic function on `points` that continues what `value_of` gives at known points around.
template <class ValueOf>
std::vector<glm::vec3> membrane(const PlaneGrid& grid, const std::vector<glm::ivec2>& points,
                                ValueOf value_of) {
  constexpr int unknown = -1;
  std::vector<int> number(grid.colours.size(), unknown);
  for (std::size_t k = 0; k < points.size(); ++k) number[grid.index(points[k].x, points[k].y)] = int(k);
  std::vector<glm::vec3> values(points.size(), glm::vec3(0.0f));
  glm::vec3 mean(0.0f);
  float count = 0.0f;
  const auto is_fixed = [&](glm::ivec2 p) {
    return grid.contains(p.x, p.y) && number[grid.index(p.x, p.y)] == unknown &&
           grid.is_known[grid.index(p.x, p.y)];
  };
  for (const glm::ivec2& p : points)
    for (const glm::ivec2& step : neighbours)
      if (is_fixed(p + step)) mean += value_of(p + step), ++count;
  std::ranges::fill(values, count > 0.0f ? mean / count : mean);
  // Successive over-relaxation; the rounds reach across groups of a few hundred points.
  const int rounds = int(std::clamp<std::size_t>(4 * std::size_t(std::sqrt(double(points.size()))), 40, 600));
  for (int round = 0; round < rounds; ++round)
    for (std::size_t k = 0; k < points.size(); ++k) {
      glm::vec3 sum(0.0f);
      float n = 0.0f;
      for (const glm::ivec2& step : neighbours) {
        const glm::ivec2 p = points[k] + step;
        if (!grid.contains(p.x, p.y)) continue;
        if (const int other = number[grid.index(p.x, p.y)]; other != unknown)
          sum += values[std::size_t(other)], ++n;
        else if (is_fixed(p))
          sum += value_of(p), ++n;
      }
      if (n > 0.0f) values[k] += 1.8f * (sum / n - values[k]);
    }
  return values;
}

void finish(PlaneGrid& grid, const Group& group, const std::vector<glm::vec3>& colours,
            std::vector<char>& filled) {
  for (std::size_t k = 0; k < group.points.size(); ++k) {
    const std::size_t i = grid.index(group.points[k].x, group.points[k].y);
    grid.colours[i] = glm::clamp(colours[k], 0.0f, 1.0f);
    grid.is_missing[i] = 0, filled[i] = 1;
  }
}

}  // namespace

std::vector<char> fill_by_shifts(PlaneGrid& grid) {
  std::vector<char> filled(grid.colours.size(), 0);
  Irregularities irregularities(grid);
  for (Group& group : missing_groups(grid)) {
    find_rim(grid, group);
    const std::optional<glm::ivec2> shift =
        group.rim.empty() ? std::nullopt : best_shift(grid, group, irregularities);
    if (!shift) continue;
    const auto copied = [&](glm::ivec2 p) {
      return grid.colours[grid.index(p.x + shift->x, p.y + shift->y)];
    };
    std::vector<glm::vec3> colours = membrane(grid, group.points, [&](glm::ivec2 p) {
      const glm::ivec2 q = p + *shift;
      const bool has_source = grid.contains(q.x, q.y) && grid.is_known[grid.index(q.x, q.y)];
      return has_source ? grid.colours[grid.index(p.x, p.y)] - copied(p) : glm::vec3(0.0f);
    });
    for (std::size_t k = 0; k < colours.size(); ++k) colours[k] += copied(group.points[k]);
    finish(grid, group, colours, filled);
  }
  return filled;  // what was filled is not marked as known: it is no source for other groups
}

std::vector<char> fill_smoothly(PlaneGrid& grid) {
  std::vector<char> filled(grid.colours.size(), 0);
  for (Group& group : missing_groups(grid)) {
    find_rim(grid, group);
    if (group.rim.empty()) continue;
    finish(grid, group,
           membrane(grid, group.points, [&](glm::ivec2 p) { return grid.colours[grid.index(p.x, p.y)]; }),
           filled);
  }
  return filled;
}

}  // namespace parvis::facades

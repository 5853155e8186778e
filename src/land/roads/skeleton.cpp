#include "land/roads/skeleton.h"

#include <algorithm>
#include <array>
#include <utility>

namespace parvis::scene {

namespace {

using Cell = glm::ivec2;

/// The eight neighbours, counter-clockwise from east.
constexpr std::array<std::array<int, 2>, 8> around{
    {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};

bool is_set(const Mask& mask, Cell cell) {
  return mask.contains(cell.x, cell.y) && mask.at(cell.x, cell.y) != 0;
}

Cell neighbour(Cell cell, std::size_t direction) {
  return cell + Cell(around[direction][0], around[direction][1]);
}

/// Whether thinning may take the cell in this of its two passes: it lies on the edge, and nothing falls
/// apart.
bool may_go(const Mask& mask, Cell cell, bool is_second_pass) {
  std::array<bool, 8> n{};
  int count = 0, risings = 0;
  for (std::size_t i = 0; i < 8; ++i) count += n[i] = is_set(mask, neighbour(cell, i));
  if (count < 2 || count > 6) return false;
  for (std::size_t i = 0; i < 8; ++i) risings += !n[i] && n[(i + 1) % 8];
  if (risings != 1) return false;
  const bool east = n[0], north = n[2], west = n[4], south = n[6];
  return is_second_pass ? !(north && east && west) && !(north && south && west)
                        : !(north && east && south) && !(east && south && west);
}

bool is_on_edge(const Mask& mask, Cell cell) {
  for (std::size_t i = 0; i < 8; ++i)
    if (!is_set(mask, neighbour(cell, i))) return true;
  return false;
}

/// Only cells on the edge are looked at: those inside stay until others have gone. So the time grows with the
/// area, not with the area times the width.
Mask thinned(Mask mask) {
  std::vector<Cell> edge;
  Mask is_listed(mask, 0);
  const auto list = [&](Cell cell) {
    if (!is_set(mask, cell) || is_listed.at(cell.x, cell.y)) return;
    is_listed.at(cell.x, cell.y) = 1;
    edge.push_back(cell);
  };
  for (int y = 0; y < mask.height; ++y)
    for (int x = 0; x < mask.width; ++x)
      if (mask.at(x, y) && is_on_edge(mask, {x, y})) list({x, y});
  std::vector<Cell> leaving;
  bool has_left = true;
  while (std::exchange(has_left, false)) {
    for (const bool is_second_pass : {false, true}) {
      leaving.clear();
      for (const Cell cell : edge)
        if (may_go(mask, cell, is_second_pass)) leaving.push_back(cell);
      for (const Cell cell : leaving) mask.at(cell.x, cell.y) = 0;
      for (const Cell cell : leaving)
        for (std::size_t i = 0; i < 8; ++i) list(neighbour(cell, i));
      std::erase_if(edge, [&](Cell cell) { return mask.at(cell.x, cell.y) == 0; });
      has_left |= !leaving.empty();
    }
  }
  return mask;
}

/// Neighbours on the thinned line; a diagonal step counts only where no two straight ones lead there.
std::vector<Cell> steps_from(const Mask& line, Cell cell) {
  std::vector<Cell> steps;
  for (std::size_t i = 0; i < 8; ++i) {
    const bool is_diagonal = i % 2 == 1;
    if (!is_set(line, neighbour(cell, i))) continue;
    const bool has_detour =
        is_diagonal && (is_set(line, neighbour(cell, i - 1)) || is_set(line, neighbour(cell, (i + 1) % 8)));
    if (!has_detour) steps.push_back(neighbour(cell, i));
  }
  return steps;
}

class Tracer {
 public:
  Tracer(const Mask& line, const GroundRaster<float>& radii)
      : line_(line), radii_(radii), node_of_(line, -1), is_done_(line, 0) {}

  Skeleton trace() {
    for_each_cell([&](Cell cell) {
      if (steps_from(line_, cell).size() != 2) add_node(cell);
    });
    for_each_cell([&](Cell cell) {
      if (node_of_.at(cell.x, cell.y) >= 0)
        for (const Cell step : steps_from(line_, cell)) follow(cell, step);
    });
    for_each_cell([&](Cell cell) {  // what is left are rings
      if (is_done_.at(cell.x, cell.y) || node_of_.at(cell.x, cell.y) >= 0) return;
      add_node(cell);
      follow(cell, steps_from(line_, cell).front());
    });
    return std::move(skeleton_);
  }

 private:
  template <class Visit>
  void for_each_cell(Visit&& visit) {
    for (int y = 0; y < line_.height; ++y)
      for (int x = 0; x < line_.width; ++x)
        if (line_.at(x, y)) visit(Cell(x, y));
  }

  void add_node(Cell cell) {
    node_of_.at(cell.x, cell.y) = int(skeleton_.nodes.size());
    skeleton_.nodes.push_back({line_.centre_of(cell), radii_.at(cell.x, cell.y)});
  }

  void follow(Cell start, Cell next) {
    const int start_node = node_of_.at(start.x, start.y), next_node = node_of_.at(next.x, next.y);
    const bool is_known = is_done_.at(next.x, next.y) || (next_node >= 0 && next_node <= start_node);
    if (is_known) return;
    SkeletonBranch branch{start_node, start_node, {}, {}};
    append(branch, start);
    Cell before = start, cell = next;
    while (node_of_.at(cell.x, cell.y) < 0) {
      append(branch, cell);
      is_done_.at(cell.x, cell.y) = 1;
      const std::vector<Cell> steps = steps_from(line_, cell);
      const Cell onward = steps[0] == before ? steps[1] : steps[0];
      before = cell, cell = onward;
    }
    append(branch, cell);
    branch.end = node_of_.at(cell.x, cell.y);
    skeleton_.branches.push_back(std::move(branch));
  }

  void append(SkeletonBranch& branch, Cell cell) {
    branch.points.push_back(line_.centre_of(cell));
    branch.radii_m.push_back(radii_.at(cell.x, cell.y));
  }

  const Mask& line_;
  const GroundRaster<float>& radii_;
  GroundRaster<int> node_of_;
  Mask is_done_;
  Skeleton skeleton_;
};

std::vector<int> degrees(const Skeleton& skeleton) {
  std::vector<int> result(skeleton.nodes.size(), 0);
  for (const SkeletonBranch& branch : skeleton.branches)
    ++result[std::size_t(branch.start)], ++result[std::size_t(branch.end)];
  return result;
}

SkeletonBranch reversed(SkeletonBranch branch) {
  std::swap(branch.start, branch.end);
  std::ranges::reverse(branch.points);
  std::ranges::reverse(branch.radii_m);
  return branch;
}

/// Branches that meet at a node of two become one.
void join_through_nodes(Skeleton& skeleton) {
  std::vector<std::vector<std::size_t>> ends_at(skeleton.nodes.size());
  for (std::size_t i = 0; i < skeleton.branches.size(); ++i) {
    ends_at[std::size_t(skeleton.branches[i].start)].push_back(i);
    ends_at[std::size_t(skeleton.branches[i].end)].push_back(i);
  }
  for (int node = 0; node < int(skeleton.nodes.size()); ++node) {
    const std::vector<std::size_t>& ends = ends_at[std::size_t(node)];
    if (ends.size() != 2 || ends[0] == ends[1]) continue;
    SkeletonBranch &first = skeleton.branches[ends[0]], &second = skeleton.branches[ends[1]];
    if (first.end != node) first = reversed(std::move(first));
    if (second.start != node) second = reversed(std::move(second));
    first.points.insert(first.points.end(), second.points.begin() + 1, second.points.end());
    first.radii_m.insert(first.radii_m.end(), second.radii_m.begin() + 1, second.radii_m.end());
    first.end = second.end;
    std::ranges::replace(ends_at[std::size_t(second.end)], ends[1], ends[0]);
    second.points.clear();
  }
  std::erase_if(skeleton.branches, [](const SkeletonBranch& branch) { return branch.points.empty(); });
}

/// A free end that hardly reaches out of the junction's own circle is a corner of the outline, not a street.
bool remove_spurs(Skeleton& skeleton) {
  const std::vector<int> degree = degrees(skeleton);
  const auto is_spur = [&](const SkeletonBranch& branch) {
    const bool start_is_free = degree[std::size_t(branch.start)] == 1,
               end_is_free = degree[std::size_t(branch.end)] == 1;
    if (start_is_free == end_is_free) return false;
    const float radius = skeleton.nodes[std::size_t(start_is_free ? branch.end : branch.start)].radius_m;
    return branch.length_m() < 1.5f * radius + 2.0f;
  };
  return std::erase_if(skeleton.branches, is_spur) > 0;
}

/// Junctions joined by a branch that lies within their circles become one, in the middle.
bool merge_close_junctions(Skeleton& skeleton) {
  const std::vector<int> degree = degrees(skeleton);
  for (std::size_t i = 0; i < skeleton.branches.size(); ++i) {
    const SkeletonBranch& branch = skeleton.branches[i];
    const int kept = branch.start, gone = branch.end;
    SkeletonNode &a = skeleton.nodes[std::size_t(kept)], &b = skeleton.nodes[std::size_t(gone)];
    const bool is_between_junctions = degree[std::size_t(kept)] > 2 && degree[std::size_t(gone)] > 2;
    const bool is_small_ring = kept == gone && branch.length_m() < 4.0f * a.radius_m;
    if (!is_small_ring &&
        (kept == gone || !is_between_junctions || branch.length_m() > std::max(a.radius_m, b.radius_m)))
      continue;
    a.position = 0.5f * (a.position + b.position);
    a.radius_m = std::max(a.radius_m, b.radius_m);
    skeleton.branches.erase(skeleton.branches.begin() + std::ptrdiff_t(i));
    for (SkeletonBranch& other : skeleton.branches) {
      if (other.start == gone) other.start = kept;
      if (other.end == gone) other.end = kept;
    }
    return true;
  }
  return false;
}

/// Lets branches end at their nodes, which merging has moved.
void lead_to_nodes(Skeleton& skeleton) {
  for (SkeletonBranch& branch : skeleton.branches) {
    branch.points.front() = skeleton.nodes[std::size_t(branch.start)].position;
    branch.points.back() = skeleton.nodes[std::size_t(branch.end)].position;
  }
}

}  // namespace

float SkeletonBranch::length_m() const {
  float length = 0.0f;
  for (std::size_t i = 1; i < points.size(); ++i) length += glm::distance(points[i - 1], points[i]);
  return length;
}

Skeleton skeleton_of(const Mask& mask) {
  const GroundRaster<float> radii = distances_to(mask, 0);
  const Mask line = thinned(mask);
  Skeleton skeleton = Tracer(line, radii).trace();
  join_through_nodes(skeleton);
  while (remove_spurs(skeleton)) join_through_nodes(skeleton);
  while (merge_close_junctions(skeleton)) join_through_nodes(skeleton);
  while (remove_spurs(skeleton)) join_through_nodes(skeleton);
  lead_to_nodes(skeleton);
  return skeleton;
}

}  // namespace parvis::scene

#include "planning/plan_drawing/plan_lines.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <unordered_set>

#include "base/content_hash.h"
#include "base/joined_triangles.h"

namespace parvis::plan_drawing {
namespace {

constexpr double same_m = 0.001, straight_m = 0.0005;

glm::dvec3 corner_of(const Mesh& mesh, const glm::mat4& world_from_mesh, std::uint32_t vertex) {
  return glm::dvec3(world_from_mesh * glm::vec4(mesh.positions[vertex], 1.0f));
}

/// Places of a plan that are closer than a millimetre, by a number each.
class Places {
 public:
  std::size_t number_of(const glm::dvec3& point) {
    const long x = std::lround(point.x / same_m), y = std::lround(point.y / same_m);
    // A place near the edge of its cell may have been noted in the next one.
    for (long dx = -1; dx <= 1; ++dx)
      for (long dy = -1; dy <= 1; ++dy)
        if (const auto found = number_of_.find(key(x + dx, y + dy)); found != number_of_.end())
          if (glm::distance(glm::dvec2(points_[found->second]), glm::dvec2(point)) <= same_m)
            return found->second;
    points_.push_back(point);
    return number_of_.try_emplace(key(x, y), points_.size() - 1).first->second;
  }
  const glm::dvec3& operator[](std::size_t number) const { return points_[number]; }
  std::size_t size() const { return points_.size(); }

 private:
  static std::uint64_t key(long x, long y) {
    return (std::uint64_t(std::uint32_t(std::int32_t(x))) << 32) | std::uint32_t(std::int32_t(y));
  }
  std::unordered_map<std::uint64_t, std::size_t> number_of_;
  std::vector<glm::dvec3> points_;
};

/// Leaves out points on the straight line between their neighbours.
std::vector<glm::dvec3> without_straight_points(const std::vector<glm::dvec3>& points) {
  std::vector<glm::dvec3> kept{points.front()};
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const glm::dvec3 chord = points[i + 1] - kept.back(), from = points[i] - kept.back();
    const double square = glm::dot(chord, chord);
    const double along = square > 0.0 ? glm::clamp(glm::dot(from, chord) / square, 0.0, 1.0) : 0.0;
    if (glm::length(from - along * chord) > straight_m) kept.push_back(points[i]);
  }
  kept.push_back(points.back());
  return kept;
}

}  // namespace

void add_section(const Mesh& mesh, const glm::mat4& world_from_mesh,
                 const std::function<float(glm::vec2)>& ground_m, float above_m,
                 std::vector<Segment>& segments) {
  std::vector<glm::dvec3> points(mesh.positions.size());
  std::vector<double> above(mesh.positions.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i] = corner_of(mesh, world_from_mesh, std::uint32_t(i));
    above[i] = points[i].z - double(ground_m(glm::vec2(points[i]))) - double(above_m);
  }
  for (std::size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
    Segment cut;
    int count = 0;
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = mesh.indices[t + std::size_t(k)],
                          b = mesh.indices[t + std::size_t((k + 1) % 3)];
      if ((above[a] >= 0.0) == (above[b] >= 0.0)) continue;
      // Along the edge in one direction, so that neighbours find the same point.
      const auto [low, high] = above[a] < above[b] ? std::pair(a, b) : std::pair(b, a);
      const double share = -above[low] / (above[high] - above[low]);
      if (count < 2) cut[std::size_t(count++)] = glm::mix(points[low], points[high], share);
    }
    if (count == 2) segments.push_back(cut);
  }
}

void add_open_edges(const Mesh& mesh, const glm::mat4& world_from_mesh, std::vector<Segment>& segments) {
  const JoinedTriangles triangles = joined_triangles(mesh);
  for (std::size_t t = 0; t < triangles.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      if (triangles.neighbours[t][k] == no_triangle)
        segments.push_back({corner_of(mesh, world_from_mesh, triangles.triangles[t][k]),
                            corner_of(mesh, world_from_mesh, triangles.triangles[t][(k + 1) % 3])});
}

std::vector<std::vector<glm::dvec3>> joined(const std::vector<Segment>& segments) {
  Places places;
  std::vector<std::vector<std::size_t>> neighbours;
  std::unordered_set<std::uint64_t> known;
  for (const Segment& segment : segments) {
    const std::size_t a = places.number_of(segment[0]), b = places.number_of(segment[1]);
    neighbours.resize(places.size());
    if (a == b || !known.insert((std::uint64_t(std::min(a, b)) << 32) | std::max(a, b)).second) continue;
    neighbours[a].push_back(b), neighbours[b].push_back(a);
  }
  std::vector<std::vector<glm::dvec3>> lines;
  const auto follow = [&](std::size_t start) {
    std::vector<glm::dvec3> line{places[start]};
    for (std::size_t at = start; !neighbours[at].empty();) {
      const std::size_t next = neighbours[at].back();
      neighbours[at].pop_back();
      std::erase(neighbours[next], at);
      line.push_back(places[next]);
      at = next;
      if (at == start) break;
    }
    if (line.size() > 1) lines.push_back(without_straight_points(line));
  };
  for (std::size_t i = 0; i < neighbours.size(); ++i)  // from ends and crossings first, then rings
    while (neighbours[i].size() % 2 == 1) follow(i);
  for (std::size_t i = 0; i < neighbours.size(); ++i)
    while (!neighbours[i].empty()) follow(i);
  return lines;
}

std::vector<glm::dvec3> convex_outline(std::vector<glm::dvec3> points) {
  // Andrew's monotone chain.
  double low = std::numeric_limits<double>::max();
  for (const glm::dvec3& point : points) low = std::min(low, point.z);
  std::ranges::sort(
      points, [](const glm::dvec3& a, const glm::dvec3& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  std::vector<glm::dvec3> hull;
  const auto add = [&](const glm::dvec3& point, std::size_t fixed) {
    const auto turns_right = [&] {
      const glm::dvec2 a(hull[hull.size() - 2]), b(hull.back()), c(point);
      return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x) <= 0.0;
    };
    while (hull.size() >= fixed + 2 && turns_right()) hull.pop_back();
    hull.push_back({point.x, point.y, low});
  };
  for (const glm::dvec3& point : points) add(point, 0);
  const std::size_t lower = hull.size();
  for (std::size_t i = points.size(); i-- > 1;) add(points[i - 1], lower - 1);
  return hull.size() >= 4 ? hull : std::vector<glm::dvec3>();
}

}  // namespace parvis::plan_drawing

#include "bench/virtual_objects/edges.h"

#include <glm/gtc/matrix_transform.hpp>

#include "base/random.h"
#include "reflections/reflection_search/reflection_search.h"
#include "reflections/reflection_search/test_exact_reflection.h"
#include "reflections/reflector_maps/reflector_map.h"
#include "reflections/virtual_objects/long_edges.h"
#include "scene/data/test_scene.h"

namespace parvis::bench {
namespace {

using namespace reflection_search;
using namespace reflector_maps;
using namespace virtual_objects;
using MapSearch = ReflectionSearch<ReflectorMap>;

constexpr std::size_t points = 20000, quick_points = 4000;
constexpr int map_side = 512;
constexpr double pixels_per_radian = 869.0;  // 720 rows, 45 degrees
constexpr double wrong_px = 100.0;           // what an end that is not found counts
constexpr double flattest = 0.1;             // cosine: beyond it a pixel spans most of the body

/// A floor under the unit ball and boxes beside it, of as few triangles as can be.
Mesh large_polygons() {
  Mesh mesh;
  append(mesh, scene::ground(4.0f), glm::translate(glm::mat4(1.0f), {0.0f, 0.0f, -1.1f}));
  append(mesh, scene::box({-2.6f, -1.5f, -1.1f}, {-1.9f, -0.8f, 0.5f}));
  append(mesh, scene::box({1.7f, -2.2f, -1.1f}, {2.5f, -1.6f, 0.0f}));
  append(mesh, scene::box({-1.0f, 2.2f, -1.1f}, {1.0f, 2.6f, 0.3f}));
  return mesh;
}

class Edges {
 public:
  explicit Edges(const Mesh& mesh) {
    for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
      const glm::vec3 a = mesh.positions[mesh.indices[i]],
                      b = mesh.positions[mesh.indices[i % 3 == 2 ? i - 2 : i + 1]];
      ends_.emplace_back(a, b);
      lengths_.push_back((lengths_.empty() ? 0.0 : lengths_.back()) + double(glm::distance(a, b)));
    }
  }
  /// By length.
  std::pair<glm::vec3, glm::vec3> draw(Random& random) const {
    const auto at =
        std::upper_bound(lengths_.begin(), lengths_.end(), double(random.uniform()) * lengths_.back());
    return ends_[std::min(std::size_t(at - lengths_.begin()), ends_.size() - 1)];
  }

 private:
  std::vector<std::pair<glm::vec3, glm::vec3>> ends_;
  std::vector<double> lengths_;
};

/// Pixels between where a point of an edge is drawn and where the unit ball mirrors it, of points that it
/// does.
std::vector<double> pixels_off(const ReflectorMap& map, const Mesh& mesh, std::size_t count) {
  const Edges edges(mesh);
  Random random(6);
  std::vector<double> px;
  MapSearch search{map};
  while (px.size() < count) {
    const float heading = random.uniform(0.0f, 6.2831853f), height = random.uniform(-0.2f, 1.0f);
    const glm::vec3 viewer =
        random.uniform(3.0f, 8.0f) * glm::normalize(glm::vec3(std::cos(heading), std::sin(heading), height));
    const auto [a, b] = edges.draw(random);
    const float part = random.uniform();
    const glm::dvec3 eye(viewer), point(a + part * (b - a));
    const std::vector<glm::dvec3> truth = reflections_on_ball(eye, point, false);
    const auto is_steep = [&](glm::dvec3 end) {
      return glm::dot(glm::normalize(end - truth.front()), truth.front()) > flattest;
    };
    if (truth.empty() || !is_steep(eye) || !is_steep(point)) continue;
    const auto image = [&](glm::vec3 vertex) {
      const MapSearch::ReflectionPoint found =
          search.search_patch({viewer, vertex, map.window.centre}, search.patch_kind(), -1).point;
      return std::pair(search.virtual_vertex(vertex, found.position, found.normal),
                       found.angle < reflection_search::found_angle);
    };
    const auto [image_a, has_a] = image(a);
    const auto [image_b, has_b] = image(b);
    const glm::dvec3 drawn(image_a + part * (image_b - image_a));
    const double off = pixels_per_radian * glm::length(glm::cross(glm::normalize(drawn - eye),
                                                                  glm::normalize(truth.front() - eye)));
    px.push_back(has_a && has_b ? off : wrong_px);
  }
  return px;
}

}  // namespace

Status measure_edges(const BenchSetup& setup, Report& report) {
  const Result<Reflector> ball = make_reflector(scene::sphere(glm::vec3(0.0f), 1.0f, 256), "ball", map_side);
  if (!ball) return ball.errors();
  const Mesh coarse = large_polygons();
  const std::array<ReflectorBall, 1> balls{{{glm::vec3(0.0f), 1.0f}}};
  const Mesh divided = with_short_edges(coarse, glm::mat4(1.0f), balls, 100000);
  const std::size_t count = setup.is_quick ? quick_points : points;
  const std::vector<double> before = pixels_off(ball->maps.front(), coarse, count),
                            after = pixels_off(ball->maps.front(), divided, count);
  report.add("long_edge_p99_px", percentile(after, 0.99));
  report.note(fmt::format(
      "long edges: {} triangles made {}; median and 99 % {:.2f} and {:.1f} px off, were {:.1f} and {:.0f}",
      coarse.triangle_count(), divided.triangle_count(), percentile(after, 0.5), percentile(after, 0.99),
      percentile(before, 0.5), percentile(before, 0.99)));
  return Done{};
}

}  // namespace parvis::bench

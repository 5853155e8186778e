// Several images of one vertex, and long edges, against the exact reflections of a torus and of balls.
#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <numeric>

#include "base/parallel.h"
#include "base/random.h"
#include "base/test_directions.h"
#include "bench/parts.h"
#include "reflections/reflection_search/reflection_search.h"
#include "reflections/reflection_search/test_exact_reflection.h"
#include "reflections/reflector_maps/reflector_map.h"
#include "reflections/reflector_maps/surface_rays.h"
#include "reflections/virtual_objects/long_edges.h"
#include "scene/data/test_scene.h"

namespace parvis::bench {
namespace {

using namespace reflection_search;
using namespace reflector_maps;
using MapSearch = ReflectionSearch<ReflectorMap>;

constexpr std::size_t tasks = 4000, quick_tasks = 1000;
constexpr int mesh_rings = 160, map_side = 512;
constexpr double ring = 1.0, tube = 0.4;            // radii of the torus
constexpr double pixels_per_radian = 869.0;         // 720 rows, 45 degrees
constexpr double wrong_px = 100.0;                  // what a missed or an extra point counts
constexpr double same_px = 2.0, same_place = 0.05;  // found from two places
constexpr double flattest = 0.1;                    // cosine: beyond it a pixel spans most of the body
constexpr double rim = 0.02;                        // of the concave ball, below the plane that it is open at

struct Task {
  glm::vec3 viewer, vertex;
};

/// A reflection point; it counts where nothing of the reflector lies between, and neither sight is too flat.
/// One that does not may still be what a search means by one that does.
struct Point {
  glm::dvec3 position;
  bool counts;
};

/// A reflector and the truth about it.
struct JudgedShape {
  std::string key;
  Mesh mesh;
  std::function<Task(Random&)> task;
  std::function<std::vector<glm::dvec3>(const Task&)> truth;
  std::function<glm::dvec3(glm::dvec3)> normal;
};

JudgedShape torus() {
  return {"torus_p99_px", scene::torus(float(ring), float(tube), mesh_rings),
          [](Random& random) {
            const glm::vec3 viewer = random.uniform(2.5f, 6.0f) * random_direction(random);
            return Task{viewer, random.uniform(1.6f, 5.0f) * random_direction(random)};
          },
          [](const Task& task) { return reflections_on_torus(ring, tube, task.viewer, task.vertex); },
          [](glm::dvec3 p) { return glm::normalize(p - ring * glm::normalize(glm::dvec3(p.x, p.y, 0.0))); }};
}

/// The lower half of a ball from within: the viewer above it, the vertex in it or above.
JudgedShape concave_ball() {
  Mesh mesh = scene::sphere(glm::vec3(0.0f), 1.0f, mesh_rings);
  std::vector<std::uint32_t> kept;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const std::uint32_t* corner = &mesh.indices[i];
    if (std::all_of(corner, corner + 3, [&](std::uint32_t v) { return mesh.positions[v].z < 1e-6f; }))
      kept.insert(kept.end(), {corner[0], corner[2], corner[1]});
  }
  mesh.indices = kept;
  for (glm::vec3& normal : mesh.normals) normal = -normal;
  return {"concave_p99_px", std::move(mesh),
          [](Random& random) {
            Task task;
            do task.viewer = random.uniform(1.2f, 4.0f) * random_direction(random);
            while (task.viewer.z < 1.0f);
            do task.vertex = random.uniform(0.1f, 3.0f) * random_direction(random);
            while (task.vertex.z < 0.1f && glm::length(task.vertex) > 0.95f);
            return task;
          },
          [](const Task& task) {
            std::vector<glm::dvec3> points = reflections_on_ball(task.viewer, task.vertex, true);
            std::erase_if(points, [](glm::dvec3 p) { return p.z > 0.0; });
            return points;
          },
          [](glm::dvec3 p) { return -glm::normalize(p); }};
}

/// All points that the maps of a shape show of a vertex.
class AllPoints {
 public:
  explicit AllPoints(Reflector reflector) : reflector_(std::move(reflector)) {
    for (const ReflectorPatch& patch : reflector_.patches)
      own_.push_back(std::make_unique<SurfaceRays>(reflector_.mesh, patch.triangles));
  }

  std::vector<glm::dvec3> of(const Task& task) const {
    std::vector<glm::dvec3> points;
    for (std::size_t k = 0; k < reflector_.maps.size(); ++k) {
      const ReflectorMap& map = reflector_.maps[k];
      MapSearch search{map};
      const MapSearch::ReflectionTask on_patch{task.viewer, task.vertex, map.window.centre};
      const int layers = map.shows_once ? 1 : search.layer_count;
      for (int layer = 0; layer < layers; ++layer) {
        const MapSearch::PatchPoint found =
            search.search_patch(on_patch, search.patch_kind(), map.shows_once ? -1 : layer);
        // A pixel shows the patch that its triangle belongs to.
        if (search.is_found(found) && is_before(found.point, task) &&
            own_[k]->along(map.window.centre, found.point.direction))
          add(points, found.point.position, task.viewer);
      }
    }
    return points;
  }

 private:
  static bool is_before(const MapSearch::ReflectionPoint& point, const Task& task) {
    return glm::dot(task.viewer - point.position, point.normal) > 0.0f &&
           glm::dot(task.vertex - point.position, point.normal) > 0.0f;
  }
  static void add(std::vector<glm::dvec3>& points, glm::dvec3 point, glm::dvec3 viewer);

  Reflector reflector_;
  std::vector<std::unique_ptr<SurfaceRays>> own_;  ///< of each patch
};

double pixels_between(glm::dvec3 a, glm::dvec3 b, glm::dvec3 viewer) {
  return pixels_per_radian * glm::length(glm::cross(glm::normalize(a - viewer), glm::normalize(b - viewer)));
}

void AllPoints::add(std::vector<glm::dvec3>& points, glm::dvec3 point, glm::dvec3 viewer) {
  const auto is_same = [&](glm::dvec3 known) {
    return pixels_between(known, point, viewer) < same_px && glm::distance(known, point) < same_place;
  };
  if (std::none_of(points.begin(), points.end(), is_same)) points.push_back(point);
}

struct PixelErrors {
  std::vector<double> px;
  int missed = 0, extra = 0;
};

/// Pairs of points and truths, the nearest first; what is left over is missed, or extra.
void compare(const std::vector<Point>& truth, const std::vector<Point>& found, glm::dvec3 viewer,
             PixelErrors& errors) {
  struct Pair {
    double px;
    std::size_t truth, found;
  };
  std::vector<Pair> pairs;
  for (std::size_t t = 0; t < truth.size(); ++t)
    for (std::size_t f = 0; f < found.size(); ++f)
      pairs.push_back({pixels_between(truth[t].position, found[f].position, viewer), t, f});
  std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) { return a.px < b.px; });
  std::vector<bool> is_met(truth.size()), is_meant(found.size());
  for (const Pair& pair : pairs) {
    if (is_met[pair.truth] || is_meant[pair.found] || pair.px > wrong_px) continue;
    is_met[pair.truth] = is_meant[pair.found] = true;
    if (truth[pair.truth].counts) errors.px.push_back(pair.px);
  }
  const auto left_over = [&](const std::vector<Point>& points, const std::vector<bool>& is_paired) {
    int count = 0;
    for (std::size_t i = 0; i < points.size(); ++i) count += points[i].counts && !is_paired[i] ? 1 : 0;
    errors.px.insert(errors.px.end(), std::size_t(count), wrong_px);
    return count;
  };
  errors.missed += left_over(truth, is_met);
  errors.extra += left_over(found, is_meant);
}

void measure_shape(const JudgedShape& shape, std::size_t count, Report& report) {
  Reflector made = must(make_reflector(shape.mesh, shape.key, map_side));
  std::vector<std::uint32_t> all(made.mesh.neighbours.size());
  std::iota(all.begin(), all.end(), 0u);
  const SurfaceRays whole(made.mesh, all);
  const AllPoints points(std::move(made));

  Random random(4);
  std::vector<Task> asked(count);
  for (Task& task : asked) task = shape.task(random);
  std::vector<PixelErrors> errors_of(count);
  std::vector<std::size_t> counted(count);
  parallel_for(count, [&](std::size_t i) {
    const Task& task = asked[i];
    const auto is_clear = [&](glm::vec3 from, glm::vec3 to) {
      const std::optional<MetSurface> met = whole.along(from, to - from);
      return !met || glm::distance(met->position, from) > 0.999f * glm::distance(from, to) - 1e-3f;
    };
    const auto judged = [&](const std::vector<glm::dvec3>& positions) {
      std::vector<Point> all_points;
      for (const glm::dvec3& p : positions) {
        const auto is_steep = [&](glm::dvec3 end) {
          return glm::dot(glm::normalize(end - p), shape.normal(p)) > flattest;
        };
        const bool is_off_rim = shape.key != "concave_p99_px" || p.z < -rim;
        all_points.push_back({p, is_off_rim && is_steep(task.viewer) && is_steep(task.vertex) &&
                                     is_clear(task.viewer, p) && is_clear(task.vertex, p)});
      }
      return all_points;
    };
    const std::vector<Point> truth = judged(shape.truth(task));
    counted[i] =
        std::size_t(std::count_if(truth.begin(), truth.end(), [](const Point& p) { return p.counts; }));
    compare(truth, judged(points.of(task)), task.viewer, errors_of[i]);
  });
  PixelErrors errors;
  for (const PixelErrors& of_task : errors_of) {
    errors.px.insert(errors.px.end(), of_task.px.begin(), of_task.px.end());
    errors.missed += of_task.missed, errors.extra += of_task.extra;
  }
  const std::size_t maximum = *std::ranges::max_element(counted),
                    truths = std::accumulate(counted.begin(), counted.end(), std::size_t(0));
  report.add(shape.key, percentile(errors.px, 0.99));
  report.note(fmt::format(
      "{}: {} points of {} vertices, at most {} of one: {} missed, {} extra; median {:.3f} px", shape.key,
      truths, count, maximum, errors.missed, errors.extra, percentile(errors.px, 0.5)));
}

using namespace virtual_objects;

constexpr std::size_t points = 20000, quick_points = 4000;

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
  /// Draws an edge with a probability proportional to its length.
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

void measure_roots(const BenchSetup& setup, Report& report) {
  for (const JudgedShape& shape : {torus(), concave_ball()})
    measure_shape(shape, setup.is_quick ? quick_tasks : tasks, report);
}

void measure_edges(const BenchSetup& setup, Report& report) {
  const Reflector ball = must(make_reflector(scene::sphere(glm::vec3(0.0f), 1.0f, 256), "ball", map_side));
  const Mesh coarse = large_polygons();
  const std::array<ReflectorBall, 1> balls{{{glm::vec3(0.0f), 1.0f}}};
  const Mesh divided = with_short_edges(coarse, glm::mat4(1.0f), balls, 100000);
  const std::size_t count = setup.is_quick ? quick_points : points;
  const std::vector<double> before = pixels_off(ball.maps.front(), coarse, count),
                            after = pixels_off(ball.maps.front(), divided, count);
  report.add("long_edge_p99_px", percentile(after, 0.99));
  report.note(fmt::format(
      "long edges: {} triangles made {}; median and 99 % {:.2f} and {:.1f} px off, were {:.1f} and {:.0f}",
      coarse.triangle_count(), divided.triangle_count(), percentile(after, 0.5), percentile(after, 0.99),
      percentile(before, 0.5), percentile(before, 0.99)));
}

}  // namespace parvis::bench

// The default search for reflection points beside the paper's, on bodies whose reflections are known from
// their fine mesh and on ellipsoids.
#include <algorithm>
#include <array>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include "base/random.h"
#include "base/test_data.h"
#include "base/test_directions.h"
#include "bench/curved/map_search.h"
#include "bench/parts.h"
#include "formats/meshes/assimp_reader.h"
#include "reflections/reflection_search/reflection_search.h"
#include "reflections/reflection_search/test_ellipsoid.h"
#include "reflections/reflection_search/test_exact_reflection.h"
#include "reflections/reflector_maps/reflector_map.h"
#include "reflections/reflector_maps/surface_rays.h"
#include "scene/data/test_scene.h"

namespace parvis::bench {
namespace {

/// A vertex that a patch of the body is known to reflect to a viewer. In the body's frame.
struct KnownReflection {
  std::size_t patch;
  glm::vec3 viewer, vertex;
  float reach;  ///< of the vertex, in radii of the body
};

/// Results of one search for all of a body's reflections.
struct SearchFigures {
  /// Angles between bisector and normal, on the fine mesh; none: there is no surface where the search has
  /// ended.
  std::vector<std::optional<double>> angles_deg;
  std::vector<bool> is_told;  ///< the search says that it has not found it
  double microseconds = 0.0;  ///< for each
};

using namespace reflection_search;
using namespace reflector_maps;

constexpr int map_side = 512;
constexpr std::size_t max_maps = 200;
constexpr std::array reaches{1.1f, 1.5f, 2.5f, 4.0f};
constexpr float flattest = 0.1f;  // cosine of the steepest sight: beyond it a pixel spans most of the body
constexpr double degrees = 57.29577951308232;

/// Draws triangles by their area.
class AreaDraw {
 public:
  AreaDraw(const ReflectorMesh& mesh, const std::vector<ReflectorPatch>& patches) {
    for (std::size_t p = 0; p < patches.size(); ++p)
      for (const std::uint32_t t : patches[p].triangles) {
        const auto [a, b, c] = mesh.corners(t);
        sums_.push_back((sums_.empty() ? 0.0 : sums_.back()) + double(glm::length(glm::cross(b - a, c - a))));
        triangles_.emplace_back(p, t);
      }
  }
  std::pair<std::size_t, std::uint32_t> draw(Random& random) const {
    const auto at = std::upper_bound(sums_.begin(), sums_.end(), double(random.uniform()) * sums_.back());
    return triangles_[std::min(std::size_t(at - sums_.begin()), triangles_.size() - 1)];
  }

 private:
  std::vector<double> sums_;
  std::vector<std::pair<std::size_t, std::uint32_t>> triangles_;  ///< patch, triangle
};

/// A chance point of a triangle, with its interpolated normal.
MetSurface chance_point(const ReflectorMesh& mesh, std::uint32_t triangle, Random& random) {
  const auto p = mesh.corners(triangle);
  const auto n = mesh.normals(triangle);
  float u = random.uniform(), v = random.uniform();
  if (u + v > 1.0f) u = 1.0f - u, v = 1.0f - v;
  return {p[0] + u * (p[1] - p[0]) + v * (p[2] - p[0]),
          glm::normalize(n[0] + u * (n[1] - n[0]) + v * (n[2] - n[0]))};
}

/// Where a ray from `from` leaves the ball; `from` lies in it.
glm::vec3 leaves_ball(glm::vec3 from, glm::vec3 direction, glm::vec3 centre, float radius) {
  const glm::vec3 off = from - centre;
  const float along = glm::dot(off, direction);
  return from + (std::sqrt(std::max(along * along - glm::dot(off, off) + radius * radius, 0.0f)) - along) *
                    direction;
}
/// A reflecting body with reflections that are known from its fine mesh.
class JudgedBody {
 public:
  using Search = std::function<MapSearch::PatchPoint(MapSearch&, const MapSearch::ReflectionTask&)>;

  /// `count` reflections that nothing of the body hides, their vertices at 1.1, 1.5, 2.5 and 4 radii.
  static JudgedBody make(std::string name, const Mesh& mesh, std::size_t count) {
    Reflector made = must(make_reflector(mesh, name, map_side, max_maps));
    const ReflectorMesh& ordered = made.mesh;
    const std::vector<ReflectorPatch>& patches = made.patches;
    JudgedBody body;
    body.name_ = std::move(name);
    body.triangles_ = ordered.neighbours.size();
    body.patches_ = patches.size();
    body.maps_ = std::move(made.maps);
    for (std::size_t i = 0; i < body.maps_.size(); ++i) {
      body.own_rays_.push_back(std::make_unique<SurfaceRays>(ordered, patches[i].triangles));
      body.rays_around_.push_back(std::make_unique<SurfaceRays>(ordered, patches[i].around));
    }

    std::vector<std::uint32_t> all(body.triangles_);
    std::iota(all.begin(), all.end(), 0u);
    const SurfaceRays whole(ordered, all);
    const AreaDraw area(ordered, patches);
    const glm::vec3 centre = ordered.mesh.bounds().centre();
    float radius = 0.0f;
    for (const glm::vec3& p : ordered.mesh.positions) radius = std::max(radius, glm::distance(p, centre));
    Random random(1);
    for (std::size_t tried = 0; body.reflections_.size() < count && tried < 100 * count; ++tried) {
      const auto [patch, triangle] = area.draw(random);
      const MetSurface at = chance_point(ordered, triangle, random);
      const glm::vec3 to_viewer = random_direction(random);
      if (glm::dot(to_viewer, at.normal) < flattest) continue;
      const glm::vec3 to_vertex = glm::reflect(-to_viewer, at.normal),
                      above = at.position + 1e-4f * radius * at.normal;
      if (whole.along(above, to_viewer) || whole.along(above, to_vertex)) continue;
      const float reach = reaches[body.reflections_.size() % reaches.size()];
      body.reflections_.push_back(
          {patch, leaves_ball(at.position, to_viewer, centre, random.uniform(1.5f, 6.0f) * radius),
           leaves_ball(at.position, to_vertex, centre, reach * radius), reach});
    }
    // As a reflector is drawn: patch by patch.
    std::sort(body.reflections_.begin(), body.reflections_.end(),
              [](const KnownReflection& a, const KnownReflection& b) { return a.patch < b.patch; });
    return body;
  }

  /// The name in the report.
  const std::string& name() const { return name_; }
  /// All known reflections.
  const std::vector<KnownReflection>& reflections() const { return reflections_; }
  /// Runs the search for every known reflection.
  SearchFigures judge(const Search& search) const;
  /// Triangles and patches, for the report.
  std::string description() const {
    return fmt::format("{}: {} triangles, {} patches, {} maps of {} x {}, {} reflections", name_, triangles_,
                       patches_, maps_.size(), map_side, map_side, reflections_.size());
  }

 private:
  std::string name_;
  std::size_t triangles_ = 0, patches_ = 0;
  std::vector<reflector_maps::ReflectorMap> maps_;
  /// Rays to the fine mesh: each map's own part, and beside it that of its neighbours.
  std::vector<std::unique_ptr<reflector_maps::SurfaceRays>> own_rays_, rays_around_;
  std::vector<KnownReflection> reflections_;
};

SearchFigures JudgedBody::judge(const Search& search) const {
  std::vector<MapSearch::PatchPoint> points(reflections_.size());
  SearchFigures figures;
  figures.microseconds = 1e3 / double(reflections_.size()) * milliseconds([&] {
                           for (std::size_t i = 0; i < reflections_.size(); ++i) {
                             const KnownReflection& known = reflections_[i];
                             if (known.patch >= maps_.size()) continue;
                             const ReflectorMap& map = maps_[known.patch];
                             MapSearch on_map{map};
                             points[i] = search(on_map, {known.viewer, known.vertex, map.window.centre});
                           }
                         });
  for (std::size_t i = 0; i < reflections_.size(); ++i) {
    const KnownReflection& known = reflections_[i];
    if (known.patch >= maps_.size()) {  // no map: told
      figures.angles_deg.push_back(std::nullopt);
      figures.is_told.push_back(true);
      continue;
    }
    MapSearch on_map{maps_[known.patch]};
    const glm::vec3 centre = maps_[known.patch].window.centre, direction = points[i].point.direction;
    std::optional<MetSurface> met = own_rays_[known.patch]->along(centre, direction);
    if (!met) met = rays_around_[known.patch]->along(centre, direction);
    figures.angles_deg.push_back(
        met ? std::optional(degrees * bisector_angle(met->position, met->normal, known.viewer, known.vertex))
            : std::nullopt);
    figures.is_told.push_back(!on_map.is_found(points[i]));
  }
  return figures;
}
/// A part of all that were counted.
struct Share {
  int counted = 0, all = 0;

  /// Adds one, which counts or does not.
  void add(bool counts) { counted += counts, ++all; }
  /// 0 of none.
  double percent() const { return all ? 100.0 * counted / all : 0.0; }
};

constexpr double judged_share = 0.99;

/// A search that never finds a point meets no target.
double ratio_of(const std::vector<double>& over, const std::vector<double>& under) {
  if (over.empty() || under.empty()) return std::numeric_limits<double>::infinity();
  return percentile(over, judged_share) / percentile(under, judged_share);
}
/// Results of searches for the same reflections. All are accepted by one rule, whatever they report of
/// themselves: a search that ends where the fine mesh has no surface has no angle there. It counts in that
/// search's share of points not found, and in no percentile.
struct ComparedSearches {
  std::vector<double> newton_deg, beside_newton_deg;    ///< the default search, and the paper's nine steps
  std::vector<double> control_deg, beside_control_deg;  ///< more of the paper's steps, and nine
  Share not_found_by_newton, not_found_by_midpoint;

  /// Figures of one body.
  void add(const SearchFigures& newton, const SearchFigures& midpoint, const SearchFigures& control) {
    for (std::size_t i = 0; i < newton.angles_deg.size(); ++i) {
      const std::optional<double> by_newton = newton.angles_deg[i];
      const std::optional<double> by_midpoint = midpoint.angles_deg[i];
      const std::optional<double> by_control = control.angles_deg[i];
      not_found_by_newton.add(!by_newton);
      not_found_by_midpoint.add(!by_midpoint);
      if (!by_midpoint) continue;
      if (by_newton) newton_deg.push_back(*by_newton), beside_newton_deg.push_back(*by_midpoint);
      if (by_control) control_deg.push_back(*by_control), beside_control_deg.push_back(*by_midpoint);
    }
  }
  /// 99th percentile of the default search's angles over that of the paper's; infinite without any.
  double newton_ratio() const;
  /// The same of more steps.
  double control_ratio() const { return ratio_of(control_deg, beside_control_deg); }
};

double ComparedSearches::newton_ratio() const { return ratio_of(newton_deg, beside_newton_deg); }
namespace fs = std::filesystem;

constexpr std::array ellipsoids{glm::vec3(1.0f), glm::vec3(1.0f, 0.6f, 0.8f), glm::vec3(2.0f, 0.9f, 0.6f)};
constexpr std::array real_bodies{"teapot", "beetle-alt", "spot", "stanford-bunny"};
constexpr std::size_t reflections = 20000, quick_reflections = 4000;  // a body
constexpr int turns = 9, quick_turns = 5;
constexpr int ellipsoid_rings = 256;
constexpr int paper_iterations = 9;
constexpr int more_iterations = 12;   // an eighth of the error: more than the target allows
constexpr float search_ends = 2e-9f;  // error, 0.005 degrees

/// Where the default search begins: at the starting point of the shortest estimated step among a few, or
/// among those beside it. The others, to which it goes on where that fails, are a part of it that the paper's
/// has not.
glm::vec3 first_start(MapSearch& search, const MapSearch::ReflectionTask& task) {
  int best = 0;
  float shortest = std::numeric_limits<float>::infinity();
  const auto estimate = [&](int first, int last) {
    for (int i = first; i < last; ++i)
      if (const float step =
              search.estimated_step(task, search.search_start(i), search.patch_kind().is_convex);
          step < shortest)
        shortest = step, best = i;
  };
  estimate(0, search_start_count);
  const int beside = search_start_count + reflection_search::starts_beside * best;
  estimate(beside, beside + reflection_search::starts_beside);
  return search.search_start(best).plane.at.position - task.centre;
}

MapSearch::PatchPoint by_midpoint_steps(MapSearch& search, const MapSearch::ReflectionTask& task,
                                        glm::vec3 start, int iterations) {
  const MapSearch::ReflectionPoint point = search.search_by_midpoint(task, start, iterations, search_ends);
  return {point, kind_surface};  // no lookup more than the paper's
}

/// The paper's search from the default one's start. To find that is not a part of the paper's: its time is
/// that of `by_midpoint`.
MapSearch::PatchPoint by_midpoint_from_first_start(MapSearch& search, const MapSearch::ReflectionTask& task) {
  return by_midpoint_steps(search, task, first_start(search, task), paper_iterations);
}

/// The control of the default search: more steps of the paper's.
MapSearch::PatchPoint by_more_midpoint_steps(MapSearch& search, const MapSearch::ReflectionTask& task) {
  return by_midpoint_steps(search, task, first_start(search, task), more_iterations);
}

MapSearch::PatchPoint by_newton(MapSearch& search, const MapSearch::ReflectionTask& task) {
  return search.search_patch(task, search.patch_kind(), -1);
}

/// Ellipsoids, and behind them the real bodies whose files are here.
struct Bodies {
  std::vector<JudgedBody> judged;
  std::vector<std::string> missing;
};

Bodies make_bodies(const BenchSetup& setup, Report& report) {
  const std::size_t count = setup.is_quick ? quick_reflections : reflections;
  Bodies bodies;
  const auto add = [&](const std::string& name, const Mesh& mesh) {
    JudgedBody body = JudgedBody::make(name, mesh, count);
    report.note(body.description());
    bodies.judged.push_back(std::move(body));
  };
  for (const glm::vec3 radii : ellipsoids) {
    Mesh mesh;
    append(mesh, scene::sphere(glm::vec3(0.0f), 1.0f, ellipsoid_rings), glm::scale(glm::mat4(1.0f), radii));
    add(fmt::format("ellipsoid {} {} {}", radii.x, radii.y, radii.z), mesh);
  }
  for (const char* name : real_bodies) {
    const auto file = shared_data(fmt::format("reflectors/{}.obj", name), fs::current_path());
    if (!file) {
      bodies.missing.emplace_back(name);
      continue;
    }
    Errors warnings;
    const scene::Model model = must(scene::read_with_assimp(*file, formats::UpAxis::file, warnings));
    Mesh mesh;
    for (const scene::Part& part : model.parts) append(mesh, part.mesh);
    add(name, mesh);
  }
  return bodies;
}

/// `newton_over_midpoint9_p99_angle` of ellipsoids or of real bodies.
void report_angles(const char* where, const ComparedSearches& compared, Report& report) {
  report.add(fmt::format("newton_over_midpoint9_p99_angle_{}", where), compared.newton_ratio());
  report.add(fmt::format("midpoint12_over_midpoint9_p99_angle_{}", where), compared.control_ratio());
  report.note(fmt::format(
      "{}: angles of the {} of {} reflections that both searches find: 99 % {:.4f} and {:.2f} deg", where,
      compared.newton_deg.size(), compared.not_found_by_newton.all, percentile(compared.newton_deg, 0.99),
      percentile(compared.beside_newton_deg, 0.99)));
}

/// Ellipsoids alone are easier: without the real bodies there is no figure of all.
void skip_figures_of_all(const std::vector<std::string>& missing, Report& report) {
  for (const char* key : {"newton_over_midpoint9_p99_angle_bodies", "newton_over_midpoint9_p99_angle",
                          "newton_over_midpoint9_time", "unflagged_over_1deg",
                          "flagged_percent_from_1_5_radii", "flagged_percent_at_1_1"})
    report.skip(key, fmt::format("the shared data lacks {}", fmt::join(missing, ", ")));
}

void measure_maps(const Bodies& all, const BenchSetup& setup, Report& report) {
  const std::vector<JudgedBody>& bodies = all.judged;
  ComparedSearches of_ellipsoids, of_bodies;
  std::vector<double> ratios;
  Share flagged_from_1_5, flagged_at_1_1, flagged_by_midpoint;
  int silently_wrong = 0;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const JudgedBody& body = bodies[b];
    const SearchFigures newton = body.judge(by_newton), midpoint = body.judge(by_midpoint_from_first_start),
                        control = body.judge(by_more_midpoint_steps);
    (b < ellipsoids.size() ? of_ellipsoids : of_bodies).add(newton, midpoint, control);
    for (std::size_t i = 0; i < newton.angles_deg.size(); ++i) {
      (body.reflections()[i].reach < 1.4f ? flagged_at_1_1 : flagged_from_1_5).add(newton.is_told[i]);
      flagged_by_midpoint.add(midpoint.is_told[i]);
      silently_wrong += !newton.is_told[i] && newton.angles_deg[i].value_or(180.0) > 1.0;
    }
    ComparedSearches alone;
    alone.add(newton, midpoint, control);
    report.note(fmt::format(
        "{}: angle median and 99 % {:.4f} {:.3f} deg (midpoint-9 {:.3f} {:.1f}), {:.2f} % not found "
        "({:.2f} %), {:.2f} us ({:.2f})",
        body.name(), percentile(alone.newton_deg, 0.5), percentile(alone.newton_deg, 0.99),
        percentile(alone.beside_newton_deg, 0.5), percentile(alone.beside_newton_deg, 0.99),
        alone.not_found_by_newton.percent(), alone.not_found_by_midpoint.percent(), newton.microseconds,
        body.judge(by_midpoint).microseconds));
  }
  report_angles("ellipsoids", of_ellipsoids, report);
  if (!all.missing.empty()) return skip_figures_of_all(all.missing, report);
  report_angles("bodies", of_bodies, report);
  report.add("newton_over_midpoint9_p99_angle",
             std::max(of_ellipsoids.newton_ratio(), of_bodies.newton_ratio()));
  report.add("midpoint12_over_midpoint9_p99_angle",
             std::min(of_ellipsoids.control_ratio(), of_bodies.control_ratio()));
  for (int turn = 0; turn < (setup.is_quick ? quick_turns : turns); ++turn) {
    double newton_us = 0.0, midpoint_us = 0.0;
    for (const JudgedBody& body : bodies) {
      newton_us += body.judge(by_newton).microseconds;
      midpoint_us += body.judge(by_midpoint).microseconds;
    }
    ratios.push_back(newton_us / midpoint_us);
  }
  report.add("newton_over_midpoint9_time", median(ratios));
  report.add("unflagged_over_1deg", double(silently_wrong));
  // A search that flags whatever is hard has small angles, too.
  report.add("flagged_percent_from_1_5_radii", flagged_from_1_5.percent());
  report.add("flagged_percent_at_1_1", flagged_at_1_1.percent());
  report.add("flagged_percent_of_midpoint9", flagged_by_midpoint.percent());
}

/// Measures searches without maps: vertices anywhere about ellipsoids, hidden ones too, at 1.1 to 4 times the
/// surface's distance.
void measure_analytic(const BenchSetup& setup, Report& report) {
  using Search = ReflectionSearch<Ellipsoid>;
  std::vector<double> newton_angles, midpoint_angles;
  for (const glm::vec3 radii : ellipsoids) {
    const Ellipsoid ellipsoid{radii};
    Search search{ellipsoid};
    Random random(2);
    const auto outside = [&](float minimum, float maximum) {
      glm::vec3 d(0.0f);
      while (glm::length(d) < 0.01f || glm::length(d) > 1.0f)
        d = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
      return random.uniform(minimum, maximum) * ellipsoid.surface(d).first;
    };
    const auto angle = [&](const Search::ReflectionPoint& point, const Search::ReflectionTask& task) {
      const glm::dvec3 p(point.position), r(radii);
      return degrees * bisector_angle(p, glm::normalize(p / (r * r)), task.viewer, task.vertex);
    };
    for (std::size_t i = 0; i < (setup.is_quick ? quick_reflections : reflections); ++i) {
      const Search::ReflectionTask task{outside(1.5f, 8.0f), outside(1.1f, 4.0f), glm::vec3(0.0f)};
      const glm::vec3 start = search.first_direction(task);
      newton_angles.push_back(
          angle(search.search_by_newton(task, start, true, search.free_growth, 12, search_ends), task));
      midpoint_angles.push_back(
          angle(search.search_by_midpoint(task, start, paper_iterations, search_ends), task));
    }
  }
  report.add("newton_over_midpoint9_p99_angle_analytic",
             percentile(newton_angles, 0.99) / percentile(midpoint_angles, 0.99));
}

}  // namespace

MapSearch::PatchPoint by_midpoint(MapSearch& search, const MapSearch::ReflectionTask& task) {
  const glm::vec3 start = search.reflector.is_whole_body()
                              ? search.first_direction(task)
                              : search.search_start(0).plane.at.position - task.centre;
  return by_midpoint_steps(search, task, start, paper_iterations);
}

void measure_search(const BenchSetup& setup, Report& report) {
  const Bodies bodies = make_bodies(setup, report);
  measure_maps(bodies, setup, report);
  measure_analytic(setup, report);
}

}  // namespace parvis::bench

#include "reflections/reflection_search/reflection_search.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/random.h"
#include "base/test_directions.h"
#include "reflections/reflection_search/test_ellipsoid.h"
#include "reflections/reflection_search/test_exact_reflection.h"

namespace parvis::reflection_search {
namespace {

using Search = ReflectionSearch<Ellipsoid>;
using Task = Search::ReflectionTask;
using Point = Search::ReflectionPoint;

constexpr float tolerated_error = 2e-9f;  // 0.005 degrees
constexpr int newton_steps = 12;
constexpr int patch_steps = 20;       // of a search over a patch
constexpr float flag_angle = 0.005f;  // radians, 0.3 degrees: a point beyond it is not drawn
constexpr double degree = 0.017453292519943295;

/// Viewer and vertex anywhere outside, the vertex at `reach` times the surface's distance from the centre.
Task chance_task(const Ellipsoid& ellipsoid, Random& random, float reach) {
  const vec3 toward_viewer = ellipsoid.surface(random_direction(random)).first;  // compilers choose the order
  const vec3 viewer = random.uniform(1.5f, 8.0f) * toward_viewer;                // in which factors are found
  return {viewer, reach * ellipsoid.surface(random_direction(random)).first, vec3(0.0f)};
}

Point newton(Search& search, const Task& task) {
  return search.search_by_newton(task, search.first_direction(task), true, search.free_growth, newton_steps,
                                 tolerated_error);
}

Point midpoint(Search& search, const Task& task, int iterations) {
  return search.search_by_midpoint(task, search.first_direction(task), iterations, tolerated_error);
}

double true_angle(const Ellipsoid& ellipsoid, const Point& point, const Task& task) {
  const glm::dvec3 p(point.position), r(ellipsoid.radii);
  return bisector_angle(p, glm::normalize(p / (r * r)), task.viewer, task.vertex);
}

/// The share of chance vertices whose reflection point is off by more than a degree.
template <class Find>
double share_over_1_degree(const Ellipsoid& ellipsoid, float reach, Find find) {
  Random random(5);
  Search search{ellipsoid};
  constexpr int tasks = 2000;
  int wrong = 0;
  for (int i = 0; i < tasks; ++i) {
    const Task task = chance_task(ellipsoid, random, reach);
    wrong += true_angle(ellipsoid, find(search, task), task) > degree ? 1 : 0;
  }
  return double(wrong) / tasks;
}

// Row E3, and equation 1 as floats can stand it: near the point, 1 - B.N is 0 long before the angle is.
TEST(BisectorError, IsEquation1AndStillReportsSmallAngles) {
  const Ellipsoid ball;
  Search search{ball};
  const vec3 n(0, 0, 1);
  EXPECT_EQ(search.bisector_error(n, n), 0.0f);
  EXPECT_FLOAT_EQ(search.bisector_error(-n, n), 1.0f);
  for (const float angle : {1e-4f, 1e-2f, 0.5f, 2.0f}) {
    const vec3 b(std::sin(angle), 0.0f, std::cos(angle));
    EXPECT_NEAR(search.bisector_error(b, n), 0.5 * (1.0 - std::cos(double(angle))), 1e-7);
    EXPECT_NEAR(search.angle_of_error(search.bisector_error(b, n)), angle, 1e-3f * angle);
  }
}

// The paper's section 3 measures against the normal of R. There the error of a point would be 0 elsewhere
// than at R: where the bisector happens to be parallel to that normal.
TEST(BisectorError, IsOfThePointsOwnNormal) {
  const Ellipsoid ball;
  Search search{ball};
  const Task task{{0, 0, 3}, {3, 0, 0}, vec3(0.0f)};
  const vec3 away = normalize(vec3(1, 0, 2));  // R lies at (1, 0, 1)
  const Search::SurfacePoint at = search.surface_at(away);
  const vec3 b = search.bisector(task.viewer, task.vertex, at);
  const double own = std::acos(double(dot(b, at.normal)));
  EXPECT_NEAR(search.angle_of_error(search.projected_bisector(task, away, {0, 0, 1}).error), own, 1e-4);
  EXPECT_GT(std::abs(own - std::acos(double(dot(b, normalize(vec3(1, 0, 1)))))), 0.1);
}

TEST(NewtonSearch, FindsTheRootOfAlhazensQuarticOnABall) {
  const Ellipsoid ball;
  Search search{ball};
  for (const std::uint64_t seed : {1u, 2u, 3u, 11u}) {
    Random random(seed);
    int reflected = 0;
    for (const float reach : {1.02f, 1.1f, 1.5f, 4.0f, 50.0f})
      for (int i = 0; i < 1500; ++i) {
        const Task task = chance_task(ball, random, reach);
        const std::vector<glm::dvec3> truth = reflections_on_ball(task.viewer, task.vertex, false);
        if (truth.empty()) continue;  // hidden by the ball
        ASSERT_EQ(truth.size(), 1u) << "a convex reflector shows a vertex once";
        ++reflected;
        const Point point = newton(search, task);
        ASSERT_LT(point.angle, flag_angle);
        ASSERT_LT(glm::distance(glm::dvec3(point.position), truth[0]), 3e-3) << reach << ", seed " << seed;
      }
    EXPECT_GT(reflected, 1500);
  }
}

struct GrazingTask {
  glm::dvec3 point;  ///< where the vertex is reflected, by construction
  Task task;
};

/// A vertex that an ellipsoid shows to a grazing sight: `cosine` of incidence at a chance point, viewer and
/// vertex at chance distances on both sides.
GrazingTask grazing_task(const Ellipsoid& ellipsoid, Random& random, double cosine) {
  const glm::dvec3 r(ellipsoid.radii), direction(random_direction(random));
  const glm::dvec3 point = direction / glm::length(direction / r), normal = glm::normalize(point / (r * r));
  const glm::dvec3 along = glm::normalize(glm::cross(normal, glm::dvec3(random_direction(random))));
  const double sine = std::sqrt(1.0 - cosine * cosine);
  const double viewer_m = random.uniform(0.3f, 7.0f), vertex_m = std::pow(10.0f, random.uniform(-1.0f, 1.5f));
  return {point,
          {vec3(point + viewer_m * (cosine * normal + sine * along)),
           vec3(point + vertex_m * (cosine * normal - sine * along)), vec3(0.0f)}};
}

struct GrazingErrors {
  int flagged = 0;
  std::vector<double> off;  ///< distances from the reflection points, from the smallest on
  double at(double part) const { return off[std::size_t(part * double(off.size() - 1))]; }
};

/// Cosines from `min_cosine` to ten times that.
GrazingErrors grazing_errors(const Ellipsoid& ellipsoid, double min_cosine, int steps) {
  constexpr int tasks = 400;
  Search search{ellipsoid};
  Random random(5);
  GrazingErrors errors;
  errors.off.reserve(tasks);
  for (int i = 0; i < tasks; ++i) {
    const double cosine = min_cosine * std::pow(10.0, double(random.uniform()));
    const auto [truth, task] = grazing_task(ellipsoid, random, cosine);
    const Point point = search.search_by_newton(task, search.first_direction(task), true, search.free_growth,
                                                steps, tolerated_error);
    if (point.angle < flag_angle)
      errors.off.push_back(glm::distance(glm::dvec3(point.position), truth));
    else
      ++errors.flagged;
  }
  std::sort(errors.off.begin(), errors.off.end());
  return errors;
}

// Beyond the point of a grazing sight the angle hardly grows: a search that ends by the angle alone, or that
// takes the way's curvature for larger than it is, stays a hundredth of the radius off.
TEST(NewtonSearch, FindsPointsOfGrazingSight) {
  const Ellipsoid ball;
  for (const double min_cosine : {1e-3, 1e-2}) {
    const GrazingErrors errors = grazing_errors(ball, min_cosine, newton_steps);
    EXPECT_EQ(errors.flagged, 0);
    EXPECT_LT(errors.at(1.0), 3e-4) << min_cosine;
    for (const vec3 radii : {vec3(1, 0.6f, 0.8f), vec3(2, 0.9f, 0.6f)}) {
      const GrazingErrors of_ellipsoid = grazing_errors({radii}, min_cosine, patch_steps);
      EXPECT_LE(of_ellipsoid.flagged, 4);
      EXPECT_LT(of_ellipsoid.at(0.9), 3e-4) << min_cosine;
      EXPECT_LT(of_ellipsoid.at(1.0), 5e-3) << min_cosine;
    }
  }
  // Farther down floats cannot tell the heights of viewer and vertex over the surface from 0.
  const GrazingErrors flattest = grazing_errors(ball, 1e-4, patch_steps);
  EXPECT_EQ(flattest.flagged, 0);
  EXPECT_LT(flattest.at(0.5), 3e-4);
  EXPECT_LT(flattest.at(0.9), 2e-3);
  EXPECT_LT(flattest.at(1.0), 1e-2);
}

TEST(NewtonSearch, FindsTheShortestWayOverEllipsoids) {
  for (const std::uint64_t seed : {2u, 3u, 4u, 5u}) {
    Random random(seed);
    for (const vec3 radii : {vec3(1, 0.6f, 0.8f), vec3(2, 0.9f, 0.6f), vec3(0.3f, 1, 1)}) {
      const Ellipsoid ellipsoid{radii};
      Search search{ellipsoid};
      int reflected = 0;
      for (int i = 0; i < 150; ++i) {
        const Task task = chance_task(ellipsoid, random, i % 2 ? 1.1f : 2.5f);
        const std::vector<glm::dvec3> truth = reflections_on_ellipsoid(radii, task.viewer, task.vertex);
        if (truth.empty()) continue;
        ASSERT_EQ(truth.size(), 1u);
        ++reflected;
        const Point point = newton(search, task);
        if (point.angle > flag_angle) continue;  // flagged; how often is counted below
        ASSERT_LT(glm::distance(glm::dvec3(point.position), truth[0]), 5e-3) << "seed " << seed << ", " << i;
      }
      EXPECT_GT(reflected, 20);
    }
  }
}

TEST(NewtonSearch, SeldomFailsAndNeverSilently) {
  for (const vec3 radii : {vec3(1), vec3(1, 0.6f, 0.8f), vec3(2, 0.9f, 0.6f)})
    for (const float reach : {1.02f, 1.1f, 1.5f, 4.0f}) {
      const Ellipsoid ellipsoid{radii};
      Search search{ellipsoid};
      Random random(3);
      int flagged = 0;
      constexpr int tasks = 2000;
      for (int i = 0; i < tasks; ++i) {
        const Task task = chance_task(ellipsoid, random, reach);
        const Point point = newton(search, task);
        if (point.angle > flag_angle)
          ++flagged;
        else
          ASSERT_LT(true_angle(ellipsoid, point, task), degree);
      }
      EXPECT_LE(flagged, tasks / (reach < 1.05f ? 100 : 1000)) << radii.x << ", " << reach;
    }
}

// Row E12: a hidden vertex stands for its mirror image, and is found on the straight line from the viewer.
TEST(NewtonSearch, HiddenVerticesAreWhereTheLineOfSightMeetsTheReflector) {
  const Ellipsoid ellipsoid{{1, 0.6f, 0.8f}};
  Search search{ellipsoid};
  Random random(4);
  int hidden = 0;
  for (int i = 0; i < 500; ++i) {
    const Task task = chance_task(ellipsoid, random, 1.5f);
    const Point point = newton(search, task);
    if (dot(task.vertex - point.position, point.normal) > -0.05f) continue;
    ++hidden;
    ASSERT_LT(point.angle, flag_angle);
    const vec3 sight = normalize(task.vertex - task.viewer), to_point = point.position - task.viewer;
    EXPECT_LT(length(cross(sight, to_point)), 0.01f * length(to_point));
    EXPECT_GT(dot(task.viewer - point.position, point.normal), 0.0f) << "on the side that the viewer sees";
    // What it stands for is reflected where the vertex is hidden: the image of the image is the vertex.
    const vec3 image = search.virtual_vertex(task.vertex, point.position, point.normal);
    EXPECT_GT(dot(image - point.position, point.normal), 0.0f);
    EXPECT_LT(distance(search.virtual_vertex(image, point.position, point.normal), task.vertex), 1e-5f);
  }
  EXPECT_GT(hidden, 50);
}

TEST(NewtonSearch, AWarmStartIsNearlyThere) {
  const Ellipsoid ellipsoid{{1, 0.6f, 0.8f}};
  Search search{ellipsoid};
  Random random(6);
  int done = 0;
  for (int i = 0; i < 300; ++i) {
    Task task = chance_task(ellipsoid, random, 2.0f);
    const Point before = newton(search, task);
    task.viewer += 0.02f * random_direction(random);  // a frame later
    task.vertex += 0.02f * random_direction(random);
    done +=
        search.search_by_newton(task, before.direction, true, search.free_growth, 3, tolerated_error).angle <
                flag_angle
            ? 1
            : 0;
  }
  EXPECT_GT(done, 290) << "all but those at the rim of what the viewer sees";
}

/// How far viewer and vertex are from each other's caustic on the concave unit ball, by the mirror equation
/// 1 / viewer + 1 / vertex = 2 / cosine of a narrow bundle, relative to its right side: near 0 two roots
/// meet.
double from_caustic(glm::dvec3 position, const Task& task) {
  const glm::dvec3 p = glm::normalize(position);
  const glm::dvec3 to_viewer = glm::dvec3(task.viewer) - p, to_vertex = glm::dvec3(task.vertex) - p;
  const double cosine = -0.5 * glm::dot(glm::normalize(to_viewer) + glm::normalize(to_vertex), p);
  return std::abs(0.5 * cosine * (1.0 / glm::length(to_viewer) + 1.0 / glm::length(to_vertex)) - 1.0);
}

// What the paper says of convex reflectors does not hold for a concave one: a vertex has up to four
// reflection points. Just beyond a caustic, where two of them have met and gone, the angle has a minimum that
// is not 0: a search ends there and says its angle, which is drawn if it is small.
TEST(NewtonSearch, InAConcaveBallEveryPointFoundIsARootOrAtACausticAndAllCanBeFound) {
  constexpr double converged = 1.5e-4;  // radians; tolerated_error is 0.9e-4
  const Ellipsoid concave{vec3(1), true};
  Search search{concave};
  std::size_t maximum = 0;
  int beyond = 0;
  for (const std::uint64_t seed : {7u, 8u, 9u}) {
    Random random(seed);
    for (int i = 0; i < 200; ++i) {
      const auto inside = [&] {  // the length first: one of these vertices lies just beyond a caustic
        const float length_m = random.uniform(0.2f, 0.9f);
        return length_m * random_direction(random);
      };
      const vec3 viewer = inside();
      const Task task{viewer, inside(), vec3(0.0f)};
      const std::vector<glm::dvec3> truth = reflections_on_ball(task.viewer, task.vertex, true);
      maximum = std::max(maximum, truth.size());
      std::vector<bool> found(truth.size());
      for (int start = 0; start < 300; ++start) {
        const Point point = search.search_by_newton(task, random_direction(random), false, search.free_growth,
                                                    patch_steps, tolerated_error);
        if (!(point.angle < 1e-3f)) continue;
        const glm::dvec3 p(point.position);
        double nearest = 10.0;
        for (std::size_t k = 0; k < truth.size(); ++k) {
          const double off = glm::distance(p, truth[k]);
          nearest = std::min(nearest, off);
          if (off < 0.02) found[k] = true;
        }
        if (nearest < 0.05) continue;
        ++beyond;
        EXPECT_LT(from_caustic(p, task), 0.1) << "seed " << seed << ", task " << i;
        const double angle = bisector_angle(p, -glm::normalize(p), task.viewer, task.vertex);
        EXPECT_GT(angle, converged) << "a root that the quartic lacks: seed " << seed << ", task " << i;
        EXPECT_NEAR(angle, double(point.angle), converged);
      }
      EXPECT_EQ(std::count(found.begin(), found.end(), false), 0) << "seed " << seed << ", task " << i;
    }
  }
  EXPECT_EQ(maximum, 4u);
  EXPECT_GT(beyond, 0);
}

TEST(MidpointSearch, ConvergesOnABallWhoseViewerAndVertexAreFar) {
  const Ellipsoid ball;
  Search search{ball};
  const Task task{{0, 0, 50}, {50, 0, 0}, vec3(0.0f)};
  float last = 1.0f;
  for (const int iterations : {3, 5, 7, 9}) {
    const float angle =
        search.search_by_midpoint(task, normalize(vec3(1, 0.3f, 3)), iterations, tolerated_error).angle;
    EXPECT_LT(angle, last);
    last = angle;
  }
  EXPECT_LT(last, 0.01f);
}

// Mirrors in a kitchen are a tenth of a metre large: what ends well outside a face of the cube is an angle,
// not a length.
TEST(MidpointSearch, GoesTheSameWayOverSmallAndLargeBodies) {
  Random random(9);
  const Ellipsoid unit{{1, 0.6f, 0.8f}};
  Search search{unit};
  for (const float size : {0.05f, 20.0f}) {
    const Ellipsoid scaled{size * unit.radii};
    Search in_scale{scaled};
    for (int i = 0; i < 200; ++i) {
      const Task task = chance_task(unit, random, 2.5f);
      const Point point = midpoint(search, task, 3),
                  other = midpoint(in_scale, {size * task.viewer, size * task.vertex, vec3(0.0f)}, 3);
      EXPECT_LT(distance(point.position, other.position / size), 0.01f);
    }
  }
}

// Row E7 says that more than nine iterations give no noticeable improvement.
TEST(MidpointSearch, MoreThanNineIterationsDoImprove) {
  const Ellipsoid ellipsoid{{1, 0.6f, 0.8f}};
  const double by_9 =
      share_over_1_degree(ellipsoid, 1.5f, [](Search& s, const Task& t) { return midpoint(s, t, 9); });
  const double by_30 =
      share_over_1_degree(ellipsoid, 1.5f, [](Search& s, const Task& t) { return midpoint(s, t, 30); });
  EXPECT_GT(by_9, 0.05);
  EXPECT_LT(by_30, 0.5 * by_9);
}

// Row E4: a step along the bisector direction that is shorter than the way to R comes nearer to R. So it is
// on a ball, but not on every convex reflector.
TEST(MidpointSearch, TheBisectorLeadsNearerOnABallButNotAlways) {
  const auto steps_away = [](vec3 radii) {
    const Ellipsoid ellipsoid{radii};
    Search search{ellipsoid};
    Random random(8);
    int away = 0;
    for (int i = 0; i < 1000; ++i) {
      const Task task = chance_task(ellipsoid, random, 2.5f);
      const Point r = newton(search, task);
      if (r.angle > flag_angle || dot(task.vertex - r.position, r.normal) < 0.1f) continue;
      const Search::SurfacePoint p = search.surface_at(r.position + 0.8f * random_direction(random));
      const float length_m = distance(p.position, r.position);
      const vec3 along = search.bisector(task.viewer, task.vertex, p) - p.normal;
      const vec3 q = p.position + 0.9f * length_m * normalize(along);
      away += distance(q, r.position) > length_m ? 1 : 0;
    }
    return away;
  };
  EXPECT_EQ(steps_away(vec3(1)), 0);
  EXPECT_GT(steps_away({2, 0.9f, 0.6f}), 0);
}

// Made from the point: the vertex on the reflected ray, by the caustic, where a second root nearly meets it.
TEST(ExactReflection, OnAConcaveBallHasBothRootsThatNearlyMeetByACaustic) {
  Random random(1);
  int made = 0;
  for (int i = 0; i < 3000; ++i) {
    const glm::dvec3 p = glm::normalize(glm::dvec3(random_direction(random)));
    const double viewer_length = random.uniform(0.2f, 0.9f);
    const glm::dvec3 viewer = viewer_length * glm::dvec3(random_direction(random));
    const glm::dvec3 to_viewer = glm::normalize(viewer - p);
    const double cosine = -glm::dot(to_viewer, p), per_m = 2.0 / cosine - 1.0 / glm::distance(viewer, p);
    const double beside = (i % 2 ? 1.0 : -1.0) * std::pow(10.0, double(random.uniform(-12.0f, -1.0f)));
    if (per_m < 1.0 / cosine) continue;  // the caustic lies outside the ball
    ++made;
    const glm::dvec3 reflected = -2.0 * cosine * p - to_viewer;
    const std::vector<glm::dvec3> points =
        reflections_on_ball(viewer, p + (1.0 + beside) / per_m * reflected, true);
    const bool is_there =
        std::any_of(points.begin(), points.end(), [&](glm::dvec3 q) { return glm::distance(p, q) < 1e-4; });
    EXPECT_TRUE(is_there) << i << ", " << beside;
  }
  EXPECT_GT(made, 1000);
}

TEST(ExactReflection, OnATorusIsMirroredInItsPlaneOfSymmetryAndAtItsOutside) {
  const std::vector<glm::dvec3> opposite = reflections_on_torus(1.0, 0.4, {5, 0, 2}, {5, 0, -2});
  const auto shows = [&](glm::dvec3 p) {
    return std::any_of(opposite.begin(), opposite.end(),
                       [&](glm::dvec3 q) { return glm::distance(p, q) < 1e-9; });
  };
  EXPECT_TRUE(shows({1.4, 0, 0})) << "the outermost point toward both";
  EXPECT_TRUE(shows({-0.6, 0, 0})) << "and the one within the ring, on the other side";
  for (const glm::dvec3& p : opposite) EXPECT_TRUE(shows({p.x, p.y, -p.z}));
}

TEST(Searches, DoNotDependOnSizeAndPlace) {
  struct Moved {
    Ellipsoid ellipsoid;
    vec3 centre;
    float scale;
    std::pair<vec3, vec3> surface(vec3 direction) const {
      const auto [position, normal] = ellipsoid.surface(direction);
      return {centre + scale * position, normal};
    }
  };
  const Ellipsoid ellipsoid{{1, 0.6f, 0.8f}};
  const Moved moved{ellipsoid, {10, -20, 5}, 50.0f};
  Search search{ellipsoid};
  ReflectionSearch<Moved> other{moved};
  Random random(9);
  for (int i = 0; i < 200; ++i) {
    const Task task = chance_task(ellipsoid, random, 2.0f);
    const auto at = [&](vec3 p) { return moved.centre + moved.scale * p; };
    const ReflectionSearch<Moved>::ReflectionTask far_task{at(task.viewer), at(task.vertex), moved.centre};
    const vec3 start = search.first_direction(task);
    const auto by_newton =
        other.search_by_newton(far_task, start, true, other.free_growth, newton_steps, tolerated_error);
    EXPECT_LT(distance(by_newton.position, at(newton(search, task).position)), 0.02f * moved.scale);
    const auto by_midpoint = other.search_by_midpoint(far_task, start, 1, tolerated_error);
    EXPECT_LT(distance(by_midpoint.position, at(midpoint(search, task, 1).position)), 0.001f * moved.scale);
  }
}

TEST(Searches, StandWhatTouchesOrLiesWithin) {
  const Ellipsoid ellipsoid{{1, 0.6f, 0.8f}};
  Search search{ellipsoid};
  const vec3 outside(2, 1, 1), on = ellipsoid.surface(outside).first, centre(0.0f);
  for (const vec3 viewer : {outside, on, 0.5f * on, centre})
    for (const vec3 vertex : {outside, on, 0.5f * on, centre, -outside}) {
      const Task task{viewer, vertex, centre};
      for (const Point& point : {newton(search, task), midpoint(search, task, 9)})
        EXPECT_TRUE(!(point.angle <= flag_angle) || std::isfinite(length(point.position)))
            << "or it is flagged";
    }
}

}  // namespace
}  // namespace parvis::reflection_search

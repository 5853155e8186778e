#include "reflections/reflection_search/reflection_search.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/random.h"
#include "base/test_directions.h"
#include "reflections/reflection_search/ellipsoid.h"
#include "reflections/reflection_search/exact_reflection.h"

namespace parvis::reflection_search {
namespace {

using Search = ReflectionSearch<Ellipsoid>;
using Task = Search::ReflectionTask;
using Point = Search::ReflectionPoint;

constexpr float min_error = 2e-9f;  // 0.005 degrees
constexpr int newton_steps = 12;
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
                                 min_error);
}

Point midpoint(Search& search, const Task& task, int iterations) {
  return search.search_by_midpoint(task, search.first_direction(task), iterations, min_error);
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
  Random random(1);
  int reflected = 0;
  for (const float reach : {1.02f, 1.1f, 1.5f, 4.0f, 50.0f})
    for (int i = 0; i < 500; ++i) {
      const Task task = chance_task(ball, random, reach);
      const std::vector<glm::dvec3> truth = reflections_on_ball(task.viewer, task.vertex, false);
      if (truth.empty()) continue;  // hidden by the ball
      ASSERT_EQ(truth.size(), 1u) << "a convex reflector shows a vertex once";
      ++reflected;
      const Point point = newton(search, task);
      ASSERT_LT(point.angle, flag_angle);
      // Grazing sight stretches the angle's last 0.005 degrees along the surface.
      ASSERT_LT(glm::distance(glm::dvec3(point.position), truth[0]), 3e-3) << reach;
    }
  EXPECT_GT(reflected, 500);
}

TEST(NewtonSearch, FindsTheShortestWayOverEllipsoids) {
  Random random(2);
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
      ASSERT_LT(glm::distance(glm::dvec3(point.position), truth[0]), 5e-3);
    }
    EXPECT_GT(reflected, 20);
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
    done += search.search_by_newton(task, before.direction, true, search.free_growth, 3, min_error).angle <
                    flag_angle
                ? 1
                : 0;
  }
  EXPECT_GT(done, 290) << "all but those at the rim of what the viewer sees";
}

// What the paper says of convex reflectors does not hold for a concave one: a vertex has up to four
// reflection points.
TEST(NewtonSearch, InAConcaveBallEveryPointFoundIsARootAndAllCanBeFound) {
  const Ellipsoid concave{vec3(1), true};
  Search search{concave};
  Random random(7);
  std::size_t maximum = 0;
  for (int i = 0; i < 100; ++i) {
    const auto inside = [&] {
      const vec3 direction = random_direction(random);
      return random.uniform(0.2f, 0.9f) * direction;
    };
    const Task task{inside(), inside(), vec3(0.0f)};
    const std::vector<glm::dvec3> truth = reflections_on_ball(task.viewer, task.vertex, true);
    maximum = std::max(maximum, truth.size());
    std::vector<bool> found(truth.size());
    for (int start = 0; start < 300; ++start) {
      const Point point =
          search.search_by_newton(task, random_direction(random), false, search.free_growth, 20, min_error);
      if (!(point.angle < 1e-3f)) continue;
      double nearest = 10.0;
      for (std::size_t k = 0; k < truth.size(); ++k) {
        const double off = glm::distance(glm::dvec3(point.position), truth[k]);
        nearest = std::min(nearest, off);
        if (off < 0.02) found[k] = true;
      }
      EXPECT_LT(nearest, 0.05);
    }
    EXPECT_EQ(std::count(found.begin(), found.end(), false), 0) << i;
  }
  EXPECT_EQ(maximum, 4u);
}

TEST(MidpointSearch, ConvergesOnABallWhoseViewerAndVertexAreFar) {
  const Ellipsoid ball;
  Search search{ball};
  const Task task{{0, 0, 50}, {50, 0, 0}, vec3(0.0f)};
  float last = 1.0f;
  for (const int iterations : {3, 5, 7, 9}) {
    const float angle =
        search.search_by_midpoint(task, normalize(vec3(1, 0.3f, 3)), iterations, min_error).angle;
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
        other.search_by_newton(far_task, start, true, other.free_growth, newton_steps, min_error);
    EXPECT_LT(distance(by_newton.position, at(newton(search, task).position)), 0.02f * moved.scale);
    const auto by_midpoint = other.search_by_midpoint(far_task, start, 1, min_error);
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

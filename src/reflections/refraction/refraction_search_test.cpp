#include "reflections/refraction/refraction_search.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "reflections/reflection_search/test_ellipsoid.h"
#include "reflections/reflector_maps/reflector_map.h"
#include "scene/data/test_scene.h"

namespace parvis::refraction {
using namespace reflection_search;
using namespace reflector_maps;
namespace {

using Search = RefractionSearch<GlassBody>;
using glm::dvec2, glm::dvec3;

/// A ray traced in double precision through an ellipsoid about the origin.
struct ExactRay {
  bool gets_through = false;
  dvec3 entry{0.0}, inside{0.0}, exit{0.0}, outgoing{0.0};
};

dvec3 bent(dvec3 d, dvec3 n, double ratio) {
  const double cosine = -glm::dot(d, n), squared = 1.0 - ratio * ratio * (1.0 - cosine * cosine);
  return squared <= 0.0 ? dvec3(0.0) : glm::normalize(ratio * d + (ratio * cosine - std::sqrt(squared)) * n);
}

ExactRay trace(dvec3 radii, double ior, dvec3 from, dvec3 toward) {
  const auto normal = [&](dvec3 p) { return glm::normalize(p / (radii * radii)); };
  const auto crossings = [&](dvec3 o, dvec3 d) {  // nearer and farther
    const dvec3 p = o / radii, q = d / radii;
    const double a = glm::dot(q, q), b = glm::dot(p, q), inner = b * b - a * (glm::dot(p, p) - 1.0);
    return inner < 0.0 ? dvec2(-1.0) : dvec2(-b - std::sqrt(inner), -b + std::sqrt(inner)) / a;
  };
  ExactRay ray;
  const dvec3 d = glm::normalize(toward - from);
  const double near = crossings(from, d).x;
  if (near <= 0.0) return ray;
  ray.entry = from + near * d;
  ray.inside = bent(d, normal(ray.entry), 1.0 / ior);
  ray.exit = ray.entry + crossings(ray.entry, ray.inside).y * ray.inside;
  ray.outgoing = bent(ray.inside, -normal(ray.exit), ior);
  ray.gets_through = ray.outgoing != dvec3(0.0);
  return ray;
}

/// How many of its foci a ray has passed at a distance behind its exit: how often the area between it and its
/// neighbours has turned over, in the body and behind it.
int foci_within(dvec3 radii, double ior, dvec3 from, dvec3 toward, double distance) {
  const dvec3 axis = glm::normalize(toward - from);
  const dvec3 u = glm::normalize(glm::cross(axis, std::abs(axis.x) < 0.8 ? dvec3(1, 0, 0) : dvec3(0, 1, 0)));
  const ExactRay ray = trace(radii, ior, from, toward);
  const std::array<ExactRay, 2> beside{trace(radii, ior, from, toward + 1e-5 * u),
                                       trace(radii, ior, from, toward + 1e-5 * glm::cross(axis, u))};
  const auto turns = [&](dvec3 ExactRay::*start, dvec3 ExactRay::*outgoing, double length) {
    const auto area = [&](double t) {
      const dvec3 at = ray.*start + t * ray.*outgoing;
      const auto off = [&](const ExactRay& other) {
        return other.*start +
               glm::dot(at - other.*start, ray.*outgoing) / glm::dot(other.*outgoing, ray.*outgoing) *
                   (other.*outgoing) -
               at;
      };
      return glm::dot(glm::cross(off(beside[0]), off(beside[1])), ray.*outgoing);
    };
    int count = 0;
    for (int i = 1; i <= 400; ++i)
      count += (area(length * i / 400.0) > 0.0) != (area(length * (i - 1) / 400.0) > 0.0);
    return count;
  };
  return turns(&ExactRay::entry, &ExactRay::inside, glm::distance(ray.entry, ray.exit)) +
         turns(&ExactRay::exit, &ExactRay::outgoing, distance);
}

dvec3 chance_point(Random& random, double size) {
  return size * dvec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
}

GlassBody analytic(const Ellipsoid& ellipsoid, float ior) {
  return {[=](glm::vec3 d) { return ellipsoid.surface(d); }, glm::vec3(0.0f),
          std::max({ellipsoid.radii.x, ellipsoid.radii.y, ellipsoid.radii.z}), ior};
}

/// Results of the search for vertices that a random ray hits.
struct Findings {
  int tasks = 0, lost = 0, elsewhere = 0;
  double farthest = 0.0;  ///< entry from the truth, where it is that of the ray
};

/// Sends rays through an ellipsoid and looks for where they entered, from what they meet at `near` to `far`
/// radii.
Findings search_for_rays(const GlassBody& body, const Ellipsoid& ellipsoid, double near, double far,
                         int views) {
  Random random(4);
  Findings found;
  for (int v = 0; v < views; ++v) {
    const dvec3 viewer = double(random.uniform(2.5f, 8.0f)) * glm::normalize(chance_point(random, 1.0));
    const Search prepared{body, refraction_rays(body, viewer)};
    Search search = prepared;
    for (int i = 0; i < 60; ++i) {
      const dvec3 toward = 0.93 * glm::dvec3(ellipsoid.surface(glm::vec3(chance_point(random, 1.0))).first);
      const ExactRay ray = trace(ellipsoid.radii, body.ior, viewer, toward);
      if (!ray.gets_through) continue;
      const double distance = near + (far - near) * double(random.uniform());
      const dvec3 vertex = ray.exit + distance * ray.outgoing;
      const int foci = foci_within(ellipsoid.radii, body.ior, viewer, ray.entry, distance);
      const auto point =
          search.refracted_vertex({glm::vec3(viewer), glm::vec3(vertex), body.centre, body.ior}, foci);
      ++found.tasks;
      if (!search.is_refracted(point, foci)) {
        ++found.lost;
      } else if (const double off = glm::distance(dvec3(point.entry.position), ray.entry); off > 0.02) {
        ++found.elsewhere;
      } else {
        found.farthest = std::max(found.farthest, off);
      }
    }
  }
  return found;
}

TEST(RefractionSearch, FindsTheRayThroughABall) {
  const Ellipsoid ball;
  for (const float ior : {1.2f, 1.5f, 1.9f}) {
    const Findings far = search_for_rays(analytic(ball, ior), ball, 3.0, 20.0, 20);
    EXPECT_GT(far.tasks, 800);
    EXPECT_LT(far.lost, far.tasks / 50) << ior;
    EXPECT_LT(far.elsewhere, far.tasks / 100) << "behind the foci there is one such ray";
    const Findings near = search_for_rays(analytic(ball, ior), ball, 0.05, 3.0, 20);
    EXPECT_LT(near.lost, near.tasks / 50) << ior;
    EXPECT_LT(near.elsewhere, near.tasks / 50) << ior;
  }
}

TEST(RefractionSearch, FindsRaysThroughEllipsoids) {
  for (const glm::vec3 radii :
       {glm::vec3(1, 0.7f, 0.8f), glm::vec3(1, 1, 0.4f), glm::vec3(0.6f, 0.6f, 1.2f)}) {
    const Ellipsoid ellipsoid{radii};
    const Findings found = search_for_rays(analytic(ellipsoid, 1.5f), ellipsoid, 0.1, 8.0, 20);
    EXPECT_GT(found.tasks, 500);
    EXPECT_LT(found.lost, found.tasks / 30);
    EXPECT_LT(found.elsewhere, found.tasks / 15);
  }
}

TEST(RefractionSearch, FindsThemInMaps) {
  const Result<Reflector> ball = make_reflector(scene::sphere(glm::vec3(0.0f), 1.0f, 128), "ball", 512);
  ASSERT_TRUE(ball);
  const ReflectorMap& map = ball->maps.front();
  ASSERT_TRUE(map.is_whole_body() && map.is_convex && map.shows_once && ball->patches.size() == 1);
  const GlassBody body{[&](glm::vec3 d) { return map.surface(d); }, map.window.centre, map.window.reach,
                       1.5f};
  const Findings found = search_for_rays(body, Ellipsoid{}, 0.5, 10.0, 20);
  EXPECT_LT(found.lost, found.tasks / 50);
}

TEST(RefractionSearch, WhatCannotBeSeenIsReported) {
  const Ellipsoid ball;
  const GlassBody body = analytic(ball, 1.5f);
  const glm::vec3 viewer(0, 0, 4);
  Search search{body, refraction_rays(body, viewer)};
  for (const glm::vec3 vertex : {glm::vec3(0, 0, 2.5f), glm::vec3(3, 0, 3), glm::vec3(0.1f, 0.2f, 0.1f),
                                 viewer, glm::vec3(0.0f), glm::vec3(0, 0, 1)})
    for (int foci = 0; foci < refraction_layers; ++foci) {
      const auto point = search.refracted_vertex({viewer, vertex, body.centre, body.ior}, foci);
      EXPECT_FALSE(search.is_refracted(point, foci)) << vertex.x << " " << vertex.y << " " << vertex.z;
    }
}

TEST(RefractionRays, FociOfABallLieWhereOpticsSays) {
  for (const float ior : {1.33f, 1.5f, 1.8f}) {
    const GlassBody body = analytic(Ellipsoid{}, ior);
    const auto rays = refraction_rays(body, {0, 0, 400});    // from far away
    const float focus = ior / (2.0f * (ior - 1.0f)) - 1.0f;  // behind the exit
    EXPECT_NEAR(rays[0][0].w, focus, 0.1f * focus + 0.01f);
    EXPECT_NEAR(rays[0][1].w, focus, 0.1f * focus + 0.01f);
    EXPECT_NEAR(rays[0][1].z, -1.0f, 1e-3f);
    for (const glm::mat4& ray : rays) EXPECT_NEAR(glm::length(glm::vec3(ray[0])), 1.0f, 0.01f);
  }
}

TEST(RefractionRays, GoThroughABodyThatIsOfAirAsIfItWereNotThere) {
  const GlassBody body = analytic(Ellipsoid{{1.0f, 0.5f, 0.7f}}, 1.0001f);
  for (const glm::mat4& ray : refraction_rays(body, {3, 1, 2})) {
    const glm::vec3 seen = glm::normalize(glm::vec3(ray[0]) - glm::vec3(3, 1, 2));
    EXPECT_LT(glm::distance(seen, glm::vec3(ray[2])), 2e-3f);
  }
}

}  // namespace
}  // namespace parvis::refraction

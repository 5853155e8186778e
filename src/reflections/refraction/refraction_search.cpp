#include "reflections/refraction/refraction_search.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

namespace parvis::refraction {
namespace {

constexpr float no_focus = 1e9f;
constexpr float aside = 0.01f;  // of the body as seen: how far off the rays are whose foci are measured

struct Ring {
  float share;  ///< of the way to the rim
  int rays;
};
constexpr std::array<Ring, 5> rings{{{0.0f, 1}, {0.35f, 6}, {0.65f, 10}, {0.85f, 10}, {0.96f, 10}}};
static_assert(std::accumulate(rings.begin(), rings.end(), 0, [](int sum, const Ring& r) {
                return sum + r.rays;
              }) == int(refraction_ray_count));

struct TracedRay {
  glm::vec3 entry, inside, exit, outgoing;  ///< points, and unit directions behind them
};

/// Where neighbours of a ray come from a point and go on in a direction: how far ahead (or, below 0, behind)
/// they meet it. The area between them vanishes there: det(apart + t turned) = 0. None: a distance that is
/// reached nowhere.
glm::vec2 foci_of(glm::vec3 outgoing, const std::array<glm::vec3, 2>& points_apart,
                  const std::array<glm::vec3, 2>& directions_apart) {
  const glm::vec3 x = glm::normalize(
      glm::cross(std::abs(outgoing.x) < 0.8f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0), outgoing));
  const glm::vec3 y = glm::cross(outgoing, x);
  const auto across = [&](glm::vec3 d) { return glm::dvec2(glm::dot(d, x), glm::dot(d, y)); };
  const glm::dmat2 apart(across(points_apart[0]), across(points_apart[1]));
  const glm::dmat2 turned(across(directions_apart[0]), across(directions_apart[1]));
  const double a = glm::determinant(turned), c = glm::determinant(apart);
  const double b = apart[0][0] * turned[1][1] + turned[0][0] * apart[1][1] - apart[0][1] * turned[1][0] -
                   turned[0][1] * apart[1][0];
  const double inner = b * b - 4.0 * a * c;
  if (inner < 0.0 || a == 0.0) return glm::vec2(no_focus);
  const double root = std::sqrt(inner), maximum = no_focus;
  return {std::clamp((-b - root) / (2.0 * a), -maximum, maximum),
          std::clamp((-b + root) / (2.0 * a), -maximum, maximum)};
}

class ViewThrough {
 public:
  ViewThrough(const GlassBody& body, glm::vec3 viewer) : body_(body), search_{body}, viewer_(viewer) {
    axis_ = glm::normalize(body.centre - viewer);
    u_ =
        glm::normalize(glm::cross(std::abs(axis_.x) < 0.8f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0), axis_));
    v_ = glm::cross(axis_, u_);
  }

  /// Traces a ray toward a point beside the centre; nothing where the ray passes by, or all light is
  /// reflected inside.
  std::optional<TracedRay> trace(glm::vec2 beside) const {
    const glm::vec3 direction = glm::normalize(body_.centre + beside.x * u_ + beside.y * v_ - viewer_);
    const auto entry = near_side(direction);
    if (!entry) return std::nullopt;
    const glm::vec3 inside = refracted(direction, entry->second, 1.0f / body_.ior);
    const auto exit = search_.far_side(body_.centre, body_.reach, entry->first, inside);
    const glm::vec3 outgoing = refracted(inside, -exit.normal, body_.ior);
    if (outgoing == glm::vec3(0.0f)) return std::nullopt;
    return TracedRay{entry->first, inside, exit.position, outgoing};
  }

  /// How far beside the centre the body reaches that way.
  float rim(glm::vec2 direction) const {
    const float distance = glm::distance(viewer_, body_.centre);
    const float sine = std::min(body_.reach / distance, 0.999f);
    float met = 0.0f, missed = 1.01f * body_.reach / std::sqrt(1.0f - sine * sine);
    for (int i = 0; i < 14; ++i) {
      const float middle = 0.5f * (met + missed);
      const glm::vec2 beside = middle * direction;
      const glm::vec3 target = body_.centre + beside.x * u_ + beside.y * v_;
      (near_side(glm::normalize(target - viewer_)) ? met : missed) = middle;
    }
    return met;
  }

  /// The ray with its foci, found by two rays beside it.
  glm::mat4 start(const TracedRay& ray, glm::vec2 beside) const {
    const float off = aside * body_.reach;
    glm::vec2 foci(no_focus);
    const auto along_u = trace(beside + glm::vec2(off, 0.0f)), along_v = trace(beside + glm::vec2(0.0f, off));
    if (along_u && along_v) foci = foci_behind(ray, *along_u, *along_v);
    return {glm::vec4(ray.entry, foci.x), glm::vec4(ray.exit, foci.y), glm::vec4(ray.outgoing, 0.0f),
            glm::vec4(0.0f)};
  }

 private:
  /// Where a ray from the viewer enters. Tangent planes again: each step stays outside.
  std::optional<std::pair<glm::vec3, glm::vec3>> near_side(glm::vec3 direction) const {
    const glm::vec3 to_centre = body_.centre - viewer_;
    const glm::vec3 passing =
        glm::dot(to_centre, direction) * direction - to_centre;  // nearest to the centre
    const float squared = body_.reach * body_.reach - glm::dot(passing, passing);
    if (squared <= 0.0f) return std::nullopt;
    const float half = std::sqrt(squared);
    float along = std::max(-half, -glm::dot(to_centre, direction));  // not behind the viewer
    for (int i = 0; i < 24 && along <= half; ++i) {
      const glm::vec3 from_centre = passing + along * direction;
      const auto [position, normal] = body_.surface(from_centre);
      const float height = glm::dot(body_.centre + from_centre - position, normal);
      const float slope = glm::dot(direction, normal);
      if (height < 1e-5f * body_.reach) return std::pair(body_.centre + from_centre, normal);
      if (slope > -1e-3f) return std::nullopt;
      along -= height / slope;
    }
    return std::nullopt;
  }

  /// Distances behind the exit; 0 for a focus that lies in the body already.
  static glm::vec2 foci_behind(const TracedRay& ray, const TracedRay& u, const TracedRay& v) {
    const glm::vec2 within = foci_of(ray.inside, {u.entry - ray.entry, v.entry - ray.entry},
                                     {u.inside - ray.inside, v.inside - ray.inside});
    glm::vec2 behind = foci_of(ray.outgoing, {u.exit - ray.exit, v.exit - ray.exit},
                               {u.outgoing - ray.outgoing, v.outgoing - ray.outgoing});
    const float length = glm::distance(ray.entry, ray.exit);
    int passed = 0;
    for (int k = 0; k < 2; ++k) passed += within[k] > 0.0f && within[k] < length ? 1 : 0;
    for (int k = 0; k < 2; ++k)
      if (behind[k] <= 0.0f) behind[k] = passed-- > 0 ? 0.0f : no_focus;
    return behind;
  }

  const GlassBody& body_;
  mutable RefractionSearch<GlassBody> search_;
  glm::vec3 viewer_, axis_{0.0f}, u_{0.0f}, v_{0.0f};
};

}  // namespace

std::array<glm::mat4, refraction_ray_count> refraction_rays(const GlassBody& body, glm::vec3 viewer) {
  const ViewThrough view(body, viewer);
  std::array<glm::mat4, refraction_ray_count> rays;
  // What no light takes out of the body misses every vertex: a way longer than any.
  const glm::vec4 nowhere(glm::vec3(9.0f), 0.0f);
  rays.fill({nowhere, nowhere, nowhere, nowhere});
  std::size_t next = 0;
  for (const Ring& ring : rings)
    for (int i = 0; i < ring.rays; ++i, ++next) {
      const float turn = 6.2831853f * (float(i) + ring.share) / float(ring.rays);
      const glm::vec2 direction(std::cos(turn), std::sin(turn));
      const glm::vec2 beside = ring.share * view.rim(direction) * direction;
      if (const auto ray = view.trace(beside)) rays[next] = view.start(*ray, beside);
    }
  return rays;
}

}  // namespace parvis::refraction

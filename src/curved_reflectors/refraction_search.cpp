#include "curved_reflectors/refraction_search.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace parvis::curved_reflectors {
namespace {

constexpr float no_focus = 1e9f;
constexpr float aside = 0.01f;  // of the body as seen: how far off the rays are whose foci are measured

struct Ring {
  float share;  ///< of the way to the rim
  int rays;
};
constexpr std::array<Ring, 5> rings{{{0.0f, 1}, {0.35f, 6}, {0.65f, 10}, {0.85f, 10}, {0.96f, 10}}};

struct TracedRay {
  glm::vec3 entry, exit, way;
};

class ViewThrough {
 public:
  ViewThrough(const GlassBody& body, glm::vec3 viewer) : body_(body), search_{body}, viewer_(viewer) {
    axis_ = glm::normalize(body.centre - viewer);
    u_ =
        glm::normalize(glm::cross(std::abs(axis_.x) < 0.8f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0), axis_));
    v_ = glm::cross(axis_, u_);
  }

  /// Toward a point beside the centre; nothing where the ray passes by, or all light is reflected inside.
  std::optional<TracedRay> trace(glm::vec2 beside) const {
    const glm::vec3 direction = glm::normalize(body_.centre + beside.x * u_ + beside.y * v_ - viewer_);
    const auto entry = near_side(direction);
    if (!entry) return std::nullopt;
    const glm::vec3 inside = refracted(direction, entry->second, 1.0f / body_.ior);
    const auto exit = search_.far_side(body_.centre, body_.reach, entry->first, inside);
    const glm::vec3 way = refracted(inside, -exit.normal, body_.ior);
    if (way == glm::vec3(0.0f)) return std::nullopt;
    return TracedRay{entry->first, exit.position, way};
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
    if (along_u && along_v) foci = foci_of(ray, *along_u, *along_v);
    return {glm::vec4(ray.entry, foci.x), glm::vec4(ray.exit, foci.y), glm::vec4(ray.way, 0.0f),
            glm::vec4(0.0f)};
  }

 private:
  /// Where a ray from the viewer enters. Tangent planes again: each step stays outside.
  std::optional<std::pair<glm::vec3, glm::vec3>> near_side(glm::vec3 direction) const {
    const glm::vec3 to_centre = body_.centre - viewer_;
    const float middle = glm::dot(to_centre, direction);
    const float squared = middle * middle + body_.reach * body_.reach - glm::dot(to_centre, to_centre);
    if (squared <= 0.0f) return std::nullopt;
    float along = std::max(middle - std::sqrt(squared), 0.0f);
    for (int i = 0; i < 24; ++i) {
      const glm::vec3 point = viewer_ + along * direction;
      const auto [position, normal] = body_.surface(point - body_.centre);
      const float height = glm::dot(point - position, normal), slope = glm::dot(direction, normal);
      if (height < 1e-5f * body_.reach) return std::pair(point, normal);
      if (slope > -1e-3f) return std::nullopt;
      along -= height / slope;
      if (along > middle + std::sqrt(squared)) return std::nullopt;
    }
    return std::nullopt;
  }

  /// Distances behind the exit at which neighbouring rays meet: where the area between them vanishes.
  static glm::vec2 foci_of(const TracedRay& ray, const TracedRay& along_u, const TracedRay& along_v) {
    const glm::vec3 x = glm::normalize(
        glm::cross(std::abs(ray.way.x) < 0.8f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0), ray.way));
    const glm::vec3 y = glm::cross(ray.way, x);
    const auto across = [&](glm::vec3 d) { return glm::dvec2(glm::dot(d, x), glm::dot(d, y)); };
    const glm::dmat2 apart(across(along_u.exit - ray.exit), across(along_v.exit - ray.exit));
    const glm::dmat2 turned(across(along_u.way - ray.way), across(along_v.way - ray.way));
    const double a = glm::determinant(turned), c = glm::determinant(apart);
    const double b = apart[0][0] * turned[1][1] + turned[0][0] * apart[1][1] - apart[0][1] * turned[1][0] -
                     turned[0][1] * apart[1][0];
    const double inner = b * b - 4.0 * a * c;
    if (inner < 0.0 || a == 0.0) return glm::vec2(no_focus);
    const auto distance = [](double t) { return t > 0.0 ? float(std::min(t, double(no_focus))) : no_focus; };
    return {distance((-b - std::sqrt(inner)) / (2.0 * a)), distance((-b + std::sqrt(inner)) / (2.0 * a))};
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

}  // namespace parvis::curved_reflectors

#include "reflections/reflection_search/test_exact_reflection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

namespace parvis::reflection_search {
namespace {

using Complex = std::complex<double>;
using Quartic = std::array<Complex, 5>;  ///< from the constant on

/// How far from the unit circle a root may be computed that lies on it: two that nearly meet, where the
/// vertex is by a caustic, come out up to the square root of the rounding error off. One that truly is so far
/// off reflects to within the square of this, in radians.
constexpr double circle_width = 1e-5;

/// All roots at once (Durand 1960, Kerner 1966).
std::array<Complex, 4> roots_of(const Quartic& polynomial) {
  std::array<Complex, 4> roots;
  for (std::size_t i = 0; i < 4; ++i) roots[i] = std::pow(Complex(0.4, 0.9), double(i));
  for (int round = 0; round < 200; ++round) {
    double change = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
      Complex value = polynomial[4], others = polynomial[4];
      for (std::size_t k = 4; k-- > 0;) value = value * roots[i] + polynomial[k];
      for (std::size_t k = 0; k < 4; ++k)
        if (k != i) others *= roots[i] - roots[k];
      const Complex step = value / others;
      roots[i] -= step;
      change = std::max(change, std::abs(step));
    }
    if (change < 1e-15) break;
  }
  return roots;
}

/// The way over a point of the ellipsoid, stationary with multiplier `lambda`: sum of the unit vectors to
/// viewer and vertex less lambda times the gradient of the ellipsoid's equation, and the equation itself.
struct Stationary {
  glm::dvec4 value;
  glm::dmat4 derivative;
};

Stationary stationary(glm::dvec3 weights, glm::dvec3 viewer, glm::dvec3 vertex, glm::dvec4 x) {
  const glm::dvec3 p(x);
  const glm::dvec3 gradient = weights * p;
  glm::dvec3 sum(0.0);
  glm::dmat3 turning(0.0);
  for (const glm::dvec3 end : {viewer, vertex}) {
    const double distance = glm::distance(end, p);
    const glm::dvec3 unit = (end - p) / distance;
    sum += unit;
    turning += (glm::outerProduct(unit, unit) - glm::dmat3(1.0)) / distance;
  }
  for (int i = 0; i < 3; ++i) turning[i][i] -= x.w * weights[i];
  Stationary s;
  s.value = glm::dvec4(sum - x.w * gradient, 0.5 * (glm::dot(gradient, p) - 1.0));
  for (int i = 0; i < 3; ++i) s.derivative[i] = glm::dvec4(turning[i], gradient[i]);
  s.derivative[3] = glm::dvec4(-gradient, 0.0);
  return s;
}

glm::dvec3 spread_over_ball(int i, int count) {
  const double z = 1.0 - 2.0 * (i + 0.5) / count, across = std::sqrt(1.0 - z * z),
               turn = 2.399963229728653 * i;
  return {across * std::cos(turn), across * std::sin(turn), z};
}

/// A torus by two turns: round its axis, and round its tube.
struct Torus {
  double ring, tube;

  glm::dvec3 normal(glm::dvec2 turns) const {
    return {std::cos(turns.y) * std::cos(turns.x), std::cos(turns.y) * std::sin(turns.x), std::sin(turns.y)};
  }
  glm::dvec3 position(glm::dvec2 turns) const {
    return ring * glm::dvec3(std::cos(turns.x), std::sin(turns.x), 0.0) + tube * normal(turns);
  }
  /// How the way over the point changes round the axis and round the tube; 0 where it is stationary.
  glm::dvec2 slope(glm::dvec2 turns, glm::dvec3 viewer, glm::dvec3 vertex) const {
    const glm::dvec3 p = position(turns), sum = glm::normalize(viewer - p) + glm::normalize(vertex - p);
    const glm::dvec3 along_ring(-std::sin(turns.x), std::cos(turns.x), 0.0);
    return {glm::dot(sum, along_ring), glm::dot(sum, glm::cross(normal(turns), along_ring))};
  }
};

void add_if_new(std::vector<glm::dvec3>& points, glm::dvec3 point) {
  const auto is_same = [&](glm::dvec3 known) { return glm::distance(known, point) < 1e-6; };
  if (std::none_of(points.begin(), points.end(), is_same)) points.push_back(point);
}

}  // namespace

double bisector_angle(glm::dvec3 position, glm::dvec3 normal, glm::dvec3 viewer, glm::dvec3 vertex) {
  const double height = std::min(glm::dot(vertex - position, normal), 0.0);
  const glm::dvec3 seen = vertex - 2.0 * height * normal;
  const glm::dvec3 sum = glm::normalize(viewer - position) + glm::normalize(seen - position);
  return glm::length(sum) < 1e-12 ? 0.0
                                  : std::atan2(glm::length(glm::cross(sum, normal)), glm::dot(sum, normal));
}

// In the plane of centre, viewer and vertex as complex numbers a and b, a point z of the unit circle reflects
// where (a - z)(b - z) / z^2 is real: conj(ab) z^4 - conj(a + b) z^3 + (a + b) z - ab = 0.
std::vector<glm::dvec3> reflections_on_ball(glm::dvec3 viewer, glm::dvec3 vertex, bool is_concave) {
  const glm::dvec3 x = glm::normalize(viewer);
  glm::dvec3 y = vertex - glm::dot(vertex, x) * x;
  if (glm::length(y) < 1e-12 * glm::length(vertex))
    y = glm::cross(x, std::abs(x.x) < 0.8 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0));
  y = glm::normalize(y);
  const Complex a(glm::length(viewer), 0.0), b(glm::dot(vertex, x), glm::dot(vertex, y));
  std::vector<glm::dvec3> points;
  for (const Complex& z : roots_of({-a * b, a + b, 0.0, -std::conj(a + b), std::conj(a * b)})) {
    if (std::abs(std::abs(z) - 1.0) > circle_width) continue;
    const double viewer_height = (a * std::conj(z)).real() - 1.0,
                 vertex_height = (b * std::conj(z)).real() - 1.0;
    const bool reflects =
        is_concave ? viewer_height < 0.0 && vertex_height < 0.0 : viewer_height > 0.0 && vertex_height > 0.0;
    if (reflects) add_if_new(points, z.real() * x + z.imag() * y);
  }
  return points;
}

std::vector<glm::dvec3> reflections_on_ellipsoid(glm::dvec3 radii, glm::dvec3 viewer, glm::dvec3 vertex,
                                                 int starts) {
  const glm::dvec3 weights = 1.0 / (radii * radii);
  std::vector<glm::dvec3> points;
  for (int i = 0; i < starts; ++i) {
    glm::dvec4 x(radii * spread_over_ball(i, starts), 1.0);
    for (int step = 0; step < 60; ++step) {
      const Stationary s = stationary(weights, viewer, vertex, x);
      glm::dvec4 d = -(glm::inverse(s.derivative) * s.value);
      const double size = glm::length(glm::dvec3(d)), longest = 0.3 * std::min({radii.x, radii.y, radii.z});
      if (size > longest) d *= longest / size;
      x += d;
      if (!(glm::length(d) > 1e-14)) break;
    }
    const glm::dvec3 p(x), normal = glm::normalize(weights * p);
    const bool is_on = std::abs(glm::dot(weights * p, p) - 1.0) < 1e-10;
    const bool reflects = glm::dot(viewer - p, normal) > 0.0 && glm::dot(vertex - p, normal) > 0.0;
    if (is_on && reflects && bisector_angle(p, normal, viewer, vertex) < 1e-9) add_if_new(points, p);
  }
  return points;
}

std::vector<glm::dvec3> reflections_on_torus(double ring, double tube, glm::dvec3 viewer, glm::dvec3 vertex) {
  constexpr int ring_starts = 40, tube_starts = 20, max_steps = 40;
  constexpr double turn = 6.283185307179586, probe = 1e-5, longest = 0.2;
  const Torus torus{ring, tube};
  std::vector<glm::dvec3> points;
  for (int i = 0; i < ring_starts * tube_starts; ++i) {
    const int round_ring = i / tube_starts, round_tube = i % tube_starts;
    glm::dvec2 turns(turn * (round_ring + 0.5) / ring_starts, turn * (round_tube + 0.5) / tube_starts);
    for (int step = 0; step < max_steps; ++step) {
      const auto change = [&](glm::dvec2 along) {
        return (torus.slope(turns + probe * along, viewer, vertex) -
                torus.slope(turns - probe * along, viewer, vertex)) /
               (2.0 * probe);
      };
      const glm::dmat2 derivative(change({1, 0}), change({0, 1}));
      if (std::abs(glm::determinant(derivative)) < 1e-14) break;
      glm::dvec2 d = -(glm::inverse(derivative) * torus.slope(turns, viewer, vertex));
      if (glm::length(d) > longest) d *= longest / glm::length(d);
      turns += d;
      if (glm::length(d) < 1e-12) break;
    }
    const glm::dvec3 p = torus.position(turns), normal = torus.normal(turns);
    const bool reflects = glm::dot(viewer - p, normal) > 0.0 && glm::dot(vertex - p, normal) > 0.0;
    if (reflects && bisector_angle(p, normal, viewer, vertex) < 1e-9) add_if_new(points, p);
  }
  return points;
}

}  // namespace parvis::reflection_search

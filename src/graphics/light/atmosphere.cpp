#include "graphics/light/atmosphere.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <numbers>

#include "base/parallel.h"

namespace parvis::light {
namespace {

/// Rays of a projection: Gauss-Legendre points of the cosine to the vertical, and turns on one side of the
/// sun's plane.
constexpr int ray_cosines = 16, ray_turns = 6, ray_steps = 16;
/// Turns of light that haze scattered once, which is brightest about the sun.
constexpr int fine_turns = 24;
constexpr int max_orders = 40;
/// An order that changes no harmonic by more than this share is the last.
constexpr float min_change = 3e-3f;

constexpr double gauss_points[8] = {0.0950125098376374, 0.2816035507792589, 0.4580167776572274,
                                    0.6178762444026438, 0.7554044083550030, 0.8656312023878318,
                                    0.9445750230732326, 0.9894009349916499};
constexpr double gauss_weights[8] = {0.1894506104550685, 0.1826034150449236, 0.1691565193950025,
                                     0.1495959888165767, 0.1246289712555339, 0.0951585116824928,
                                     0.0622535239386479, 0.0271524594117541};

std::array<float, 6> basis(float x, float z) {
  const float y2 = std::max(0.0f, 1.0f - x * x - z * z);
  return {0.282095f,         0.488603f * z,           0.488603f * x, 0.315392f * (3.0f * z * z - 1.0f),
          1.092548f * x * z, 0.546274f * (x * x - y2)};
}
constexpr int order_of[6] = {0, 1, 1, 2, 2, 2};
/// The factor of a phase function on a harmonic, by order: of molecules 1, 0, 1/10; of Henyey and Greenstein
/// g^order.
constexpr float molecules_keep[3] = {1.0f, 0.0f, 0.1f};
const float haze_keep[3] = {1.0f, haze_asymmetry, haze_asymmetry* haze_asymmetry};

/// The direction seen from a place: its cosine to the vertical, and along the horizon toward the sun.
struct Local {
  float x, z;
};
Local local(glm::dvec3 direction, glm::dvec3 up, glm::dvec3 to_sun, double sun_mu) {
  const double z = glm::dot(direction, up), across = std::sqrt(std::max(0.0, 1.0 - sun_mu * sun_mu));
  const double x = across > 1e-6 ? (glm::dot(direction, to_sun) - z * sun_mu) / across : 0.0;
  return {float(x), float(z)};
}

/// Sun elevations lie close where the sun sets. Deeper than 20 degrees below the horizon of a place no light
/// is left.
constexpr double min_sun_mu = -0.35;
const double min_sun_root = -std::sqrt(-min_sun_mu);
double sun_coordinate(double mu) {
  const double root = std::copysign(std::sqrt(std::abs(mu)), mu);
  return std::clamp((root - min_sun_root) / (1.0 - min_sun_root), 0.0, 1.0);
}
double sun_at(double coordinate) {
  const double root = min_sun_root + coordinate * (1.0 - min_sun_root);
  return std::copysign(root * root, root);
}

glm::dvec3 direction_at(double mu) { return {std::sqrt(std::max(0.0, 1.0 - mu * mu)), 0.0, mu}; }

}  // namespace

AirColumns::AirColumns() : columns_(std::size_t(heights) * cosines) {
  parallel_for(std::size_t(heights), [&](std::size_t row) {
    const double u = double(row) / (heights - 1);
    const double r = ground_radius_m + u * u * (top_radius_m - ground_radius_m);
    const double horizon = -std::sqrt(std::max(0.0, 1.0 - ground_radius_m * ground_radius_m / (r * r)));
    for (int column = 0; column < cosines; ++column) {
      const double v = double(column) / (cosines - 1), mu = horizon + (1.0 - horizon) * v * v;
      const double length = distance_to_top(r, mu);
      constexpr int steps = 400;
      glm::dvec3 sum(0.0);
      for (int i = 0; i < steps; ++i) {  // steps grow along the ray: the air is densest near its lowest end
        const double from = double(i) / steps, to = double(i + 1) / steps,
                     t = 0.5 * length * (from * from + to * to);
        const Densities d = densities_at(std::sqrt(r * r + t * t + 2.0 * r * mu * t) - ground_radius_m);
        sum += length * (to * to - from * from) * glm::dvec3(d.molecules, d.haze, d.ozone);
      }
      columns_[row * cosines + std::size_t(column)] = sum;
    }
  });
}

const AirColumns& AirColumns::table() {
  static const AirColumns columns;
  return columns;
}

Densities AirColumns::to_top(double r, double mu) const {
  const double u = std::sqrt(std::clamp((r - ground_radius_m) / (top_radius_m - ground_radius_m), 0.0, 1.0));
  const double horizon = -std::sqrt(std::max(0.0, 1.0 - ground_radius_m * ground_radius_m / (r * r)));
  const double v = std::sqrt(std::clamp((mu - horizon) / (1.0 - horizon), 0.0, 1.0));
  const double y = u * (heights - 1), x = v * (cosines - 1);
  const int row = std::min(int(y), heights - 2), column = std::min(int(x), cosines - 2);
  const float fy = float(y - row), fx = float(x - column);
  const glm::vec3* cell = &columns_[std::size_t(row) * cosines + std::size_t(column)];
  const glm::vec3 sum =
      glm::mix(glm::mix(cell[0], cell[1], fx), glm::mix(cell[cosines], cell[cosines + 1], fx), fy);
  return {double(sum.x), double(sum.y), double(sum.z)};
}

Spectrum sunlight(const AirCoefficients& air, double r, double sun_mu) {
  const double share = visible_disc(r, sun_mu);
  if (share <= 0.0) return Spectrum();
  return float(share) * attenuation(air.extinction(AirColumns::table().to_top(r, sun_mu)));
}

Atmosphere::Atmosphere(const Air& air) : air_(air), coefficients_(air), fields_(std::size_t(heights) * suns) {
  add_orders();
}

Atmosphere::Place Atmosphere::place_of(int height, int sun) const {
  const double u = double(height) / (heights - 1);
  return {ground_radius_m + 1.0 + u * u * (top_radius_m - ground_radius_m - 2.0),
          sun_at(double(sun) / (suns - 1))};
}

Atmosphere::Field Atmosphere::field_at(double r, double sun_mu) const {
  const double y = (heights - 1) *
                   std::sqrt(std::clamp((r - ground_radius_m) / (top_radius_m - ground_radius_m), 0.0, 1.0));
  const double x = (suns - 1) * sun_coordinate(sun_mu);
  const int row = std::min(int(y), heights - 2), column = std::min(int(x), suns - 2);
  const float fy = float(y - row), fx = float(x - column);
  const Field* cell = &fields_[std::size_t(row) * suns + std::size_t(column)];
  Field result;
  for (int i = 0; i < harmonics; ++i) {
    const std::size_t k = std::size_t(i);
    result[k] = (1.0f - fy) * ((1.0f - fx) * cell[0][k] + fx * cell[1][k]) +
                fy * ((1.0f - fx) * cell[suns][k] + fx * cell[suns + 1][k]);
  }
  return result;
}

/// Radiance of the ground: Lambertian, under the sun and the sky of the field so far.
Spectrum Atmosphere::ground_light(glm::dvec3 normal, glm::dvec3 to_sun) const {
  const double sun_mu = glm::dot(normal, to_sun), r = ground_radius_m + 1.0;
  const Field field = field_at(r, sun_mu);
  // Irradiance of a horizontal plane by harmonics convolved with the cosine (Ramamoorthi and Hanrahan 2001).
  const std::array<float, harmonics> up = basis(0.0f, 1.0f);
  Spectrum irradiance = (glm::pi<float>() * up[0]) * field[0] + (2.0943951f * up[1]) * field[1] +
                        (0.7853982f * up[3]) * field[3];
  for (float& value : irradiance.values) value = std::max(value, 0.0f);
  irradiance += float(std::max(sun_mu, 0.0)) * sunlight(coefficients_, r, sun_mu);
  return float(air_.ground_albedo) / glm::pi<float>() * irradiance;
}

Atmosphere::Ray Atmosphere::ray_from(double r, double mu, int steps) const {
  Ray ray;
  ray.meets_ground = meets_ground(r, mu);
  ray.length_m = ray.meets_ground ? distance_to_ground(r, mu) : distance_to_top(r, mu);
  ray.left = Spectrum(1.0f);
  ray.steps.reserve(std::size_t(steps));
  for (int i = 0; i < steps; ++i) {  // steps grow with the distance: the air near the viewer counts most
    const double from = double(i) / steps, to = double(i + 1) / steps;
    Step step;
    step.t = 0.5 * ray.length_m * (from * from + to * to);
    step.length_m = ray.length_m * (to * to - from * from);
    step.r = std::sqrt(r * r + step.t * step.t + 2.0 * r * mu * step.t);
    const Densities density = densities_at(step.r - ground_radius_m);
    const Spectrum extinction = coefficients_.extinction(density);
    const Spectrum through = attenuation(float(step.length_m) * extinction);
    for (int band = 0; band < band_count; ++band) {
      // the source is even over the step, its light attenuated within it (Hillaire 2015)
      const float depth = float(step.length_m) * extinction[band];
      const float lit = depth > 1e-3f ? (1.0f - through[band]) / extinction[band]
                                      : float(step.length_m) * (1.0f - 0.5f * depth);
      step.molecules[band] = ray.left[band] * lit * float(density.molecules) * coefficients_.molecules[band];
      step.haze[band] = ray.left[band] * lit * float(density.haze) * coefficients_.haze_scattering[band];
    }
    ray.left *= through;
    ray.steps.push_back(step);
  }
  return ray;
}

/// Light that air scatters along a ray, of light that was scattered before; the ray's horizontal part makes
/// an angle `turn` with the sun's.
Spectrum Atmosphere::scattered_again(const Place& place, const Ray& ray, double z, double turn) const {
  const double across = std::sqrt(std::max(0.0, 1.0 - z * z));
  const glm::dvec3 direction(across * std::cos(turn), across * std::sin(turn), z),
      to_sun = direction_at(place.sun_mu);
  const glm::dvec3 origin(0.0, 0.0, place.r);
  Spectrum sum;
  for (const Step& step : ray.steps) {
    const glm::dvec3 up = (origin + step.t * direction) / step.r;
    const double sun_mu = glm::dot(up, to_sun);
    const Local seen = local(direction, up, to_sun, sun_mu);
    const std::array<float, harmonics> weight = basis(seen.x, seen.z);
    const Field field = field_at(step.r, sun_mu);
    Spectrum by_molecules, by_haze;
    for (std::size_t k = 0; k < harmonics; ++k) {
      if (order_of[k] != 1) by_molecules += (weight[k] * molecules_keep[order_of[k]]) * field[k];
      by_haze += (weight[k] * haze_keep[order_of[k]]) * field[k];
    }
    for (int band = 0; band < band_count; ++band)
      // harmonics of second order may swing below zero where there is next to no light
      sum[band] +=
          std::max(0.0f, step.molecules[band] * by_molecules[band] + step.haze[band] * by_haze[band]);
  }
  if (ray.meets_ground)
    sum += ray.left * ground_light(glm::normalize(origin + ray.length_m * direction), to_sun);
  return sum;
}

Atmosphere::View Atmosphere::view(double height_m, glm::dvec3 direction, glm::dvec3 to_sun, int steps) const {
  const double r = ground_radius_m + height_m, sun_mu = to_sun.z;
  const Ray ray = ray_from(r, direction.z, steps);
  const glm::dvec2 level(direction), sun_level(to_sun);
  const double lengths = glm::length(level) * glm::length(sun_level);
  const double turn =
      lengths > 1e-12 ? std::acos(std::clamp(glm::dot(level, sun_level) / lengths, -1.0, 1.0)) : 0.0;
  View view{scattered_again({r, sun_mu}, ray, direction.z, turn), {}};
  const double cosine = glm::dot(direction, to_sun);
  for (const Step& step : ray.steps) {
    const double mu = (r * sun_mu + step.t * cosine) / step.r;
    const Spectrum sun = sunlight(coefficients_, step.r, mu);
    view.radiance += molecule_phase(float(cosine)) * (step.molecules * sun);
    view.haze_once += step.haze * sun;
  }
  return view;
}

template <class Light>
Atmosphere::Field Atmosphere::projected(const Place& place, int turns, const Light& light) const {
  Field sums{};
  for (int i = 0; i < ray_cosines; ++i) {
    const double z = i % 2 == 0 ? gauss_points[i / 2] : -gauss_points[i / 2], across = std::sqrt(1.0 - z * z);
    const float solid_angle = float(gauss_weights[i / 2] * 2.0 * std::numbers::pi / turns);
    for (int k = 0; k < turns; ++k) {
      const double turn = std::numbers::pi * (k + 0.5) / turns;
      const std::array<float, harmonics> to = basis(float(across * std::cos(turn)), float(z));
      const Spectrum seen = light(place, i, z, turn);
      for (std::size_t h = 0; h < harmonics; ++h) sums[h] += (solid_angle * to[h]) * seen;
    }
  }
  return sums;
}

void Atmosphere::add_orders() {
  // The rays of a height, for any sun.
  std::vector<std::array<Ray, ray_cosines>> rays(heights);
  parallel_for(heights, [&](std::size_t height) {
    for (int i = 0; i < ray_cosines; ++i) {
      const double z = i % 2 == 0 ? gauss_points[i / 2] : -gauss_points[i / 2];
      rays[height][std::size_t(i)] = ray_from(place_of(int(height), 0).r, z, ray_steps);
    }
  });
  const auto each_place = [&](int turns, const auto& light) {
    std::vector<Field> result(fields_.size());
    parallel_for(
        result.size(),
        [&](std::size_t index) {
          const auto& of_height = rays[index / suns];
          result[index] = projected(place_of(int(index / suns), int(index % suns)), turns,
                                    [&](const Place& place, int ray, double z, double turn) {
                                      return light(place, of_height[std::size_t(ray)], z, turn);
                                    });
        },
        4);
    return result;
  };
  // Light that was scattered once; the ground gives back the sun's.
  const std::vector<Field> once =
      each_place(fine_turns, [&](const Place& place, const Ray& ray, double z, double turn) {
        const glm::dvec3 direction(std::sqrt(1.0 - z * z) * std::cos(turn), 0.0, z);  // y is not asked for
        const double cosine = glm::dot(direction, direction_at(place.sun_mu));
        Spectrum sum;
        for (const Step& step : ray.steps) {
          const Spectrum sun =
              sunlight(coefficients_, step.r, (place.r * place.sun_mu + step.t * cosine) / step.r);
          sum +=
              (molecule_phase(float(cosine)) * step.molecules + haze_phase(float(cosine)) * step.haze) * sun;
        }
        return sum;
      });
  // Then all that is scattered again, until another order adds nothing.
  for (fields_ = once; orders_ < max_orders; ++orders_) {
    std::vector<Field> next =
        each_place(ray_turns, [&](const Place& place, const Ray& ray, double z, double turn) {
          return scattered_again(place, ray, z, turn);
        });
    float change = 0.0f;
    for (std::size_t i = 0; i < next.size(); ++i) {
      for (std::size_t h = 0; h < harmonics; ++h) next[i][h] += once[i][h];
      for (int band = 0; band < band_count; ++band)
        if (next[i][0][band] > 1e-9f)
          change = std::max(change, 1.0f - fields_[i][0][band] / next[i][0][band]);
    }
    fields_ = std::move(next);
    if (change < min_change) break;
  }
}

}  // namespace parvis::light

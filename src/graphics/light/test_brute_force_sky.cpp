#include "graphics/light/test_brute_force_sky.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/parallel.h"
#include "base/random.h"

namespace parvis::light {
namespace {

constexpr double pi = std::numbers::pi;

using Bands = std::array<double, band_count>;

class Path {
 public:
  Path(const AirCoefficients& air, double ground_albedo, glm::dvec3 to_sun, std::uint64_t seed)
      : air_(air), ground_albedo_(ground_albedo), to_sun_(to_sun), random_(seed) {}

  /// One estimate of the irradiance; `u` and `v` place the first direction.
  Bands irradiance(double u, double v) {
    through_.fill(pi);  // cosine-weighted directions
    light_.fill(0.0);
    const double across = std::sqrt(u), turn = 2.0 * pi * v;
    glm::dvec3 at(0.0, 0.0, ground_radius_m + 0.5),
        direction(across * std::cos(turn), across * std::sin(turn), std::sqrt(1.0 - u));
    for (int order = 1; order < 200; ++order) {
      if (!scatter(at, direction)) break;
      if (order >= 6 && !survives()) break;
    }
    return light_;
  }

 private:
  double next() { return double(random_.uniform()); }

  /// Optical depths along a segment, by the midpoint rule with steps that grow from its lower end.
  Bands depth(glm::dvec3 from, glm::dvec3 direction, double length) const {
    constexpr int steps = 48;
    const bool is_rising = glm::dot(from, direction) >= 0.0;
    glm::dvec3 sum(0.0);
    for (int i = 0; i < steps; ++i) {
      const double a = double(i) / steps, b = double(i + 1) / steps, t = 0.5 * length * (a * a + b * b);
      const glm::dvec3 place = from + (is_rising ? t : length - t) * direction;
      const Densities d = densities_at(glm::length(place) - ground_radius_m);
      sum += length * (b * b - a * a) * glm::dvec3(d.molecules, d.haze, d.ozone);
    }
    Bands result{};
    for (int i = 0; i < band_count; ++i)
      result[std::size_t(i)] = double(air_.molecules[i]) * sum.x + double(air_.haze_extinction[i]) * sum.y +
                               double(air_.ozone[i]) * sum.z;
    return result;
  }

  /// A distance along a segment: half of them by how far light of the middle band gets, which finds thick
  /// haze, half over the whole of it, which finds the lit air of a twilight (both weighted by the balance
  /// heuristic, Veach 1997). Gives the optical depths up to there.
  Bands choose_distance(glm::dvec3 from, glm::dvec3 direction, double length, double& t, double& density) {
    constexpr std::size_t steps = 64;
    constexpr int middle = 4;
    std::array<double, steps + 1> depths{}, ends{};
    for (std::size_t i = 0; i < steps; ++i) {
      const double a = double(i) / double(steps), b = double(i + 1) / double(steps);
      const Densities d =
          densities_at(glm::length(from + 0.5 * length * (a * a + b * b) * direction) - ground_radius_m);
      ends[i + 1] = length * b * b;
      depths[i + 1] = depths[i] + length * (b * b - a * a) * double(air_.extinction(d)[middle]);
    }
    const double scattered = 1.0 - std::exp(-depths.back());
    if (next() < 0.5) {
      const double u = next();
      t = length * u * u;
    } else {
      const double depth = -std::log(1.0 - next() * scattered);
      const std::size_t i =
          std::size_t(std::lower_bound(depths.begin() + 1, depths.end() - 1, depth) - depths.begin());
      t = ends[i - 1] +
          (ends[i] - ends[i - 1]) * (depth - depths[i - 1]) / std::max(depths[i] - depths[i - 1], 1e-300);
    }
    const std::size_t i = std::size_t(std::lower_bound(ends.begin() + 1, ends.end() - 1, t) - ends.begin());
    const double slope = (depths[i] - depths[i - 1]) / (ends[i] - ends[i - 1]);
    const double by_depth = slope * std::exp(-depths[i - 1] - slope * (t - ends[i - 1])) / scattered;
    density = 0.5 * by_depth + 0.5 / (2.0 * std::sqrt(length * std::max(t, 1e-9)));
    return depth(from, direction, t);
  }

  /// Share of the sun's light that arrives: by depth to the top, unless the earth is in the way (a point of
  /// the disc is chosen).
  void add_sun(glm::dvec3 at, const Bands& weight) {
    const double r = glm::length(at), mu = glm::dot(at, to_sun_) / r, share = visible_disc(r, mu);
    if (share <= 0.0) return;
    const Bands sun = depth(at, to_sun_, distance_to_top(r, mu));
    for (std::size_t i = 0; i < band_count; ++i)
      light_[i] += through_[i] * weight[i] * share * std::exp(-sun[i]);
  }

  /// Moves along the ray to a place where light is scattered, adds the sun's, turns; false where the path
  /// ends.
  bool scatter(glm::dvec3& at, glm::dvec3& direction) {
    const double r = glm::length(at), mu = glm::dot(at, direction) / r;
    const bool is_ground = meets_ground(r, mu);
    const double length = is_ground ? distance_to_ground(r, mu) : distance_to_top(r, mu);
    if (is_ground && next() < 0.3) {  // the ground that the ray ends on
      const Bands passed = depth(at, direction, length);
      for (std::size_t i = 0; i < band_count; ++i) through_[i] *= std::exp(-passed[i]) * ground_albedo_ / 0.3;
      at += length * direction;
      const glm::dvec3 normal = glm::normalize(at);
      at = normal * (ground_radius_m + 0.5);
      Bands weight{};
      weight.fill(std::max(0.0, glm::dot(normal, to_sun_)) / pi);
      add_sun(at, weight);
      do direction = any_direction();
      while (glm::dot(direction, normal) <= 0.0);
      for (double& value : through_)
        value *= 2.0 * glm::dot(direction, normal);  // evenly over the hemisphere
      return true;
    }
    double t = 0.0, density = 0.0;
    const Bands passed = choose_distance(at, direction, length, t, density);
    at += t * direction;
    const Densities here = densities_at(glm::length(at) - ground_radius_m);
    Bands molecules{}, haze{};
    for (std::size_t i = 0; i < band_count; ++i) {
      through_[i] *= std::exp(-passed[i]) / density / (is_ground ? 0.7 : 1.0);
      molecules[i] = double(air_.molecules[int(i)]) * here.molecules;
      haze[i] = double(air_.haze_scattering[int(i)]) * here.haze;
    }
    const auto scattered = [&](double cosine) {
      Bands weight{};
      for (std::size_t i = 0; i < band_count; ++i)
        weight[i] = molecules[i] * double(molecule_phase(float(cosine))) +
                    haze[i] * double(haze_phase(float(cosine)));
      return weight;
    };
    add_sun(at, scattered(glm::dot(direction, to_sun_)));
    const double haze_share = haze[4] / (haze[4] + molecules[4] + 1e-300);
    const glm::dvec3 turned = next() < haze_share ? haze_direction(direction) : any_direction();
    const double cosine = glm::dot(turned, direction);
    const double chance = haze_share * double(haze_phase(float(cosine))) + (1.0 - haze_share) / (4.0 * pi);
    const Bands weight = scattered(cosine);
    for (std::size_t i = 0; i < band_count; ++i) through_[i] *= weight[i] / chance;
    direction = turned;
    return true;
  }

  bool survives() {
    double maximum = 0.0;
    for (const double value : through_) maximum = std::max(maximum, value);
    const double chance = std::min(0.9, maximum / pi * 2.0);
    if (next() >= chance) return false;
    for (double& value : through_) value /= chance;
    return true;
  }

  glm::dvec3 any_direction() {
    const double z = 2.0 * next() - 1.0, turn = 2.0 * pi * next(),
                 across = std::sqrt(std::max(0.0, 1.0 - z * z));
    return {across * std::cos(turn), across * std::sin(turn), z};
  }

  /// Henyey and Greenstein 1941.
  glm::dvec3 haze_direction(glm::dvec3 before) {
    const double g = double(haze_asymmetry), s = (1.0 - g * g) / (1.0 - g + 2.0 * g * next());
    const double cosine = std::clamp((1.0 + g * g - s * s) / (2.0 * g), -1.0, 1.0), turn = 2.0 * pi * next();
    const glm::dvec3 side = glm::normalize(
        glm::cross(before, std::abs(before.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0)));
    const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
    return cosine * before + sine * (std::cos(turn) * side + std::sin(turn) * glm::cross(before, side));
  }

  const AirCoefficients& air_;
  double ground_albedo_;
  glm::dvec3 to_sun_;
  Random random_;
  Bands through_{}, light_{};
};

}  // namespace

BruteForceIrradiance brute_force_diffuse(const Air& air, double sun_elevation_deg, int paths,
                                         std::uint64_t seed) {
  const AirCoefficients coefficients(air);
  const double elevation = sun_elevation_deg * pi / 180.0;
  const glm::dvec3 to_sun(std::cos(elevation), 0.0, std::sin(elevation));
  constexpr int batches = 64;
  const int per_batch = std::max(1, paths / batches);
  std::vector<Bands> means(batches, Bands{});
  parallel_for(batches, [&](std::size_t batch) {
    Path path(coefficients, air.ground_albedo, to_sun, seed * 1000 + batch);
    Random places(seed * 7919 + batch);
    for (int i = 0; i < per_batch; ++i) {
      const Bands light = path.irradiance((i + double(places.uniform())) / per_batch,
                                          std::fmod(0.61803398875 * i + double(batch) / batches, 1.0));
      for (std::size_t k = 0; k < band_count; ++k) means[batch][k] += light[k] / per_batch;
    }
  });
  BruteForceIrradiance result;
  std::array<double, batches> luminance{};
  double mean = 0.0, variance = 0.0;
  for (std::size_t batch = 0; batch < batches; ++batch) {
    Spectrum one;
    for (int k = 0; k < band_count; ++k) one[k] = float(means[batch][std::size_t(k)]);
    result.share += (1.0f / batches) * one;
    luminance[batch] = xyz(one).y, mean += luminance[batch] / batches;
  }
  for (const double value : luminance) variance += (value - mean) * (value - mean) / (batches - 1);
  result.standard_error = std::sqrt(variance / batches) / mean;
  return result;
}

}  // namespace parvis::light

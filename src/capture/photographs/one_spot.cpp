#include "capture/photographs/one_spot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <numeric>
#include <optional>

#include "base/parallel.h"
#include "base/random.h"

namespace parvis::photographs {
namespace {

constexpr std::size_t min_agreeing = 12;
constexpr int trials = 150, focal_steps = 30, rounds = 30;
constexpr double near_share = 0.004;  ///< of the picture's width: matches that agree are as near
constexpr double huber_px = 1.5;

/// Of the house's camera: x right, y up, -z forward.
glm::dvec3 ray(glm::dvec2 pixel, glm::dvec2 size, double focal) {
  const glm::dvec2 p = pixel - 0.5 * size;
  return glm::normalize(glm::dvec3(p.x, -p.y, -focal));
}

std::optional<glm::dvec2> pixel_of(glm::dvec3 direction, glm::dvec2 size, double focal) {
  if (direction.z >= -1e-6) return std::nullopt;
  return 0.5 * size + focal / -direction.z * glm::dvec2(direction.x, -direction.y);
}

/// The rotation that takes two directions to two others: exactly the first, and the plane of both.
glm::dmat3 rotation_of(glm::dvec3 a0, glm::dvec3 a1, glm::dvec3 b0, glm::dvec3 b1) {
  const auto frame = [](glm::dvec3 x, glm::dvec3 y) {
    const glm::dvec3 z = glm::normalize(glm::cross(x, y));
    return glm::dmat3(x, glm::cross(z, x), z);
  };
  return frame(b0, b1) * glm::transpose(frame(a0, a1));
}

/// b_from_a of a pair, and which of its matches agree.
struct PairRotation {
  glm::dmat3 b_from_a{1.0};
  std::vector<std::size_t> agreeing;
};

PairRotation rotation_of(const SpotPair& pair, glm::dvec2 size, double focal, std::uint64_t seed) {
  PairRotation best;
  const std::size_t count = pair.pixels.size();
  if (count < min_agreeing) return best;
  std::vector<glm::dvec3> of_a, of_b;
  for (const auto& [a, b] : pair.pixels)
    of_a.push_back(ray(a, size, focal)), of_b.push_back(ray(b, size, focal));
  const double nearest = std::pow(near_share * size.x / focal, 2);
  Random random(seed + 977 * pair.a + pair.b);
  for (int trial = 0; trial < trials; ++trial) {
    const std::size_t i = random.next() % count, k = random.next() % count;
    if (i == k || glm::length(glm::cross(of_a[i], of_a[k])) < 0.02 ||
        glm::length(glm::cross(of_b[i], of_b[k])) < 0.02)
      continue;
    PairRotation one{rotation_of(of_a[i], of_a[k], of_b[i], of_b[k]), {}};
    for (std::size_t m = 0; m < count; ++m) {
      const glm::dvec3 off = one.b_from_a * of_a[m] - of_b[m];
      if (glm::dot(off, off) < nearest) one.agreeing.push_back(m);
    }
    if (one.agreeing.size() > best.agreeing.size()) best = std::move(one);
  }
  if (best.agreeing.size() < min_agreeing) best.agreeing.clear();
  return best;
}

std::vector<PairRotation> rotations_of(const std::vector<SpotPair>& pairs, glm::dvec2 size, double focal,
                                       std::uint64_t seed) {
  std::vector<PairRotation> rotations(pairs.size());
  parallel_for(pairs.size(), [&](std::size_t i) { rotations[i] = rotation_of(pairs[i], size, focal, seed); });
  return rotations;
}

/// Places photographs one after another, by the pair with the most matches to one that is placed.
void place(const std::vector<SpotPair>& pairs, const std::vector<PairRotation>& rotations,
           SpotCameras& cameras) {
  const auto strongest =
      std::ranges::max_element(rotations, {}, [](const PairRotation& r) { return r.agreeing.size(); });
  if (strongest == rotations.end() || strongest->agreeing.empty()) return;
  cameras.is_placed[pairs[std::size_t(strongest - rotations.begin())].a] = 1;
  for (;;) {
    std::size_t best = pairs.size(), most = 0;
    for (std::size_t i = 0; i < pairs.size(); ++i)
      if (cameras.is_placed[pairs[i].a] != cameras.is_placed[pairs[i].b] &&
          rotations[i].agreeing.size() > most)
        best = i, most = rotations[i].agreeing.size();
    if (best == pairs.size()) return;
    const auto& [a, b, pixels] = pairs[best];
    const glm::dmat3& b_from_a = rotations[best].b_from_a;
    if (cameras.is_placed[a])
      cameras.world_from_camera[b] = cameras.world_from_camera[a] * glm::transpose(b_from_a);
    else
      cameras.world_from_camera[a] = cameras.world_from_camera[b] * b_from_a;
    cameras.is_placed[a] = cameras.is_placed[b] = 1;
  }
}

/// A match of two placed photographs.
struct Sighting {
  std::size_t a, b;
  glm::dvec2 in_a, in_b;
};

/// Where the second photograph has the match, by the cameras, less where it has it.
glm::dvec2 residual(const Sighting& s, const glm::dmat3& a, const glm::dmat3& b, glm::dvec2 size,
                    double focal) {
  const auto pixel = pixel_of(glm::transpose(b) * (a * ray(s.in_a, size, focal)), size, focal);
  return pixel ? *pixel - s.in_b : size;
}

/// Turned by a small rotation vector, in the world.
glm::dmat3 turned(const glm::dmat3& rotation, glm::dvec3 by) {
  const double angle = glm::length(by);
  return angle < 1e-14 ? rotation : glm::dmat3(glm::mat3_cast(glm::angleAxis(angle, by / angle))) * rotation;
}

double weight_of(glm::dvec2 r) { return std::min(1.0, huber_px / std::max(glm::length(r), 1e-9)); }

double cost(const std::vector<Sighting>& sightings, const SpotCameras& cameras, glm::dvec2 size) {
  double sum = 0.0;
  for (const Sighting& s : sightings) {
    const double r = glm::length(
        residual(s, cameras.world_from_camera[s.a], cameras.world_from_camera[s.b], size, cameras.focal_px));
    sum += r < huber_px ? 0.5 * r * r : huber_px * (r - 0.5 * huber_px);
  }
  return sum;
}

/// Solves a symmetric positive definite system in place (Cholesky); `n` x `n` by rows.
std::vector<double> solved(std::vector<double> m, std::vector<double> right, std::size_t n) {
  for (std::size_t j = 0; j < n; ++j) {
    for (std::size_t k = 0; k < j; ++k) m[j * n + j] -= m[j * n + k] * m[j * n + k];
    m[j * n + j] = std::sqrt(std::max(m[j * n + j], 1e-12));
    for (std::size_t i = j + 1; i < n; ++i) {
      for (std::size_t k = 0; k < j; ++k) m[i * n + j] -= m[i * n + k] * m[j * n + k];
      m[i * n + j] /= m[j * n + j];
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < i; ++k) right[i] -= m[i * n + k] * right[k];
    right[i] /= m[i * n + i];
  }
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t k = i + 1; k < n; ++k) right[i] -= m[k * n + i] * right[k];
    right[i] /= m[i * n + i];
  }
  return right;
}

/// J^T J and J^T r, with derivatives by differences: three per rotation, and the logarithm of the focal
/// length last.
void normal_equations(const std::vector<Sighting>& sightings, const SpotCameras& cameras, glm::dvec2 size,
                      std::vector<double>& matrix, std::vector<double>& right) {
  const std::size_t n = right.size();
  constexpr double step = 1e-6;
  for (const Sighting& s : sightings) {
    const glm::dmat3 &a = cameras.world_from_camera[s.a], &b = cameras.world_from_camera[s.b];
    const glm::dvec2 r = residual(s, a, b, size, cameras.focal_px);
    std::array<std::pair<std::size_t, glm::dvec2>, 7> columns;
    for (int c = 0; c < 3; ++c) {
      glm::dvec3 by(0.0);
      by[c] = step;
      columns[std::size_t(c)] = {3 * s.a + std::size_t(c),
                                 (residual(s, turned(a, by), b, size, cameras.focal_px) - r) / step};
      columns[std::size_t(3 + c)] = {3 * s.b + std::size_t(c),
                                     (residual(s, a, turned(b, by), size, cameras.focal_px) - r) / step};
    }
    columns[6] = {n - 1, (residual(s, a, b, size, cameras.focal_px * (1.0 + step)) - r) / step};
    const double weight = weight_of(r);
    for (const auto& [i, of_i] : columns) {
      right[i] -= weight * glm::dot(of_i, r);
      for (const auto& [k, of_k] : columns) matrix[i * n + k] += weight * glm::dot(of_i, of_k);
    }
  }
}

void refine(const std::vector<Sighting>& sightings, glm::dvec2 size, SpotCameras& cameras) {
  const std::size_t n = 3 * cameras.world_from_camera.size() + 1;
  double damping = 1e-3, before = cost(sightings, cameras, size);
  for (int round = 0; round < rounds && damping < 1e6; ++round) {
    std::vector<double> matrix(n * n, 0.0), right(n, 0.0);
    normal_equations(sightings, cameras, size, matrix, right);
    for (std::size_t i = 0; i < n; ++i) matrix[i * n + i] += damping * matrix[i * n + i] + 1e-6;
    const std::vector<double> by = solved(matrix, right, n);
    SpotCameras next = cameras;
    for (std::size_t i = 0; i < next.world_from_camera.size(); ++i)
      next.world_from_camera[i] =
          turned(next.world_from_camera[i], {by[3 * i], by[3 * i + 1], by[3 * i + 2]});
    next.focal_px *= std::exp(std::clamp(by[n - 1], -0.5, 0.5));
    const double after = cost(sightings, next, size);
    if (after < before) {
      const bool is_done = before - after < 1e-9 * before;
      cameras = next, before = after, damping *= 0.3;
      if (is_done) return;
    } else {
      damping *= 10.0;
    }
  }
}

}  // namespace

SpotCameras cameras_of_one_spot(std::size_t photographs, const std::vector<SpotPair>& pairs, glm::dvec2 size,
                                std::uint64_t seed) {
  SpotCameras cameras;
  cameras.world_from_camera.assign(photographs, glm::dmat3(1.0));
  cameras.is_placed.assign(photographs, 0);
  std::vector<PairRotation> rotations;
  std::size_t most = 0;
  for (int i = 0; i < focal_steps; ++i) {
    const double fov = glm::radians(glm::mix(20.0, 110.0, double(i) / (focal_steps - 1)));
    const double focal = 0.5 * size.x / std::tan(0.5 * fov);
    std::vector<PairRotation> tried = rotations_of(pairs, size, focal, seed);
    const std::size_t agreeing =
        std::transform_reduce(tried.begin(), tried.end(), std::size_t(0), std::plus<>(),
                              [](const PairRotation& r) { return r.agreeing.size(); });
    if (agreeing > most) most = agreeing, cameras.focal_px = focal, rotations = std::move(tried);
  }
  if (most == 0) return cameras;
  place(pairs, rotations, cameras);
  std::vector<Sighting> sightings;
  for (std::size_t i = 0; i < pairs.size(); ++i)
    if (cameras.is_placed[pairs[i].a] && cameras.is_placed[pairs[i].b])
      for (const std::size_t m : rotations[i].agreeing)
        sightings.push_back({pairs[i].a, pairs[i].b, pairs[i].pixels[m].first, pairs[i].pixels[m].second});
  refine(sightings, size, cameras);
  double squared = 0.0;
  for (const Sighting& s : sightings) {
    const glm::dvec2 r =
        residual(s, cameras.world_from_camera[s.a], cameras.world_from_camera[s.b], size, cameras.focal_px);
    if (glm::length(r) > 2.0 * huber_px) continue;
    squared += glm::dot(r, r), ++cameras.agreeing;
  }
  cameras.error_px = std::sqrt(squared / double(std::max<std::size_t>(cameras.agreeing, 1)));
  const glm::dmat3 first_from_world = glm::transpose(cameras.world_from_camera.front());
  for (glm::dmat3& rotation : cameras.world_from_camera) rotation = first_from_world * rotation;
  return cameras;
}

}  // namespace parvis::photographs

#include "graphics/light/visibility_places.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <numeric>

#include "base/parallel.h"
#include "graphics/light/ray_packet.h"

namespace parvis::light {
namespace {

constexpr std::size_t direction_count = 64;
/// Of each direction, steradians.
constexpr float solid_angle_of_direction = 2.0f * glm::pi<float>() / float(direction_count);

/// Numbers of the directions by their azimuth: rays that are answered together go about the same way.
const std::array<std::size_t, direction_count>& by_azimuth() {
  static const std::array<std::size_t, direction_count> order = [] {
    std::array<std::size_t, direction_count> result;
    std::iota(result.begin(), result.end(), std::size_t(0));
    std::ranges::sort(result, {}, [](std::size_t k) {
      const glm::vec3 d = VisibilityPlaces::directions()[k];
      return std::atan2(d.y, d.x);
    });
    return result;
  }();
  return order;
}

/// From each direction.
std::array<glm::vec3, direction_count> radiance_of(const SkyTable& sky) {
  std::array<glm::vec3, direction_count> radiance;
  for (std::size_t k = 0; k < direction_count; ++k)
    radiance[k] = sky.radiance(VisibilityPlaces::directions()[k]);
  return radiance;
}

/// Of level ground that is as bright everywhere.
glm::vec3 from_below(glm::vec3 normal, const SkyTable& sky, Blocked blocked) {
  if (blocked == Blocked::dark) return glm::vec3(0.0f);
  return 0.5f * (1.0f - normal.z) * 3.14159265f * sky.radiance({0.0f, 0.0f, -1.0f});
}

using Shares = float[direction_count];

/// Irradiance of the sky's directions, of each the share that `set_shares` sets for the vertex of a number.
template <class SetShares>
std::vector<glm::vec3> sky_irradiance(const std::vector<LitVertex>& vertices, const SkyTable& sky,
                                      Blocked blocked, const SetShares& set_shares) {
  const std::array<glm::vec3, direction_count> radiance = radiance_of(sky);
  std::vector<glm::vec3> result(vertices.size());
  parallel_for(
      vertices.size(),
      [&](std::size_t v) {
        Shares shares;
        set_shares(v, shares);
        glm::vec3 sum(0.0f);
        for (std::size_t k = 0; k < direction_count; ++k)
          sum += shares[k] * std::max(glm::dot(VisibilityPlaces::directions()[k], vertices[v].normal), 0.0f) *
                 radiance[k];
        result[v] = solid_angle_of_direction * sum + from_below(vertices[v].normal, sky, blocked);
      },
      64);
  return result;
}

/// A bit for each direction in which nothing stops a ray.
std::uint64_t open_directions(const reference::RayScene& scene, glm::vec3 at, std::size_t place) {
  std::uint64_t open = 0;
  Packet packet(scene);
  const auto take = [&] {
    const std::uint32_t blocked = packet.blocked();
    for (std::size_t i = 0; i < packet.count(); ++i)
      if ((blocked >> i & 1u) == 0) open |= std::uint64_t(1) << packet.tag(i).ray;
    packet.clear();
  };
  for (const std::size_t k : by_azimuth()) {
    packet.add(at, VisibilityPlaces::directions()[k], {place, k});
    if (packet.is_full()) take();
  }
  take();
  return open;
}

}  // namespace

const std::vector<glm::vec3>& VisibilityPlaces::directions() {
  static const std::vector<glm::vec3> even = [] {
    std::vector<glm::vec3> result;
    for (int i = 0; i < 64; ++i) {
      const float z = (float(i) + 0.5f) / 64.0f, across = std::sqrt(1.0f - z * z),
                  turn = 2.39996323f * float(i);
      result.emplace_back(across * std::cos(turn), across * std::sin(turn), z);
    }
    return result;
  }();
  return even;
}

VisibilityPlaces::VisibilityPlaces(const reference::RayScene& scene, const Bounds& region, float spacing_m,
                                   std::size_t max_places)
    : origin_(region.min), spacing_m_(spacing_m) {
  const auto counts = [&] { return glm::ivec3(glm::ceil(region.size() / spacing_m_)) + 1; };
  while (glm::dot(glm::dvec3(1.0), glm::log(glm::dvec3(counts()))) > std::log(double(max_places)))
    spacing_m_ *= 1.26f;
  counts_ = counts();
  masks_.resize(std::size_t(counts_.x) * std::size_t(counts_.y) * std::size_t(counts_.z));
  parallel_for(
      masks_.size(),
      [&](std::size_t i) {
        const int x = int(i) % counts_.x, y = int(i) / counts_.x % counts_.y,
                  z = int(i) / counts_.x / counts_.y;
        const glm::vec3 at = origin_ + spacing_m_ * glm::vec3(x, y, z);
        masks_[i] = open_directions(scene, at, i);
      },
      16);
}

std::uint64_t VisibilityPlaces::mask(glm::ivec3 place) const {
  const glm::ivec3 p = glm::clamp(place, glm::ivec3(0), counts_ - 1);
  return masks_[(std::size_t(p.z) * std::size_t(counts_.y) + std::size_t(p.y)) * std::size_t(counts_.x) +
                std::size_t(p.x)];
}

void VisibilityPlaces::interpolate(glm::vec3 point, float (&shares)[64]) const {
  const glm::vec3 at = (point - origin_) / spacing_m_, low = glm::floor(at), part = at - low;
  std::fill(std::begin(shares), std::end(shares), 0.0f);
  for (int corner = 0; corner < 8; ++corner) {
    const glm::ivec3 step(corner & 1, corner >> 1 & 1, corner >> 2);
    float weight = 1.0f;
    for (int axis = 0; axis < 3; ++axis) weight *= step[axis] ? part[axis] : 1.0f - part[axis];
    const std::uint64_t bits = mask(glm::ivec3(low) + step);
    for (std::size_t k = 0; k < 64; ++k) shares[k] += weight * float(bits >> k & 1);
  }
}

/// A place at the rim of the region has two neighbours along fewer axes; one that has none anywhere is left
/// out.
float VisibilityPlaces::uncertainty() const {
  const auto share = [&](glm::ivec3 place) {
    return float(std::popcount(mask(place))) / float(direction_count);
  };
  double sum = 0.0;
  std::size_t count = 0;
  for (int z = 0; z < counts_.z; ++z)
    for (int y = 0; y < counts_.y; ++y)
      for (int x = 0; x < counts_.x; ++x) {
        const glm::ivec3 place(x, y, z);
        float neighbours = 0.0f;
        int axes = 0;
        for (int axis = 0; axis < 3; ++axis) {
          if (place[axis] == 0 || place[axis] == counts_[axis] - 1) continue;
          glm::ivec3 step(0);
          step[axis] = 1;
          neighbours += 0.5f * (share(place - step) + share(place + step)), ++axes;
        }
        if (axes == 0) continue;
        const double off = double(share(place) - neighbours / float(axes));
        sum += off * off, ++count;
      }
  return count > 0 ? float(std::sqrt(sum / double(count))) : 0.0f;
}

std::vector<glm::vec3> interpolated_irradiance(const std::vector<LitVertex>& vertices,
                                               const VisibilityPlaces& places, const SkyTable& sky,
                                               Blocked blocked) {
  return sky_irradiance(vertices, sky, blocked, [&](std::size_t v, Shares& shares) {
    places.interpolate(vertices[v].position, shares);
  });
}

std::vector<glm::vec3> open_sky_irradiance(const std::vector<LitVertex>& vertices, const SkyTable& sky,
                                           Blocked blocked) {
  return sky_irradiance(vertices, sky, blocked, [](std::size_t, Shares& shares) {
    std::fill(std::begin(shares), std::end(shares), 1.0f);
  });
}

std::vector<glm::vec3> open_irradiance(const std::vector<LitVertex>& vertices, const SkyTable& sky,
                                       Blocked blocked) {
  std::vector<glm::vec3> result = open_sky_irradiance(vertices, sky, blocked);
  for (std::size_t v = 0; v < result.size(); ++v)
    result[v] += std::max(glm::dot(sky.to_sun(), vertices[v].normal), 0.0f) * sky.sun_irradiance();
  return result;
}

}  // namespace parvis::light

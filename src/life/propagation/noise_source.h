// Point and line sources of a scene, as the node noiseSource gives them: a fan, a terrace, a pipe.
#pragma once

#include <string_view>
#include <vector>

#include "base/content_hash.h"
#include "life/propagation/octaves.h"
#include "scene/data/path.h"
#include "scene/data/room_data.h"

namespace parvis::propagation {

/// Steady noise from a point, or evenly from along a line. It is heard, and counts in the map of noise.
struct NoiseSource {
  static constexpr std::string_view name = "propagation.noise_source";
  static constexpr scene::DataRole role = scene::DataRole::settings;  // heard, not seen
  scene::Path line;                     ///< in the world, metres; one point, or more
  Octaves power_db{};                   ///< of the whole, dB re 1 pW
  std::array<double, 3> hours_share{};  ///< of day, evening and night in which it sounds, 0 to 1

  /// The middles of its pieces, which are as long and at most so long.
  std::vector<glm::dvec3> places(double max_piece_m) const {
    if (line.size() < 2) return {glm::dvec3(line.front())};
    const scene::MeasuredPath path(line);
    const double length_m = double(path.length());
    const int pieces = std::max(1, int(std::ceil(length_m / max_piece_m)));
    std::vector<glm::dvec3> result;
    for (int i = 0; i < pieces; ++i) result.emplace_back(path.at(float(length_m * (i + 0.5) / pieces)));
    return result;
  }
  /// Adds all members; see SceneData.
  void hash(ContentHash& hash) const {
    for (const glm::vec3& point : line) hash.add(point);
    for (const double level : power_db) hash.add(level);
    for (const double share : hours_share) hash.add(share);
  }
};

}  // namespace parvis::propagation

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

  /// A piece: a source at its middle stands for it.
  struct Piece {
    glm::dvec3 middle{0.0}, half{0.0};  ///< half: from the middle to its end, metres
  };
  /// Its pieces, which are as long as each other and at most so long.
  std::vector<Piece> pieces(double max_piece_m) const {
    if (line.size() < 2) return {{glm::dvec3(line.front())}};
    const scene::MeasuredPath path(line);
    const double length_m = double(path.length());
    const int count = std::max(1, int(std::ceil(length_m / max_piece_m)));
    const auto at = [&](double piece) { return glm::dvec3(path.at(float(length_m * piece / count))); };
    std::vector<Piece> result;
    for (int i = 0; i < count; ++i) result.push_back({at(i + 0.5), 0.5 * (at(i + 1) - at(i))});
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

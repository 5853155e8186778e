// How much a path weakens sound, by octave: CNOSSOS-EU (Directive (EU) 2015/996, Annex, 2.5, as amended by
// Delegated Directive (EU) 2021/1226): divergence, air, ground and diffraction in homogeneous and in
// favourable conditions, in which the sound's path is curved downward.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "life/propagation/octaves.h"

namespace parvis::propagation {

/// The state of the atmosphere: without, or with a curvature of the paths downward.
enum class Condition { homogeneous, favourable };

/// A point of the ground line under a path. Roofs are ground with a factor of 0; a wall of a building is a
/// pair of points at one distance.
struct GroundPoint {
  double distance_m = 0.0;  ///< in plan from the source, along the unfolded path
  double z_m = 0.0;         ///< absolute height
  double factor = 0.0;      ///< G from here to the next point: 0 is hard, 1 is porous
};

/// The top of a thin wall, which is no part of the ground.
struct Edge {
  double distance_m = 0.0;  ///< in plan from the source
  double z_m = 0.0;         ///< absolute height
};

/// A vertical cut along a path, unfolded where the path turns in plan.
struct Profile {
  std::vector<GroundPoint> ground;  ///< two points or more; distances ascend from 0
  std::vector<Edge> walls;          ///< distances ascend
  double source_z_m = 0.0;          ///< absolute height
  double receiver_z_m = 0.0;        ///< absolute height

  /// Length in plan, metres.
  double length_m() const { return ground.back().distance_m; }
  /// Distance from source to receiver in space along the unfolded path, metres.
  double distance_m() const { return std::hypot(length_m(), receiver_z_m - source_z_m); }
};

/// A path round corners, in space.
struct Detour {
  double direct_m = 0.0;   ///< from source to receiver
  double path_m = 0.0;     ///< along the path
  double between_m = 0.0;  ///< from the first corner to the last, along the path
  /// The path passes one more corner, in clear sight of it but near: as if it were a corner by a weight from
  /// 0 to 1 in each octave, so that levels do not step where it becomes one. By the Directive the weight is
  /// 0.
  double with_grazed_m = 0.0;  ///< as `between_m`, with that corner
  Octaves grazed{};            ///< the weights
};

/// A facade or wall that reflects a path.
struct Reflector {
  double distance_m = 0.0;   ///< in plan from the source, along the unfolded path
  double top_z_m = 0.0;      ///< absolute height of its upper edge
  double bottom_z_m = -1e9;  ///< it reflects nothing that passes below
  Octaves absorption{};      ///< α: 0 reflects all energy
};

/// Attenuation in dB of the path that lies in the profile's plane, over all that stands there (2.5.3 to
/// 2.5.5): from the sound power of a point source to the level at the receiver. `air_db_per_m` is that of
/// `absorption_db_per_m`.
Octaves attenuation_over(const Profile& profile, const Octaves& air_db_per_m, Condition condition);

/// Attenuation in dB of a path round vertical edges (2.5.6, lateral diffraction); the profile is that of the
/// unfolded path.
Octaves attenuation_around(const Profile& profile, const Detour& detour, const Octaves& air_db_per_m,
                           Condition condition);

/// Attenuation that reflection adds to the attenuation of the unfolded path, in dB (2.5.7): absorption, and
/// the loss at an upper edge that is near the path (retrodiffraction). Nothing where the path passes above a
/// reflector.
std::optional<Octaves> reflection_loss(const Profile& profile, std::span<const Reflector> reflectors,
                                       Condition condition);

/// Loss in dB by octave past one edge for a path difference in metres, negative in clear sight (2.5.21).
Octaves edge_loss_db(double difference_m);

/// How much the path rises above the straight line of a length in plan, at a distance from its begin, metres:
/// 0, or as an arc with a radius of 8 lengths and 1 km at least.
double rise_of_ray(double distance_m, double length_m, Condition condition);

}  // namespace parvis::propagation

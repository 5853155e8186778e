// What sound meets between source and receiver: ground, roofs and walls, and the paths that lead past them.
// All paths lie in vertical planes, unfolded where they turn, as CNOSSOS-EU has them.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "life/propagation/path_attenuation.h"

namespace parvis::propagation {

/// The ground and the roofs over it, in plan.
class Terrain {
 public:
  virtual ~Terrain() = default;
  /// Height of the ground, metres.
  virtual double ground_z(glm::dvec2 place) const = 0;
  /// G of the ground: 0 is hard, 1 is porous.
  virtual double ground_factor(glm::dvec2 place) const = 0;
  /// Height of the roof over a place, metres; nothing where no building stands.
  virtual std::optional<double> roof_z(glm::dvec2 place) const = 0;
  /// Height of the underside of a roof or house that is open below it, as over an arcade; else nothing.
  virtual std::optional<double> ceiling_z(glm::dvec2) const { return std::nullopt; }
  /// Whether a building stands at a place and height: under a ceiling none does.
  bool is_built(glm::dvec2 place, double z) const {
    const std::optional<double> ceiling = roof_z(place) ? ceiling_z(place) : std::nullopt;
    return ceiling ? z >= *ceiling : roof_z(place).has_value();
  }
  /// Adds the distances from `from`, metres, at which slope or factor change on the way to `to`, in any
  /// order.
  virtual void add_breaks(glm::dvec2 from, glm::dvec2 to, std::vector<double>& distances_m) const = 0;
};

/// An upright wall: a facade, or a thin wall that stands alone. Its foot is the ground, unless it is open
/// below.
struct Wall {
  glm::dvec2 a{0.0}, b{0.0};          ///< ends in plan, metres
  double top_a = 0.0, top_b = 0.0;    ///< absolute heights of its upper edge at the ends
  std::optional<Octaves> absorption;  ///< α of its surface; nothing: reflections are not counted
  double bottom = -1e9;  ///< absolute height of its lower edge where sound passes below it: over an arcade
};

/// Where the sound comes from or is heard: plan position and absolute height, metres.
using Place = glm::dvec3;

/// A path that is reflected in turn by walls: their indices, from the source to the receiver.
using WallSequence = std::vector<int>;

/// One path from a source to a receiver.
struct SoundPath {
  Octaves attenuation_db{};
  Place comes_from{0.0};                ///< the source, the last corner, or the last point of reflection
  double length_m = 0.0;                ///< in space
  const WallSequence* walls = nullptr;  ///< that reflect it; null: none do
};

/// Attenuations of one pair of places summed over paths: levels at the receiver for a sound power level of
/// 0 dB, `silence_db` where no path leads.
struct Transfer {
  Octaves homogeneous_db{}, favourable_db{};

  /// The level for a long time in which conditions are favourable for a fraction of it.
  Octaves long_term_db(double favourable_fraction) const;
};

/// Which paths are followed.
struct PathChoice {
  int reflections = 1;          ///< highest order; 0 for none
  bool is_lateral = true;       ///< also round the ends of what stands in the way
  int directions = 180;         ///< in which walls are sought that reflect toward the receiver
  double max_length_m = 800.0;  ///< of a reflected or lateral path
  /// Edges diffract sound that passes them in clear sight, too, so that levels do not step where a listener
  /// walks into a shadow: lateral diffraction with a negative path difference, which CNOSSOS-EU leaves out.
  bool softens_shadows = false;
};

/// Walls on a terrain, which must outlive the site. May be asked from several threads.
class Site {
 public:
  Site(const Terrain& terrain, std::vector<Wall> walls);
  ~Site();
  Site(Site&&) noexcept;

  /// The walls in the order in which they were given.
  const std::vector<Wall>& walls() const { return walls_; }
  /// The ground below.
  const Terrain& terrain() const { return terrain_; }

  /// The vertical cut along a line of plan points with a source at its begin and a receiver at its end.
  Profile profile(std::span<const glm::dvec2> line, double source_z, double receiver_z) const;

  /// Corners in plan of the path on one side round what stands higher than the ray: the convex hull from
  /// source to receiver of walls, joined at their ends, that stand in the way. Empty where none does, where
  /// the path would be longer than `max_length_m`, and where source or receiver stand within the hull, as in
  /// a court.
  std::vector<glm::dvec2> corners_around(const Place& source, const Place& receiver, Condition condition,
                                         bool is_left, double max_length_m) const;

  /// A wall that a line in plan meets.
  struct WallHit {
    int wall;
    double distance_m;  ///< from the line's begin
    double top_z;       ///< of the wall there
  };
  /// The nearest wall that reflects along a line, other than `but`; nothing where there is none. Those that
  /// the line passes below are left out.
  std::optional<WallHit> reflecting_wall(const Place& from, const Place& to, int but = -1) const;
  /// A direction in plan after its reflection by a wall.
  glm::dvec2 turned_by(int wall, glm::dvec2 direction) const;

  /// Plan points of the path that the walls reflect, source and receiver included (image sources); empty
  /// where a point of reflection would lie beside its wall or on its back.
  std::vector<glm::dvec2> reflected_line(const Place& source, const Place& receiver,
                                         std::span<const int> walls) const;

  /// Sequences of walls, to the highest order, that level rays from a receiver find. The walls reflect all
  /// rays that reach them in plan, whatever their heights, but for those that pass below.
  std::vector<WallSequence> sequences_seen_from(const Place& receiver, const PathChoice& choice) const;

  /// Attenuation of the path over all in the straight line.
  Octaves over(const Place& source, const Place& receiver, const Octaves& air_db_per_m,
               Condition condition) const;
  /// Attenuation round plan corners; `softens_shadows`: see PathChoice.
  Octaves around(const Place& source, const Place& receiver, std::span<const glm::dvec2> corners,
                 const Octaves& air_db_per_m, Condition condition, bool softens_shadows = false) const;
  /// Attenuation by way of walls; nothing where the ray passes above one of them or below the ground.
  std::optional<Octaves> reflected(const Place& source, const Place& receiver, std::span<const int> walls,
                                   const Octaves& air_db_per_m, Condition condition) const;

  /// All paths; `sequences`: those seen from the receiver, which the paths point to.
  std::vector<SoundPath> paths(const Place& source, const Place& receiver,
                               std::span<const WallSequence> sequences, const PathChoice& choice,
                               const Octaves& air_db_per_m, Condition condition) const;
  /// All paths together.
  Transfer transfer(const Place& source, const Place& receiver, std::span<const WallSequence> sequences,
                    const PathChoice& choice, const Octaves& air_db_per_m) const;

 private:
  class Rays;
  struct Crossing;
  struct Grazed;
  struct End;
  std::vector<Crossing> crossings(const Place& from, const Place& to) const;
  void add_leg(const Place& from, const Place& to, double offset_m, Profile& profile) const;
  std::optional<Grazed> grazed(const Place& from, const Place& to) const;
  Octaves grazing_loss(const Place& source, const Place& receiver) const;
  std::optional<SoundPath> reflected_path(const Place& source, const Place& receiver,
                                          std::span<const int> walls, const Octaves& air_db_per_m,
                                          Condition condition) const;

  const Terrain& terrain_;
  std::vector<Wall> walls_;
  std::vector<std::array<std::vector<int>, 2>> neighbours_;  // of each wall: those that share its end a, b
  std::vector<End> ends_;                                    // of walls
  std::unique_ptr<Rays> rays_;
};

}  // namespace parvis::propagation

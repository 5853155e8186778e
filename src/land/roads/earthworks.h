// Cut and fill: how the ground is shaped for roads, whose beds are level from side to side.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <unordered_map>
#include <vector>

namespace parvis::scene {

/// Relation of a road to the ground below it.
enum class Bed : std::uint8_t {
  none,  ///< nothing: the road runs high above the ground or deep below it
  cut,   ///< the road lies on something else (a bridge, a ramp), through which the ground must not rise
  earth  ///< the road lies on the ground, which is cut and filled
};

/// The bed of a road along its middle line.
struct RoadBed {
  /// A point of the middle line, at the height of the bed.
  struct Point {
    glm::vec3 position;
    Bed kind = Bed::earth;
  };
  std::vector<Point> points;  ///< at most about 10 m from each other, for the bed widens between them
  float half_m = 0.0f;   ///< half of the bed's width: the carriageway, what is paved beside it and a shoulder
  bool is_turn = false;  ///< through a crossing: it widens the beds that meet there, and has their height
};

/// The shape that the ground takes for the roads of a place. Below a road it is level from side to side, at
/// the height of the road's middle; beside it, slopes of earth rise (cuts) or fall (dams) to the ground that
/// was there. Where roads meet, their beds are blended by the distance from each, and slopes begin beyond the
/// turns that round the corners between them. Beds are wider at the ends of roads, where vehicles turn round.
class Earthworks {
 public:
  /// Rise over run of the slopes of earth: 1 : 1.75.
  static constexpr float slope = 1.0f / 1.75f;
  /// How far the slopes reach beside a bed. On hillsides too steep for them, the ground runs out steeper
  /// over the second half of it.
  static constexpr float reach_m = 18.0f;

  explicit Earthworks(std::span<const RoadBed> beds);

  /// The height of the ground at a point, where it was `bare_m` before.
  float at(glm::vec2 point, float bare_m) const;
  /// False if `at` changes nothing in this box.
  bool may_change(glm::vec2 low, glm::vec2 high) const;

 private:
  /// A straight piece of a bed; those of one road follow each other.
  struct Piece {
    glm::vec3 a, b;
    float half_at_a_m, half_at_b_m;
    std::uint32_t road;
    Bed kind;
    bool is_turn;
  };
  /// The nearest point of a road's bed.
  struct Nearest {
    float distance_m, half_m, height_m;
    Bed kind;
  };

  void add(const RoadBed& bed, std::uint32_t road);
  const std::vector<std::uint32_t>* near(glm::vec2 point) const;
  static Nearest nearest_on(const Piece& piece, glm::vec2 point);

  std::vector<Piece> pieces_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;  ///< pieces within reach of each cell
};

}  // namespace parvis::scene

// One step of a crowd: everybody walks towards an aim, keeps a distance to who walks ahead, and clears walls,
// vehicles and others. Flat arrays, one thread, no allocation once the arrays have grown.
//
// Departures from van den Berg and others 2011 (avoidance.h): the preferred speed falls with the distance to
// the next person ahead (Tordeux, Chraibi and Seyfried 2016, "Collision-free speed model for pedestrian
// dynamics"), since reciprocal avoidance alone lets dense crowds walk far too fast; velocities relax (Helbing
// and Molnar 1995, "Social force model for pedestrian dynamics"); a person whose way is blocked by somebody
// who comes the other way turns to the right, and in time turns the shoulders; bodies that touch are pushed
// apart, and walls have the last word.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "life/crowd/walls.h"

namespace parvis::crowd {

/// People, one element each in every array.
struct Walkers {
  std::vector<glm::vec2> position;  ///< in plan, metres
  std::vector<glm::vec2> velocity;  ///< of the last step, m/s
  std::vector<glm::vec2> aim;       ///< unit vector towards where they walk; zero: they stand
  std::vector<float> height_m;      ///< of the ground below them
  std::vector<float> radius_m;      ///< of the body in plan
  std::vector<float> free_speed;    ///< with nobody in the way, m/s
  std::vector<float> blocked_s;     ///< for how long they have hardly moved although they want to

  std::size_t size() const { return position.size(); }
  /// Adds a person who stands; returns the index.
  std::size_t add(glm::vec2 where, float ground_m, float radius, float speed);
  /// Removes a person; the last one takes the index.
  void remove(std::size_t index);
};

/// Something that moves and does not give way, as a capsule: a vehicle, a visitor.
struct MovingBody {
  glm::vec2 a, b;            ///< ends of the middle line
  float radius_m = 0.0f;     ///< about it
  glm::vec2 velocity{0.0f};  ///< m/s
  float bottom_m = -1e9f, top_m = 1e9f;
};

/// Parameters of people's behaviour.
struct SteeringRules {
  float horizon_s = 1.6f;         ///< for which others are cleared
  float wall_horizon_s = 0.35f;   ///< for which walls are
  float headway_s = 1.3f;         ///< to the person ahead, beyond touching; see above
  float headway_body = 0.86f;     ///< of both radii that counts as touching there
  float headway_stride = 1.1f;    ///< the same of who walks the same way: strides need room
  float headway_width = 0.8f;     ///< of both radii: who is farther beside the way is not ahead
  float relaxation_s = 0.5f;      ///< in which a walker's velocity becomes the wanted one but for 1 / e
  float max_acceleration = 3.0f;  ///< m/s2
};

/// Makes steps; holds what they need in between.
class Steering {
 public:
  explicit Steering(SteeringRules rules = {}) : rules_(rules) {}

  /// Everybody walks for `step_s` (0.05 to 0.2).
  void step(Walkers& walkers, const Walls& walls, std::span<const MovingBody> bodies, float step_s);

 private:
  static constexpr int max_neighbours = 10;
  struct Near {
    std::uint32_t index;  ///< in sorted order
    float distance_2;
  };
  /// The nearest others as one person sees them: an array for each number, so that a search through all of
  /// them is a few vector instructions. Elements beyond `count` block nobody.
  struct Around {
    static constexpr int lanes = 12;  ///< max_neighbours, rounded up to whole vectors
    int count = 0;
    std::array<float, lanes> x, y;                    ///< from the person, metres
    std::array<float, lanes> bodies;                  ///< the sum of both radii
    std::array<float, lanes> room;                    ///< to the other one, by SteeringRules::headway_body
    std::array<std::uint32_t, max_neighbours> index;  ///< in sorted order
  };
  /// A person where neighbours are sought: in the order of cells.
  struct Sorted {
    glm::vec2 position, velocity, aim;
    float height_m, radius_m;
    std::uint32_t index;
  };

  void sort(const Walkers& walkers);
  Around look_around(std::size_t sorted) const;
  float speed_along(glm::vec2 way, float free_speed, const Around& around) const;
  glm::vec2 wanted_velocity(const Walkers& walkers, std::size_t sorted, const Around& around) const;
  glm::vec2 steered(const Walkers& walkers, std::size_t sorted, const Walls& walls,
                    std::span<const MovingBody> bodies, const Around& around, float step_s) const;
  void separate(Walkers& walkers, const Walls& walls, std::span<const MovingBody> bodies);

  SteeringRules rules_;
  std::vector<Sorted> sorted_;
  std::vector<std::uint32_t> starts_, cells_;
  std::vector<std::uint32_t> neighbours_;  ///< max_neighbours each, of those in sorted order
  std::vector<std::uint8_t> neighbour_count_;
  std::vector<glm::vec2> steered_;
  std::vector<float> slim_;  ///< of each person: the radius that they need when they turn their shoulders
  glm::vec2 corner_{0.0f};
  glm::ivec2 size_{0};
  float cell_m_ = 1.0f;
};

}  // namespace parvis::crowd

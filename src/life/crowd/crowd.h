// People on their ways: each has a destination, walks there over the navigation mesh among the others, and
// arrives.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "base/random.h"
#include "life/crowd/nav_mesh.h"
#include "life/crowd/steering.h"

namespace parvis::crowd {

/// A line that people walk to and arrive at anywhere along it: a door, the end of a street. A point where
/// both ends are one.
struct Destination {
  glm::vec3 a{0.0f}, b{0.0f};
  float reach_m = 0.45f;  ///< from the line, at which they have arrived
};

/// Data of a person beside the arrays of Walkers.
struct PersonOnTheWay {
  std::uint32_t number = 0;  ///< unique in the crowd; the person's own random numbers follow from it
  int destination = -1;      ///< index of the crowd's; -1: stands
  float waits_s = 0.0f;      ///< until the person sets off
  float slope = 0.0f;        ///< of the ground in the walking direction
  bool has_arrived = false;
  bool is_held = false;     ///< stands for this step, at a kerb say
  bool is_away = false;     ///< is not on this ground: in nobody's way
  float own_speed = 1.34f;  ///< on level ground with nobody in the way, m/s
  float lean_m = 0.0f;      ///< by which corners are passed wider
  Way way = {};
  std::size_t corner = 0;  ///< of the way, that is walked to
  int leader = -1;         ///< the person whom they walk beside; -1: nobody
};

/// A crowd on one mesh. All that happens follows from its seed and the calls.
class Crowd {
 public:
  /// The mesh belongs to the crowd.
  explicit Crowd(NavMesh mesh, SteeringRules rules = {});

  /// Adds a destination; returns its index.
  int add(const Destination& destination);
  /// Adds a person at a place of the mesh; returns the index. Nothing where the place is not on the mesh, or
  /// no way leads to the destination.
  std::optional<std::size_t> add(glm::vec3 where, int destination, float speed, float radius_m,
                                 float waits_s = 0.0f);
  /// Sends a person elsewhere, who sets off in `waits_s`. False where no way leads there.
  bool send(std::size_t person, int destination, float waits_s = 0.0f);
  /// The one of `destinations` at which a person would have passed first, by distance and by who is nearer
  /// and goes there, too: 1.2 people per second and metre of its line pass. The present one is left where
  /// another one saves a third.
  int quickest(std::size_t person, std::span<const int> destinations) const;
  /// Lets a person walk beside another one, of the same destination: both keep abreast, who is behind
  /// catches up, who leads waits for who has fallen behind.
  void accompany(std::size_t person, std::size_t leader) { people_[person].leader = int(leader); }
  /// Holds a person where they stand, or lets them walk.
  void hold(std::size_t person, bool is_held) { people_[person].is_held = is_held; }
  /// Takes a person off the ground, or leaves them there again: aboard a tram, say.
  void set_away(std::size_t person, bool is_away);
  /// Puts a person who was away at a place, where they stand.
  void put(std::size_t person, glm::vec3 where);
  /// Undoes the last step of a person, who then stands where they were before.
  void stand_back(std::size_t person, glm::vec2 before);
  /// Removes a person; the last one takes the index.
  void remove(std::size_t person);

  /// `step_s` passes (0.05 to 0.2). Who arrives stands, with has_arrived.
  void step(float step_s, std::span<const MovingBody> bodies = {});

  /// The ground has changed between `low` and `high` (in plan): whose way it crosses finds another one.
  void change_ground(const WalkingGround& ground, glm::vec2 low, glm::vec2 high);

  /// The direction in which a person wants to walk on; zero for who has no way.
  glm::vec2 direction(std::size_t person) const;

  std::size_t size() const { return walkers_.size(); }                            ///< people
  const Walkers& walkers() const { return walkers_; }                             ///< where they are
  const std::vector<PersonOnTheWay>& people() const { return people_; }           ///< as in walkers()
  const std::vector<Destination>& destinations() const { return destinations_; }  ///< in the order added
  const NavMesh& mesh() const { return mesh_; }                                   ///< on which they walk
  const Walls& walls() const { return walls_; }                                   ///< its borders

 private:
  void find_walls();
  void follow_way(std::size_t person);
  void look_at_ground(std::size_t person);
  glm::vec2 target_of(std::size_t person) const;
  /// Away from the wall about which a person's way turns at the corner that is walked to; unit.
  glm::vec2 outward(const PersonOnTheWay& person) const;
  /// How far the next wall is in that direction.
  float room_at_corner(const PersonOnTheWay& person) const;
  void keep_together();

  NavMesh mesh_;
  Walls walls_;
  Steering steering_;
  Walkers walkers_;
  std::vector<PersonOnTheWay> people_;
  std::vector<Destination> destinations_;
  std::uint32_t next_number_ = 0, steps_ = 0;
};

}  // namespace parvis::crowd

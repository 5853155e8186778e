// People who ride: they walk to a stop, wait on its platform, let others out and board, and alight elsewhere.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/random.h"
#include "land/roads/transit_stops.h"
#include "life/crowd/crowd.h"

namespace parvis::crowd {

/// The passengers among the people of a crowd, by their indices there.
class Passengers {
 public:
  /// The stage of somebody's ride.
  enum class Trip : std::uint8_t { none, walks_to_stop, waits, walks_to_door, enters, rides, leaves };

  /// Finds places to wait and doors on the mesh of the crowd, at the stops within the radius.
  Passengers(std::shared_ptr<std::vector<scene::TransitStop>> stops, Crowd& crowd, glm::vec2 centre,
             float radius_m);
  /// True where no stop can be walked to.
  bool empty() const { return places_.empty(); }
  /// Adds a person of the crowd, the last one; some are aboard from the beginning.
  void add(Crowd& crowd, Random& random);

  /// True if a person who has arrived somewhere goes on by themselves; false: somebody must send them.
  bool continues(std::size_t person, Crowd& crowd, Random& random);
  /// `step_s` passes. Calls `send(person)` for who has alighted and is to walk somewhere.
  void step(float step_s, Crowd& crowd, std::span<Random> randoms,
            const std::function<void(std::size_t)>& send);

  Trip trip(std::size_t person) const { return people_[person].trip; }
  /// The place of who goes through a door.
  std::optional<glm::vec3> between(std::size_t person) const;
  /// The direction in which somebody who waits looks.
  std::optional<glm::vec2> looks_to(std::size_t person) const;

 private:
  struct Passenger {
    Trip trip = Trip::none;
    int stop = -1;  ///< of the scene
    int door = 0;
    glm::vec3 from{0.0f}, to{0.0f};  ///< on the way through a door
    float passed_s = 0.0f;           ///< since it began
    float delay_s = 0.0f;            ///< until it begins
  };
  /// A stop's destinations.
  struct Places {
    int stop = 0;
    std::vector<int> waiting, doors;  ///< of the crowd
    bool was_open = false;
  };
  bool to_stop(std::size_t person, Crowd& crowd, Random& random);
  void let_out(Places& places, std::span<Random> randoms);
  void board(const Places& places, Crowd& crowd, std::span<Random> randoms);
  int pending(int stop, Trip trip) const;

  std::shared_ptr<std::vector<scene::TransitStop>> stops_;
  std::vector<Places> places_;
  std::vector<Passenger> people_;
};

}  // namespace parvis::crowd

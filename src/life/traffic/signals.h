// Traffic lights at junctions: streets that face each other have green together, people cross the others
// meanwhile, and trams are let through.
//
// Phases follow one another: green, 3 s yellow, 2 s all red. People's light turns red so long before the end
// of green that whoever has just stepped on is across at 1.2 m/s (RiLSA 2015, section 2.7). A tram that will
// cross within 14 s ends the green of streets most of whose ways cross its track, and keeps them red until it
// has passed; other streets have green meanwhile.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "land/roads/street_crossings.h"
#include "scene/data/room_data.h"

namespace parvis::traffic {

/// The light that drivers see.
enum class DriveLight : std::uint8_t { red, yellow, green };

/// Lights that the node `trafficLights` asks for.
struct SignalDemand {
  static constexpr std::string_view name = "traffic.signals";
  static constexpr scene::DataRole role =
      scene::DataRole::settings;  // pictures show lamps, which are objects
  std::string called;
  glm::vec3 position{0.0f};  ///< near the middle of a junction
  float green_s = 20.0f;     ///< at least: people need time to cross
  float offset_s = 0.0f;     ///< how long the first phase has run when the scene begins
  float beside_m = 0.9f;     ///< of masts from the edge of the outer lane
  bool is_visible = true;
  bool is_of_map = false;   ///< a map has a light there: without a junction near it there is none
  FileLocation where = {};  ///< of its node

  /// Adds all members but `where`; see SceneData.
  void hash(ContentHash& hash) const {
    hash.add_text(called), hash.add(position), hash.add(green_s), hash.add(offset_s), hash.add(beside_m);
    hash.add(is_visible), hash.add(is_of_map);
  }
};

/// A lane that leads to a junction with lights.
struct SignalApproach {
  int lane = 0;            ///< of the road graph
  int phase = 0;           ///< in which it has green
  float line_m = 0.0f;     ///< of its stop line, before the lane's end
  glm::vec2 away{1, 0};    ///< unit vector from the junction along the street
  glm::vec3 stop{0.0f};    ///< the middle of the stop line
  float half_width_m = 0;  ///< of the lane
};

/// A crossing with lights for people.
struct SignalWalk {
  int crossing = 0;            ///< of street_crossings
  int phase = -1;              ///< in which vehicles drive over it; -1: none does straight on
  float clearing_s = 0.0f;     ///< that people need to get across any of them
  glm::vec3 a{0.0f}, b{0.0f};  ///< its ends
  float half_width_m = 2.0f;
};

/// The lights of one junction.
struct SignalJunction {
  int junction = 0;  ///< Lane::crossing
  glm::vec3 middle{0.0f};
  int phases = 0;
  float green_s = 20.0f, offset_s = 0.0f, beside_m = 0.9f;
  std::vector<SignalApproach> approaches;
  std::vector<SignalWalk> walks;
};

/// Lays out the lights at the junction nearest to the demand's position. Errors: no junction of three streets
/// within 30 m.
Result<SignalJunction> signals_at(const scene::RoadGraph& roads,
                                  std::span<const scene::StreetCrossing> crossings,
                                  const SignalDemand& demand);

/// All lights of a scene that runs.
class Signals {
 public:
  Signals() = default;
  /// Lights of these junctions; `lanes`: of the road graph, `crossings`: how many it has.
  Signals(std::vector<SignalJunction> junctions, const scene::RoadGraph& roads, std::size_t crossings);

  bool empty() const { return junctions_.empty(); }  ///< true if no junction has lights
  /// `seconds` pass. Trams come to `rails` when these say so.
  void step(float seconds, std::span<const scene::RailCrossing> rails);

  /// A turning lane's stop line and light.
  struct Gate {
    bool is_lit = false;
    float line_m = 0.0f;  ///< before the turning lane begins
    DriveLight light = DriveLight::green;
  };
  /// The gate of a lane of the road graph; not lit where there are no lights.
  Gate gate(int turn) const;
  /// The light of each crossing of the scene.
  const std::vector<scene::WalkLight>& walk_lights() const { return walk_; }
  const std::vector<SignalJunction>& junctions() const { return junctions_; }  ///< in the order given
  /// The light of a phase of a junction, both by number.
  DriveLight light(std::size_t junction, int phase) const;

 private:
  struct State {
    int phase = 0;
    float since_s = 0.0f;  ///< the phase began
    float green_s = 0.0f;  ///< until it turns yellow, counted from there
  };
  bool is_barred(const SignalJunction& junction, std::size_t number, int phase,
                 std::span<const scene::RailCrossing> rails) const;

  std::vector<SignalJunction> junctions_;
  std::vector<State> states_;
  std::vector<std::pair<int, int>> approach_of_;      ///< of each lane: junction and approach; -1: none
  std::vector<std::vector<std::vector<int>>> turns_;  ///< of each junction and phase
  std::vector<scene::WalkLight> walk_;
  std::vector<std::vector<glm::vec2>> lane_points_;  ///< of turns, in plan
};

}  // namespace parvis::traffic

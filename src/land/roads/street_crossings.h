// Where people cross streets, and who is on the way there while a scene runs: at the mouth of every street at
// a junction, from edge to edge of its lanes.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <memory>
#include <vector>

#include "base/content_hash.h"
#include "scene/data/room_data.h"
#include "scene/data/scene.h"

namespace parvis::scene {

/// A strip of carriageway that people walk over; world frame, metres.
struct StreetCrossing {
  glm::vec3 a{0.0f}, b{0.0f};  ///< ends of its middle line, at the outer edges of the lanes
  float half_width_m = 2.0f;   ///< along the street
  int junction = -1;           ///< Lane::crossing of the turns beside which it lies; -1: none

  /// True if a place in plan lies on it; it is `more_m` wider on all sides.
  bool contains(glm::vec2 place, float more_m = 0.0f) const;
};

/// The crossings of all streets at their junctions, on the paint of zebras ("zebra" in a material's name)
/// where there is some, else a few metres before the junction.
std::vector<StreetCrossing> street_crossings(const Scene& scene);

/// The light that people see at a crossing; `none` where it has no traffic lights.
enum class WalkLight : std::uint8_t { none, walk, wait };

/// A piece of track across a lane, where drivers let trams pass.
struct RailCrossing {
  StreetCrossing strip;                                 ///< its middle line lies along the track
  float tram_in_s = std::numeric_limits<float>::max();  ///< until a tram is on it; 0: one is
};

/// The state of a scene's streets at the present step: vehicles, and crossings in use. The processes of the
/// scene read and write it.
struct StreetTraffic {
  /// A vehicle in plan.
  struct Vehicle {
    glm::vec2 rear{0.0f}, front{0.0f};  ///< ends of its middle line
    float half_width_m = 1.0f, ground_m = 0.0f;
    glm::vec2 velocity{0.0f};  ///< m/s
  };
  bool has_people = false;  ///< else vehicles pay no heed to crossings
  std::vector<StreetCrossing> crossings;
  std::vector<std::uint8_t> people;  ///< of each crossing: somebody walks there or waits to
  std::vector<std::uint8_t> taken;   ///< of each: a vehicle is on it, or can no longer stop before it
  std::vector<WalkLight> lights;     ///< of each crossing
  std::vector<Vehicle> vehicles;
  std::vector<RailCrossing> rail_crossings;
  std::vector<StreetCrossing> kept_clear;  ///< ground that trams cover within seconds: nobody steps onto it
};

/// The StreetTraffic of a running scene; null before its traffic begins.
struct SharedStreets {
  static constexpr std::string_view name = "roads.shared_streets";
  static constexpr DataRole role =
      DataRole::settings;  // pictures show vehicles and people, which are objects
  std::shared_ptr<StreetTraffic> now;

  /// Adds nothing: the state of a moment; see SceneData.
  void hash(ContentHash&) const {}
};

}  // namespace parvis::scene

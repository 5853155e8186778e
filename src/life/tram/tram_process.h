// The trams of a scene that runs.
#pragma once

#include <vector>

#include "land/roads/street_crossings.h"
#include "land/roads/transit_stops.h"
#include "life/tram/tram_line.h"
#include "scene/action/event_queue.h"
#include "scene/action/process.h"

namespace parvis::tram {

/// A part of a track, metres along it.
struct TrackPart {
  float from_m = 0.0f, to_m = 0.0f;
};

/// Where a track crosses lanes, in order; parts that touch are one.
std::vector<TrackPart> crossed_lanes(const scene::MeasuredPath& track, const scene::RoadGraph& roads);

/// Trams on all lines of the scene: where they are follows from the time, and from the people for whom their
/// doors wait.
class TramProcess final : public action::Process {
 public:
  std::string name() const override { return "tram"; }
  /// "2 trams"; empty where there is no line.
  std::string status() const override;
  /// Adds an object for each section of each tram.
  void begin(scene::Scene& scene, action::SharedByProcesses&) override;
  void step(const scene::Scene&) override {
    ++steps_;
    wait_for_people();
    if (streets_) share();
  }
  void present(scene::Scene& scene, double ahead_s) override;

 private:
  struct Running {
    TramLine line;
    std::size_t first_object = 0;           ///< then those of its trams, section by section
    std::size_t first_vehicle = 0;          ///< of the streets' vehicles, likewise
    std::vector<TrackPart> crossings = {};  ///< where it crosses lanes
    std::size_t first_crossing = 0;         ///< of the streets' rail crossings, in their order
    std::size_t first_stop = 0;             ///< of the scene's stops, in their order
    std::vector<double> late_s = {};        ///< of each tram, in its present run
  };
  void wait_for_people();
  void share_stops();
  void add_stops(Running& running);
  void share();

  std::vector<Running> lines_;
  std::shared_ptr<scene::StreetTraffic> streets_;  ///< null: nobody else moves
  std::shared_ptr<std::vector<scene::TransitStop>> stops_ =
      std::make_shared<std::vector<scene::TransitStop>>();
  long steps_ = 0;
};

}  // namespace parvis::tram

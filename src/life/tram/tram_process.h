// The trams of a scene that runs.
#pragma once

#include <vector>

#include "land/roads/street_crossings.h"
#include "life/tram/tram_line.h"
#include "scene/action/event_queue.h"
#include "scene/action/process.h"

namespace parvis::tram {

/// Trams on all lines of the scene: where they are follows from the time alone.
class TramProcess final : public action::Process {
 public:
  std::string name() const override { return "tram"; }
  /// "2 trams"; empty where there is no line.
  std::string status() const override;
  /// Adds an object for each section of each tram.
  void begin(scene::Scene& scene, action::SharedByProcesses&) override;
  void step(const scene::Scene&) override {
    ++steps_;
    if (streets_) share();
  }
  void present(scene::Scene& scene, double ahead_s) override;

 private:
  struct Running {
    TramLine line;
    std::size_t first_object = 0;   ///< then those of its trams, section by section
    std::size_t first_vehicle = 0;  ///< of the streets' vehicles, likewise
  };
  void share();

  std::vector<Running> lines_;
  std::shared_ptr<scene::StreetTraffic> streets_;  ///< null: nobody else moves
  long steps_ = 0;
};

}  // namespace parvis::tram

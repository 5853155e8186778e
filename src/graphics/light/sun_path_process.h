// Lets the nodes sunPath follow the place, the day and the hour of dayLight while a scene runs.
#pragma once

#include <vector>

#include "graphics/light/day_light_time.h"
#include "scene/action/process.h"

namespace parvis::light {

/// Moves the pieces of all sun paths. What a node makes is otherwise rebuilt when its own attributes change;
/// sun paths show what messages, scenarios and the window change in dayLight.
class SunPathProcess final : public action::Process {
 public:
  std::string name() const override { return "sun paths"; }
  void begin(scene::Scene& scene, action::SharedByProcesses& shared) override;
  void present(scene::Scene& scene, double ahead_s) override;

 private:
  /// A node and what its pieces show.
  struct Path {
    const scene::Node* node;
    std::vector<int> days = {};
    PlaceAndTime now = {};
  };

  const scene::LiveScene* live_ = nullptr;
  std::vector<Path> paths_;
};

}  // namespace parvis::light

// The traffic of a scene that runs.
#pragma once

#include <memory>

#include "life/traffic/traffic.h"
#include "scene/action/process.h"

namespace parvis::traffic {

/// Vehicles on the roads of the scene, as its TrafficDemand asks.
class TrafficProcess final : public action::Process {
 public:
  std::string name() const override { return "traffic"; }
  /// "30 vehicles"; empty where none drives.
  std::string status() const override {
    return traffic_->vehicle_count() == 0 ? "" : fmt::format("{} vehicles", traffic_->vehicle_count());
  }
  /// Puts vehicles on the scene's roads.
  void begin(scene::Scene& scene, action::SharedByProcesses&) override {
    const std::vector<scene::StreetCrossing> crossings = scene::street_crossings(scene);
    traffic_ = std::make_unique<Traffic>(scene, crossings);
    for (const std::string& warning : traffic_->warnings()) warn(error("{}", warning));
    traffic_->add_vehicles(scene), traffic_->add_lamps(scene);
    streets_ = std::make_shared<scene::StreetTraffic>();
    streets_->crossings = crossings;
    streets_->people.assign(streets_->crossings.size(), 0);
    traffic_->share(*streets_);
    scene.data<scene::SharedStreets>().now = streets_;
    scene.data<scene::SharedStops>().now = traffic_->stops()->empty() ? nullptr : traffic_->stops();
  }
  void step(const scene::Scene&) override { traffic_->step(); }
  void present(scene::Scene& scene, double ahead_s) override { traffic_->place(scene, ahead_s); }

  /// The traffic after `begin`.
  const Traffic& traffic() const { return *traffic_; }
  Traffic& traffic() { return *traffic_; }  ///< likewise, for benches' controls

 private:
  std::shared_ptr<scene::StreetTraffic> streets_;
  std::unique_ptr<Traffic> traffic_;
};

}  // namespace parvis::traffic

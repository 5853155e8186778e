// What the test room keeps in a scene, and the process that moves it.
#pragma once

#include <map>

#include "reflections/methods/settings.h"
#include "scene/action/process.h"

namespace parvis::test_room {

/// A balloon as its script describes it.
struct Balloon {
  static constexpr std::string_view name = "test_room.balloon";
  static constexpr scene::DataRole role = scene::DataRole::settings;

  float radius_m = 1.0f;
  /// Adds all of it.
  void hash(ContentHash& hash) const { hash.add(radius_m); }
};

/// The setting of the reflection method: the radiance of every mirror direction, in the green channel.
struct Glow {
  static constexpr std::string_view name = "test_room.glow";
  static constexpr scene::DataRole role = scene::DataRole::settings;

  float radiance = 0.25f;
  /// Adds all of it.
  void hash(ContentHash& hash) const { hash.add(radiance); }
};

/// Lets balloons rise at the speed that the message "rise SPEED" gave each.
class BalloonProcess final : public action::Process {
 public:
  std::string name() const override { return "balloons"; }
  std::string status() const override {
    return speeds_.empty() ? "" : fmt::format("{} rise", speeds_.size());
  }
  void begin(scene::Scene& scene, action::SharedByProcesses& shared) override;
  void step(const scene::Scene& scene) override;
  void present(scene::Scene& scene, double ahead_s) override;
  bool receive(scene::Scene& scene, const scene::Node& node, const scene::Message& message) override;

 private:
  struct Rise {
    int object = -1;
    float start_m = 0.0f, height_m = 0.0f, speed_m_s = 0.0f;
  };
  const scene::LiveScene* live_ = nullptr;
  std::map<const scene::Node*, Rise> speeds_;
};

}  // namespace parvis::test_room

// Shows what is seen only while a lamp burns: lit windows.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <tuple>

#include "scene/action/process.h"
#include "scene/data/lamp.h"

namespace parvis::lamps {

/// The names in a lamp: Lamp::of, shows and part.
using LampNames = std::tuple<std::string, std::string, std::string>;

/// Shows and hides the objects of Lamp::shows. Warns once of each lamp that names none: when all processes
/// have made their objects, and of lamps that a scenario shows later, when it does.
class LampProcess final : public action::Process {
 public:
  std::string name() const override { return "lamps"; }
  void begin(scene::Scene& scene, action::SharedByProcesses& shared) override;
  void present(scene::Scene& scene, double ahead_s) override;

 private:
  void warn_of_idle(const scene::Scene& scene);

  const scene::LiveScene* live_ = nullptr;
  std::optional<std::string> checked_;  ///< the scenario whose lamps were looked at last
  std::set<LampNames> looked_at_;
};

}  // namespace parvis::lamps

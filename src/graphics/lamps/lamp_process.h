// Shows what is seen only while a lamp burns: lit windows.
#pragma once

#include "scene/action/process.h"
#include "scene/data/lamp.h"

namespace parvis::lamps {

/// Shows and hides the objects of Lamp::shows.
class LampProcess final : public action::Process {
 public:
  std::string name() const override { return "lamps"; }
  void begin(scene::Scene& scene, action::SharedByProcesses&) override { present(scene, 0.0); }
  void present(scene::Scene& scene, double) override { scene::show_what_lamps_show(scene); }
};

}  // namespace parvis::lamps

// Shows what is seen only while a lamp burns: lit windows.
#pragma once

#include "scene/action/process.h"
#include "scene/data/lamp.h"

namespace parvis::lamps {

/// Shows and hides the objects of Lamp::shows. Warns once, when all processes have made their objects, of
/// lamps that name none.
class LampProcess final : public action::Process {
 public:
  std::string name() const override { return "lamps"; }
  void begin(scene::Scene& scene, action::SharedByProcesses& shared) override;
  void present(scene::Scene& scene, double ahead_s) override;

 private:
  void warn_of_idle(const scene::Scene& scene, const std::vector<scene::Node>& nodes);

  const scene::LiveScene* unchecked_ = nullptr;  ///< until a first moment is shown
};

}  // namespace parvis::lamps

// Animations of models, played as time passes.
#pragma once

#include "scene/action/process.h"
#include "scene/data/object_animation.h"

namespace parvis::action {

/// Poses and deforms every object that plays an animation.
class AnimationProcess final : public Process {
 public:
  std::string name() const override { return "animations"; }
  void begin(scene::Scene&, SharedByProcesses&) override {}
  void step(const scene::Scene&) override { ++steps_; }
  void present(scene::Scene& scene, double ahead_s) override {
    scene::animate(scene, double(steps_) * step_s + ahead_s);
  }

 private:
  long steps_ = 0;
};

}  // namespace parvis::action

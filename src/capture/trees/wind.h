// Captured trees that sway in the wind. A tree leans as a whole, by a shear about its foot, so that its
// billboards, its rays and its shadows move alike and what is kept per tree stays as it is.
#pragma once

#include "capture/trees/scene_tree.h"
#include "scene/action/process.h"

namespace parvis::trees {

/// Where the top of a tree is at a time beside its place at rest, in shares of how far it sways at most.
/// `phase`: trees of different phase do not sway together. Continuous; its length is at most 1.
glm::vec2 lean_at(double time_s, float phase);

/// Lets the trees of a scene sway that ask for it.
class WindProcess final : public action::Process {
 public:
  std::string name() const override { return "wind"; }
  std::string status() const override { return swaying_ == 0 ? "" : fmt::format("{} trees sway", swaying_); }
  void begin(scene::Scene& scene, action::SharedByProcesses&) override { present(scene, 0.0); }
  void step(const scene::Scene&) override { ++steps_; }
  void present(scene::Scene& scene, double ahead_s) override;

 private:
  long steps_ = 0;
  int swaying_ = 0;
};

}  // namespace parvis::trees

// Baking: every registered step on every state of a scene that is asked for.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>

#include "base/registries.h"
#include "base/result.h"
#include "machines/processes.h"
#include "scene/data/scene.h"

namespace parvis::stage {

/// One run of `parvis bake`: states are baked one by one; then what is kept of all others is removed.
class Baking {
 public:
  /// `registries` outlives it. `processes` divide the work of steps that can be divided; all of them bake.
  explicit Baking(const Registries& registries, const machines::Processes& processes = {})
      : registries_(registries), processes_(processes) {}

  /// Runs all steps on one state, except those whose results its reflection method never reads. Prints a line
  /// per step that has something to bake. `plan`: see render::BakeInput. Needs a current OpenGL 4.5 context.
  Status bake(const scene::Scene& state, const std::filesystem::path& plan = {});

  /// Removes what the steps have kept of states of the scene that were not given to `bake`.
  void forget_other_states(const scene::Scene& scene) const;

 private:
  const Registries& registries_;
  machines::Processes processes_;
  std::map<std::string, std::set<std::filesystem::path>> kept_;  ///< per name of a step
};

}  // namespace parvis::stage

// The registry of what is baked: what takes long, stays the same, and is kept in NAME.baked beside a scene's
// script. `parvis bake` runs every step on every state (scenario) that it is given.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "graphics/render/drawables.h"
#include "graphics/render/renderer.h"
#include "machines/processes.h"

namespace parvis::render {

/// The input of a bake step: one state of a scene. It cannot be copied: it owns the renderer.
class BakeInput {
 public:
  /// The arguments outlive it. `plan`: where to write a picture of what is baked, seen from above; empty:
  /// nowhere.
  BakeInput(const scene::Scene& scene, const Drawables& drawables, const MakeLight& make_light,
            std::filesystem::path plan = {}, const machines::Processes& processes = {})
      : scene_(scene),
        drawables_(drawables),
        make_light_(make_light),
        plan_(std::move(plan)),
        processes_(processes) {}
  BakeInput(const BakeInput&) = delete;

  /// The state that is baked.
  const scene::Scene& scene() const { return scene_; }
  /// Its renderer, created when a step first asks for it. Needs a current OpenGL 4.5 context.
  Result<Renderer*> renderer();
  /// Steps that know places write their picture here; empty: it is not wanted.
  const std::filesystem::path& plan() const { return plan_; }
  /// The processes, all of which run each step; the first one alone writes files.
  const machines::Processes& processes() const { return processes_; }

 private:
  const scene::Scene& scene_;
  const Drawables& drawables_;
  const MakeLight& make_light_;
  std::filesystem::path plan_;
  machines::Processes processes_;
  std::unique_ptr<Renderer> renderer_;
};

/// The results of a step for one state.
struct Baked {
  std::set<std::filesystem::path> kept;  ///< files or folders, named by the hash of all that they depend on
  std::string summary;                   ///< a line for the user; empty: this state has nothing for the step
};

/// One step of baking.
struct BakeStep {
  std::string name;  ///< what it bakes, as --help lists it; unique
  /// Bakes and keeps what is not kept yet, with progress; interrupted, it resumes when it is called again.
  std::function<Result<Baked>(BakeInput&)> run;
  /// Removes what this step has kept of any state of the scene, other than `kept`.
  std::function<void(const scene::Scene& scene, const std::set<std::filesystem::path>& kept)> forget_others;
};

/// All steps, in the order in which rooms have added them and in which they are run.
class BakeSteps {
 public:
  /// No two steps have one name; both functions are given.
  void add(BakeStep step);
  /// Every step.
  const std::vector<BakeStep>& all() const { return steps_; }

 private:
  std::vector<BakeStep> steps_;
};

}  // namespace parvis::render

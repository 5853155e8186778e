#include "stage/baking.h"

#include <fmt/format.h>

#include "graphics/render/bake_steps.h"
#include "reflections/methods/registry.h"

namespace parvis::stage {

Status Baking::bake(const scene::Scene& state, const std::filesystem::path& plan) {
  render::BakeInput input(state, registries_.get<render::Drawables>(), registries_.get<render::Lights>().make,
                          plan, processes_);
  for (const render::BakeStep& step : registries_.get<render::BakeSteps>().all()) {
    if (!registries_.get<methods::Registry>().reads_baked(state, step.name)) continue;
    Result<render::Baked> baked = step.run(input);
    if (!baked) return baked.errors();
    if (!baked->summary.empty()) fmt::print("{}\n", baked->summary);
    kept_[step.name].merge(std::move(baked->kept));
  }
  return Ok{};
}

void Baking::forget_other_states(const scene::Scene& scene) const {
  if (!processes_.is_first()) return;
  for (const render::BakeStep& step : registries_.get<render::BakeSteps>().all()) {
    const auto kept = kept_.find(step.name);
    step.forget_others(scene, kept == kept_.end() ? std::set<std::filesystem::path>() : kept->second);
  }
}

}  // namespace parvis::stage

#include "graphics/render/bake_steps.h"

#include <algorithm>
#include <cassert>

namespace parvis::render {

Result<Renderer*> BakeInput::renderer() {
  if (!renderer_) {
    Result<std::unique_ptr<Renderer>> made = Renderer::create(scene_, drawables_, make_light_);
    if (!made) return made.errors();
    renderer_ = *std::move(made);
  }
  return renderer_.get();
}

void BakeSteps::add(BakeStep step) {
  assert(step.run && step.forget_others);
  assert(std::ranges::find(steps_, step.name, &BakeStep::name) == steps_.end() && "two steps have one name");
  steps_.push_back(std::move(step));
}

}  // namespace parvis::render

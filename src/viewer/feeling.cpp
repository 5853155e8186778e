#include "viewer/feeling.h"

namespace parvis::viewer {
namespace {

const std::vector<devices::HapticEffect>& effects_of(const scene::Scene& scene) {
  return scene.data<scene::ItemsOf<devices::HapticEffect>>().items;
}

}  // namespace

bool Feeling::is_in(const scene::Scene& scene) { return !effects_of(scene).empty(); }

void Feeling::step(Visit& visit, Planning& planning, const Controls& controls, glm::vec3 stood, float seconds,
                   devices::Devices* devices) {
  const planner::Tool* tool = planning.tool();
  const bool holds = tool && tool->snapped().kind != planner::SnapKind::none &&
                     tool->snapped().kind != planner::SnapKind::grid;
  const std::size_t selected = planning.session() ? planning.session()->selected().size() : 0;
  const bool walks =
      visit.mode() == Mode::walk && glm::length(glm::vec2(controls.move)) > 0.3f && seconds > 0.0f;
  const bool is_stopped = (walks && glm::distance(stood, visit.camera().position_in_world()) < 1e-4f) ||
                          (tool && !tool->refusal().empty());
  const std::array now{holds, is_stopped, selected > std::exchange(selected_, selected)};
  for (std::size_t i = 0; i < now.size(); ++i)
    if (!std::exchange(is_felt_[i], now[i]) && now[i] && devices)
      for (const devices::HapticEffect& effect : effects_of(visit.scene()))
        if (std::size_t(effect.on) == i) devices->pulse(effect.pulse);
}

}  // namespace parvis::viewer

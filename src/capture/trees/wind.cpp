#include "capture/trees/wind.h"

#include <cmath>

#include "scene/action/event_queue.h"

namespace parvis::trees {
namespace {

constexpr double period_s = 3.1;  // of a tree of ten metres (Moore and Maguire 2004: .2 to .5 per second)
constexpr double gust_s = 11.7;

}  // namespace

glm::vec2 lean_at(double time_s, float phase) {
  const double turn = 6.283185307179586 / period_s, p = double(phase);
  const double gust = 0.6 + 0.4 * std::sin(6.283185307179586 / gust_s * time_s + 0.7 * p);
  // The wind blows along x: the tree leans with it and swings about that, less across.
  return glm::vec2(gust * (0.35 + 0.55 * std::sin(turn * time_s + p)),
                   gust * 0.3 * std::sin(0.83 * turn * time_s + 2.1 * p));
}

void WindProcess::present(scene::Scene& scene, double ahead_s) {
  const double time_s = double(steps_) * action::step_s + ahead_s;
  swaying_ = 0;
  if (scene_trees(scene).empty()) return;
  for (SceneTree& tree : scene.data<SceneTrees>().items) {
    if (!tree.sways()) continue;
    ++swaying_;
    const glm::vec4 foot = tree.world_from_tree * glm::vec4(tree.tree->foot, 1.0f);
    const glm::vec2 in_world = tree.sway_m * lean_at(time_s, foot.x + 1.7f * foot.y);
    tree.lean_m = glm::vec2(glm::inverse(glm::mat3(tree.world_from_tree)) * glm::vec3(in_world, 0.0f));
    if (!tree.tree->trunk) continue;
    for (scene::Object& object : scene.objects)
      if (object.model == tree.tree->trunk && object.world_from_model == tree.world_from_tree)
        object.pose = {tree.leaning()};
  }
}

}  // namespace parvis::trees

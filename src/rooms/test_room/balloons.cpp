#include "rooms/test_room/balloons.h"

namespace parvis::test_room {

void BalloonProcess::begin(scene::Scene&, action::SharedByProcesses& shared) { live_ = &shared.live; }

void BalloonProcess::step(const scene::Scene&) {
  for (auto& [node, rise] : speeds_) rise.height_m += rise.speed_m_s * float(action::step_s);
}

void BalloonProcess::present(scene::Scene& scene, double ahead_s) {
  for (const auto& [node, rise] : speeds_)
    scene.objects[std::size_t(rise.object)].world_from_model[3].z =
        rise.start_m + rise.height_m + rise.speed_m_s * float(ahead_s);
}

bool BalloonProcess::receive(scene::Scene& scene, const scene::Node& node, const scene::Message& message) {
  if (message.schema->name != "rise" || node.schema->type != "balloon") return false;
  Rise& rise = speeds_[&node];
  if (rise.object < 0) {
    rise.object = live_->objects_of(node).front();
    rise.start_m = scene.objects[std::size_t(rise.object)].world_from_model[3].z;
  }
  rise.speed_m_s = float(std::get<double>(message.arguments.at(0)));
  return true;
}

}  // namespace parvis::test_room

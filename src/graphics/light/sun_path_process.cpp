#include "graphics/light/sun_path_process.h"

#include "graphics/light/day_light.h"
#include "graphics/light/nodes_sun_path.h"
#include "graphics/light/sun_path_model.h"

namespace parvis::light {
namespace {

template <class Visit>
void for_each_sun_path(const scene::Nodes& nodes, const Visit& visit) {
  for (const scene::Node& node : nodes) {
    if (node.schema->type == sun_path_type) visit(node);
    for_each_sun_path(node.children, visit);
  }
}

/// The same arcs: only the hour may differ.
bool is_same_day(PlaceAndTime one, const PlaceAndTime& other) {
  one.time_of_day_h = other.time_of_day_h;
  return one == other;
}

}  // namespace

void SunPathProcess::begin(scene::Scene& /*scene*/, action::SharedByProcesses& shared) {
  live_ = &shared.live;
  for_each_sun_path(live_->nodes(), [this](const scene::Node& node) { paths_.push_back({&node}); });
}

void SunPathProcess::present(scene::Scene& scene, double /*ahead_s*/) {
  if (paths_.empty()) return;
  const PlaceAndTime& now = scene.data<DayLight>().when;
  for (Path& path : paths_) {
    std::vector<int> days = sun_path_days(*path.node, now.year);
    const bool has_other_arcs = days != path.days || !is_same_day(now, path.now);
    if (!has_other_arcs && now == path.now) continue;
    for (const int object : live_->objects_of(*path.node)) {
      std::vector<glm::mat4>& pose = scene.objects[std::size_t(object)].pose;
      if (has_other_arcs)
        pose = sun_path_pose(now, days);
      else
        place_sun(now, pose);
    }
    path.days = std::move(days), path.now = now;
  }
}

}  // namespace parvis::light

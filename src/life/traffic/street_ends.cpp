#include "life/traffic/street_ends.h"

#include "scene/data/path.h"

namespace parvis::traffic {

CutStreets cut_streets(const scene::RoadGraph& roads, float end_m) {
  CutStreets cut{roads, {}};
  for (const scene::Lane& lane : roads.lanes)
    cut.parts.push_back(lane.crossing >= 0 ? LanePart::turn : LanePart::street);
  for (std::size_t i = 0; i < roads.lanes.size(); ++i) {
    const scene::MeasuredPath path = scene::MeasuredPath::in_plan(roads.lanes[i].points);
    if (cut.parts[i] == LanePart::turn || path.length() < 6.0f * end_m) continue;
    scene::Lane middle = roads.lanes[i], last = roads.lanes[i];
    const int first_new = int(cut.roads.lanes.size());
    cut.roads.lanes[i].points = path.part(0.0f, end_m);
    cut.roads.lanes[i].next = {first_new};
    middle.points = path.part(end_m, path.length() - end_m);
    middle.next = {first_new + 1};
    last.points = path.part(path.length() - end_m, path.length());
    cut.roads.lanes.push_back(std::move(middle));
    cut.roads.lanes.push_back(std::move(last));
    cut.parts[i] = LanePart::first_metres;
    cut.parts.insert(cut.parts.end(), {LanePart::street, LanePart::last_metres});
  }
  return cut;
}

}  // namespace parvis::traffic

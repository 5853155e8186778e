#include "formats/city_models/osm_earthworks.h"

#include <memory>

#include "scene/roads/earthworks.h"
#include "scene/roads/road_beds.h"

namespace parvis::scene {
namespace {

constexpr double raised_m = 0.05;  // of ramps, over the ground

}  // namespace

GroundOnMap ground_shaped_for(const std::vector<Road>& roads, const GroundOnMap& ground,
                              const glm::dvec3& origin) {
  if (!ground) return {};
  std::vector<RoadBed> beds;
  beds.reserve(roads.size());
  for (const Road& road : roads) {
    RoadBed& bed = beds.emplace_back();
    bed.half_m = half_bed_m(road);
    bed.points.reserve(road.path.size());
    for (const glm::vec3& point : road.path) {
      const bool is_raised = double(point.z) > ground(glm::dvec2(point) + glm::dvec2(origin)) + raised_m;
      bed.points.push_back({point, is_raised ? Bed::cut : Bed::earth});
    }
  }
  return [works = std::make_shared<const Earthworks>(beds), ground, origin](glm::dvec2 on_map) {
    const double bare_m = ground(on_map);
    const glm::vec2 place(on_map - glm::dvec2(origin));
    return bare_m + double(works->at(place, float(bare_m)) - float(bare_m));
  };
}

}  // namespace parvis::scene

#include "formats/city_models/osm_earthworks.h"

#include <memory>

#include "land/heights/ground_heights.h"
#include "land/roads/earthworks.h"
#include "land/roads/road_beds.h"
#include "land/roads/road_builder.h"

namespace parvis::scene {
namespace {

constexpr double raised_m = 0.05;  // of ramps, over the ground
// The same of turns, which have the heights of the roads' middle lines beside them.
constexpr double turn_raised_m = ground_reach_m;

}  // namespace

GroundOnMap ground_shaped_for(const std::vector<Road>& roads, const GroundOnMap& ground,
                              const glm::dvec3& origin) {
  if (!ground) return {};
  // Of roads that make no lanes the script's `streets` complains: here they have their beds, and no turns.
  const Result<RoadGraph> graph = build_road_graph(roads);
  const std::vector<Road> turns = graph ? right_turns(*graph) : std::vector<Road>();
  std::vector<RoadBed> beds;
  beds.reserve(roads.size() + turns.size());
  const auto add_bed = [&](const Road& road, bool is_turn) {
    RoadBed& bed = beds.emplace_back();
    bed.half_m = half_bed_m(road), bed.is_turn = is_turn;
    bed.points.reserve(road.path.size());
    for (const glm::vec3& point : road.path) {
      const bool is_raised = double(point.z) > ground(glm::dvec2(point) + glm::dvec2(origin)) +
                                                   (is_turn ? turn_raised_m : raised_m);
      bed.points.push_back({point, is_raised ? Bed::cut : Bed::earth});
    }
  };
  for (const Road& road : roads) add_bed(road, false);
  for (const Road& turn : turns) add_bed(turn, true);
  return [works = std::make_shared<const Earthworks>(beds), ground, origin](glm::dvec2 on_map) {
    const double bare_m = ground(on_map);
    const glm::vec2 place(on_map - glm::dvec2(origin));
    return bare_m + double(works->at(place, float(bare_m)) - float(bare_m));
  };
}

}  // namespace parvis::scene

// trafficCount: how many vehicles pass on a road, for noise.
#include "base/registries.h"
#include "planning/noise/noise_map_node.h"
#include "planning/noise/traffic_count.h"
#include "room_list.h"
#include "scene/script/attribute.h"
#include "scene/script/node_registry.h"
#include "scene/script/scene_builder.h"

namespace parvis::noise {
namespace {

using namespace scene::attribute;

scene::NodeSchema count_schema() {
  return {
      .type = "trafficCount",
      .help =
          "Vehicles that pass on roads by day (7 to 19), evening (19 to 23) and night (23 to 7): what parvis "
          "noise "
          "computes with. Without any, the vehicles of traffic count, as if they drove at all hours.",
      .attributes =
          {text("road",
                "name of roads; * and ? stand for any text and any character; the last node "
                "that matches counts")
               .by_default("*"),
           vec3("per_hour", "vehicles per hour in both directions: by day, evening, night")
               .in("1/h")
               .required(),
           vec3("heavy_percent", "of them lorries and buses: by day, evening, night")
               .in("%")
               .by_default("3 3 3"),
           number("speed_km_h", "mean speed; 0: the road's limit").in("km/h").between(0, 200).by_default("0"),
           choice("surface", "of the carriageway", {surface_names.begin(), surface_names.end()})
               .by_default("reference")},
      .example = "trafficCount(road=\"long*\", per_hour=\"420 210 60\", heavy_percent=\"6 3 3\")"};
}

void build_count(const scene::Node& node, scene::SceneBuilder& builder) {
  TrafficCount count;
  count.road = node.text("road"), count.surface = node.text("surface");
  count.speed_km_h = node.number("speed_km_h");
  const glm::vec3 per_hour = node.vec3("per_hour"), heavy = node.vec3("heavy_percent");
  constexpr float max_per_hour = 20'000.0f;
  for (int i = 0; i < int(periods); ++i) {
    if (!(per_hour[i] >= 0.0f && per_hour[i] <= max_per_hour))
      return builder.fail(
          error_at(node.where_of("per_hour"),
                   "trafficCount: {:g} vehicles per hour; expected 0 to {:.0f} of day, evening and night",
                   per_hour[i], max_per_hour));
    if (!(heavy[i] >= 0.0f && heavy[i] <= 100.0f))
      return builder.fail(error_at(
          node.where_of("heavy_percent"),
          "trafficCount: {:g} % of heavy vehicles; expected 0 to 100 of day, evening and night", heavy[i]));
    count.per_hour[std::size_t(i)] = double(per_hour[i]),
    count.heavy_percent[std::size_t(i)] = double(heavy[i]);
  }
  builder.add(std::move(count));
}

}  // namespace

void register_room(Registries& registries) {
  registries.get<scene::NodeRegistry>().add(count_schema(), build_count);
  add_map_node(registries.get<scene::NodeRegistry>());
}

}  // namespace parvis::noise

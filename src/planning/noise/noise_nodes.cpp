// trafficCount: how many vehicles pass on a road, for noise. noiseSource: what else makes noise.
#include <algorithm>

#include "base/registries.h"
#include "life/propagation/noise_source.h"
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

scene::NodeSchema source_schema() {
  return {.type = "noiseSource",
          .help =
              "Steady noise from a point or along a line: a fan, a terrace, a pipe. It is heard, and counts "
              "in the "
              "map of noise.",
          .attributes =
              {points("path", "one point, or the line's points").in("m").required(),
               text("power_db",
                    "sound power of the whole, dB re 1 pW: eight levels from 63 Hz to 8 kHz, or one in "
                    "dB(A), whose A-weighted octaves are equal")
                   .required(),
               vec3("hours", "fraction in which it sounds: of day, evening, night").by_default("1 1 1")},
          .example = "noiseSource(path=\"12 4 8.5\", power_db=\"70 68 66 64 62 58 52 45\", hours=\"1 1 0\")"};
}

void build_source(const scene::Node& node, scene::SceneBuilder& builder) {
  constexpr float same_point_m = 1e-3f, max_source_m = 10'000.0f;  // each piece of it costs time
  propagation::NoiseSource source;
  for (const glm::vec3& point : node.points("path"))
    source.line.emplace_back(builder.world_from_parent() * glm::vec4(point, 1.0f));
  // Repeats in space, not in plan: a line may stand upright.
  const auto repeats = std::ranges::unique(
      source.line, [](glm::vec3 a, glm::vec3 b) { return glm::distance(a, b) < same_point_m; });
  source.line.erase(repeats.begin(), repeats.end());
  if (const float length_m = source.line.size() > 1 ? scene::MeasuredPath(source.line).length() : 0.0f;
      !(length_m <= max_source_m))
    return builder.fail(error_at(node.where_of("path"),
                                 "noiseSource: a line of {:g} m; expected at most {:.0f} m", length_m,
                                 max_source_m));
  const std::vector<double> levels = scene::parse_numbers(node.text("power_db"));
  const auto is_level = [](double level) { return level >= -50.0 && level <= 160.0; };
  if (source.line.empty() || (levels.size() != 1 && levels.size() != propagation::octaves) ||
      !std::ranges::all_of(levels, is_level))
    return builder.fail(error_at(node.where_of("power_db"),
                                 "noiseSource: power_db=\"{}\"; expected one level or eight, -50 to 160 dB",
                                 node.text("power_db")));
  for (std::size_t band = 0; band < propagation::octaves; ++band)
    source.power_db[band] = levels.size() > 1 ? levels[band]
                                              : levels[0] - propagation::a_weights_db[band] -
                                                    10.0 * std::log10(double(propagation::octaves));
  const glm::vec3 hours = node.vec3("hours");
  for (int i = 0; i < int(periods); ++i) {
    if (!(hours[i] >= 0.0f && hours[i] <= 1.0f))
      return builder.fail(
          error_at(node.where_of("hours"), "noiseSource: {:g}; expected fractions of 0 to 1", hours[i]));
    source.hours_share[std::size_t(i)] = double(hours[i]);
  }
  builder.add(std::move(source));
}

}  // namespace

void register_room(Registries& registries) {
  registries.get<scene::NodeRegistry>().add(count_schema(), build_count);
  registries.get<scene::NodeRegistry>().add(source_schema(), build_source);
  add_map_node(registries.get<scene::NodeRegistry>());
}

}  // namespace parvis::noise

#include "planning/noise/road_sources.h"

#include <algorithm>
#include <cmath>

#include "land/roads/road_data.h"
#include "life/propagation/noise_source.h"
#include "life/propagation/tram_emission.h"
#include "life/traffic/demand.h"
#include "life/tram/tram_line.h"
#include "scene/data/name_pattern.h"
#include "scene/data/path.h"

namespace parvis::noise {
namespace {

using propagation::RoadTraffic;

constexpr auto light = std::size_t(propagation::VehicleCategory::light),
               heavy = std::size_t(propagation::VehicleCategory::heavy);

/// Vehicles per hour of each period on each lane, with the traffic's other figures.
struct LaneTraffic {
  std::array<RoadTraffic, periods> by_period;
  std::string surface = "reference";
  bool has_figures = false;
};

double length_of(const scene::Lane& lane) { return double(scene::MeasuredPath(lane.points).length()); }

/// The planned road on whose carriageway a lane's middle lies; null for none.
const scene::Road* road_of(const scene::Scene& scene, const scene::Lane& lane) {
  const scene::MeasuredPath line(lane.points);
  const glm::vec2 middle(line.at(0.5f * line.length()));
  const scene::Road* nearest = nullptr;
  float nearest_m = std::numeric_limits<float>::max();
  for (const scene::PlannedRoad& planned : scene.items<scene::PlannedRoad>()) {
    const scene::Road& road = planned.road;
    const float width_m = road.lane_width_m * float(road.lanes_each_way + road.lanes_against());
    for (std::size_t i = 0; i + 1 < road.path.size(); ++i) {
      const glm::vec2 a(road.path[i]), along = glm::vec2(road.path[i + 1]) - a;
      const float t =
          glm::clamp(glm::dot(middle - a, along) / std::max(glm::dot(along, along), 1e-9f), 0.0f, 1.0f);
      const float away_m = glm::distance(middle, a + t * along);
      if (away_m < nearest_m && away_m < width_m) nearest_m = away_m, nearest = &road;
    }
  }
  return nearest;
}

double gradient_percent(const scene::Lane& lane) {
  const glm::vec3 rise = lane.points.back() - lane.points.front();
  const double run_m = double(glm::length(glm::vec2(rise)));
  return run_m > 1.0 ? 100.0 * double(rise.z) / run_m : 0.0;
}

/// Figures of trafficCount for the lanes of named roads; lanes of one road share its vehicles.
void set_counted(const scene::Scene& scene, std::vector<LaneTraffic>& lanes) {
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    const scene::Lane& lane = scene.roads.lanes[i];
    const scene::Road* road = lane.crossing < 0 ? road_of(scene, lane) : nullptr;
    if (!road) continue;
    for (const TrafficCount& count : scene.items<TrafficCount>()) {
      if (!scene::matches(count.road, road->name)) continue;
      lanes[i].has_figures = true, lanes[i].surface = count.surface;
      const double fraction = 1.0 / double(road->lanes_each_way + road->lanes_against());
      for (std::size_t p = 0; p < periods; ++p) {
        RoadTraffic& traffic = lanes[i].by_period[p];
        traffic.flow_per_h[light] = fraction * count.per_hour[p] * (1.0 - 0.01 * count.heavy_percent[p]);
        traffic.flow_per_h[heavy] = fraction * count.per_hour[p] * 0.01 * count.heavy_percent[p];
        traffic.speed_km_h.fill(count.speed_km_h > 0.0 ? count.speed_km_h : 3.6 * double(lane.speed_limit));
      }
    }
  }
}

/// Flows of the vehicles that `traffic` spreads evenly over its part of the town: density times speed.
void set_driven(const scene::Scene& scene, std::vector<LaneTraffic>& lanes) {
  const scene::DrivingArea& area = scene.data<scene::DrivingArea>();
  const auto is_driven = [&](const scene::Lane& lane) {
    return lane.crossing < 0 && area.contains(glm::vec2(lane.points.front()));
  };
  double length_m = 0.0;
  for (const scene::Lane& lane : scene.roads.lanes)
    if (is_driven(lane)) length_m += length_of(lane);
  if (length_m <= 0.0) return;
  const double per_m = scene.data<traffic::TrafficDemand>().vehicles / length_m;
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    if (!is_driven(scene.roads.lanes[i])) continue;
    lanes[i].has_figures = true;
    for (RoadTraffic& traffic : lanes[i].by_period) {
      traffic.flow_per_h[light] = 3600.0 * per_m * double(scene.roads.lanes[i].speed_limit);
      traffic.speed_km_h.fill(3.6 * double(scene.roads.lanes[i].speed_limit));
    }
  }
}

/// Turning lanes have what comes from the lanes before them, evenly divided.
void set_turning(const scene::Scene& scene, std::vector<LaneTraffic>& lanes) {
  for (std::size_t from = 0; from < lanes.size(); ++from) {
    const scene::Lane& lane = scene.roads.lanes[from];
    if (lane.crossing >= 0 || !lanes[from].has_figures) continue;
    for (const int next : lane.next) {
      if (scene.roads.lanes[std::size_t(next)].crossing < 0) continue;
      LaneTraffic& turning = lanes[std::size_t(next)];
      turning.has_figures = true, turning.surface = lanes[from].surface;
      for (std::size_t p = 0; p < periods; ++p) {
        for (std::size_t c = 0; c < propagation::vehicle_categories; ++c)
          turning.by_period[p].flow_per_h[c] +=
              lanes[from].by_period[p].flow_per_h[c] / double(lane.next.size());
        turning.by_period[p].speed_km_h = lanes[from].by_period[p].speed_km_h;
      }
    }
  }
}

Result<std::vector<LaneTraffic>> traffic_of(const scene::Scene& scene) {
  if (scene.roads.empty())
    return error("the scene has no roads: nothing makes noise; add road(...) or streets(...)");
  std::vector<LaneTraffic> lanes(scene.roads.lanes.size());
  for (std::size_t i = 0; i < lanes.size(); ++i)
    for (RoadTraffic& traffic : lanes[i].by_period) {
      traffic.gradient_percent = gradient_percent(scene.roads.lanes[i]);
      traffic.celsius = 15.0;
    }
  if (!scene.items<TrafficCount>().empty())
    set_counted(scene, lanes);
  else if (scene.data<traffic::TrafficDemand>().vehicles > 0)
    set_driven(scene, lanes);
  else
    return error(
        "the scene's roads have no traffic figures: add trafficCount(per_hour=\"DAY EVENING NIGHT\"), or "
        "traffic(vehicles=)");
  set_turning(scene, lanes);
  if (std::ranges::none_of(lanes, &LaneTraffic::has_figures))
    return error(
        "no road of the scene has a name that its trafficCount nodes give: name the roads, or leave road= "
        "out");
  return lanes;
}

std::vector<PatchPower> power_of_patches(const std::vector<LaneTraffic>& lanes,
                                         std::span<const SourcePatch> patches) {
  std::vector<PatchPower> result(patches.size());
  std::vector<std::array<propagation::Octaves, periods>> per_metre(lanes.size());
  for (std::size_t i = 0; i < lanes.size(); ++i)
    for (std::size_t p = 0; p < periods; ++p)
      per_metre[i][p] = propagation::road_power_db(propagation::road_coefficients_2020,
                                                   surface_named(lanes[i].surface), lanes[i].by_period[p]);
  for (std::size_t i = 0; i < patches.size(); ++i)
    for (std::size_t p = 0; p < periods && patches[i].lane >= 0; ++p)
      for (std::size_t band = 0; band < propagation::octaves; ++band)
        result[i][p][band] =
            propagation::energy(per_metre[std::size_t(patches[i].lane)][p][band]) * patches[i].length_m();
  return result;
}

/// Adds the pieces of a line's track with the mean power of the trams that pass: what one gives off while its
/// middle is on the piece, times the trams per second.
void add_trams(const tram::TramLine& line, double patch_m, RoadSources& sources) {
  if (!line.is_visible || !line.timetable || line.headway_s <= 0.0) return;
  const double length_m = double(line.track.length());
  const auto pieces = std::size_t(std::max(1.0, std::ceil(length_m / patch_m)));
  std::vector<propagation::Octaves> energies(pieces, propagation::Octaves{});
  constexpr double step_s = 0.1, half_tram_m = 16.0;
  for (double at_s = 0.0; at_s < line.timetable->duration_s(); at_s += step_s) {
    const tram::Moment moment = line.timetable->at(at_s);
    const double middle_m = std::clamp(moment.front_m - half_tram_m, 0.0, length_m - 1e-3);
    const propagation::Octaves power = propagation::tram_power_db(double(moment.speed_m_s));
    for (std::size_t band = 0; band < propagation::octaves; ++band)
      energies[std::size_t(middle_m / length_m * double(pieces))][band] +=
          propagation::energy(power[band]) * step_s / line.headway_s;
  }
  for (std::size_t k = 0; k < pieces; ++k) {
    const auto at = [&](std::size_t piece) {
      return glm::dvec3(line.track.at(float(length_m * double(piece) / double(pieces))));
    };
    const glm::dvec3 a = at(k), b = at(k + 1);
    sources.patches.push_back({.middle = 0.5 * (a + b) + glm::dvec3(0, 0, propagation::tram_source_m),
                               .half = 0.5 * (b - a),
                               .lane = -1,
                               .height_m = propagation::tram_source_m});
    sources.power.push_back({energies[k], energies[k], energies[k]});
  }
  sources.has_trams = true;
}

void add_noise_source(const propagation::NoiseSource& source, double patch_m, RoadSources& sources) {
  const auto pieces = source.pieces(patch_m);
  PatchPower power{};
  for (std::size_t p = 0; p < periods; ++p)
    for (std::size_t band = 0; band < propagation::octaves; ++band)
      power[p][band] =
          source.hours_share[p] * propagation::energy(source.power_db[band]) / double(pieces.size());
  for (const auto& [middle, half] : pieces) {
    sources.patches.push_back({.middle = middle, .half = half, .lane = -1, .height_m = -1.0});
    sources.power.push_back(power);
  }
}

}  // namespace

propagation::RoadSurface surface_named(const std::string& name) {
  // Delegated Directive (EU) 2021/1226, table F-4: NL02, porous asphalt of two layers; NL11, hard elements
  // not in herring-bone.
  if (name == surface_names[1])
    return {.alpha = {{{1.6, 4, 0.3, -3, -4, -6.2, -4.8, -2},
                       {7.3, 2, -0.3, -5.2, -6.1, -6, -4.4, -3.5},
                       {8.3, 2.2, -0.4, -5.2, -6.2, -6.1, -4.5, -3.5}}},
            .beta = {-3, 4.7, 4.7}};
  if (name == surface_names[2])
    return {.alpha = {{{31.4, 19.7, 16.8, 8.4, 7.2, 3.3, 7.8, 9.1},
                       {34, 23.6, 19.8, 10.5, 11.7, 8.2, 12.2, 10},
                       {33.8, 24.7, 20.4, 10.9, 10.9, 6.8, 12, 10.8}}},
            .beta = {2.9, 2.9, 2.9}};
  return {};
}

Result<RoadSources> road_sources(const scene::Scene& scene, double patch_m) {
  RoadSources others;
  for (const tram::TramLine& line : scene.items<tram::TramLine>()) add_trams(line, patch_m, others);
  for (const propagation::NoiseSource& source : scene.items<propagation::NoiseSource>())
    add_noise_source(source, patch_m, others);
  const Result<std::vector<LaneTraffic>> lanes = traffic_of(scene);
  const bool has_figures =
      !scene.items<TrafficCount>().empty() || scene.data<traffic::TrafficDemand>().vehicles > 0;
  if (!lanes && (has_figures || others.patches.empty())) return lanes.errors();
  if (!lanes) return others;
  RoadSources sources;
  sources.is_driven = scene.items<TrafficCount>().empty();
  for (std::size_t i = 0; i < lanes->size(); ++i) {
    if (!(*lanes)[i].has_figures) {
      sources.lanes_without_figures += scene.roads.lanes[i].crossing < 0 ? 1 : 0;
      continue;
    }
    const scene::MeasuredPath line(scene.roads.lanes[i].points);
    const int pieces = std::max(1, int(std::ceil(double(line.length()) / patch_m)));
    for (int k = 0; k < pieces; ++k) {
      const auto at = [&](float piece) { return glm::dvec3(line.at(line.length() * piece / float(pieces))); };
      const glm::dvec3 a = at(float(k)), b = at(float(k + 1));
      if (glm::distance(a, b) < 0.01) continue;
      SourcePatch patch{.middle = 0.5 * (a + b), .half = 0.5 * (b - a), .lane = int(i)};
      patch.middle.z += patch.height_m;
      sources.patches.push_back(patch);
    }
  }
  sources.power = power_of_patches(*lanes, sources.patches);
  sources.patches.insert(sources.patches.end(), others.patches.begin(), others.patches.end());
  sources.power.insert(sources.power.end(), others.power.begin(), others.power.end());
  sources.has_trams = others.has_trams;
  return sources;
}

std::vector<PatchPower> multiplied(const RoadSources& sources, double factor) {
  std::vector<PatchPower> power = sources.power;
  for (std::size_t i = 0; i < power.size(); ++i)
    if (sources.patches[i].lane >= 0)
      for (propagation::Octaves& energies : power[i])
        for (double& energy : energies) energy *= factor;
  return power;
}

}  // namespace parvis::noise

#include "life/tram/tram_process.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace parvis::tram {

std::vector<TrackPart> crossed_lanes(const scene::MeasuredPath& track, const scene::RoadGraph& roads) {
  constexpr float bridge_m = 3.0f, beside_lane_m = 0.5f, longest_half_m = 12.0f, longest_m = 24.0f;
  std::vector<TrackPart> parts;
  const scene::Path& rails = track.points();
  std::vector<float> along_m(rails.size(), 0.0f);
  for (std::size_t i = 1; i < rails.size(); ++i)
    along_m[i] = along_m[i - 1] + glm::distance(rails[i - 1], rails[i]);
  for (const scene::Lane& lane : roads.lanes)
    for (std::size_t k = 0; k + 1 < lane.points.size(); ++k) {
      const glm::vec3 a = lane.points[k], ab = lane.points[k + 1] - a;
      for (std::size_t i = 0; i + 1 < rails.size(); ++i) {
        const glm::vec3 c = rails[i], cd = rails[i + 1] - c;
        const float across = scene::cross_in_plan(cd, ab);
        if (std::abs(across) < 1e-6f) continue;
        const float on_track = scene::cross_in_plan(a - c, ab) / across,
                    on_lane = scene::cross_in_plan(a - c, cd) / across;
        if (on_track < 0.0f || on_track > 1.0f || on_lane < 0.0f || on_lane > 1.0f ||
            std::abs((c + on_track * cd - a - on_lane * ab).z) > bridge_m)
          continue;
        const float sine = std::abs(across) / (glm::length(glm::vec2(ab)) * glm::length(glm::vec2(cd)));
        const float half_m =
            std::min((0.5f * lane.width_m + beside_lane_m) / std::max(sine, 0.05f), longest_half_m);
        const float at_m = along_m[i] + on_track * glm::length(cd);
        parts.push_back({at_m - half_m, at_m + half_m});
      }
    }
  std::ranges::sort(parts, {}, &TrackPart::from_m);
  std::vector<TrackPart> joined;
  for (const TrackPart& part : parts)
    if (!joined.empty() && part.from_m <= joined.back().to_m && part.to_m - joined.back().from_m < longest_m)
      joined.back().to_m = std::max(joined.back().to_m, part.to_m);
    else
      joined.push_back(part);
  return joined;
}

std::string TramProcess::status() const {
  int trams = 0;
  for (const Running& it : lines_) trams += it.line.trams();
  return trams == 0 ? "" : fmt::format("{} tram{}", trams, trams == 1 ? "" : "s");
}

void TramProcess::begin(scene::Scene& scene, action::SharedByProcesses&) {
  const std::vector<TramLine> lines = std::as_const(scene).items<TramLine>();
  streets_ = std::as_const(scene).data<scene::SharedStreets>().now;
  if (const auto& of_buses = std::as_const(scene).data<scene::SharedStops>().now) stops_ = of_buses;
  for (const TramLine& line : lines) {
    std::map<SectionKind, std::shared_ptr<const scene::Model>> models;
    for (const SectionKind kind : kind_of_section)
      if (!models.contains(kind)) models[kind] = section_model(kind, line.colour);
    lines_.push_back({line, scene.objects.size(), streets_ ? streets_->vehicles.size() : 0});
    if (streets_) {
      streets_->vehicles.resize(streets_->vehicles.size() + std::size_t(line.trams()) * section_count);
      Running& running = lines_.back();
      running.crossings = crossed_lanes(line.track, scene.roads);
      running.first_crossing = streets_->rail_crossings.size();
      constexpr float beside_m = 0.6f;
      for (const TrackPart& part : running.crossings)
        streets_->rail_crossings.push_back(
            {{line.track.at(part.from_m), line.track.at(part.to_m), 0.5f * width_m + beside_m}});
    }
    lines_.back().late_s.assign(std::size_t(line.trams()), 0.0);
    add_stops(lines_.back());
    for (int tram = 0; tram < line.trams(); ++tram)
      for (int section = 0; section < section_count; ++section) {
        scene::Object object;
        object.name = section_name(line.called, tram, section);
        object.model = models[kind_of_section[std::size_t(section)]];
        object.pose = scene::rest_pose(*object.model);
        object.is_dynamic = object.takes_reflection = true;
        object.is_visible = false;
        scene.objects.push_back(std::move(object));
      }
  }
  if (streets_) share();
  if (!stops_->empty()) scene.data<scene::SharedStops>().now = stops_;
  share_stops();
  present(scene, 0.0);
}

void TramProcess::add_stops(Running& running) {
  const TramLine& line = running.line;
  running.first_stop = stops_->size();
  for (std::size_t s = 0; s < line.edges.size(); ++s) {
    const PlatformEdge& edge = line.edges[s];
    scene::TransitStop stop{edge.from, edge.to, edge.away, edge.breadth_m, {}};
    for (const float behind_m : doors_behind_front()) {
      const glm::vec2 on_track(line.track.at(line.timetable->stops()[s].front_m - behind_m));
      const glm::vec2 along = glm::normalize(glm::vec2(edge.to - edge.from)), from(edge.from);
      const float at = glm::dot(on_track - from, along) / glm::distance(glm::vec2(edge.to), from);
      stop.doors.push_back(glm::mix(edge.from, edge.to, std::clamp(at, 0.0f, 1.0f)));
    }
    stops_->push_back(std::move(stop));
  }
}

/// Doors that are to close while people are on the way to them stay open, as long as the next tram is not
/// held up.
void TramProcess::wait_for_people() {
  if (stops_->empty()) return;
  const double time_s = double(steps_) * action::step_s;
  for (Running& it : lines_)
    for (int tram = 0; tram < it.line.trams(); ++tram) {
      double& late_s = it.late_s[std::size_t(tram)];
      if (it.line.since_start_s(tram, time_s) < action::step_s) late_s = 0.0;
      const double run_s = it.line.run_s(tram, time_s, late_s);
      if (run_s < 0.0 || late_s + action::step_s > it.line.spare_s) continue;
      const Moment moment = it.line.timetable->at(run_s);
      if (moment.stop < 0 || (*stops_)[it.first_stop + std::size_t(moment.stop)].boarding == 0) continue;
      if (moment.leaves_in_s <= double(doors_move_s) && moment.leaves_in_s > double(doors_move_s) - 0.1)
        late_s += action::step_s;
    }
  share_stops();
}

void TramProcess::share_stops() {
  const double time_s = double(steps_) * action::step_s;
  for (const Running& it : lines_)
    for (std::size_t s = 0; s < it.line.edges.size(); ++s) (*stops_)[it.first_stop + s].is_open = false;
  for (const Running& it : lines_)
    for (int tram = 0; tram < it.line.trams(); ++tram) {
      const double run_s = it.line.run_s(tram, time_s, it.late_s[std::size_t(tram)]);
      const Moment moment = it.line.timetable->at(run_s);
      if (run_s < 0.0 || moment.stop < 0 || !it.line.is_visible) continue;
      constexpr float wide_open = 0.95f;
      scene::TransitStop& stop = (*stops_)[it.first_stop + std::size_t(moment.stop)];
      stop.is_open = moment.doors > wide_open;
      stop.open_s = float(moment.leaves_in_s) - doors_move_s;
    }
}

/// Writes where the trams are, and the ground that they cover next, for people to see.
void TramProcess::share() {
  constexpr float away_m = 1e6f;  // the height of who is not on the line
  constexpr float warned_s = 4.0f, at_least_m = 3.0f, strip_m = 4.0f, beside_m = 0.4f;
  streets_->kept_clear.clear();
  const double time_s = double(steps_) * action::step_s;
  for (const Running& it : lines_) {
    for (std::size_t c = 0; c < it.crossings.size(); ++c) {
      float& tram_in_s = streets_->rail_crossings[it.first_crossing + c].tram_in_s;
      tram_in_s = std::numeric_limits<float>::max();
      for (int tram = 0; tram < it.line.trams(); ++tram)
        tram_in_s = std::min(tram_in_s, float(it.line.until_s(tram, time_s, it.late_s[std::size_t(tram)],
                                                              it.crossings[c].from_m, it.crossings[c].to_m)));
    }
    for (int tram = 0; tram < it.line.trams(); ++tram) {
      const double run_s = it.line.run_s(tram, time_s, it.late_s[std::size_t(tram)]);
      const Moment moment = it.line.timetable->at(run_s);
      float front_m = float(moment.front_m);
      for (std::size_t section = 0; section < section_count; ++section) {
        scene::StreetTraffic::Vehicle& vehicle =
            streets_->vehicles[it.first_vehicle + std::size_t(tram) * section_count + section];
        const float rear_m = front_m - section_length_m[section];
        const glm::vec3 front = it.line.track.at(front_m), rear = it.line.track.at(rear_m);
        vehicle = {rear, front, 0.5f * width_m, run_s < 0.0 ? away_m : front.z,
                   moment.speed_m_s * glm::normalize(glm::vec2(front - rear))};
        front_m = rear_m;
      }
      if (run_s < 0.0) continue;
      const float clear_m = at_least_m + warned_s * moment.speed_m_s;
      for (float at_m = 0.0f; at_m < clear_m; at_m += strip_m)
        streets_->kept_clear.push_back({it.line.track.at(float(moment.front_m) + at_m),
                                        it.line.track.at(float(moment.front_m) + at_m + strip_m),
                                        0.5f * width_m + beside_m});
    }
  }
}

void TramProcess::present(scene::Scene& scene, double ahead_s) {
  const double time_s = double(steps_) * action::step_s + ahead_s;
  for (const Running& it : lines_)
    for (int tram = 0; tram < it.line.trams(); ++tram) {
      const double run_s = it.line.run_s(tram, time_s, it.late_s[std::size_t(tram)]);
      const Moment moment = it.line.timetable->at(run_s);
      const bool is_left =
          moment.stop >= 0 && it.line.timetable->stops()[std::size_t(moment.stop)].is_on_left;
      const std::array<glm::mat4, section_count> placed = placed_sections(it.line.track, moment.front_m);
      for (std::size_t section = 0; section < placed.size(); ++section) {
        scene::Object& object = scene.objects[it.first_object + std::size_t(tram) * section_count + section];
        object.is_visible = it.line.is_visible && run_s >= 0.0;
        object.world_from_model = placed[section];
        object.pose = section_pose(*object.model, moment.doors, is_left, moment.front_m);
      }
    }
}

}  // namespace parvis::tram

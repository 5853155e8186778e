#include "life/tram/tram_process.h"

#include <fmt/format.h>

#include <map>

namespace parvis::tram {

std::string TramProcess::status() const {
  int trams = 0;
  for (const Running& it : lines_) trams += it.line.trams();
  return trams == 0 ? "" : fmt::format("{} tram{}", trams, trams == 1 ? "" : "s");
}

void TramProcess::begin(scene::Scene& scene, action::SharedByProcesses&) {
  const std::vector<TramLine> lines = std::as_const(scene).items<TramLine>();
  streets_ = std::as_const(scene).data<scene::SharedStreets>().now;
  for (const TramLine& line : lines) {
    std::map<SectionKind, std::shared_ptr<const scene::Model>> models;
    for (const SectionKind kind : kind_of_section)
      if (!models.contains(kind)) models[kind] = section_model(kind, line.colour);
    lines_.push_back({line, scene.objects.size(), streets_ ? streets_->vehicles.size() : 0});
    if (streets_)
      streets_->vehicles.resize(streets_->vehicles.size() + std::size_t(line.trams()) * section_count);
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
  present(scene, 0.0);
}

/// Writes where the trams are, and the ground that they cover next, for people to see.
void TramProcess::share() {
  constexpr float away_m = 1e6f;  // the height of who is not on the line
  constexpr float warned_s = 4.0f, at_least_m = 3.0f, strip_m = 4.0f, beside_m = 0.4f;
  streets_->kept_clear.clear();
  const double time_s = double(steps_) * action::step_s;
  for (const Running& it : lines_)
    for (int tram = 0; tram < it.line.trams(); ++tram) {
      const double run_s = it.line.run_s(tram, time_s);
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

void TramProcess::present(scene::Scene& scene, double ahead_s) {
  const double time_s = double(steps_) * action::step_s + ahead_s;
  for (const Running& it : lines_)
    for (int tram = 0; tram < it.line.trams(); ++tram) {
      const double run_s = it.line.run_s(tram, time_s);
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

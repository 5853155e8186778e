#include "life/tram/tram_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace parvis::tram {

int TramLine::trams() const { return int(std::ceil((timetable->duration_s() + spare_s) / headway_s)); }

double TramLine::since_start_s(int tram, double time_s) const {
  const double round_s = double(trams()) * headway_s;
  const double run = std::fmod(time_s + start_s - double(tram) * headway_s, round_s);
  return run < 0.0 ? run + round_s : run;
}

double TramLine::run_s(int tram, double time_s, double late_s) const {
  const double run = since_start_s(tram, time_s) - late_s;
  return run <= timetable->duration_s() ? run : -1.0;
}

double TramLine::until_s(int tram, double time_s, double late_s, float from_m, float to_m) const {
  const double since = since_start_s(tram, time_s), reaches = timetable->reaches_s(from_m);
  const double next_run_s = double(trams()) * headway_s - since + reaches;
  const double run = since - late_s;
  if (run > timetable->duration_s()) return next_run_s;
  const double front_m = timetable->at(run).front_m;
  if (front_m < double(from_m)) return std::max(reaches - run, 0.0);
  return front_m - double(length_m) <= double(to_m) ? 0.0 : next_run_s;
}

void TramLine::hash(ContentHash& hash) const {
  hash.add_text(called);
  for (const glm::vec3 point : track.points()) hash.add(point);
  hash.add(headway_s), hash.add(start_s), hash.add(colour), hash.add(is_visible);
  if (timetable)
    for (const Stop& stop : timetable->stops())
      hash.add(stop.front_m), hash.add(stop.dwell_s), hash.add(stop.is_on_left);
}

double min_headway_s(const Timetable& timetable) {
  constexpr double clear_m = double(length_m) + 4.0, step_s = 0.5;
  double headway_s = 1.0;
  // Whoever is at a place then must have been a tram's length behind it a headway before.
  for (double t = 0.0; t < timetable.duration_s(); t += step_s) {
    const double front = timetable.at(t).front_m;
    while (t - headway_s >= 0.0 && front - timetable.at(t - headway_s).front_m < clear_m) headway_s += 1.0;
  }
  return headway_s;
}

std::string section_name(const std::string& line, int tram, int section) {
  return section == 0 ? fmt::format("{} {}", line, tram + 1)
                      : fmt::format("{} {} section {}", line, tram + 1, section + 1);
}

}  // namespace parvis::tram

#include "life/tram/tram_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace parvis::tram {

int TramLine::trams() const { return int(std::ceil(timetable->duration_s() / headway_s)); }

double TramLine::run_s(int tram, double time_s) const {
  const double round_s = double(trams()) * headway_s;
  double run = std::fmod(time_s + start_s - double(tram) * headway_s, round_s);
  if (run < 0.0) run += round_s;
  return run <= timetable->duration_s() ? run : -1.0;
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

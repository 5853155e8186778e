// A tram line of a scene: its track, timetable and trams.
#pragma once

#include <memory>
#include <string>

#include "life/tram/timetable.h"
#include "life/tram/track.h"
#include "life/tram/tram_body.h"
#include "scene/data/room_data.h"

namespace parvis::tram {

inline constexpr int max_trams = 24;  ///< on one line at a time

/// The line that a node `tram` makes; trams follow each other at the headway, from one end of the track to
/// the other.
struct TramLine {
  static constexpr std::string_view name = "tram.line";
  static constexpr scene::DataRole role =
      scene::DataRole::settings;  // pictures show its trams, which are objects
  std::string called;             ///< its trams are "CALLED 1", "CALLED 2", ...
  scene::MeasuredPath track;      ///< at the height of the rails
  std::shared_ptr<const Timetable> timetable;
  std::vector<PlatformEdge> edges;  ///< of the timetable's stops
  double headway_s = 300.0;
  double spare_s = 0.0;    ///< by which a tram may be late and is not in the way of the next
  double start_s = 0.0;    ///< how long the first tram has run when the scene begins
  glm::vec3 colour{0.6f};  ///< linear
  bool is_visible = true;

  /// How many trams run on it at a time, at most.
  int trams() const;
  /// Seconds of the timetable that a tram, counted from 0, has run at a time of the scene when it is `late_s`
  /// late; negative: it is not on the line.
  double run_s(int tram, double time_s, double late_s = 0.0) const;
  /// Seconds since a tram last began a run, on time.
  double since_start_s(int tram, double time_s) const;
  /// Seconds until the front of a tram so late is at a place of the track, at most those of a round; 0 while
  /// the tram covers the part from there to `to_m`.
  double until_s(int tram, double time_s, double late_s, float from_m, float to_m) const;

  /// Adds what the trams' motion follows from; see SceneData.
  void hash(ContentHash& hash) const;
};

/// The shortest headway at which trams of this timetable never come closer than their length and 4 m, whole
/// seconds.
double min_headway_s(const Timetable& timetable);

/// Name of the object of a section, both counted from 0: the first bears the tram's name.
std::string section_name(const std::string& line, int tram, int section);

}  // namespace parvis::tram

#include "graphics/light/bench/sun_hours_bench.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/parallel.h"
#include "graphics/light/bench/double_tracer.h"
#include "graphics/light/bench/worse.h"
#include "graphics/light/sun_study.h"

namespace parvis::bench {
namespace {

/// A point of a sun study, as it looks for the sun, and the hours that the study found there.
struct StudiedPoint {
  light::SunPoint point;
  float hours;
};

/// Points of a study, by what they lie on.
struct StudiedPoints {
  std::vector<StudiedPoint> cells;    ///< of the plan
  std::vector<StudiedPoint> ground;   ///< vertices of surfaces that lie
  std::vector<StudiedPoint> facades;  ///< vertices of surfaces that stand upright
};

StudiedPoints points_of(const light::SunStudy& study) {
  constexpr float max_rise = 0.3f;  // of a facade's normal
  StudiedPoints points;
  for (const light::GroundCell& cell : study.cells)
    if (cell.kind != light::GroundCell::Kind::nothing)
      points.cells.push_back({light::lifted(cell.position, {0, 0, 1}), cell.hours});
  for (std::size_t i = 0; i < study.surfaces.positions.size(); ++i) {
    const bool stands = std::abs(study.surfaces.normals[i].z) < max_rise;
    (stands ? points.facades : points.ground)
        .push_back(
            {light::lifted(study.surfaces.positions[i], study.surfaces.normals[i]), study.surface_hours[i]});
  }
  return points;
}

/// An even choice of at most `count`.
std::vector<StudiedPoint> chosen(const std::vector<StudiedPoint>& all, std::size_t count) {
  const std::size_t wanted = std::min(count, all.size());
  std::vector<StudiedPoint> chosen;
  chosen.reserve(wanted);
  for (std::size_t i = 0; i < wanted; ++i) chosen.push_back(all[i * all.size() / wanted]);
  return chosen;
}

/// Hours of direct sun on one day by the other tracer, a ray at each minute.
std::vector<double> hours_by_minutes(const DoubleTracer& tracer, const std::vector<StudiedPoint>& points,
                                     light::PlaceAndTime when) {
  std::vector<glm::dvec3> suns;
  for (int minute = 0; minute < 24 * 60; ++minute) {
    when.time_of_day_h = (double(minute) + 0.5) / 60.0;
    const light::SolarPosition sun = light::sun_of(when);
    if (sun.elevation_deg() > 0.0) suns.push_back(glm::dvec3(sun.direction()));
  }
  std::vector<double> hours(points.size());
  parallel_for(points.size(), [&](std::size_t i) {
    int lit = 0;
    for (const glm::dvec3& sun : suns)
      lit += glm::dot(sun, glm::dvec3(points[i].point.normal)) > 0.0 &&
             !tracer.is_blocked(glm::dvec3(points[i].point.position), sun, 1e-3, StoppedBy::both);
    hours[i] = double(lit) / 60.0;
  });
  return hours;
}

/// Hours that are off, and all true ones.
struct HoursOff {
  double off = 0.0, all = 0.0;
  std::size_t points = 0;

  void add(const std::vector<StudiedPoint>& studied, const std::vector<double>& truth) {
    points += studied.size();
    for (std::size_t i = 0; i < studied.size(); ++i)
      off += std::abs(double(studied[i].hours) - truth[i]), all += truth[i];
  }
  double mean() const { return all / double(points); }
  double percent() const { return 100.0 * off / all; }
};

}  // namespace

Status measure_sun_hours(const BenchSetup& setup, const scene::Scene& city, Report& report) {
  const scene::Scene twin = opaque_twin(city);
  const DoubleTracer tracer(twin);
  const std::size_t wanted = setup.is_quick ? 400 : 4000;
  double maximum = 0.0, max_of_facades = 0.0, max_hourly = 0.0, max_hourly_of_facades = 0.0;
  for (const int day : setup.is_quick ? std::vector{80} : std::vector{80, 172, 355}) {
    light::SunStudyOptions options;
    options.period = {.place = {.day_of_year = day}, .first_day = day, .last_day = day};
    options.area = glm::dvec4(-60.0, -60.0, 60.0, 60.0);
    const auto study = light::study_sun(twin, options);
    if (!study) return study.errors();
    options.period.step_h = 1.0, options.period.bisections = 0;
    const auto hourly = light::study_sun(twin, options);
    if (!hourly) return hourly.errors();
    const StudiedPoints points = points_of(*study), hourly_points = points_of(*hourly);
    HoursOff all, all_hourly, facades, facades_hourly;
    std::string counts;
    for (const auto& [kind, name, share] : {std::tuple{&StudiedPoints::cells, "cells of the plan", 2},
                                            {&StudiedPoints::ground, "vertices of ground and roofs", 4},
                                            {&StudiedPoints::facades, "vertices of facades", 4}}) {
      const std::vector<StudiedPoint> judged = chosen(points.*kind, wanted / std::size_t(share)),
                                      by_hours = chosen(hourly_points.*kind, wanted / std::size_t(share));
      if (judged.empty() || judged.size() != by_hours.size())
        return error("day {}: the study of the city has {} {} to judge, that of hourly rays {}", day,
                     judged.size(), name, by_hours.size());
      const std::vector<double> truth = hours_by_minutes(tracer, judged, options.period.place);
      all.add(judged, truth), all_hourly.add(by_hours, truth);
      if (kind == &StudiedPoints::facades) facades.add(judged, truth), facades_hourly.add(by_hours, truth);
      counts += fmt::format("{}{} {}", counts.empty() ? "" : ", ", judged.size(), name);
    }
    report.note(fmt::format("day {}: {} judged, {:.1f} hours in the mean, {:.1f} on facades", day, counts,
                            all.mean(), facades.mean()));
    if (!(facades.all > 0.0)) return error("day {}: no facade of the city has any sun", day);
    maximum = worse(maximum, all.percent()), max_hourly = worse(max_hourly, all_hourly.percent());
    max_of_facades = worse(max_of_facades, facades.percent());
    max_hourly_of_facades = worse(max_hourly_of_facades, facades_hourly.percent());
  }
  report.add("sun_hours_error_percent", maximum, up_to(1.0));
  report.add_control("sun_hours_error_percent_hourly_rays", max_hourly, up_to(1.0));
  report.add("sun_hours_error_percent_of_facades", max_of_facades, up_to(1.0));
  report.add_control("sun_hours_error_percent_of_facades_hourly_rays", max_hourly_of_facades, up_to(1.0));
  report.note(
      "mean difference over half as many cells of the plan, a quarter vertices of ground and roofs and a "
      "quarter of facades of a study of the paper's city, as a share of the mean hours, against another "
      "tracer's rays at each minute");
  return Done{};
}

}  // namespace parvis::bench

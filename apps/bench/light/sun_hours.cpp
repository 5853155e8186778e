// Hours of direct sun against another tracer's rays at each minute.
#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/parallel.h"
#include "bench/light/exact_sun.h"
#include "bench/parts.h"
#include "graphics/light/test_worse.h"
#include "places/paper_city/street_plan.h"
#include "planning/sun_hours/sun_study.h"

namespace parvis::bench {
namespace {

using light::worse;

/// A point of a sun study, as it looks for the sun, and the hours that the study found there.
struct StudiedPoint {
  sun_hours::SunPoint point;
  float hours;
};

/// Points of a study, by what they lie on.
struct StudiedPoints {
  std::vector<StudiedPoint> cells;    ///< of the plan
  std::vector<StudiedPoint> facades;  ///< vertices of the houses' upright surfaces
  std::vector<StudiedPoint> others;   ///< those of ground, roofs and trees' wood
};

/// The object that holds the houses, alone: what stands upright there, higher than kerbs and bollards, are
/// facades.
scene::Scene houses_of(const scene::Scene& twin) {
  scene::Scene houses = twin;
  std::erase_if(houses.objects, [](const scene::Object& object) { return object.name != "city"; });
  return houses;
}

StudiedPoints points_of(const sun_hours::SunStudy& study, const DoubleTracer& houses) {
  constexpr float max_rise = 0.3f;  // of a facade's normal
  constexpr float min_height_m = 3.0f;
  constexpr double reach_m = 0.03;  // more than points are lifted
  const auto is_of_facade = [&](const sun_hours::SunPoint& point) {
    if (std::abs(point.normal.z) >= max_rise || point.position.z < min_height_m) return false;
    const auto below =
        houses.nearest(glm::dvec3(point.position), -glm::dvec3(point.normal), 0.0, StoppedBy::both);
    return below && below->distance_m < reach_m;
  };
  StudiedPoints points;
  for (const sun_hours::GroundCell& cell : study.cells)
    if (cell.kind != sun_hours::GroundCell::Kind::nothing)
      points.cells.push_back({sun_hours::lifted(cell.position, {0, 0, 1}), cell.hours});
  for (std::size_t i = 0; i < study.surfaces.positions.size(); ++i) {
    const sun_hours::SunPoint point =
        sun_hours::lifted(study.surfaces.positions[i], study.surfaces.normals[i]);
    (is_of_facade(point) ? points.facades : points.others).push_back({point, study.surface_hours[i]});
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

  void add(double hours, double truth) { ++points, off += std::abs(hours - truth), all += truth; }
  void add(const std::vector<StudiedPoint>& studied, const std::vector<double>& truth) {
    for (std::size_t i = 0; i < studied.size(); ++i) add(double(studied[i].hours), truth[i]);
  }
  double mean() const { return all / double(points); }
  double percent() const { return 100.0 * off / all; }
};

sun_hours::SunStudyOptions options_of(int day) {
  constexpr double half_m = 60.0;
  const glm::dvec2 middle(city::main_crossing());
  sun_hours::SunStudyOptions options;
  options.period = {.place = {.day_of_year = day}, .first_day = day, .last_day = day};
  options.area = glm::dvec4(middle - half_m, middle + half_m);
  return options;
}

/// The study whose rays ask once an hour.
sun_hours::SunPeriod hourly(sun_hours::SunPeriod period) {
  period.step_h = 1.0, period.bisections = 0;
  return period;
}

/// Measures the ground below the leaves of crowns, which let some sun through, in the city as it ships. The
/// truth are rays of Parvis's own tracer at each minute: the other one knows no leaves.
void measure_under_trees(const std::vector<int>& days, const scene::Scene& city, Report& report) {
  scene::Scene still = city;
  std::erase_if(still.objects, [](const scene::Object& object) { return object.is_dynamic; });
  const reference::RayScene rays(still);
  const auto is_under_leaves = [&](const sun_hours::SunPoint& point) {
    const auto above = rays.nearest_hit({point.position, {0, 0, 1}, 0.0f, 1e30f});
    return above && above->place->material->alpha_mode != scene::Alpha::opaque;
  };
  double maximum = 0.0, max_hourly = 0.0;
  for (const int day : days) {
    sun_hours::SunStudyOptions options = options_of(day);
    options.cell_m = 1.0, options.has_facades = false;
    const auto study = must(sun_hours::study_sun(still, options));
    std::vector<sun_hours::SunPoint> points;
    std::vector<float> studied;
    for (const sun_hours::GroundCell& cell : study.cells) {
      if (cell.kind != sun_hours::GroundCell::Kind::ground) continue;
      const sun_hours::SunPoint point = sun_hours::lifted(cell.position, {0, 0, 1});
      if (is_under_leaves(point)) points.push_back(point), studied.push_back(cell.hours);
    }
    const std::vector<float> truth = sun_hours::sun_hours_by_minutes(rays, points, options.period),
                             by_hours = sun_hours::sun_hours(rays, points, hourly(options.period));
    HoursOff off, off_hourly;
    for (std::size_t i = 0; i < points.size(); ++i)
      off.add(double(studied[i]), double(truth[i])), off_hourly.add(double(by_hours[i]), double(truth[i]));
    if (!(off.all > 0.0)) fail("day {}: no ground below leaves has any sun", day);
    report.note(fmt::format("day {}: {} cells of ground below leaves, {:.1f} hours in the mean", day,
                            off.points, off.mean()));
    maximum = worse(maximum, off.percent()), max_hourly = worse(max_hourly, off_hourly.percent());
  }
  report.add("sun_hours_error_percent_under_trees", maximum);
  report.add("sun_hours_error_percent_under_trees_hourly_rays", max_hourly);
}

}  // namespace

void measure_sun_hours(const BenchSetup& setup, Report& report) {
  const scene::Scene city = setup.scene(setup.city() / "paper_day.xp");
  const std::vector<int> days = setup.is_quick ? std::vector{80} : std::vector{80, 172, 355};
  const scene::Scene twin = opaque_twin(city);
  const DoubleTracer tracer(twin), houses(houses_of(twin));
  const std::size_t wanted = setup.is_quick ? 400 : 4000;
  double maximum = 0.0, max_of_facades = 0.0, max_hourly = 0.0, max_hourly_of_facades = 0.0;
  for (const int day : days) {
    sun_hours::SunStudyOptions options = options_of(day);
    const auto study = must(sun_hours::study_sun(twin, options));
    options.period = hourly(options.period);
    const auto hourly_study = must(sun_hours::study_sun(twin, options));
    const StudiedPoints points = points_of(study, houses), hourly_points = points_of(hourly_study, houses);
    HoursOff all, all_hourly, facades, facades_hourly;
    std::string counts;
    for (const auto& [kind, name, share] : {std::tuple{&StudiedPoints::cells, "cells of the plan", 2},
                                            {&StudiedPoints::others, "vertices of other surfaces", 4},
                                            {&StudiedPoints::facades, "vertices of facades", 4}}) {
      const std::vector<StudiedPoint> judged = chosen(points.*kind, wanted / std::size_t(share)),
                                      by_hours = chosen(hourly_points.*kind, wanted / std::size_t(share));
      if (judged.empty() || judged.size() != by_hours.size())
        fail("day {}: the study of the city has {} {} to judge, that of hourly rays {}", day, judged.size(),
             name, by_hours.size());
      const std::vector<double> truth = hours_by_minutes(tracer, judged, options.period.place);
      all.add(judged, truth), all_hourly.add(by_hours, truth);
      if (kind == &StudiedPoints::facades) facades.add(judged, truth), facades_hourly.add(by_hours, truth);
      counts += fmt::format("{}{} {}", counts.empty() ? "" : ", ", judged.size(), name);
    }
    report.note(fmt::format("day {}: {} judged, {:.1f} hours in the mean, {:.1f} on facades", day, counts,
                            all.mean(), facades.mean()));
    if (!(facades.all > 0.0)) fail("day {}: no facade of the city has any sun", day);
    maximum = worse(maximum, all.percent()), max_hourly = worse(max_hourly, all_hourly.percent());
    max_of_facades = worse(max_of_facades, facades.percent());
    max_hourly_of_facades = worse(max_hourly_of_facades, facades_hourly.percent());
  }
  report.add("sun_hours_error_percent", maximum);
  report.add("sun_hours_error_percent_hourly_rays", max_hourly);
  report.add("sun_hours_error_percent_of_facades", max_of_facades);
  report.add("sun_hours_error_percent_of_facades_hourly_rays", max_hourly_of_facades);
  measure_under_trees(days, city, report);
}

}  // namespace parvis::bench

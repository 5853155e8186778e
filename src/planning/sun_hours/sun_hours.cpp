#include "planning/sun_hours/sun_hours.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"

namespace parvis::sun_hours {
namespace {

/// One day's suns at equal steps, and finer ones between them, so that points need not ask where the sun
/// stands.
struct Day {
  std::vector<glm::vec3> suns;  ///< every `step_h / 2^bisections`; the coarse steps are every 2^bisections-th
  std::vector<bool> counts;     ///< the sun is high enough
  double fine_h = 0.0;
  int days = 1;  ///< that this one stands for
};

std::vector<Day> days_of(const SunPeriod& period, double step_h, int parts) {
  std::vector<Day> days;
  for (int first = period.first_day; first <= period.last_day; first += period.day_step) {
    const int count = std::min(period.day_step, period.last_day - first + 1);
    light::PlaceAndTime when = period.place;
    when.day_of_year = first + count / 2;
    for (; when.day_of_year > light::days_in_year(when.year); ++when.year)
      when.day_of_year -= light::days_in_year(when.year);
    Day day{.suns = {}, .counts = {}, .fine_h = step_h / parts, .days = count};
    const light::DaylightHours light = light::daylight_hours(when);
    if (light.is_polar_night()) {
      days.push_back(day);
      continue;
    }
    const double from = light.begin_h(), to = light.end_h();
    const int steps = std::max(1, int(std::ceil((to - from) / step_h)));
    day.fine_h = (to - from) / (steps * parts);
    for (int i = 0; i <= steps * parts; ++i) {
      when.time_of_day_h = from + i * day.fine_h;
      const light::SolarPosition sun = light::sun_of(when);
      day.suns.push_back(glm::vec3(sun.direction()));
      day.counts.push_back(sun.elevation_deg() >= period.min_elevation_deg);
    }
    days.push_back(std::move(day));
  }
  return days;
}

bool is_sunlit(const reference::RayScene& scene, const SunPoint& point, const Day& day, int i) {
  const glm::vec3 to_sun = day.suns[std::size_t(i)];
  if (!day.counts[std::size_t(i)] || glm::dot(to_sun, point.normal) <= 0.0f) return false;
  reference::Passage passage{Random(std::uint64_t(i))};  // everything casts a shadow, from both sides
  return !scene.is_blocked({point.position, to_sun, 1e-3f, 1e30f}, passage);
}

/// The step after which the answer is no longer that at `from`; at `to` it is another.
double change_between(const reference::RayScene& scene, const SunPoint& point, const Day& day, int from,
                      int to, bool lit_from) {
  while (to - from > 1) {
    const int middle = (from + to) / 2;
    (is_sunlit(scene, point, day, middle) == lit_from ? from : to) = middle;
  }
  return 0.5 * (from + to);
}

double hours_of_day(const reference::RayScene& scene, const SunPoint& point, const Day& day, int parts) {
  double fine_steps = 0.0;
  bool was_lit = !day.suns.empty() && is_sunlit(scene, point, day, 0);
  for (int i = parts; i < int(day.suns.size()); i += parts) {
    const bool is_lit = is_sunlit(scene, point, day, i);
    if (is_lit == was_lit) {
      fine_steps += is_lit ? parts : 0;
    } else {
      const double change = change_between(scene, point, day, i - parts, i, was_lit);
      fine_steps += was_lit ? change - (i - parts) : i - change;
    }
    was_lit = is_lit;
  }
  return fine_steps * day.fine_h;
}

std::vector<float> hours(const reference::RayScene& scene, const std::vector<SunPoint>& points,
                         const SunPeriod& period, double step_h, int parts) {
  const std::vector<Day> days = days_of(period, step_h, parts);
  const double all_days = period.last_day - period.first_day + 1;
  std::vector<float> result(points.size());
  parallel_for(
      points.size(),
      [&](std::size_t i) {
        double sum = 0.0;
        for (const Day& day : days) sum += day.days * hours_of_day(scene, points[i], day, parts);
        result[i] = float(sum / all_days);
      },
      64);
  return result;
}

}  // namespace

std::vector<float> sun_hours(const reference::RayScene& scene, const std::vector<SunPoint>& points,
                             const SunPeriod& period) {
  return hours(scene, points, period, period.step_h, 1 << period.bisections);
}

std::vector<float> sun_hours_by_minutes(const reference::RayScene& scene, const std::vector<SunPoint>& points,
                                        const SunPeriod& period) {
  SunPeriod every_day = period;
  every_day.day_step = 1;
  return hours(scene, points, every_day, 1.0 / 60.0, 1);
}

}  // namespace parvis::sun_hours

#include "planning/plan_drawing/sun_difference.h"

#include <algorithm>

#include "planning/sun_hours/sun_study.h"

namespace parvis::plan_drawing {
namespace {

/// The scene without dynamic geometry.
scene::Scene at_rest(scene::Scene scene) {
  for (scene::Object& object : scene.objects) object.is_visible = object.is_visible && !object.is_dynamic;
  return scene;
}

std::vector<float> hours_on(const scene::Scene& scene, const std::vector<sun_hours::SunPoint>& points,
                            const sun_hours::SunPeriod& period) {
  const scene::Scene still = at_rest(scene);
  const reference::RayScene rays(still);
  return sun_hours::sun_hours(rays, points, period);
}

}  // namespace

double SunDifference::area_m2() const {
  return double(std::ranges::count(is_ground, std::uint8_t(1))) * cell_m * cell_m;
}

double SunDifference::mean_hours(const std::vector<float>& hours) const {
  double sum = 0.0;
  for (const float each : hours) sum += double(each);
  const auto count = double(std::ranges::count(is_ground, std::uint8_t(1)));
  return count > 0.0 ? sum / count : 0.0;
}

double SunDifference::area_with_m2(const std::vector<float>& hours, double at_least_h) const {
  std::size_t count = 0;
  for (std::size_t i = 0; i < hours.size(); ++i)
    count += is_ground[i] && double(hours[i]) >= at_least_h ? 1 : 0;
  return double(count) * cell_m * cell_m;
}

double SunDifference::area_changed_m2(double by_h) const {
  std::size_t count = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const double change = double(after[i]) - double(before[i]);
    count += is_ground[i] && (by_h < 0.0 ? change <= by_h : change >= by_h) ? 1 : 0;
  }
  return double(count) * cell_m * cell_m;
}

Result<SunDifference> sun_difference(const scene::Scene& bare, const scene::Scene& before,
                                     const scene::Scene& after, const sun_hours::SunPeriod& period,
                                     const glm::dvec4& area, double cell_m) {
  const sun_hours::SunStudyOptions options{
      .period = period, .cell_m = cell_m, .area = area, .has_facades = false, .judged = {}, .processes = {}};
  const Result<sun_hours::SunStudy> study = sun_hours::study_sun(at_rest(bare), options);
  if (!study) return study.errors();
  SunDifference made;
  made.columns = study->columns, made.rows = study->rows, made.corner = study->corner;
  made.cell_m = study->cell_m, made.max_hours = study->max_hours;
  std::vector<sun_hours::SunPoint> points;
  for (const sun_hours::GroundCell& cell : study->cells) {
    const bool is_ground = cell.kind == sun_hours::GroundCell::Kind::ground;
    made.is_ground.push_back(is_ground ? 1 : 0);
    if (is_ground) points.push_back({cell.position + glm::vec3(0.0f, 0.0f, sun_above_ground_m), {0, 0, 1}});
  }
  if (points.empty()) return error("there is no ground in the area about what the designs change");
  for (const auto& [scene, hours] : {std::pair(&before, &made.before), std::pair(&after, &made.after)}) {
    const std::vector<float> found = hours_on(*scene, points, period);
    std::size_t next = 0;
    for (const std::uint8_t is_ground : made.is_ground) hours->push_back(is_ground ? found[next++] : 0.0f);
  }
  return made;
}

}  // namespace parvis::plan_drawing

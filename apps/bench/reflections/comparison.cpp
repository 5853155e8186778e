#include "bench/reflections/comparison.h"

#include <algorithm>
#include <numeric>

#include "graphics/shading/tone_curve.h"

namespace parvis::bench {
namespace {

constexpr float crossing_reach_m = 15.0f;

/// Lanes end at crossings.
bool is_at_crossing(const scene::Scene& scene, glm::vec3 at) {
  return std::ranges::any_of(scene.roads.lanes, [&](const scene::Lane& lane) {
    return glm::distance(lane.points.front(), at) < crossing_reach_m ||
           glm::distance(lane.points.back(), at) < crossing_reach_m;
  });
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / double(std::max<std::size_t>(values.size(), 1));
}

/// Judges the pictures of all methods in one view.
void judge(stage::Stage& stage, const std::vector<JudgedMethod>& judged, const NearView& view,
           const Comparison& comparison, Compared& compared) {
  const glm::ivec2 size = comparison.size;
  std::vector<Image8> pictures;
  for (const JudgedMethod& method : judged)
    pictures.push_back(picture_of(stage, method, view.camera, size, view.window));
  const reference::TracedPicture truth =
      stage.trace(view.camera, size.x, size.y, comparison.samples_per_pixel, view.window);
  const Image8 expected = shading::tone_mapped_picture(truth.radiance, stage.scene().exposure);
  for (std::size_t m = 0; m < judged.size(); ++m)
    compared.methods[m].flip.push_back(flip_between(pictures[m], expected, truth.mirror_mask));
}

void time(stage::Stage& stage, const std::vector<JudgedMethod>& judged, const NearView& view,
          const Comparison& comparison, Compared& compared) {
  const auto costs = reflection_costs(stage, judged, view.camera, full_picture,
                                      {.repeats = comparison.repeats, .step_s = comparison.step_s});
  for (std::size_t m = 0; m < judged.size(); ++m) {
    compared.methods[m].ms.push_back(median(costs[m].ms).value);
    if (judged[m].name == "rerendered")
      compared.seen.push_back(std::max(judged[m].reflections->faces_drawn(), 1) / 6.0);
  }
}

}  // namespace

const Compared::Method& Compared::method(const std::string& name) const {
  if (name == "best") {
    const Method &full = method("rerendered"), &lod = method("rerendered_lod");
    return median(lod.ms).value < median(full.ms).value ? lod : full;
  }
  const auto found = std::ranges::find(methods, name, &Method::name);
  if (found == methods.end()) fail("no method \"{}\" is compared", name);
  return *found;
}

double Compared::value(const MethodRow& row) const {
  const Method& of = method(row.method);
  const bool is_ratio = *row.over != '\0';
  if (row.measure == Measure::cost)
    return is_ratio ? ratio_in_turn(of.ms, method(row.over).ms).value : median(of.ms).value;
  if (row.measure == Measure::flip) return mean(of.flip) / (is_ratio ? mean(method(row.over).flip) : 1.0);
  double worst = 0.0;
  for (std::size_t v = 0; v < of.flip.size(); ++v)
    worst = std::max(worst, of.flip[v] / method(row.over).flip[v]);
  return worst;
}

void Compared::report(std::span<const MethodRow> rows, Report& report) const {
  const auto list = [](const std::vector<double>& values, int digits) {
    std::string text;
    for (const double value : values) text += fmt::format(" {:.{}f}", value, digits);
    return text;
  };
  for (const Method& method : methods) {
    if (!method.flip.empty())
      report.note(
          fmt::format("FLIP {}: mean {:.4f}, views{}", method.name, mean(method.flip), list(method.flip, 3)));
    if (!method.ms.empty()) report.note(fmt::format("{} ms:{}", method.name, list(method.ms, 1)));
  }
  for (const MethodRow& row : rows) {
    if (std::string(row.over) == "best")
      report.note(fmt::format("{}: the baseline is {}", row.key, method("best").name));
    report.add(row.key, value(row));
  }
}

Compared compared(stage::Stage& stage, const Comparison& comparison) {
  const std::vector<JudgedMethod> judged = judged_methods(stage, comparison.methods);
  const bool is_judged = comparison.size.x > 0;
  const glm::ivec2 size = is_judged ? comparison.size : full_picture;
  NearViews views(stage, size, comparison.wish);
  Compared result;
  for (const JudgedMethod& method : judged) result.methods.push_back({method.name, {}, {}});
  for (int v = 0; v < comparison.views; ++v) {
    const NearView view = views.next();
    result.is_at_crossing.push_back(is_at_crossing(stage.scene(), view.car));
    if (is_judged) judge(stage, judged, view, comparison, result);
    if (comparison.also) comparison.also(view, judged);
    if (comparison.repeats > 0) time(stage, judged, view, comparison, result);
  }
  return result;
}

}  // namespace parvis::bench

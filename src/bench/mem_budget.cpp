#include "bench/mem_budget.h"

#include <algorithm>
#include <cmath>

#include "bench/judged_method.h"

namespace parvis::bench {
namespace {

constexpr double frames_a_second = 30.0;
constexpr int tried_frames = 12;          // with the cheapest reflections and the best, in turn
constexpr int settling_frames = 30;       // until the controller knows the machine
constexpr float least_budget_ms = 1e-3f;  // the cheapest that there is
constexpr double quantile = 0.95;

struct FrameTime {
  double update_ms, rest_ms;
  double whole_ms() const { return update_ms + rest_ms; }
};

/// Draws the frame of now behind a car.
Result<FrameTime> timed_frame(stage::Stage& stage, const JudgedMethod& method, int width, int height) {
  const Result<Camera> camera = stage.camera("follow");
  if (!camera) return camera.errors();
  render::Renderer& renderer = stage.renderer();
  glFinish();
  const double before_ms = milliseconds([&] {
    renderer.begin_frame(stage.scene(), *camera);
    renderer.prepare_main_view(*camera, width, height);
    glFinish();
  });
  const double update_ms = milliseconds([&] {
    method.reflections->update(renderer, stage.scene(), *camera);
    glFinish();
  });
  const double after_ms = milliseconds([&] {
    renderer.draw_main_view();
    glFinish();
  });
  return FrameTime{update_ms, before_ms + after_ms};
}

Result<JudgedMethod> with_budget(stage::Stage& stage, scene::Reflection reflection, float budget_ms) {
  reflection.budget_ms = budget_ms;
  return judged_method(stage, "budget", reflection);
}

/// What whole frames take with the cheapest reflections, and with the best.
Result<std::pair<double, double>> range_of_frames(stage::Stage& stage, const scene::Reflection& reflection,
                                                  int width, int height) {
  const Result<JudgedMethod> cheapest = with_budget(stage, reflection, least_budget_ms),
                             best = with_budget(stage, reflection, 0.0f);
  if (!cheapest) return cheapest.errors();
  if (!best) return best.errors();
  std::vector<double> cheap_ms, dear_ms;
  for (int frame = 0; frame < tried_frames; ++frame)
    for (const auto& [method, samples] : {std::pair{&*cheapest, &cheap_ms}, {&*best, &dear_ms}}) {
      if (Status status = stage.renderer().set_reflection(method->reflections.get()); !status)
        return status.errors();
      for (int turn = 0; turn < 2; ++turn) {  // the first makes what is made once
        const Result<FrameTime> time = timed_frame(stage, *method, width, height);
        if (!time) return time.errors();
        if (turn > 0) samples->push_back(time->whole_ms());
        stage.play().advance(1.0 / frames_a_second);
      }
    }
  return std::pair{median(cheap_ms).value, median(dear_ms).value};
}

}  // namespace

Status measure_budget(stage::Stage& stage, const scene::Reflection& reflection, int seconds, int width,
                      int height, Report& report) {
  const Result<std::pair<double, double>> range = range_of_frames(stage, reflection, width, height);
  if (!range) return range.errors();
  const double budget_ms = 0.5 * (range->first + range->second);
  const Result<JudgedMethod> method = with_budget(stage, reflection, float(budget_ms));
  if (!method) return method.errors();
  if (Status status = stage.renderer().set_reflection(method->reflections.get()); !status) return status;
  std::vector<double> errors_percent;
  const int frames = int(std::lround(seconds * frames_a_second));
  for (int frame = 0; frame < settling_frames + frames; ++frame) {
    const Result<FrameTime> time = timed_frame(stage, *method, width, height);
    if (!time) return time.errors();
    method->reflections->frame_took(time->update_ms, time->rest_ms);
    if (frame >= settling_frames)
      errors_percent.push_back(100.0 * std::abs(time->whole_ms() - budget_ms) / budget_ms);
    stage.play().advance(1.0 / frames_a_second);
  }
  std::ranges::sort(errors_percent);
  report.add("budget_p95_error_percent",
             errors_percent[std::size_t(quantile * double(errors_percent.size() - 1))]);
  report.note(fmt::format(
      "budget {:.1f} ms a frame at {} x {} (cheapest reflections {:.1f}, best {:.1f}), {} frames: "
      "median error {:.1f} %",
      budget_ms, width, height, range->first, range->second, frames,
      errors_percent[errors_percent.size() / 2]));
  return Done{};
}

}  // namespace parvis::bench

#include "bench/environment_rays/frame_budget.h"

#include <algorithm>
#include <cmath>

#include "bench/judged_method.h"
#include "graphics/render/picture_scale.h"
#include "reflections/methods/settings.h"

namespace parvis::bench {
namespace {

constexpr double frames_per_second = 30.0;
constexpr int tried_frames = 12;        // the cheapest and the best, in turn
constexpr int same_frames = 60;         // drawn again as it is, for the clock's own spread
constexpr int settling_frames = 30;     // until the controller knows the machine
constexpr float min_budget_ms = 1e-3f;  // the cheapest that there is
constexpr double quantile = 0.95;

struct FrameTime {
  double update_ms = 0.0, rest_ms = 0.0;
  double whole_ms() const { return update_ms + rest_ms; }
};

/// Draws the frame of now behind a car.
Result<FrameTime> timed_frame(house::Stage& stage, const JudgedMethod& method, glm::ivec2 size) {
  const Result<Camera> camera = stage.camera("follow");
  if (!camera) return camera.errors();
  render::Renderer& renderer = stage.renderer();
  FrameTime time;
  do {
    glFinish();
    const double before_ms = milliseconds([&] {
      renderer.begin_frame(stage.scene(), *camera);
      renderer.prepare_main_view(*camera, size.x, size.y);
      glFinish();
    });
    time.update_ms = milliseconds([&] {
      method.reflections->update(renderer, stage.scene(), *camera);
      glFinish();
    });
    const double after_ms = milliseconds([&] {
      renderer.draw_main_view();
      glFinish();
    });
    time.rest_ms = before_ms + after_ms;
  } while (method.reflections->supply(renderer, stage.scene()));  // it lacked maps: it cost too little
  return time;
}

/// As small as pictures become.
glm::ivec2 min_size(glm::ivec2 size) {
  render::PictureScale scale;
  for (int frame = 0; frame < settling_frames; ++frame) scale.frame_took(1e3, double(min_budget_ms));
  return scale.drawn_size(size.x, size.y);
}

double p95(std::vector<double> samples) {
  std::ranges::sort(samples);
  return samples[std::size_t(quantile * double(samples.size() - 1))];
}

Result<JudgedMethod> with_budget(house::Stage& stage, methods::Settings reflection, float budget_ms) {
  reflection.budget_ms = budget_ms;
  return judged_method(stage, "budget", reflection);
}

/// What whole frames take with the fewest pixels and the cheapest reflections, and with all and the best.
Result<std::pair<double, double>> range_of_frames(house::Stage& stage, const methods::Settings& reflection,
                                                  glm::ivec2 size) {
  const Result<JudgedMethod> cheapest = with_budget(stage, reflection, min_budget_ms),
                             best = with_budget(stage, reflection, 0.0f);
  if (!cheapest) return cheapest.errors();
  if (!best) return best.errors();
  const glm::ivec2 minimum = min_size(size);
  std::vector<double> cheap_ms, expensive_ms;
  for (int frame = 0; frame < tried_frames; ++frame)
    for (const auto& [method, drawn, samples] :
         {std::tuple{&*cheapest, minimum, &cheap_ms}, {&*best, size, &expensive_ms}}) {
      if (Status status = stage.renderer().set_reflection(method->reflections.get()); !status)
        return status.errors();
      for (int turn = 0; turn < 2; ++turn) {  // the first makes what is made once
        const Result<FrameTime> time = timed_frame(stage, *method, drawn);
        if (!time) return time.errors();
        if (turn > 0) samples->push_back(time->whole_ms());
        stage.play().advance(1.0 / frames_per_second);
      }
    }
  return std::pair{median(cheap_ms).value, median(expensive_ms).value};
}

/// By how many percent of their median frames differ that show the same, but for one in twenty.
Result<double> own_spread_percent(house::Stage& stage, const JudgedMethod& method, glm::ivec2 size) {
  std::vector<double> whole_ms;
  for (int frame = 0; frame < same_frames; ++frame) {
    const Result<FrameTime> time = timed_frame(stage, method, size);
    if (!time) return time.errors();
    whole_ms.push_back(time->whole_ms());
  }
  const double middle_ms = median(whole_ms).value;
  for (double& ms : whole_ms) ms = 100.0 * std::abs(ms - middle_ms) / middle_ms;
  return p95(std::move(whole_ms));
}

}  // namespace

Status measure_budget(house::Stage& stage, const methods::Settings& reflection, int seconds, int width,
                      int height, Report& report) {
  const glm::ivec2 size(width, height);
  const Result<std::pair<double, double>> range = range_of_frames(stage, reflection, size);
  if (!range) return range.errors();
  const double budget_ms = 0.5 * (range->first + range->second);
  const Result<JudgedMethod> method = with_budget(stage, reflection, float(budget_ms));
  if (!method) return method.errors();
  if (Status status = stage.renderer().set_reflection(method->reflections.get()); !status) return status;
  render::PictureScale scale;
  std::vector<double> errors_percent;
  const int frames = int(std::lround(seconds * frames_per_second));
  for (int frame = 0; frame < settling_frames + frames; ++frame) {
    const Result<FrameTime> time = timed_frame(stage, *method, scale.drawn_size(width, height));
    if (!time) return time.errors();
    method->reflections->frame_took(time->update_ms, time->rest_ms);
    scale.frame_took(time->whole_ms(), budget_ms);
    if (frame >= settling_frames)
      errors_percent.push_back(100.0 * std::abs(time->whole_ms() - budget_ms) / budget_ms);
    stage.play().advance(1.0 / frames_per_second);
  }
  const Result<double> own = own_spread_percent(stage, *method, scale.drawn_size(width, height));
  if (!own) return own.errors();
  report.add("budget_p95_error_percent", p95(errors_percent));
  report.note(fmt::format(
      "budget {:.1f} ms a frame at {} x {} (the least {:.1f}, the best {:.1f}), {} frames: median error "
      "{:.1f} %; the same frame again is off by {:.1f} % (95 %)",
      budget_ms, width, height, range->first, range->second, frames, median(errors_percent).value, *own));
  return Done{};
}

}  // namespace parvis::bench

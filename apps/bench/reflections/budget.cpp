// How well a method that holds a budget holds it: real frames of a drive behind a car, by the clock.
#include <cmath>

#include "bench/parts.h"
#include "bench/reflections/judged_method.h"
#include "graphics/render/picture_scale.h"

namespace parvis::bench {
namespace {

constexpr double frames_per_second = 30.0;
constexpr int tried_frames = 12;        // the cheapest and the best, in turn
constexpr int same_frames = 60;         // drawn again as it is, for the clock's own spread
constexpr int settling_frames = 30;     // until the controller knows the machine
constexpr float min_budget_ms = 1e-3f;  // the cheapest that there is

struct FrameTime {
  double update_ms = 0.0, rest_ms = 0.0;
  double whole_ms() const { return update_ms + rest_ms; }
};

/// Draws the frame of now behind a car.
FrameTime timed_frame(stage::Stage& stage, const JudgedMethod& method, glm::ivec2 size) {
  const Camera camera = must(stage.camera("follow"));
  render::Renderer& renderer = stage.renderer();
  FrameTime time;
  do {
    time.rest_ms = finished_ms([&] {
      renderer.begin_frame(stage.scene(), camera);
      renderer.prepare_main_view(camera, size.x, size.y);
    });
    time.update_ms = finished_ms([&] { method.reflections->update(renderer, stage.scene(), camera); });
    time.rest_ms += finished_ms([&] { renderer.draw_main_view(); });
  } while (method.reflections->supply(renderer, stage.scene()));  // it lacked maps: it cost too little
  return time;
}

/// The smallest size of pictures.
glm::ivec2 min_size(glm::ivec2 size) {
  render::PictureScale scale;
  for (int frame = 0; frame < settling_frames; ++frame) scale.frame_took(1e3, double(min_budget_ms));
  return scale.drawn_size(size.x, size.y);
}

JudgedMethod with_budget(stage::Stage& stage, float budget_ms) {
  methods::Settings reflection = shipped_maps();
  reflection.budget_ms = budget_ms;
  return judged_methods(stage, {{"budget", reflection}}).front();
}

/// Times of whole frames with the fewest pixels and the cheapest reflections, and with all and the best.
std::pair<double, double> range_of_frames(stage::Stage& stage, glm::ivec2 size) {
  const JudgedMethod cheapest = with_budget(stage, min_budget_ms), best = with_budget(stage, 0.0f);
  std::vector<double> cheap_ms, expensive_ms;
  for (int frame = 0; frame < tried_frames; ++frame)
    for (const auto& [method, drawn, samples] :
         {std::tuple{&cheapest, min_size(size), &cheap_ms}, {&best, size, &expensive_ms}}) {
      must(stage.renderer().set_reflection(method->reflections.get()));
      for (int turn = 0; turn < 2; ++turn) {  // the first makes what is made once
        const FrameTime time = timed_frame(stage, *method, drawn);
        if (turn > 0) samples->push_back(time.whole_ms());
        stage.simulation().advance(1.0 / frames_per_second);
      }
    }
  return {median(cheap_ms).value, median(expensive_ms).value};
}

double off_percent(double ms, double expected_ms) { return 100.0 * std::abs(ms - expected_ms) / expected_ms; }

}  // namespace

void measure_budget(stage::Stage& stage, const BenchSetup& setup, Report& report) {
  const glm::ivec2 size = setup.is_quick ? full_picture / 2 : full_picture;
  const auto [cheapest_ms, best_ms] = range_of_frames(stage, size);
  const double budget_ms = 0.5 * (cheapest_ms + best_ms);
  const JudgedMethod method = with_budget(stage, float(budget_ms));
  must(stage.renderer().set_reflection(method.reflections.get()));
  render::PictureScale scale;
  std::vector<double> errors_percent, same_ms;
  const int frames = int(std::lround((setup.is_quick ? 6 : 60) * frames_per_second));
  for (int frame = 0; frame < settling_frames + frames; ++frame) {
    const FrameTime time = timed_frame(stage, method, scale.drawn_size(size.x, size.y));
    method.reflections->frame_took(time.update_ms, time.rest_ms);
    scale.frame_took(time.whole_ms(), budget_ms);
    if (frame >= settling_frames) errors_percent.push_back(off_percent(time.whole_ms(), budget_ms));
    stage.simulation().advance(1.0 / frames_per_second);
  }
  for (int frame = 0; frame < same_frames; ++frame)
    same_ms.push_back(timed_frame(stage, method, scale.drawn_size(size.x, size.y)).whole_ms());
  const double same = median(same_ms).value;
  for (double& ms : same_ms) ms = off_percent(ms, same);
  report.add("budget_p95_error_percent", percentile(errors_percent, 0.95));
  report.note(
      fmt::format("budget {:.1f} ms per frame (the least {:.1f}, the best {:.1f}); the same frame again is "
                  "off by {:.1f} %",
                  budget_ms, cheapest_ms, best_ms, percentile(same_ms, 0.95)));
}

}  // namespace parvis::bench

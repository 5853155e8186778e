#include "bench/reflection_cost.h"

namespace parvis::bench {
namespace {

constexpr double min_ms = 1e-3;
constexpr int max_lacking = 20;  // turns in which some method lacked surroundings

/// Gives methods the surroundings that the frames timed last were found to lack; false: they lacked none. All
/// are asked, since the frame of now is another one afterwards.
bool supplied(house::Stage& stage, const std::vector<JudgedMethod>& methods) {
  bool is_any = false;
  for (const JudgedMethod& method : methods)
    is_any |= method.reflections->supply(stage.renderer(), stage.scene());
  return is_any;
}

}  // namespace

double finished_ms(const std::function<void()>& work) {
  glFinish();
  return milliseconds([&] {
    work();
    glFinish();
  });
}

Result<std::vector<ReflectionCost>> reflection_costs(house::Stage& stage,
                                                     const std::vector<JudgedMethod>& methods,
                                                     const Camera& camera, int width, int height, int repeats,
                                                     Frames frames, double step_s) {
  std::vector<ReflectionCost> costs(methods.size());
  std::vector<double> passes_ms(methods.size()), cars_ms(methods.size()), pictures_ms(methods.size());
  render::Renderer& renderer = stage.renderer();
  for (int repeat = -1, lacking = 0; repeat < repeats;) {  // the first turn makes what is made once
    if (step_s > 0.0) stage.play().advance(step_s);
    renderer.begin_frame(stage.scene(), camera);
    for (std::size_t turn = 0; turn < methods.size(); ++turn) {
      const std::size_t m = repeat % 2 == 0 ? turn : methods.size() - 1 - turn;
      if (Status status = renderer.set_reflection(methods[m].reflections.get()); !status)
        return status.errors();
      renderer.prepare_main_view(camera, width, height, render::Subjects::moving);
      passes_ms[m] = finished_ms([&] { methods[m].reflections->update(renderer, stage.scene(), camera); });
      cars_ms[m] = finished_ms([&] { renderer.draw_main_view(); });
      if (frames == Frames::left_out) continue;
      renderer.prepare_main_view(camera, width, height);
      const double picture_ms = finished_ms([&] { renderer.draw_main_view(); });
      pictures_ms[m] = passes_ms[m] + picture_ms;
    }
    const bool has_lacked = supplied(stage, methods);
    if (has_lacked && repeat >= 0) {  // what was timed lacked surroundings: it cost too little
      if (++lacking > max_lacking) return error("methods lack surroundings, however often they are supplied");
      continue;
    }
    for (std::size_t m = 0; repeat >= 0 && m < methods.size(); ++m) {
      costs[m].ms.push_back(passes_ms[m] + cars_ms[m] - cars_ms.front());
      if (frames == Frames::whole) costs[m].frame_ms.push_back(pictures_ms[m]);
    }
    ++repeat;
  }
  return costs;
}

Median ratio(const Median& over, const Median& under) {
  return {over.value / std::max(under.value, min_ms), over.low / std::max(under.high, min_ms),
          over.high / std::max(under.low, min_ms)};
}

Median ratio_in_turn(const std::vector<double>& over, const std::vector<double>& under) {
  std::vector<double> ratios;
  ratios.reserve(over.size());
  for (std::size_t i = 0; i < over.size(); ++i) ratios.push_back(over[i] / std::max(under[i], min_ms));
  return median(std::move(ratios));
}

}  // namespace parvis::bench

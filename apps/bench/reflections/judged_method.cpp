#include "bench/reflections/judged_method.h"

#include <algorithm>

#include "reflections/methods/frame.h"
#include "reflections/methods/registry.h"
#include "reflections/reference_maps/scene_maps.h"

namespace parvis::bench {
namespace {

constexpr int max_lacking = 20;  // turns in which some method lacked surroundings

Image8 cut_out(const Image8& picture, const reference::PixelWindow& window) {
  if (window.width == 0) return picture;
  Image8 part(window.width, window.height, picture.channels);
  for (int y = 0; y < window.height; ++y)
    std::copy_n(picture.at(window.x, window.y + y), window.width * picture.channels, part.at(0, y));
  return part;
}

/// Gives methods the surroundings that the frames timed last were found to lack; false: they lacked none. All
/// are asked, since the frame of now is another one afterwards.
bool supplied(stage::Stage& stage, const std::vector<JudgedMethod>& methods) {
  bool is_any = false;
  for (const JudgedMethod& method : methods)
    is_any |= method.reflections->supply(stage.renderer(), stage.scene());
  return is_any;
}

}  // namespace

methods::Settings shipped_maps() { return {.method = "multiple_environment_maps"}; }

methods::Settings usual(const char* method, bool uses_level_of_detail) {
  return {method, 128, uses_level_of_detail};
}

methods::Settings rerendered_baseline(const scene::Scene& scene) {
  methods::Settings baseline = methods::settings(scene);
  baseline.method = "rerendered_cube_map";
  baseline.resolution = 512, baseline.uses_level_of_detail = false;
  return baseline;
}

void keep_maps(scene::Scene scene, const methods::Settings& reflection) {
  methods::settings(scene) = reflection;
  const auto renderer = renderer_of(scene);
  const reference_maps::HeightPyramid heights(reference_maps::heights_of(scene));
  must(reference_maps::keep_maps(scene, heights, *renderer));
}

std::vector<JudgedMethod> judged_methods(stage::Stage& stage, const WantedMethods& wanted) {
  const auto& registry = stage.registries().get<methods::Registry>();
  std::vector<JudgedMethod> made;
  made.reserve(wanted.size());
  for (const auto& [name, reflection] : wanted) {
    scene::Scene scene = stage.scene();  // models are shared
    methods::settings(scene) = reflection;
    const methods::Method* method = must(registry.method_of(scene));
    made.push_back({name, must(registry.make(scene, stage.renderer())), method->needs_earlier_frames});
  }
  return made;
}

void pass_by(stage::Stage& stage, const JudgedMethod& method, const Camera& camera, glm::ivec2 size) {
  render::Renderer& renderer = stage.renderer();
  must(renderer.set_reflection(method.reflections.get()));
  renderer.begin_frame(stage.scene(), camera);
  renderer.prepare_main_view(camera, size.x, size.y);
  method.reflections->update(renderer, stage.scene(), camera);
}

void draw(stage::Stage& stage, const JudgedMethod& method, const Camera& camera, glm::ivec2 size) {
  must(stage.renderer().set_reflection(method.reflections.get()));
  draw_again(stage, method, camera, size);
}

void draw_again(stage::Stage& stage, const JudgedMethod& method, const Camera& camera, glm::ivec2 size) {
  must(methods::draw_frame(stage.renderer(), stage.scene(), method.reflections.get(),
                           {camera, size.x, size.y}));
}

Image8 picture_of(stage::Stage& stage, const JudgedMethod& method, const Camera& camera, glm::ivec2 size,
                  const reference::PixelWindow& window) {
  draw(stage, method, camera, size);
  return cut_out(stage.renderer().read_picture(stage.scene().exposure), window);
}

double finished_ms(const std::function<void()>& work) {
  glFinish();
  return milliseconds([&] {
    work();
    glFinish();
  });
}

std::vector<ReflectionCost> reflection_costs(stage::Stage& stage, const std::vector<JudgedMethod>& methods,
                                             const Camera& camera, glm::ivec2 size, const Timing& timing) {
  std::vector<ReflectionCost> costs(methods.size());
  std::vector<double> passes_ms(methods.size()), cars_ms(methods.size());
  render::Renderer& renderer = stage.renderer();
  for (int repeat = -1, lacking = 0; repeat < timing.repeats;) {  // the first turn makes what is made once
    if (timing.step_s > 0.0) stage.simulation().advance(timing.step_s);
    renderer.begin_frame(stage.scene(), camera);
    for (std::size_t turn = 0; turn < methods.size(); ++turn) {
      const std::size_t m = repeat % 2 == 0 ? turn : methods.size() - 1 - turn;
      must(renderer.set_reflection(methods[m].reflections.get()));
      renderer.prepare_main_view(camera, size.x, size.y, render::Subjects::moving);
      passes_ms[m] = finished_ms([&] { methods[m].reflections->update(renderer, stage.scene(), camera); });
      cars_ms[m] = finished_ms([&] { renderer.draw_main_view(); });
    }
    const bool has_lacked = supplied(stage, methods);
    if (has_lacked && repeat >= 0) {  // what was timed lacked surroundings: it cost too little
      if (++lacking > max_lacking) fail("methods lack surroundings, however often they are supplied");
      continue;
    }
    for (std::size_t m = 0; repeat >= 0 && m < methods.size(); ++m)
      costs[m].ms.push_back(passes_ms[m] + cars_ms[m] - cars_ms.front());
    ++repeat;
  }
  return costs;
}

void report_shown(stage::Stage& stage, const JudgedMethod& timed, const Camera& camera, glm::ivec2 size,
                  const std::string& key, Report& report) {
  const auto others = judged_methods(stage, {{"none", usual("none")}, {"traced", usual("traced")}});
  const Image8 expected = picture_of(stage, others[1], camera, size);
  const auto flip = [&](const JudgedMethod& method) {
    return flip_between(picture_of(stage, method, camera, size), expected);
  };
  const double none = flip(others[0]), of_timed = flip(timed), none_again = flip(others[0]);
  if (none <= 0.0) fail("mirror rays show nothing in this view");
  report.add(key, of_timed / none);
  report.add(key + "_without_reflections", none_again / none);
}

}  // namespace parvis::bench

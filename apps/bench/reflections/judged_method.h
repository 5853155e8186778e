// A method of reflection that is judged, with the maps it has made, and what it costs.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bench/bench.h"
#include "reflections/methods/settings.h"

namespace parvis::bench {

/// The size of the pictures of reflections, unless another is given; `--quick` judges at half.
inline constexpr glm::ivec2 full_picture{1280, 720};
inline constexpr int near_frame_step_ms = 33;  ///< between frames that are timed, as in a film: cars drive on

/// The configuration that ships, which every key speaks of.
methods::Settings shipped_maps();

/// A method by its name, to be compared with it.
methods::Settings usual(const char* method, bool uses_level_of_detail = false);

/// The scene's settings, but by cube maps of 512 pixels per face with centres of their own.
methods::Settings rerendered_baseline(const scene::Scene& scene);

struct JudgedMethod {
  std::string name;
  std::shared_ptr<methods::Reflections> reflections;
  bool shows_earlier_frames = false;  ///< its maps are taken little by little
};

/// Names and settings of methods.
using WantedMethods = std::vector<std::pair<std::string, methods::Settings>>;

/// Draws a scene's reference maps and keeps them beside its file, so that no method need draw them again.
void keep_maps(scene::Scene scene, const methods::Settings& reflection);

/// Makes methods for a stage's scene, in their order; they live no longer than the stage.
std::vector<JudgedMethod> judged_methods(stage::Stage& stage, const WantedMethods& wanted);

/// Draws a frame of the stage by a method.
void draw(stage::Stage& stage, const JudgedMethod& method, const Camera& camera, glm::ivec2 size);

/// A frame by the method that was drawn by last: what is timed.
void draw_again(stage::Stage& stage, const JudgedMethod& method, const Camera& camera, glm::ivec2 size);

/// Lets a method make what it makes for a frame, of which no picture is wanted.
void pass_by(stage::Stage& stage, const JudgedMethod& method, const Camera& camera, glm::ivec2 size);

/// A frame by a method, tone-mapped; a part of it, where a window is given.
Image8 picture_of(stage::Stage& stage, const JudgedMethod& method, const Camera& camera, glm::ivec2 size,
                  const reference::PixelWindow& window = {});

/// The wall clock over `work`, until OpenGL has done all of it, and none that came before it.
double finished_ms(const std::function<void()>& work);

/// Milliseconds of the reflections of one method alone, one sample per repetition: of their passes, and what
/// the pass of the cars takes longer.
struct ReflectionCost {
  std::vector<double> ms;
};

/// How methods are timed.
struct Timing {
  int repeats = 1;                            ///< at least 1
  double step_s = 1e-3 * near_frame_step_ms;  ///< by which the scene plays on before each turn
};

/// Times methods in alternating order, one sample of each per turn, after a turn that is not timed; the first
/// must be the method without reflections, whose cost is nothing. A turn in which a method lacked
/// surroundings (Reflections::supply) is not counted: it is supplied, and the turn is taken again.
std::vector<ReflectionCost> reflection_costs(stage::Stage& stage, const std::vector<JudgedMethod>& methods,
                                             const Camera& camera, glm::ivec2 size, const Timing& timing);

/// FLIP of `timed` against the picture by mirror rays, over that of the picture without reflections: what a
/// cost buys. Reported as `key`, with the picture without reflections, drawn once more, as its control.
void report_shown(stage::Stage& stage, const JudgedMethod& timed, const Camera& camera, glm::ivec2 size,
                  const std::string& key, Report& report);

}  // namespace parvis::bench

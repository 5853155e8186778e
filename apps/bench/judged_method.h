// A method of reflection that a bench judges, with the maps it has made.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "house/stage/stage.h"
#include "reflections/methods/settings.h"

namespace parvis::bench {

struct JudgedMethod {
  std::string name;
  std::shared_ptr<methods::Reflections> reflections;
  bool shows_earlier_frames = false;  ///< its maps are taken little by little
};

/// Draws a scene's reference maps and keeps them beside its file, so that no method need draw them again.
Status keep_maps(const House& house, scene::Scene scene, const methods::Settings& reflection);

/// Makes a method for a stage's scene; it lives no longer than the stage.
Result<JudgedMethod> judged_method(house::Stage& stage, std::string name,
                                   const methods::Settings& reflection);

/// Makes several, each by its name and settings, in their order.
Result<std::vector<JudgedMethod>> judged_methods(
    house::Stage& stage, const std::vector<std::pair<std::string, methods::Settings>>& wanted);

/// Draws a frame of the stage by a method: all of it, or cars alone.
Status draw(house::Stage& stage, const JudgedMethod& method, const Camera& camera, int width, int height,
            render::Subjects subjects = render::Subjects::all);

/// A frame by the method that was drawn by last: what is timed.
Status draw_again(house::Stage& stage, const JudgedMethod& method, const Camera& camera, int width,
                  int height, render::Subjects subjects = render::Subjects::all);

/// Lets a method make what it makes for a frame, of which no picture is wanted.
Status pass_by(house::Stage& stage, const JudgedMethod& method, const Camera& camera, int width, int height);

/// A part of a frame by a method, tone-mapped.
Result<Image8> picture_of(house::Stage& stage, const JudgedMethod& method, const Camera& camera, int width,
                          int height, const reference::PixelWindow& window);

}  // namespace parvis::bench

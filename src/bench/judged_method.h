// A method of reflection that a bench judges, with the maps it has made.
#pragma once

#include <memory>
#include <string>

#include "stage/stage.h"

namespace parvis::bench {

struct JudgedMethod {
  std::string name;
  std::shared_ptr<render::Reflections> reflections;
};

/// Makes a method for a stage's scene; it lives no longer than the stage.
Result<JudgedMethod> judged_method(stage::Stage& stage, std::string name,
                                   const scene::Reflection& reflection);

/// Draws a frame of the stage by a method: all of it, or cars alone.
Status draw(stage::Stage& stage, const JudgedMethod& method, const Camera& camera, int width, int height,
            render::Subjects subjects = render::Subjects::all);

}  // namespace parvis::bench

// The programs of a surface that a room draws by itself: it writes two functions in GLSL, and gets a program
// for every kind of view.
#pragma once

#include "graphics/render/drawable_shader.h"
#include "graphics/render/view.h"

namespace parvis::render {

class ViewPrograms {
 public:
  /// Fails only if a shader does. Programs of mirrored views are linked when one is drawn first.
  static Result<ViewPrograms> create(DrawableShader shader);

  /// Uses the program for a view, with what the view itself binds, and gives it for the room's own uniforms.
  /// Null: the view shows none of what rooms draw by themselves (mirrors).
  const gl::Program* use(const View& view) const;

 private:
  DrawableShader shader_;
  gl::Program many_samples_, one_sample_, depth_, picking_;
};

}  // namespace parvis::render

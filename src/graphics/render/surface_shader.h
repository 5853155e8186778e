// The seam by which rooms above shade surfaces: a fragment shader of theirs in place of render/surface.frag.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "graphics/render/surface_programs.h"

namespace parvis::render {

/// Shades the mirror-like parts of objects that take reflections, in the main view. Implemented by a room
/// above.
class SurfaceShader {
 public:
  virtual ~SurfaceShader() = default;
  /// The source from which it is compiled.
  virtual SurfaceSource source() const = 0;
  /// Binds what the shader needs for one object: textures from `first_unit_above` on, uniforms of `program`.
  virtual void bind(const gl::Program& program, int object) = 0;

 private:
  friend class SceneDrawable;
  std::optional<SurfacePrograms> programs_;  ///< linked when it is first set, for the scene of that renderer
};

}  // namespace parvis::render

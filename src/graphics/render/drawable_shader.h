// The shaders of a surface that a room draws by itself.
#pragma once

#include <string>

#include "graphics/gl/program.h"

namespace parvis::render {

/// The files of a room's shaders, as gl::Program takes them.
struct DrawableShader {
  /// Defines `void surface_vertex()`; see surface_outputs.glsl. Attributes and uniforms are the room's own.
  std::string vertex_path;
  /// Defines `Surface surface_at(...)`; see material_surface.glsl. Texture units 0 to 3 are free, and those
  /// from `first_drawable_unit` on.
  std::string surface_path;
  /// HAS_HOLES: alpha cuts out. HAS_BACKS: it is there when seen from behind. HAS_COAT: it has a clear coat.
  /// IS_RECORDED: it emits what a photograph recorded, and no light of the scene is added.
  /// RECEIVES_INSERTED with it: shadows of what the photographs do not show fall on it; the surface sets
  /// `kept_in_shadow`. And the room's own.
  gl::Defines defines;
};

/// The defines that put a room's files in place of the scene's.
gl::Defines defines_of(const DrawableShader& shader);

}  // namespace parvis::render

// Where mirrored views show vertices. A room above supplies it.
#pragma once

#include <utility>

#include "base/bounds.h"
#include "graphics/render/surface_programs.h"

namespace parvis::render {

class VirtualVertices {
 public:
  virtual ~VirtualVertices() = default;
  /// Binds what the shaders need for the reflector that is drawn now: textures from `first_unit_above` on,
  /// uniforms of `program`.
  virtual void bind(const gl::Program& program) = 0;
  /// May that reflector show any of what lies within these bounds? Else it is left out.
  virtual bool may_show(const Bounds& bounds) const = 0;
  /// The next view shows an item: what its vertices read as attribute 7, two integers.
  virtual glm::ivec2 add(const Item& /*item*/) { return {}; }
  /// All items of the next view have been added, and nothing is drawn yet: here it may draw elsewhere.
  virtual void prepare() {}

  const gl::Program& program_of(const GpuMaterial& material) const { return programs_.of(material, true); }
  /// The program of a surface that a room draws by itself; linked when it is asked for first. Null, with a
  /// message on standard error, where it does not link.
  const gl::Program* program_of(const DrawableShader& shader) { return programs_.of(shader); }

 protected:
  /// Compiled with IS_MIRRORED, for all materials of the scene: a vertex shader that includes SURFACE_VERTEX
  /// and sets `seen_from` of surface_body.glsl, too, and a fragment shader that includes that file and
  /// defines `is_mirrored_here`.
  explicit VirtualVertices(SurfacePrograms programs) : programs_(std::move(programs)) {}

 private:
  SurfacePrograms programs_;
};

}  // namespace parvis::render

// A packed facade in graphics memory.
#pragma once

#include <memory>

#include "base/result.h"
#include "capture/facades/packed_facade.h"
#include "graphics/gl/objects.h"
#include "graphics/gl/program.h"

namespace parvis::facades {

/// Geometry, tables and textures of one facade. Needs a current OpenGL 4.5 context as long as it lives.
class FacadeTextures {
 public:
  /// Fails where the facade has more textures or longer tables than the graphics hardware holds.
  static Result<FacadeTextures> create(const PackedFacade& facade);

  /// Binds all to the units of drawables, and sets the samplers of `program`.
  void bind(const gl::Program& program) const;
  void draw(std::size_t first_triangle, std::size_t triangles) const;
  std::size_t bytes() const { return bytes_; }

 private:
  gl::Buffer corners_;
  gl::VertexArray vertices_;
  gl::Texture photos_, layers_, candidates_, tiles_, depths_, atlas_;
  std::size_t bytes_ = 0;
};

}  // namespace parvis::facades

// A blended model on the GPU.
#pragma once

#include "capture/view_dependent_objects/blended_model.h"
#include "graphics/gl/objects.h"
#include "graphics/gl/program.h"

namespace parvis::view_dependent_objects {

/// Corners, table and pictures. Needs a current OpenGL context from creation to destruction.
class ObjectTextures {
 public:
  /// Errors: more pictures than the driver's texture arrays have layers.
  static Result<ObjectTextures> create(const BlendedModel& model);

  /// Vertices, and textures from `render::first_drawable_unit` on.
  void bind(const gl::Program& program) const;

 private:
  gl::Buffer corners_;
  gl::VertexArray vertices_;
  gl::Texture table_, pictures_;
};

}  // namespace parvis::view_dependent_objects

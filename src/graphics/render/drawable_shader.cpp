#include "graphics/render/drawable_shader.h"

namespace parvis::render {

gl::Defines defines_of(const DrawableShader& shader) {
  gl::Defines defines = shader.defines;
  defines.emplace_back("SURFACE_VERTEX", '"' + shader.vertex_path + '"');
  defines.emplace_back("SURFACE", '"' + shader.surface_path + '"');
  return defines;
}

}  // namespace parvis::render

// The shader files of all rooms, embedded at build.
#pragma once

namespace parvis::gl {

struct ShaderFile {
  const char* path;  ///< below src, as #include names it: "graphics/shading/surface.glsl"
  const char* text;
};

/// Ends with an entry of null pointers.
extern const ShaderFile embedded_shaders[];

}  // namespace parvis::gl

// Textures and the samplers of a program that read them, named once.
#pragma once

#include <epoxy/gl.h>

#include <initializer_list>

#include "graphics/gl/program.h"

namespace parvis::gl {

/// A texture, the unit to which it is bound, and the sampler that reads the unit.
struct SampledTexture {
  const char* sampler;
  GLuint unit;
  GLuint texture;
};

/// Binds textures, and lets the program's samplers read their units. The text of its shaders must declare
/// each (std::logic_error).
inline void bind_textures(const Program& program, std::initializer_list<SampledTexture> textures) {
  for (const SampledTexture& sampled : textures) {
    glBindTextureUnit(sampled.unit, sampled.texture);
    program.set(sampled.sampler, int(sampled.unit));
  }
}

}  // namespace parvis::gl

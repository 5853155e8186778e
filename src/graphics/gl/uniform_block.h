// The buffer of a uniform block that one file declares for shaders and for C++ (UNIFORM_BLOCK of
// shading/glsl.h), so that neither names a value that the other lacks.
#pragma once

#include <type_traits>

#include "graphics/gl/objects.h"
#include "graphics/gl/program.h"

namespace parvis::gl {

/// Values of one uniform block on the GPU. `Values` is the struct that UNIFORM_BLOCK declares in C++.
template <class Values>
class UniformBlock {
  static_assert(std::is_trivially_copyable_v<Values>);

 public:
  /// `name` is the block's in shaders and must outlive this; programs read it at `binding`.
  UniformBlock(const char* name, GLuint binding)
      : name_(name), binding_(binding), buffer_(Buffer::create()) {}

  /// Uploads the values and lets the program read them. A program whose compiler has removed the block is
  /// left as it is.
  void bind(const Program& program, const Values& values) const {
    const struct alignas(16) { Values values; } padded{values};  // as std140 rounds sizes up
    glNamedBufferData(buffer_.name(), sizeof(padded), &padded, GL_STREAM_DRAW);
    glBindBufferBase(GL_UNIFORM_BUFFER, binding_, buffer_.name());
    if (const GLuint index = glGetUniformBlockIndex(program.name(), name_); index != GL_INVALID_INDEX)
      glUniformBlockBinding(program.name(), index, binding_);
  }

 private:
  const char* name_;
  GLuint binding_;
  Buffer buffer_;
};

}  // namespace parvis::gl

// A buffer for what changes with every view: data is appended, and when the store is full the driver gives a
// fresh one, so that nothing waits for what the GPU still reads.
#pragma once

#include <span>

#include "graphics/gl/objects.h"

namespace parvis::render {

class StreamBuffer {
 public:
  explicit StreamBuffer(GLsizeiptr bytes) : size_(bytes), buffer_(gl::Buffer::create()) {
    glNamedBufferData(buffer_.name(), size_, nullptr, GL_STREAM_DRAW);
  }

  /// Returns the offset in bytes, a multiple of `alignment`.
  template <class T>
  GLintptr append(std::span<const T> values, GLsizeiptr alignment) {
    const GLsizeiptr bytes = GLsizeiptr(values.size_bytes());
    cursor_ = (cursor_ + alignment - 1) / alignment * alignment;
    if (cursor_ + bytes > size_) {
      while (bytes > size_) size_ *= 2;
      glNamedBufferData(buffer_.name(), size_, nullptr, GL_STREAM_DRAW);
      cursor_ = 0;
    }
    if (bytes > 0) glNamedBufferSubData(buffer_.name(), cursor_, bytes, values.data());
    const GLintptr offset = cursor_;
    cursor_ += bytes;
    return offset;
  }

  GLuint name() const { return buffer_.name(); }

 private:
  GLsizeiptr size_;
  GLsizeiptr cursor_ = 0;
  gl::Buffer buffer_;
};

}  // namespace parvis::render

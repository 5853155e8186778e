// Move-only owners of OpenGL's objects, named after them. They hold a name and delete it; calls stay OpenGL's
// own (DSA).
#pragma once

#include <epoxy/gl.h>

#include <cstddef>
#include <span>
#include <utility>

namespace parvis::gl {

/// Owns one OpenGL name, which `Traits` makes and deletes.
template <class Traits>
class Owned {
 public:
  Owned() = default;
  template <class... Args>
  static Owned create(Args... args) {
    return Owned(Traits::create(args...));
  }
  Owned(Owned&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
  Owned& operator=(Owned&& other) noexcept {
    std::swap(name_, other.name_);
    return *this;
  }
  ~Owned() {
    if (name_) Traits::destroy(name_);
  }

  GLuint name() const { return name_; }
  explicit operator bool() const { return name_ != 0; }

 private:
  explicit Owned(GLuint name) : name_(name) {}
  GLuint name_ = 0;
};

struct BufferTraits {
  static GLuint create() {
    GLuint n = 0;
    glCreateBuffers(1, &n);
    return n;
  }
  static void destroy(GLuint n) { glDeleteBuffers(1, &n); }
};
struct TextureTraits {
  static GLuint create(GLenum target) {
    GLuint n = 0;
    glCreateTextures(target, 1, &n);
    return n;
  }
  static void destroy(GLuint n) { glDeleteTextures(1, &n); }
};
struct FramebufferTraits {
  static GLuint create() {
    GLuint n = 0;
    glCreateFramebuffers(1, &n);
    return n;
  }
  static void destroy(GLuint n) { glDeleteFramebuffers(1, &n); }
};
struct VertexArrayTraits {
  static GLuint create() {
    GLuint n = 0;
    glCreateVertexArrays(1, &n);
    return n;
  }
  static void destroy(GLuint n) { glDeleteVertexArrays(1, &n); }
};
struct SamplerTraits {
  static GLuint create() {
    GLuint n = 0;
    glCreateSamplers(1, &n);
    return n;
  }
  static void destroy(GLuint n) { glDeleteSamplers(1, &n); }
};

struct QueryTraits {
  static GLuint create(GLenum target) {
    GLuint n = 0;
    glCreateQueries(target, 1, &n);
    return n;
  }
  static void destroy(GLuint n) { glDeleteQueries(1, &n); }
};

using Buffer = Owned<BufferTraits>;
using Texture = Owned<TextureTraits>;
using Framebuffer = Owned<FramebufferTraits>;
using VertexArray = Owned<VertexArrayTraits>;
using Sampler = Owned<SamplerTraits>;
using Query = Owned<QueryTraits>;

/// A buffer of these bytes, whose size never changes; nor do the bytes, but for what `flags` allow.
template <class T>
Buffer immutable_buffer(std::span<const T> values, GLbitfield flags = 0) {
  Buffer buffer = Buffer::create();
  // OpenGL refuses an empty store
  glNamedBufferStorage(buffer.name(), GLsizeiptr(values.empty() ? 1 : values.size_bytes()), values.data(),
                       flags);
  return buffer;
}

/// A flat texture with `levels` of mipmaps, filtered linearly and clamped.
Texture texture_2d(GLenum format, int width, int height, int levels = 1);

}  // namespace parvis::gl

// Move-only owners of OpenGL objects, named after them. They hold a name and delete it; calls stay OpenGL's
// own (direct state access).
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

/// How `Owned` creates and deletes a buffer.
struct BufferTraits {
  /// glCreateBuffers; the buffer has no storage yet.
  static GLuint create() {
    GLuint n = 0;
    glCreateBuffers(1, &n);
    return n;
  }
  static void destroy(GLuint n) { glDeleteBuffers(1, &n); }  ///< commands in flight complete first
};
/// How `Owned` creates and deletes a texture.
struct TextureTraits {
  /// glCreateTextures for a `target` such as GL_TEXTURE_2D; without storage.
  static GLuint create(GLenum target) {
    GLuint n = 0;
    glCreateTextures(target, 1, &n);
    return n;
  }
  static void destroy(GLuint n) { glDeleteTextures(1, &n); }  ///< commands in flight complete first
};
/// How `Owned` creates and deletes a framebuffer.
struct FramebufferTraits {
  /// glCreateFramebuffers; nothing is attached yet.
  static GLuint create() {
    GLuint n = 0;
    glCreateFramebuffers(1, &n);
    return n;
  }
  static void destroy(GLuint n) { glDeleteFramebuffers(1, &n); }  ///< commands in flight complete first
};
/// How `Owned` creates and deletes a vertex array.
struct VertexArrayTraits {
  /// glCreateVertexArrays; no attribute is enabled yet.
  static GLuint create() {
    GLuint n = 0;
    glCreateVertexArrays(1, &n);
    return n;
  }
  static void destroy(GLuint n) { glDeleteVertexArrays(1, &n); }  ///< commands in flight complete first
};
/// How `Owned` creates and deletes a sampler.
struct SamplerTraits {
  /// glCreateSamplers, with OpenGL's default filters and wrapping.
  static GLuint create() {
    GLuint n = 0;
    glCreateSamplers(1, &n);
    return n;
  }
  static void destroy(GLuint n) { glDeleteSamplers(1, &n); }  ///< commands in flight complete first
};

/// How `Owned` creates and deletes a query.
struct QueryTraits {
  /// glCreateQueries for a `target` such as GL_TIME_ELAPSED.
  static GLuint create(GLenum target) {
    GLuint n = 0;
    glCreateQueries(target, 1, &n);
    return n;
  }
  static void destroy(GLuint n) { glDeleteQueries(1, &n); }  ///< commands in flight complete first
};

using Buffer = Owned<BufferTraits>;
using Texture = Owned<TextureTraits>;
using Framebuffer = Owned<FramebufferTraits>;
using VertexArray = Owned<VertexArrayTraits>;
using Sampler = Owned<SamplerTraits>;
using Query = Owned<QueryTraits>;

/// An immutable buffer that holds `values`. `flags` are those of glNamedBufferStorage: without any, neither
/// size nor content can change.
template <class T>
Buffer immutable_buffer(std::span<const T> values, GLbitfield flags = 0) {
  Buffer buffer = Buffer::create();
  // OpenGL refuses an empty store
  glNamedBufferStorage(buffer.name(), GLsizeiptr(values.empty() ? 1 : values.size_bytes()), values.data(),
                       flags);
  return buffer;
}

/// A 2D texture with immutable storage for `levels` mipmap levels, linear filtering, clamped to its edge.
Texture texture_2d(GLenum format, int width, int height, int levels = 1);

}  // namespace parvis::gl

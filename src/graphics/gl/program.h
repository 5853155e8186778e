// Shader programs from the embedded files: each #include is resolved once, defines select permutations, and
// errors name the original file and line. The same files compile as desktop GLSL and as GLSL ES 3.00.
#pragma once

#include <epoxy/gl.h>

#include <functional>
#include <glm/glm.hpp>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/result.h"
#include "graphics/gl/objects.h"

namespace parvis::gl {

/// GLSL version that a shader is compiled as: `#version 450 core`, or `#version 300 es` (WebGL 2).
enum class Dialect { desktop_450, es_300 };

/// Names and values of preprocessor macros, in the order in which they are defined.
using Defines = std::vector<std::pair<std::string, std::string>>;

/// The text of a shader ready to compile: version, preamble, defines, and `path` with its includes in place.
/// `#include NAME "default.glsl"` includes the file that the define NAME has as its value, in quotes, where
/// it is defined: so one shader serves surfaces of several rooms. An include that names no file and a `path`
/// that is none are errors. `files` receives the names that #line numbers stand for.
/// The files of `includes` come before `path`, as if its first lines included them.
Result<std::string> shader_text(const std::string& path, const Defines& defines, Dialect dialect,
                                std::vector<std::string>& files, std::span<const std::string> includes = {});

/// Compiles one stage in the current context; the errors name file and line.
Result<GLuint> compile_shader(GLenum stage, const std::string& path, const Defines& defines, Dialect dialect,
                              std::span<const std::string> includes = {});

/// A uniform that a shader's text declares outside blocks: `uniform mat4 world_from_object;`.
struct DeclaredUniform {
  std::string name;
  std::string type;  ///< as GLSL writes it: "mat4", "sampler2DArray"; of an array that of its elements
};

/// The uniforms that `text` declares outside blocks, in order, in all branches of its preprocessor.
std::vector<DeclaredUniform> declared_uniforms(std::string_view text);

/// A linked program of a vertex and a fragment shader; owns its OpenGL name.
class Program {
 public:
  Program() = default;
  /// Links a vertex and a fragment shader ("graphics/render/surface.vert"), the latter with further includes.
  static Result<Program> create(const std::string& vertex_path, const std::string& fragment_path,
                                const Defines& defines = {},
                                std::span<const std::string> fragment_includes = {});
  /// Takes over the OpenGL name; `other` is empty afterwards.
  Program(Program&& other) noexcept
      : name_(std::exchange(other.name_, 0)), uniforms_(std::move(other.uniforms_)) {}
  Program& operator=(Program&& other) noexcept {
    std::swap(name_, other.name_);
    std::swap(uniforms_, other.uniforms_);
    return *this;
  }
  ~Program();

  /// Makes it the current program (glUseProgram).
  void use() const { glUseProgram(name_); }
  /// OpenGL's name of the program; 0 if it is empty.
  GLuint name() const { return name_; }

  /// True if the text of one of its shaders declares that uniform, in whichever branch.
  bool declares(std::string_view uniform) const { return uniforms_.contains(uniform); }

  // Uniforms by name, elements of arrays as "name[3]"; the program need not be current. The text of its
  // shaders must declare that name with that type (std::logic_error), in whichever branch; a uniform that the
  // compiler has removed is ignored.
  void set(const char* uniform, int value) const;               ///< int, bool, or sampler (texture unit)
  void set(const char* uniform, float value) const;             ///< float
  void set(const char* uniform, glm::vec2 value) const;         ///< vec2
  void set(const char* uniform, glm::vec3 value) const;         ///< vec3
  void set(const char* uniform, glm::vec4 value) const;         ///< vec4
  void set(const char* uniform, const glm::mat4& value) const;  ///< mat4, column-major
  void set(const char* uniform, std::span<const glm::vec3> values) const;  ///< vec3[]; at least one value
  void set(const char* uniform, std::span<const glm::mat4> values) const;  ///< mat4[]; at least one value

 private:
  struct Uniform {
    std::string type;
    GLint location = -1;  // -1: the compiler has removed it
  };

  explicit Program(GLuint name) : name_(name) {}
  GLint location(const char* uniform, std::string_view type) const;
  GLuint name_ = 0;
  std::map<std::string, Uniform, std::less<>> uniforms_;  // by name
};

}  // namespace parvis::gl

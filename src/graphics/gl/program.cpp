#include "graphics/gl/program.h"

#include <algorithm>
#include <cctype>
#include <glm/gtc/type_ptr.hpp>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>
#include <stdexcept>

#include "graphics/gl/shader_files.h"

namespace parvis::gl {
namespace {

const char* embedded_text(const std::string& path) {
  for (const ShaderFile* file = embedded_shaders; file->path; ++file)
    if (path == file->path) return file->text;
  return nullptr;
}

/// Texts put together: each file once, with #line directives that carry the file's place in `files`.
/// `#include NAME "file"` includes the file that the define NAME names, in quotes; without it, this one.
struct Assembly {
  std::vector<std::string>& files;
  const Defines& defines;
  std::set<std::string> seen{};
  std::string text{};

  Status add(const std::string& path) {
    if (!seen.insert(path).second) return Ok{};
    const char* body = embedded_text(path);
    if (!body) return error("{}: no such shader file is embedded", path);
    const std::size_t number = files.size();
    files.push_back(path);
    text += fmt::format("#line 1 {}\n", number);

    std::istringstream lines(body);
    static const std::regex include(R"re(^\s*#\s*include\s+(?:(\w+)\s+)?"([^"]+)")re");
    int line_number = 0;
    for (std::string line; std::getline(lines, line);) {
      ++line_number;
      std::smatch match;
      if (line.find('#') == std::string::npos || !std::regex_search(line, match, include)) {
        text += line + "\n";
        continue;
      }
      if (Status status = add(included(match[1], match[2])); !status) {
        Errors errors = status.errors();
        if (errors.front().where.file.empty()) errors.front().where = {path, line_number, 0};
        return errors;
      }
      text += fmt::format("#line {} {}\n", line_number + 1, number);
    }
    return Ok{};
  }

  std::string included(const std::string& name, const std::string& file) const {
    for (const auto& [define, value] : defines)
      if (!name.empty() && define == name && value.size() > 2) return value.substr(1, value.size() - 2);
    return file;
  }
};

/// Replaces the "0:12" or "0(12)" of drivers' messages by "file:12".
std::string with_file_names(const std::string& log, const std::vector<std::string>& files) {
  static const std::regex place(R"(\b(\d+)[:(](\d+)\)?)");
  std::string result;
  std::istringstream lines(log);
  for (std::string line; std::getline(lines, line);) {
    std::smatch match;
    if (std::regex_search(line, match, place) && match[1].length() < 4 &&
        std::size_t(std::stoi(match[1])) < files.size())
      line = fmt::format("{}{}:{}{}", match.prefix().str(), files[std::size_t(std::stoi(match[1]))],
                         match[2].str(), match.suffix().str());
    result += line + "\n";
  }
  return result;
}

template <class GetLength, class GetLog>
std::string info_log(GLuint name, GetLength get_length, GetLog get_log) {
  GLint length = 0;
  get_length(name, GL_INFO_LOG_LENGTH, &length);
  std::string log(std::size_t(std::max(length, 1)), '\0');
  get_log(name, length, nullptr, log.data());
  return log.c_str();
}

}  // namespace

Result<std::string> shader_text(const std::string& path, const Defines& defines, Dialect dialect,
                                std::vector<std::string>& files, std::span<const std::string> includes) {
  Assembly assembly{files, defines};
  if (dialect == Dialect::es_300)
    assembly.text =
        "#version 300 es\nprecision highp float;\nprecision highp int;\nprecision highp sampler2D;\n"
        "precision highp sampler2DArray;\nprecision highp sampler3D;\nprecision highp samplerCube;\n"
        "precision highp sampler2DShadow;\nprecision highp sampler2DArrayShadow;\n";
  else
    assembly.text = "#version 450 core\n";
  for (const auto& [name, value] : defines) assembly.text += fmt::format("#define {} {}\n", name, value);
  if (Status status = assembly.add("graphics/shading/glsl.glsl"); !status) return status.errors();
  for (const std::string& include : includes)
    if (Status status = assembly.add(include); !status) return status.errors();
  if (Status status = assembly.add(path); !status) return status.errors();
  return std::move(assembly.text);
}

std::vector<DeclaredUniform> declared_uniforms(std::string_view text) {
  std::string code;  // without comments and directives
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view line = text.substr(at, end - at);
    code += line.substr(0, std::min(line.find("//"), line.find('#')));
    code += '\n';
    at = end + 1;
  }
  // A declaration names its type, after a precision, and one or several uniforms, to its semicolon. A block
  // has a brace before it. Expressions search slowly: they see what begins with the word alone.
  static const std::regex declaration(R"(uniform\s+(?:(?:low|medium|high)p\s+)?(\w+)\s+([^;{}]+);)");
  static const std::regex name(R"(\s*(\w+)\s*(?:\[[^\]]*\])?\s*(?:,|$))");
  std::vector<DeclaredUniform> uniforms;
  for (std::size_t at = code.find("uniform"); at != std::string::npos; at = code.find("uniform", at + 1)) {
    const bool is_word =
        at == 0 || (!std::isalnum(static_cast<unsigned char>(code[at - 1])) && code[at - 1] != '_');
    std::smatch match;
    if (!is_word || !std::regex_search(code.cbegin() + std::ptrdiff_t(at), code.cend(), match, declaration,
                                       std::regex_constants::match_continuous))
      continue;
    const std::string names = match[2];
    for (std::sregex_iterator each(names.begin(), names.end(), name), end; each != end; ++each)
      uniforms.push_back({(*each)[1], match[1]});
  }
  return uniforms;
}

namespace {

Result<GLuint> compile_text(GLenum stage, const std::string& path, const std::string& text,
                            const std::vector<std::string>& files) {
  const GLuint shader = glCreateShader(stage);
  const char* source = text.c_str();
  glShaderSource(shader, 1, &source, nullptr);
  glCompileShader(shader);
  GLint compiled = GL_FALSE;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
  if (compiled) return shader;
  const std::string log = info_log(shader, glGetShaderiv, glGetShaderInfoLog);
  glDeleteShader(shader);
  return error("the shader {} does not compile:\n{}", path, with_file_names(log, files));
}

}  // namespace

Result<GLuint> compile_shader(GLenum stage, const std::string& path, const Defines& defines, Dialect dialect,
                              std::span<const std::string> includes) {
  std::vector<std::string> files;
  const Result<std::string> text = shader_text(path, defines, dialect, files, includes);
  if (!text) return text.errors();
  return compile_text(stage, path, *text, files);
}

Result<Program> Program::create(const std::string& vertex_path, const std::string& fragment_path,
                                const Defines& defines, std::span<const std::string> fragment_includes) {
  struct Stage {
    GLenum stage;
    const std::string& path;
    std::span<const std::string> includes;
  };
  Program program(glCreateProgram());
  std::vector<DeclaredUniform> declared;
  for (const auto& [stage, path, includes] : {Stage{GL_VERTEX_SHADER, vertex_path, {}},
                                              Stage{GL_FRAGMENT_SHADER, fragment_path, fragment_includes}}) {
    std::vector<std::string> files;
    const Result<std::string> text = shader_text(path, defines, Dialect::desktop_450, files, includes);
    if (!text) return text.errors();
    const Result<GLuint> shader = compile_text(stage, path, *text, files);
    if (!shader) return shader.errors();
    glAttachShader(program.name_, *shader);
    glDeleteShader(*shader);  // lives as long as the program
    std::ranges::move(declared_uniforms(*text), std::back_inserter(declared));
  }
  glLinkProgram(program.name_);
  GLint linked = GL_FALSE;
  glGetProgramiv(program.name_, GL_LINK_STATUS, &linked);
  if (!linked)
    return error("{} and {} do not link:\n{}", vertex_path, fragment_path,
                 info_log(program.name_, glGetProgramiv, glGetProgramInfoLog));
  for (const DeclaredUniform& uniform : declared)
    program.uniforms_[uniform.name] = {uniform.type,
                                       glGetUniformLocation(program.name_, uniform.name.c_str())};
  return program;
}

Program::~Program() {
  if (name_) glDeleteProgram(name_);
}

GLint Program::location(const char* uniform, std::string_view type) const {
  const std::string_view name(uniform), array = name.substr(0, name.find('['));
  const auto found = uniforms_.find(array);
  if (found == uniforms_.end())
    throw std::logic_error(fmt::format("no shader of the program declares the uniform {}", uniform));
  const std::string& declared = found->second.type;
  const bool takes_int = declared == "bool" || declared.find("sampler") != std::string::npos;
  if (declared != type && !(type == "int" && takes_int))
    throw std::logic_error(fmt::format("the uniform {} is {}, not {}", uniform, declared, type));
  return name == array ? found->second.location : glGetUniformLocation(name_, uniform);
}

void Program::set(const char* uniform, int value) const {
  glProgramUniform1i(name_, location(uniform, "int"), value);
}
void Program::set(const char* uniform, float value) const {
  glProgramUniform1f(name_, location(uniform, "float"), value);
}
void Program::set(const char* uniform, glm::vec2 value) const {
  glProgramUniform2fv(name_, location(uniform, "vec2"), 1, glm::value_ptr(value));
}
void Program::set(const char* uniform, glm::vec3 value) const {
  glProgramUniform3fv(name_, location(uniform, "vec3"), 1, glm::value_ptr(value));
}
void Program::set(const char* uniform, glm::vec4 value) const {
  glProgramUniform4fv(name_, location(uniform, "vec4"), 1, glm::value_ptr(value));
}
void Program::set(const char* uniform, const glm::mat4& value) const {
  glProgramUniformMatrix4fv(name_, location(uniform, "mat4"), 1, GL_FALSE, glm::value_ptr(value));
}
void Program::set(const char* uniform, std::span<const glm::vec3> values) const {
  glProgramUniform3fv(name_, location(uniform, "vec3"), GLsizei(values.size()),
                      glm::value_ptr(values.front()));
}
void Program::set(const char* uniform, std::span<const glm::mat4> values) const {
  glProgramUniformMatrix4fv(name_, location(uniform, "mat4"), GLsizei(values.size()), GL_FALSE,
                            glm::value_ptr(values.front()));
}

}  // namespace parvis::gl

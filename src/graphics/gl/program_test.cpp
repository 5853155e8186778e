#include "graphics/gl/program.h"

#include <gtest/gtest.h>

#include <string_view>

#include "graphics/gl/shader_files.h"
#include "graphics/gl/test_context.h"

namespace parvis::gl {
namespace {

using std::string_view_literals::operator""sv;

std::size_t count(const std::string& text, const std::string& word) {
  std::size_t found = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++found;
  return found;
}

TEST(ShaderText, HoldsEachIncludedFileOnce) {
  std::vector<std::string> files;
  const Result<std::string> text =
      shader_text("graphics/render/surface.frag", {}, Dialect::desktop_450, files);
  ASSERT_TRUE(text) << to_string(text.errors());
  EXPECT_EQ(count(*text, "uniform Frame"), 1u);
  EXPECT_EQ(text->find("#include"), std::string::npos);
  EXPECT_TRUE(text->starts_with("#version 450 core"));
}

TEST(ShaderText, AFileThatIsNotThereIsNamed) {
  std::vector<std::string> files;
  const Result<std::string> text =
      shader_text("graphics/render/no_such.frag", {}, Dialect::desktop_450, files);
  ASSERT_FALSE(text);
  EXPECT_NE(to_string(text.errors()).find("graphics/render/no_such.frag"), std::string::npos);
}

class ProgramTest : public ContextTest {};

TEST_F(ProgramTest, AnErrorNamesTheFileAndTheLine) {
  // The define breaks one line of an included file.
  const Result<GLuint> shader = compile_shader(GL_FRAGMENT_SHADER, "graphics/render/surface.frag",
                                               {{"greatest_radiance", "1.0f 2.0f"}}, Dialect::desktop_450);
  ASSERT_FALSE(shader);
  const std::string message = to_string(shader.errors());
  EXPECT_NE(message.find("graphics/render/surface_body.glsl:"), std::string::npos) << message;
}

/// Multisampled textures are of OpenGL ES 3.10. Before that a blit would bring the samples together: over
/// pictures of virtual objects cleared to alpha 0, with surroundings on outlines.
bool is_for_the_desktop_alone(std::string_view path) {
  return path == "graphics/render/resolve.frag" ||
         path == "reflections/curved_reflectors/virtual_picture.frag";
}

TEST_F(ProgramTest, EveryDisplayShaderCompilesInBothDialects) {
  const Defines all{{"HAS_NORMAL_MAP", ""},    {"HAS_SURFACE_MAP", ""},
                    {"HAS_EMISSION_MAP", ""},  {"HAS_COAT", ""},
                    {"HAS_BACKS", ""},         {"HAS_HOLES", ""},
                    {"IS_LEAF", ""},           {"ANISOTROPY_BY_TAPS", ""},
                    {"HAS_VERTEX_SEARCH", ""}, {"MIDPOINT_ITERATIONS", "9"},
                    {"IS_GLASS", ""},          {"HAS_GLASS_PICTURE", ""},
                    {"HAS_NEAR_PICTURE", ""},  {"HAS_RELIEF", ""},
                    {"ONE_SAMPLE", ""}};
  Defines mirrored = all;  // what a mirror shows, and a mirror in a mirror
  mirrored.emplace_back("IS_MIRRORED", "");
  const auto variants_of = [&](std::string_view path) -> std::vector<Defines> {
    if (path.find("twice_virtual") != path.npos) return {{{"IS_MIRRORED", ""}, {"MIRRORS", "2"}}};
    if (path.find("virtual_") != path.npos || path.find("refracted_") != path.npos)
      return {{{"IS_MIRRORED", ""}}, mirrored};
    return {Defines{}, all};
  };
  for (const ShaderFile* file = embedded_shaders; file->path; ++file) {
    const std::string_view path = file->path;
    if (path.ends_with(".glsl"sv)) continue;
    const GLenum stage = path.ends_with(".vert"sv) ? GL_VERTEX_SHADER : GL_FRAGMENT_SHADER;
    for (const Dialect dialect : {Dialect::desktop_450, Dialect::es_300}) {
      if (dialect == Dialect::es_300 && is_for_the_desktop_alone(path)) continue;
      for (const Defines& defines : variants_of(path)) {
        const Result<GLuint> shader = compile_shader(stage, file->path, defines, dialect);
        ASSERT_TRUE(shader) << path << (dialect == Dialect::es_300 ? " as GLSL ES 3.00: " : ": ")
                            << to_string(shader.errors());
        glDeleteShader(*shader);
      }
    }
  }
}

}  // namespace
}  // namespace parvis::gl

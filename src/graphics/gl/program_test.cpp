#include "graphics/gl/program.h"

#include <gtest/gtest.h>

#include "graphics/gl/test_context.h"

namespace parvis::gl {
namespace {

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
  EXPECT_EQ(count(*text, "UNIFORM_BLOCK(Frame)"), 1u);
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

TEST(DeclaredUniforms, AreAllOutsideBlocks) {
  const std::vector<DeclaredUniform> uniforms = declared_uniforms(
      "uniform mat4 a;  // uniform float commented;\n"
      "UNIFORM_BLOCK(Frame) { vec4 inside; };\n"
      "layout(std140) uniform Block { vec4 inside; } block;\n"
      "uniform vec3 b[16 * COUNT];\n"
      "uniform highp sampler2D\n    c,\n    d;\n");
  ASSERT_EQ(uniforms.size(), 4u);
  const char* expected[][2] = {{"a", "mat4"}, {"b", "vec3"}, {"c", "sampler2D"}, {"d", "sampler2D"}};
  for (std::size_t i = 0; i < uniforms.size(); ++i) {
    EXPECT_EQ(uniforms[i].name, expected[i][0]);
    EXPECT_EQ(uniforms[i].type, expected[i][1]);
  }
}

class ProgramTest : public ContextTest {};

TEST_F(ProgramTest, AnErrorNamesTheFileAndTheLine) {
  // The define breaks one line of an included file.
  const Result<GLuint> shader = compile_shader(GL_FRAGMENT_SHADER, "graphics/render/surface.frag",
                                               {{"max_radiance", "1.0f 2.0f"}}, Dialect::desktop_450);
  ASSERT_FALSE(shader);
  const std::string message = to_string(shader.errors());
  EXPECT_NE(message.find("graphics/render/frame.glsl:"), std::string::npos) << message;
}

TEST_F(ProgramTest, AUniformIsSetByItsNameAndWithItsType) {
  const Result<Program> program =
      Program::create("graphics/render/whole_screen.vert", "graphics/render/display.frag");
  ASSERT_TRUE(program) << to_string(program.errors());
  EXPECT_NO_THROW(program->set("exposure", 2.0f));
  EXPECT_THROW(program->set("exposure", 2), std::logic_error);
  EXPECT_THROW(program->set("exposures", 2.0f), std::logic_error);
}

}  // namespace
}  // namespace parvis::gl

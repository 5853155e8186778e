// Every shader of every room compiles as desktop GLSL and as GLSL ES 3.00.
#include <gtest/gtest.h>

#include <string_view>

#include "graphics/gl/program.h"
#include "graphics/gl/shader_files.h"
#include "graphics/gl/test_context.h"

namespace parvis::rooms {
namespace {

using namespace gl;
using std::string_view_literals::operator""sv;

/// Multisampled textures are of OpenGL ES 3.10. Before that a blit would bring the samples together: over
/// pictures of virtual objects cleared to alpha 0, with surroundings on outlines.
bool is_for_the_desktop_alone(std::string_view path) {
  return path == "graphics/render/resolve.frag" || path == "reflections/reflector_maps/virtual_picture.frag";
}

class DisplayShadersTest : public gl::ContextTest {};

TEST_F(DisplayShadersTest, EveryDisplayShaderCompilesInBothDialects) {
  Defines all{{"HAS_NORMAL_MAP", ""},    {"HAS_SURFACE_MAP", ""},
              {"HAS_EMISSION_MAP", ""},  {"HAS_COAT", ""},
              {"HAS_BACKS", ""},         {"HAS_HOLES", ""},
              {"IS_LEAF", ""},           {"ANISOTROPY_BY_TAPS", ""},
              {"HAS_VERTEX_SEARCH", ""}, {"MIDPOINT_ITERATIONS", "9"},
              {"IS_GLASS", ""},          {"HAS_RELIEF", ""},
              {"ONE_SAMPLE", ""},        {"HAS_RAYS", ""}};
  // With the overlays of surfaces (render::SurfaceSource), which lie over any method.
  const std::vector<std::string> overlays{"reflections/virtual_objects/near_picture.glsl",
                                          "reflections/refraction/glass_picture.glsl"};
  all.emplace_back("REFLECTION_OVERLAY(radiance, roughness)",
                   "with_near_objects(radiance, roughness, surface_mirrors)");
  all.emplace_back("TRANSMISSION_OVERLAY(radiance)", "seen_through_glass(radiance)");
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
        const Result<GLuint> shader =
            compile_shader(stage, file->path, defines, dialect,
                           stage == GL_FRAGMENT_SHADER ? overlays : std::vector<std::string>());
        ASSERT_TRUE(shader) << path << (dialect == Dialect::es_300 ? " as GLSL ES 3.00: " : ": ")
                            << to_string(shader.errors());
        glDeleteShader(*shader);
      }
    }
  }
}

}  // namespace
}  // namespace parvis::rooms

#include "environment_maps/reference_maps.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

#include "base/progress.h"
#include "environment_maps/octahedral.h"
#include "render/cube_map.h"

namespace parvis::environment_maps {
namespace {

constexpr int levels = 4;  // as far as the border reaches
const glm::ivec2 gloss_size(int(gloss_tile_count* gloss_side), int(gloss_side));

gl::Texture layers_of(GLenum format, int level_count, glm::ivec2 size, std::size_t count) {
  gl::Texture texture = gl::Texture::create(GLenum(GL_TEXTURE_2D_ARRAY));
  glTextureStorage3D(texture.name(), level_count, format, size.x, size.y, GLsizei(count));
  glTextureParameteri(texture.name(), GL_TEXTURE_MIN_FILTER,
                      level_count > 1 ? GL_LINEAR_MIPMAP_LINEAR : GL_LINEAR);
  for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
    glTextureParameteri(texture.name(), axis, GL_CLAMP_TO_EDGE);
  return texture;
}

gl::Texture texture_of(const std::vector<glm::vec3>& places) {
  gl::Texture texture = gl::texture_2d(GL_RGB32F, int(places.size()), 1);
  glTextureParameteri(texture.name(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTextureParameteri(texture.name(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glTextureSubImage2D(texture.name(), 0, 0, 0, GLsizei(places.size()), 1, GL_RGB, GL_FLOAT, places.data());
  return texture;
}

/// Draws single layers with a program.
class LayerPainter {
 public:
  LayerPainter() : framebuffer_(gl::Framebuffer::create()), no_attributes_(gl::VertexArray::create()) {}

  void paint(const gl::Program& program, GLuint source, GLuint target, glm::ivec2 size, int layer) const {
    glNamedFramebufferTextureLayer(framebuffer_.name(), GL_COLOR_ATTACHMENT0, target, 0, layer);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    glViewport(0, 0, size.x, size.y);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glDisable(GL_BLEND);
    program.use();
    program.set("layer_size", glm::vec2(float(size.x), float(ReferenceMaps::border)));
    glBindTextureUnit(0, source);
    glBindVertexArray(no_attributes_.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
  }

 private:
  gl::Framebuffer framebuffer_;
  gl::VertexArray no_attributes_;
};

}  // namespace

ReferenceMaps::ReferenceMaps(std::vector<glm::vec3> places, int resolution)
    : places_(std::move(places)),
      resolution_(resolution),
      colours_(layers_of(GL_R11F_G11F_B10F, levels, glm::ivec2(resolution), places_.size())),
      glosses_(layers_of(GL_R11F_G11F_B10F, 1, gloss_size, places_.size())),
      distances_(layers_of(GL_R16F, 1, glm::ivec2(resolution), places_.size())),
      place_texture_(texture_of(places_)) {}

Result<ReferenceMaps> ReferenceMaps::bake(render::Renderer& renderer, std::vector<glm::vec3> places,
                                          int face_resolution) {
  constexpr const char* screen = "render/whole_screen.vert";
  Result<gl::Program> distance = gl::Program::create(screen, "environment_maps/reference_map_distance.frag");
  if (!distance) return distance.errors();
  Result<gl::Program> colour = gl::Program::create(screen, "environment_maps/reference_map_colour.frag");
  if (!colour) return colour.errors();
  Result<gl::Program> gloss = gl::Program::create(screen, "environment_maps/reference_map_gloss.frag");
  if (!gloss) return gloss.errors();
  distance->set("near_far", glm::vec2(render::cube_near_m, render::cube_far_m));

  ReferenceMaps maps(std::move(places), 2 * face_resolution);
  const LayerPainter painter;
  const glm::ivec2 size(maps.resolution_);
  const int drawn_resolution = 2 * face_resolution;  // four texels make one
  render::CubeMap cube(drawn_resolution);
  Progress progress("reference maps", maps.places_.size());
  for (std::size_t i = 0; i < maps.places_.size(); ++i) {
    const glm::vec3 place = maps.places_[i];
    for (int face = 0; face < 6; ++face) {
      cube.draw_face(renderer, face, place, -1, render::Subjects::fixed);
      const glm::mat4 clip_from_world = render::face_view(face, place, drawn_resolution, 0).clip_from_world;
      distance->set("clip_from_direction", glm::translate(clip_from_world, place));
      painter.paint(*distance, cube.depth_texture(), maps.distances_.name(), size, int(i));
    }
    cube.update_levels();
    painter.paint(*colour, cube.texture(), maps.colours_.name(), size, int(i));
    painter.paint(*gloss, cube.texture(), maps.glosses_.name(), gloss_size, int(i));
    progress.advance();
  }
  glGenerateTextureMipmap(maps.colours_.name());
  return maps;
}

std::size_t ReferenceMaps::bytes() const {
  std::size_t bytes = 4 * std::size_t(gloss_size.x) * std::size_t(gloss_size.y);
  for (int level = 0; level < levels; ++level) {
    const std::size_t side = std::size_t(std::max(resolution_ >> level, 1));
    bytes += 4 * side * side + (level == 0 ? 2 * side * side : 0);
  }
  return bytes * places_.size();
}

}  // namespace parvis::environment_maps

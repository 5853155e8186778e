#include "reflections/reference_maps/map_painter.h"

#include <glm/gtc/matrix_transform.hpp>

namespace parvis::reference_maps {

Result<MapPainter> MapPainter::create(int face_resolution) {
  constexpr const char* screen = "graphics/render/whole_screen.vert";
  Result<gl::Program> distance =
      gl::Program::create(screen, "reflections/reference_maps/reference_map_distance.frag");
  if (!distance) return distance.errors();
  Result<gl::Program> colour =
      gl::Program::create(screen, "reflections/reference_maps/reference_map_colour.frag");
  if (!colour) return colour.errors();
  Result<gl::Program> gloss =
      gl::Program::create(screen, "reflections/reference_maps/reference_map_gloss.frag");
  if (!gloss) return gloss.errors();
  distance->set("near_far", glm::vec2(methods::cube_near_m, methods::cube_far_m));
  const int drawn_resolution = 2 * face_resolution;  // four texels make one
  return MapPainter(*std::move(distance), *std::move(colour), *std::move(gloss), drawn_resolution);
}

MapPainter::MapPainter(gl::Program distance, gl::Program colour, gl::Program gloss, int drawn_resolution)
    : distance_(std::move(distance)),
      colour_(std::move(colour)),
      gloss_(std::move(gloss)),
      cube_(drawn_resolution),
      framebuffer_(gl::Framebuffer::create()) {}

void MapPainter::paint_layer(const gl::Program& program, GLuint source, GLuint target, glm::ivec2 size,
                             std::size_t map) const {
  glNamedFramebufferTextureLayer(framebuffer_.name(), GL_COLOR_ATTACHMENT0, target, 0, GLint(map));
  program.set("layer_size", glm::vec2(float(size.x), float(ReferenceMaps::border)));
  screen_.draw(program, framebuffer_.name(), size, source);
}

void MapPainter::paint(render::Renderer& renderer, ReferenceMaps& maps, std::size_t map) {
  for (int face = 0; face < methods::cube_faces; ++face) paint_face(renderer, maps, map, face);
}

void MapPainter::paint_face(render::Renderer& renderer, ReferenceMaps& maps, std::size_t map, int face) {
  const glm::vec3 place = maps.places()[map];
  const glm::ivec2 size(maps.resolution());
  cube_.draw_face(renderer, face, place, -1, render::Subjects::fixed);
  const glm::mat4 clip_from_world = methods::face_view(face, place, cube_.resolution(), 0).clip_from_world;
  distance_.set("clip_from_direction", glm::translate(clip_from_world, place));
  paint_layer(distance_, cube_.depth_texture(), maps.distances(), size, map);
  if (face + 1 < methods::cube_faces) return;
  cube_.update_levels();
  paint_layer(colour_, cube_.texture(), maps.colours(), size, map);
  paint_layer(gloss_, cube_.texture(), maps.glosses(), ReferenceMaps::gloss_size(), map);
}

}  // namespace parvis::reference_maps

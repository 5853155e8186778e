// Draws reference maps: six faces of the fixed scene about a place, brought onto the map's octahedral layers.
#pragma once

#include "graphics/render/whole_screen.h"
#include "reflections/methods/cube_map.h"
#include "reflections/reference_maps/reference_maps.h"

namespace parvis::reference_maps {

class MapPainter {
 public:
  /// Creates a painter of maps that are as sharp as cube maps with faces of `face_resolution`. Fails only if
  /// a shader does.
  static Result<MapPainter> create(int face_resolution);

  /// Draws one of `maps`, without its coarser levels; takes some tenths of a second in a city. The light is
  /// that of the renderer's frame.
  void paint(render::Renderer& renderer, ReferenceMaps& maps, std::size_t map);
  /// The same in six steps, `face` from 0 to 5: nothing else may be painted between them.
  void paint_face(render::Renderer& renderer, ReferenceMaps& maps, std::size_t map, int face);

 private:
  MapPainter(gl::Program distance, gl::Program colour, gl::Program gloss, int drawn_resolution);
  void paint_layer(const gl::Program& program, GLuint source, GLuint target, glm::ivec2 size,
                   std::size_t map) const;

  gl::Program distance_, colour_, gloss_;
  methods::CubeMap cube_;
  gl::Framebuffer framebuffer_;
  render::WholeScreen screen_;
};

}  // namespace parvis::reference_maps

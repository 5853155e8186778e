// The texture that holds all local maps: each has a slot of three by two tiles, one per cube face. The meshes
// of all maps of a frame are drawn in one call.
#pragma once

#include <span>
#include <vector>

#include "graphics/gl/uniform_block.h"
#include "graphics/render/stream_buffer.h"
#include "graphics/shading/glsl.h"
#include "reflections/local_maps/local_map_mesh.h"
#include "reflections/local_maps/local_map_settings.h"
#include "reflections/methods/bindings.h"
#include "reflections/reference_maps/reference_maps.h"
#include "scene/data/scene.h"

namespace parvis::local_maps {
using namespace reference_maps;
namespace picture_block {
using namespace parvis::shading;
#include "reflections/local_maps/picture_block.glsl"
}  // namespace picture_block

/// Place of a local map in the texture; its tiles may be smaller than the slot's.
struct LocalMapPlace {
  int slot;
  int tile;  ///< texels per side, border included
};

/// Colour, depth and mipmap levels of all local maps.
class LocalMapPicture {
 public:
  /// `max_texels`: side of the largest tile, a power of two. Fails only if a shader does not compile.
  static Result<LocalMapPicture> create(int max_texels, LocalMapView shown);

  /// Provides this many slots, or as many as the largest texture holds. Returns true if the content was lost.
  bool reserve(int slots);
  int slots() const { return slots_; }  ///< number available
  glm::vec2 corner(int slot) const;     ///< south-west, in texels
  /// Size of the texture in texels.
  glm::ivec2 size() const { return size_; }
  GLuint texture() const { return colours_.name(); }  ///< colour; OpenGL's name

  /// Draws meshes with colour and depth; `cell_m` is the cell size of the height field in which they were
  /// traced.
  void draw(std::span<const FaceMesh> meshes, const ReferenceMaps& maps, float cell_m);
  /// The view of one face as `draw` left it, for drawing dynamic objects over it.
  render::View face_view(LocalMapPlace place, int face, glm::vec3 centre) const;
  /// Computes the coarser mipmap levels of these maps; call it after all drawing.
  void update_levels(std::span<const LocalMapPlace> places);

 private:
  struct Programs {
    gl::Program radiance, marks, level;  ///< marks: mesh or weights
  };
  LocalMapPicture(int max_texels, LocalMapView shown, Programs programs);
  void upload(std::span<const FaceMesh> meshes);
  void bind_layout(const gl::Program& program, float layer_side, float cell_m) const;

  int max_texels_;
  LocalMapView shown_;
  Programs programs_;
  int slots_ = 0, columns_ = 1;
  glm::ivec2 size_{0};
  gl::Texture colours_, depth_;
  gl::Framebuffer framebuffer_;
  gl::VertexArray mesh_array_, tile_array_;
  render::StreamBuffer vertex_store_{1 << 20}, index_store_{1 << 20}, tile_store_{1 << 12};
  std::vector<LocalMapVertex> vertices_;
  std::vector<std::uint32_t> indices_;
  std::vector<glm::vec4> rectangles_;
  gl::UniformBlock<picture_block::PictureLayout> layout_{"PictureLayout", methods::first_method_block};
};

}  // namespace parvis::local_maps

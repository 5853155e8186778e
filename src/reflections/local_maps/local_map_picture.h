// The picture that holds all local maps: each has a slot of three by two tiles, drawn by the meshes of its
// six faces, all maps of a frame in one call.
#pragma once

#include <span>
#include <vector>

#include "graphics/gl/program.h"
#include "graphics/render/stream_buffer.h"
#include "reflections/local_maps/local_map_mesh.h"
#include "reflections/local_maps/local_map_settings.h"
#include "reflections/reference_maps/reference_maps.h"
#include "scene/data/scene.h"

namespace parvis::local_maps {
using namespace reference_maps;

/// A local map's place: a slot's tiles may be smaller than the largest.
struct LocalMapPlace {
  int slot;
  int tile;  ///< texels a side, border included
};

class LocalMapPicture {
 public:
  /// `max_texels`: a side of the largest tile, a power of two. Fails only if a shader does.
  static Result<LocalMapPicture> create(int max_texels, LocalMapView shown);

  /// Makes room for so many slots, or for as many as the largest texture holds. True: what was drawn is lost.
  bool reserve(int slots);
  int slots() const { return slots_; }
  glm::vec2 corner(int slot) const;  ///< south-west, in texels
  glm::ivec2 size() const { return size_; }
  GLuint texture() const { return colours_.name(); }

  /// Draws meshes with colour and depth; `cell_m` is that of the heights they were traced in.
  void draw(std::span<const FaceMesh> meshes, const ReferenceMaps& maps, float cell_m);
  /// The view of one face as `draw` left it, to draw dynamic objects over it.
  render::View face_view(LocalMapPlace place, int face, glm::vec3 centre) const;
  /// To be called when all is drawn: the coarser levels of these maps.
  void update_levels(std::span<const LocalMapPlace> places);

 private:
  struct Programs {
    gl::Program radiance, marks, level;  ///< marks: mesh or weights
  };
  LocalMapPicture(int max_texels, LocalMapView shown, Programs programs);
  void upload(std::span<const FaceMesh> meshes);

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
};

}  // namespace parvis::local_maps

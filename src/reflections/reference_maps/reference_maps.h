// Reference maps (Meyer and Loscos 2003, section 4): what the fixed scene looks like all round a few places,
// with the distance of what is seen. Each map is one octahedral layer, which holds what the paper has in six
// faces.
#pragma once

#include <cstdint>
#include <vector>

#include "graphics/gl/objects.h"
#include "graphics/render/renderer.h"

namespace parvis::reference_maps {

class ReferenceMaps {
 public:
  /// Texels that repeat what lies across a layer's sides, in its finest level.
  static constexpr int border = 4;
  static glm::ivec2 gloss_size();  ///< texels of a layer of `glosses`
  /// Texels per side of a layer that is as sharp as cube maps with faces of `face_resolution`. 54 maps for
  /// faces of 128 take 30 MB, compressed 14.
  static int layer_side(int face_resolution);

  /// Graphics memory of one map with layers of `resolution` texels per side, all in all.
  static std::size_t bytes_per_map(int resolution, bool is_compressed = false);
  /// How many maps one set holds: OpenGL's layers per texture.
  static std::size_t max_count();

  /// Maps that hold nothing yet. Compressed colours (BPTC, a quarter of the memory) cannot be drawn into,
  /// only copied from other maps. Errors: more than `max_count` maps; the driver has no memory for them.
  static Result<ReferenceMaps> create(std::vector<glm::vec3> places, int resolution,
                                      bool is_compressed = false);
  /// Draws the fixed scene from each place, as sharp as faces of `face_resolution`; takes some tenths of a
  /// second a map, so it shows progress. Errors: those of `create`; a shader.
  static Result<ReferenceMaps> bake(render::Renderer& renderer, std::vector<glm::vec3> places,
                                    int face_resolution);

  const std::vector<glm::vec3>& places() const { return places_; }
  int resolution() const { return resolution_; }      ///< texels per side of a layer
  GLuint colours() const { return colours_.name(); }  ///< linear radiance, with mipmaps
  GLuint glosses() const { return glosses_.name(); }  ///< blurred for roughness, map_levels.glsl
  GLuint distances() const {
    return distances_.name();
  }  ///< metres from the place; as far as can be for the sky
  GLuint place_texture() const { return place_texture_.name(); }  ///< one row: each map's place in the world
  std::size_t colour_bytes() const;                               ///< of graphics memory, with mipmaps
  std::size_t bytes() const;                                      ///< of graphics memory, all in all

  /// Makes the coarser levels of colours that were drawn or written.
  void update_levels();
  /// The finest levels of a map as bytes, for files; not of compressed maps.
  std::vector<std::vector<std::uint8_t>> read(std::size_t map) const;
  /// False, and nothing is changed, where these are not the bytes of such a map.
  bool write(std::size_t map, const std::vector<std::vector<std::uint8_t>>& textures);
  /// Gives a layer to another place; it keeps showing the old one until it is drawn, written or copied into.
  void move(std::size_t map, glm::vec3 place);
  /// Copies a map of the same resolution, with all its levels, and compresses it if these are compressed.
  void copy(std::size_t map, const ReferenceMaps& from, std::size_t map_there);

 private:
  ReferenceMaps(std::vector<glm::vec3> places, int resolution, bool is_compressed);

  std::vector<glm::vec3> places_;
  int resolution_;
  bool is_compressed_;
  gl::Texture colours_, glosses_, distances_, place_texture_;
};

}  // namespace parvis::reference_maps

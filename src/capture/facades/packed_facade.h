// A captured place as it is displayed: surfaces, and for each photograph the tiles of its layers, compressed.
// Tiles that no surface needs are not stored: sky, and hidden parts that another photograph shows.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "base/bounds.h"
#include "base/result.h"
#include "capture/facades/balance.h"
#include "capture/facades/bc7_blocks.h"
#include "capture/facades/place_layers.h"

namespace parvis::facades {

inline constexpr std::size_t max_facade_photos = 4096;  ///< of a file; more are refused
inline constexpr int tile_inner = 62;                   ///< pixels of the photograph in a tile, per side
inline constexpr int tile_border =
    1;  ///< texels about them that repeat the neighbours; coarse levels are read less near the edge
inline constexpr int tile_side = tile_inner + 2 * tile_border;
inline constexpr int tile_levels = 3;  ///< mipmaps
inline constexpr std::size_t blocks_per_slot = (64 * 64 + 32 * 32 + 16 * 16) / 16;
static_assert(tile_side == 64);

/// A tile's kind, in the lowest two bits of its entry.
enum class TileKind : std::uint8_t {
  none,   ///< not stored
  seen,   ///< the photograph sees all of it
  mixed,  ///< alpha: 255 where the photograph sees the surface, 191 where it was filled, 0 where nothing is
          ///< known
  alpha   ///< seen, with an artist's alpha
};

inline constexpr int depth_cell = 8;  ///< pixels per side of a cell of PackedFacade::depths
/// Cells of a photograph.
inline glm::ivec2 depth_cells(const View& view) {
  return {(view.width + depth_cell - 1) / depth_cell, (view.height + depth_cell - 1) / depth_cell};
}
/// Depth in 16 bits: 1/2048 of an octave is 0.03 %; from 2^-16 to 2^16 world units, beyond it the most.
std::uint16_t encoded_depth(double depth);

/// A photograph's camera and colours.
struct PackedPhoto {
  std::string name;
  View view;
  Balance balance;
};

/// A layer's box and its tiles: ceil(width / tile_inner) across, row by row from `first_tile`.
struct PackedLayer {
  PixelBox box;
  std::uint32_t photo = 0, first_tile = 0;

  /// Tiles in a row.
  int across() const { return (box.width + tile_inner - 1) / tile_inner; }
  /// Rows of tiles.
  int down() const { return (box.height + tile_inner - 1) / tile_inner; }
};

/// The colour of a corner about which no photograph says anything, and whose proposal was refused; known
/// colours never are this one.
inline constexpr glm::u8vec3 no_colour{128, 128, 128};

/// A facade as a facade(...) node shows it.
struct PackedFacade {
  std::vector<std::string> surfaces;               ///< names of the model's objects
  std::vector<glm::vec3> corners;                  ///< in the facade's frame, three per triangle
  std::vector<std::uint32_t> surface_of_triangle;  ///< ascending
  /// Proposed sRGB per corner, where no photograph says anything, or no_colour.
  std::vector<glm::u8vec3> fallback;
  std::vector<glm::uvec2> lists;          ///< per triangle: first and number of its candidates
  std::vector<std::uint32_t> candidates;  ///< layers
  std::vector<PackedPhoto> photos;
  std::vector<PackedLayer> layers;
  std::vector<std::uint32_t> tiles;  ///< TileKind, and the slot above it
  std::vector<Bc7Block> blocks;      ///< blocks_per_slot for each slot, level by level
  /// Depths of each photograph, depth_cells.x * depth_cells.y values row by row: how far the photograph sees
  /// in each cell of depth_cell x depth_cell pixels, see encoded_depth. They tell what an object hides of
  /// itself.
  std::vector<std::uint16_t> depths;

  /// Found in the photographs when a scene shows the facade (find_shadows), and not kept in files: per
  /// surface its luminance in the sun (photographs::encoded_luminance), empty where nothing is known; and
  /// what shadows leave of the light.
  std::vector<std::uint8_t> lit_of_surface;
  float kept_in_shadows = 1.0f;

  /// `lit_of_surface` of a triangle's; 0: not known.
  std::uint8_t lit_of_triangle(std::size_t triangle) const {
    return lit_of_surface.empty() ? std::uint8_t(0) : lit_of_surface[surface_of_triangle[triangle]];
  }
  /// Number of triangles, three corners each.
  std::size_t triangle_count() const { return corners.size() / 3; }
  /// Number of stored tiles.
  std::size_t slot_count() const { return blocks.size() / blocks_per_slot; }
  /// Size of all textures and tables, as graphics memory holds them.
  std::size_t texture_bytes() const;
  /// Size of the photographs that they were made of, at 4 bytes per pixel.
  std::size_t photograph_bytes() const;
  /// Bounds of all surfaces, in the facade's frame.
  Bounds bounds() const;
};

/// Packs the layers of a place with the proposals that were not refused. Where a photograph sees a surface
/// its own pixels stay until a proposal is accepted.
PackedFacade packed_facade(const PlaceLayers& place);

/// The file appears whole or not at all.
Status write_facade(const std::filesystem::path& file, const PackedFacade& facade);
/// Errors: missing, foreign, cut short, damaged, or with numbers that do not fit together.
Result<PackedFacade> read_facade(const std::filesystem::path& file);
/// The same of what the file's seal holds.
Result<PackedFacade> facade_of(std::string_view content, const std::filesystem::path& file);

/// Whether its lists fit together, as both readers ask it: an error that names `file` and what does not.
Status check_facade(const PackedFacade& facade, const std::filesystem::path& file);

/// The rows of the tables that facade_lookup.glsl reads.
using PhotoRow = std::array<glm::vec4, 7>;
/// FacadePhoto of facade_photo.glsl, of a photograph whose depths begin at `first_depth`.
PhotoRow photo_row(const PackedPhoto& photo, std::size_t first_depth);
/// Where each photograph's depths begin.
std::vector<std::size_t> first_depths(const PackedFacade& facade);
/// The layer as `facade_layer` of facade_lookup.glsl returns it.
glm::uvec4 layer_row(const PackedLayer& layer);

}  // namespace parvis::facades

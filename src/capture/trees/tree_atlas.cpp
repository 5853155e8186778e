// Textures of one size fill strips of 128 rows, left to right and downward; each level of a tree begins with
// a strip of its own.
#include "capture/trees/tree_atlas.h"

#include <algorithm>
#include <array>

#include "base/colour.h"
#include "base/parallel.h"

namespace parvis::trees {
namespace {

constexpr int layer_side = 2048, strip_rows = 128, strips_per_layer = layer_side / strip_rows;
constexpr std::size_t strip_bytes = std::size_t(4) * layer_side * strip_rows;
constexpr int encoding_steps = 4095;

int tiles_per_strip(int side) { return (layer_side / side) * (strip_rows / side); }

/// sRGB to linear and back, of premultiplied texels, by table.
struct Encoding {
  std::array<float, 256> linear;
  std::array<std::uint8_t, encoding_steps + 1> srgb8;

  Encoding() {
    for (std::size_t i = 0; i < linear.size(); ++i) linear[i] = linear_from_srgb(float(i) / 255.0f);
    for (std::size_t i = 0; i < srgb8.size(); ++i)
      srgb8[i] = std::uint8_t(255.0f * srgb_from_linear(float(i) / encoding_steps) + 0.5f);
  }
  void premultiply(const std::uint8_t* straight, std::uint8_t* out) const {
    const float alpha = float(straight[3]) * (float(encoding_steps) / 255.0f);
    for (int c = 0; c < 3; ++c) out[c] = srgb8[std::size_t(alpha * linear[straight[c]] + 0.5f)];
    out[3] = straight[3];
  }
};

/// A texture of a strip, side^2 straight RGBA.
using Tile = const std::uint8_t*;

std::vector<Tile> tiles_of(const BillboardTree& level) {
  const std::size_t bytes = 4 * std::size_t(level.texels_per_side) * std::size_t(level.texels_per_side);
  std::vector<Tile> tiles;
  for (const BillboardTextures& view : level.views)
    for (std::size_t i = 0; i < view.count(level.texels_per_side); ++i)
      tiles.push_back(view.texels.data() + i * bytes);
  return tiles;
}

/// The texels that show something: low corner, high corner excluded.
glm::u8vec4 extent_of(Tile tile, int side) {
  glm::ivec4 extent(side, side, 0, 0);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      if (tile[4 * (y * side + x) + 3] > 0)
        extent = {std::min(extent.x, x), std::min(extent.y, y), std::max(extent.z, x + 1), y + 1};
  return glm::u8vec4(extent);
}

/// The mean opacities of a tile's parts.
void write_mask(Tile tile, int side, int parts, std::uint8_t* mask) {
  const auto first = [&](int part) { return part * side / parts; };
  for (int v = 0; v < parts; ++v)
    for (int u = 0; u < parts; ++u) {
      int sum = 0, count = 0;
      for (int y = first(v); y < std::max(first(v + 1), first(v) + 1); ++y)
        for (int x = first(u); x < std::max(first(u + 1), first(u) + 1); ++x)
          sum += tile[4 * (y * side + x) + 3], ++count;
      mask[v * parts + u] = std::uint8_t(sum / count);
    }
}

void write_strip(std::span<const Tile> tiles, int side, std::vector<std::uint8_t>& texels) {
  static const Encoding encoding;
  texels.assign(strip_bytes, 0);
  const std::size_t size = std::size_t(side), columns = layer_side / size;
  parallel_for(tiles.size(), [&](std::size_t i) {
    const std::size_t left = i % columns * size, top = i / columns * size;
    for (std::size_t y = 0; y < size; ++y)
      for (std::size_t x = 0; x < size; ++x)
        encoding.premultiply(tiles[i] + 4 * (y * size + x),
                             texels.data() + 4 * ((top + y) * layer_side + left + x));
  });
}

}  // namespace

Result<TreeAtlas> TreeAtlas::create(std::span<const TreeLevels* const> trees) {
  TreeAtlas atlas;
  std::size_t strips = 0;
  for (const TreeLevels* tree : trees)
    for (const BillboardTree& level : tree->levels) {
      Level& placed = atlas.levels_[tree].emplace_back();
      placed.first_strip = std::uint32_t(strips);
      std::size_t tiles = 0;
      for (const BillboardTextures& view : level.views) {
        placed.first_tiles.push_back(std::uint32_t(tiles));
        tiles += view.count(level.texels_per_side);
      }
      const std::size_t per_strip = std::size_t(tiles_per_strip(level.texels_per_side));
      strips += (tiles + per_strip - 1) / per_strip;
    }
  GLint max_layers = 0;
  glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &max_layers);
  const std::size_t layers = std::max<std::size_t>((strips + strips_per_layer - 1) / strips_per_layer, 1);
  if (layers > std::size_t(std::min(max_layers, 256)))
    return error(
        "the captured trees of this scene need {} MB of textures, {} MB are possible: use fewer kinds of "
        "trees, or "
        "make them with fewer texels or photographs",
        layers * 22, std::min(max_layers, 256) * 22);
  atlas.texture_ = gl::Texture::create(GLenum(GL_TEXTURE_2D_ARRAY));
  const GLuint name = atlas.texture_.name();
  glTextureStorage3D(name, mip_levels, GL_SRGB8_ALPHA8, layer_side, layer_side, GLsizei(layers));
  for (const GLenum side : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
    glTextureParameteri(name, side, GL_CLAMP_TO_EDGE);
  glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_NEAREST);
  glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  std::vector<std::uint8_t> texels;
  for (const TreeLevels* tree : trees)
    for (std::size_t i = 0; i < tree->levels.size(); ++i) {
      const int side = tree->levels[i].texels_per_side;
      const std::vector<Tile> tiles = tiles_of(tree->levels[i]);
      std::vector<glm::u8vec4>& extents = atlas.levels_[tree][i].extents;
      extents.resize(tiles.size());
      const int mask_side = atlas.levels_[tree][i].mask_side = std::min(side, i == 0 ? 4 : 8);
      const std::size_t mask_bytes = std::size_t(mask_side) * std::size_t(mask_side);
      std::vector<std::uint8_t>& masks = atlas.levels_[tree][i].masks;
      masks.resize(tiles.size() * mask_bytes);
      parallel_for(tiles.size(), [&](std::size_t t) {
        extents[t] = extent_of(tiles[t], side);
        write_mask(tiles[t], side, mask_side, &masks[t * mask_bytes]);
      });
      const std::size_t per_strip = std::size_t(tiles_per_strip(side));
      std::size_t strip = atlas.levels_[tree][i].first_strip;
      for (std::size_t first = 0; first < tiles.size(); first += per_strip, ++strip) {
        write_strip(std::span(tiles).subspan(first, std::min(per_strip, tiles.size() - first)), side, texels);
        glTextureSubImage3D(name, 0, 0, int(strip % strips_per_layer) * strip_rows,
                            int(strip / strips_per_layer), layer_side, strip_rows, 1, GL_RGBA,
                            GL_UNSIGNED_BYTE, texels.data());
      }
    }
  glGenerateTextureMipmap(name);
  return atlas;
}

std::uint32_t TreeAtlas::tile(const TreeLevels* tree, std::size_t level, std::size_t view,
                              std::size_t cell) const {
  const BillboardTree& shown = tree->levels[level];
  const std::int32_t texture = shown.views[view].texture_of_cell[cell];
  if (texture < 0) return no_tile;
  const std::uint32_t side = std::uint32_t(shown.texels_per_side), columns = layer_side / side;
  const std::uint32_t per_strip = std::uint32_t(tiles_per_strip(shown.texels_per_side));
  const Level& placed = levels_.at(tree)[level];
  const std::uint32_t number = placed.first_tiles[view] + std::uint32_t(texture);
  const std::uint32_t strip = placed.first_strip + number / per_strip, within = number % per_strip;
  const std::uint32_t x = within % columns * side,
                      y = strip % strips_per_layer * strip_rows + within / columns * side;
  return x / 4 | y / 4 << 9 | strip / strips_per_layer << 18 | side / 4 << 26;
}

glm::vec4 TreeAtlas::extent(const TreeLevels* tree, std::size_t level, std::size_t view, std::size_t cell,
                            float mip_level) const {
  const BillboardTree& shown = tree->levels[level];
  const std::int32_t texture = shown.views[view].texture_of_cell[cell];
  if (texture < 0) return {-1.0f, -1.0f, 1.0f, 1.0f};
  const Level& placed = levels_.at(tree)[level];
  const glm::vec4 texels(placed.extents[placed.first_tiles[view] + std::uint32_t(texture)]);
  if (texels.x >= texels.z) return {0.0f, 0.0f, 0.0f, 0.0f};
  const float around = std::exp2(mip_level), to_billboard = 2.0f / float(shown.texels_per_side);
  // v runs downward.
  return {(texels.x - around) * to_billboard - 1.0f, 1.0f - (texels.w + around) * to_billboard,
          (texels.z + around) * to_billboard - 1.0f, 1.0f - (texels.y - around) * to_billboard};
}

OpacityMask TreeAtlas::mask(const TreeLevels* tree, std::size_t level, std::size_t view,
                            std::size_t cell) const {
  const BillboardTree& shown = tree->levels[level];
  const std::int32_t texture = shown.views[view].texture_of_cell[cell];
  if (texture < 0) return {1, std::span(&shown.base[cell].w, 1)};
  const Level& placed = levels_.at(tree)[level];
  const std::size_t bytes = std::size_t(placed.mask_side) * std::size_t(placed.mask_side);
  const std::size_t first = (placed.first_tiles[view] + std::uint32_t(texture)) * bytes;
  return {placed.mask_side, std::span(placed.masks).subspan(first, bytes)};
}

}  // namespace parvis::trees

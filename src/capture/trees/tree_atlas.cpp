// Textures of one size fill strips of 64 rows, left to right and downward; a photograph's textures of one
// level begin with a strip of their own.
#include "capture/trees/tree_atlas.h"

#include <algorithm>
#include <array>

#include "base/colour.h"
#include "base/parallel.h"

namespace parvis::trees {
namespace {

constexpr int layer_side = 2048, strip_rows = 64, strips_per_layer = layer_side / strip_rows;
constexpr std::size_t strip_bytes = std::size_t(4) * layer_side * strip_rows;
constexpr int encoding_steps = 4095;

int tiles_per_strip(int side) { return (layer_side / side) * (strip_rows / side); }

std::size_t strips_of(const BillboardTextures& view, int side) {
  const std::size_t per_strip = std::size_t(tiles_per_strip(side));
  return (view.count(side) + per_strip - 1) / per_strip;
}

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

std::vector<std::uint8_t> strip_texels(const BillboardTextures& view, int side, std::size_t strip) {
  static const Encoding encoding;
  std::vector<std::uint8_t> texels(strip_bytes, 0);
  const std::size_t per_strip = std::size_t(tiles_per_strip(side)), first = strip * per_strip;
  const std::size_t count = std::min(per_strip, view.count(side) - first);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t column = i % std::size_t(layer_side / side), row = i / std::size_t(layer_side / side);
    for (std::size_t y = 0; y < std::size_t(side); ++y)
      for (std::size_t x = 0; x < std::size_t(side); ++x)
        encoding.premultiply(
            view.texels.data() + 4 * (((first + i) * std::size_t(side) + y) * std::size_t(side) + x),
            texels.data() +
                4 * ((row * std::size_t(side) + y) * layer_side + column * std::size_t(side) + x));
  }
  return texels;
}

}  // namespace

Result<TreeAtlas> TreeAtlas::create(std::span<const TreeLevels* const> trees) {
  struct Strip {
    const BillboardTextures* view;
    int side;
    std::size_t index;
  };
  TreeAtlas atlas;
  std::vector<Strip> strips;
  for (const TreeLevels* tree : trees) {
    auto& levels = atlas.first_strips_[tree];
    for (const BillboardTree& level : tree->levels) {
      levels.emplace_back();
      for (const BillboardTextures& view : level.views) {
        levels.back().push_back(std::uint32_t(strips.size()));
        const std::size_t count = strips_of(view, level.texels_per_side);
        for (std::size_t i = 0; i < count; ++i) strips.push_back({&view, level.texels_per_side, i});
      }
    }
  }
  GLint max_layers = 0;
  glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &max_layers);
  const std::size_t layers =
      std::max<std::size_t>((strips.size() + strips_per_layer - 1) / strips_per_layer, 1);
  if (layers > std::size_t(std::min(max_layers, 256)))
    return error(
        "the captured trees of this scene need {} MB of textures, {} MB are possible: use fewer kinds of "
        "trees, or "
        "make them with fewer texels or photographs",
        layers * 17, std::min(max_layers, 256) * 17);
  atlas.texture_ = gl::Texture::create(GLenum(GL_TEXTURE_2D_ARRAY));
  const GLuint name = atlas.texture_.name();
  glTextureStorage3D(name, 1, GL_SRGB8_ALPHA8, layer_side, layer_side, GLsizei(layers));
  for (const GLenum side : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
    glTextureParameteri(name, side, GL_CLAMP_TO_EDGE);
  for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
    glTextureParameteri(name, filter, GL_LINEAR);
  for (std::size_t i = 0; i < strips.size(); ++i) {
    const std::vector<std::uint8_t> texels = strip_texels(*strips[i].view, strips[i].side, strips[i].index);
    glTextureSubImage3D(name, 0, 0, int(i % strips_per_layer) * strip_rows, int(i / strips_per_layer),
                        layer_side, strip_rows, 1, GL_RGBA, GL_UNSIGNED_BYTE, texels.data());
  }
  return atlas;
}

std::uint32_t TreeAtlas::tile(const TreeLevels* tree, std::size_t level, std::size_t view,
                              std::size_t cell) const {
  const BillboardTree& shown = tree->levels[level];
  const std::int32_t texture = shown.views[view].texture_of_cell[cell];
  if (texture < 0) return no_tile;
  const std::uint32_t side = std::uint32_t(shown.texels_per_side), columns = layer_side / side;
  const std::uint32_t per_strip = std::uint32_t(tiles_per_strip(shown.texels_per_side));
  const std::uint32_t strip = first_strips_.at(tree)[level][view] + std::uint32_t(texture) / per_strip;
  const std::uint32_t within = std::uint32_t(texture) % per_strip;
  const std::uint32_t x = within % columns * side,
                      y = strip % strips_per_layer * strip_rows + within / columns * side;
  return x / 4 | y / 4 << 9 | strip / strips_per_layer << 18 | side / 4 << 26;
}

}  // namespace parvis::trees

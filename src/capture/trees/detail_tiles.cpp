// Coarser levels are averaged here: OpenGL ES makes none of signed texels.
#include "capture/trees/detail_tiles.h"

#include <bit>
#include <vector>

namespace parvis::trees {
namespace {

constexpr int mip_levels = std::bit_width(unsigned(LeafDetail::side));

std::vector<glm::vec2> halved(const std::vector<glm::vec2>& texels, int side) {
  const std::size_t half = std::size_t(side) / 2, row = std::size_t(side);
  std::vector<glm::vec2> result;
  result.reserve(half * half);
  for (std::size_t y = 0; y < half; ++y)
    for (std::size_t x = 0; x < half; ++x) {
      const std::size_t i = 2 * y * row + 2 * x;
      result.push_back(0.25f * (texels[i] + texels[i + 1] + texels[i + row] + texels[i + row + 1]));
    }
  return result;
}

}  // namespace

DetailTiles DetailTiles::of(std::span<const TreeLevels* const> trees) {
  DetailTiles tiles;
  for (const TreeLevels* tree : trees)
    if (!tree->detail.is_empty()) tiles.layers_.emplace(tree, std::uint32_t(tiles.layers_.size()));
  if (tiles.layers_.empty()) return tiles;
  tiles.texture_ = gl::Texture::create(GLenum(GL_TEXTURE_2D_ARRAY));
  const GLuint name = tiles.texture_.name();
  glTextureStorage3D(name, mip_levels, GL_RG8_SNORM, LeafDetail::side, LeafDetail::side,
                     GLsizei(tiles.layers_.size()));
  for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T}) glTextureParameteri(name, axis, GL_REPEAT);
  glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  for (const auto& [tree, layer] : tiles.layers_) {
    std::vector<glm::vec2> texels(tree->detail.texels.begin(), tree->detail.texels.end());
    int side = LeafDetail::side;
    for (int mip_level = 0; mip_level < mip_levels; ++mip_level, side /= 2) {
      std::vector<glm::i8vec2> rounded;
      rounded.reserve(texels.size());
      for (const glm::vec2 texel : texels) rounded.emplace_back(glm::round(texel));
      glTextureSubImage3D(name, mip_level, 0, 0, GLint(layer), side, side, 1, GL_RG, GL_BYTE, rounded.data());
      if (side > 1) texels = halved(texels, side);
    }
  }
  return tiles;
}

}  // namespace parvis::trees

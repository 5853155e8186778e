#include "capture/trees/trunk_shape.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <iterator>

#include "capture/trees/texture_blocks.h"

namespace parvis::trees {
namespace {

constexpr int ring_sides = 24;
constexpr std::size_t max_rings = 4096;
constexpr int max_bark_side = 2048;

/// Calls visit(x, y) for the first texel of each 4x4 block of a picture.
template <class Visit>
void for_each_block_corner(const Image8& picture, Visit&& visit) {
  for (int y = 0; y < picture.height; y += 4)
    for (int x = 0; x < picture.width; x += 4) visit(x, y);
}

bool is_trunk(const Trunk& trunk) {
  if (trunk.rings.size() < 2 || trunk.rings.size() > max_rings) return false;
  for (std::size_t i = 0; i < trunk.rings.size(); ++i) {
    const Trunk::Ring& ring = trunk.rings[i];
    if (glm::any(glm::isnan(ring.centre)) || glm::any(glm::isinf(ring.centre))) return false;
    if (!(ring.radius_m > 0.0f) || std::isinf(ring.radius_m)) return false;
    if (i > 0 && !(ring.centre.z > trunk.rings[i - 1].centre.z)) return false;
  }
  return true;
}

}  // namespace

Trunk::Ring Trunk::ring_at(float z) const {
  const auto above = std::ranges::find_if(rings, [&](const auto& ring) { return ring.centre.z >= z; });
  if (above == rings.begin()) return rings.front();
  if (above == rings.end()) return rings.back();
  const Ring &b = *above, &a = *std::prev(above);
  const float share = (z - a.centre.z) / std::max(b.centre.z - a.centre.z, 1e-6f);
  return {glm::mix(a.centre, b.centre, share), glm::mix(a.radius_m, b.radius_m, share)};
}

bool Trunk::contains(glm::vec3 point) const {
  if (rings.size() < 2) return false;
  const float step = (rings.back().centre.z - rings.front().centre.z) / float(rings.size() - 1);
  // Below the first ring it stands on the ground.
  if (point.z > rings.back().centre.z + 0.5f * step) return false;
  const Ring ring = ring_at(point.z);
  return glm::distance(glm::vec2(point), glm::vec2(ring.centre)) <= ring.radius_m;
}

scene::Model model_of(const TrunkShape& shape) {
  scene::Model model;
  model.name = "trunk";
  scene::Texture texture;
  texture.name = "bark", texture.image = shape.bark;
  model.textures.push_back(std::move(texture));
  scene::Material bark;
  bark.name = "bark", bark.base_colour = glm::vec3(1.0f), bark.base_colour_texture = 0, bark.roughness = 0.9f;
  model.materials.push_back(bark);
  scene::Part part;
  part.object = "trunk";
  Mesh& mesh = part.mesh;
  const std::vector<Trunk::Ring>& rings = shape.trunk.rings;
  const float foot = rings.front().centre.z, height = rings.back().centre.z - foot;
  for (const Trunk::Ring& ring : rings)
    for (int side = 0; side <= ring_sides; ++side) {
      const float angle = glm::two_pi<float>() * float(side) / ring_sides;
      const glm::vec3 normal(std::cos(angle), std::sin(angle), 0.0f);
      mesh.positions.push_back(ring.centre + ring.radius_m * normal);
      mesh.normals.push_back(normal);
      mesh.uvs.emplace_back(float(side) / ring_sides, 1.0f - (ring.centre.z - foot) / height);
    }
  constexpr auto row = std::uint32_t(ring_sides + 1);
  for (std::uint32_t r = 0; r + 1 < std::uint32_t(rings.size()); ++r)
    for (std::uint32_t side = 0; side + 1 < row; ++side) {
      const std::uint32_t i = r * row + side;
      mesh.indices.insert(mesh.indices.end(), {i, i + 1, i + row + 1, i, i + row + 1, i + row});
    }
  model.parts.push_back(std::move(part));
  return model;
}

void append_trunk(std::string& content, const TrunkShape& shape) {
  append_values(content, shape.trunk.rings);
  append_value(content, std::int32_t(shape.bark.width)),
      append_value(content, std::int32_t(shape.bark.height));
  std::vector<TextureBlock> blocks;
  for_each_block_corner(shape.bark, [&](int x, int y) {
    BlockTexels texels;
    for (int row = 0; row < 4; ++row) std::copy_n(shape.bark.at(x, y + row), 16, texels.data() + 16 * row);
    blocks.push_back(compressed_block(texels));
  });
  append_values(content, blocks);
}

Result<TrunkShape> take_trunk(ByteReader& reader) {
  TrunkShape shape;
  shape.trunk.rings = reader.take_values<Trunk::Ring>();
  const auto width = reader.take<std::int32_t>(), height = reader.take<std::int32_t>();
  const auto blocks = reader.take_values<TextureBlock>();
  if (reader.has_ended_early() || !is_trunk(shape.trunk)) return error("its trunk is no stack of discs");
  const auto is_side = [](int side) { return side >= 4 && side <= max_bark_side && side % 4 == 0; };
  if (!is_side(width) || !is_side(height) ||
      blocks.size() != std::size_t(width / 4) * std::size_t(height / 4))
    return error("the picture of its bark is {} x {} texels in {} blocks", width, height, blocks.size());
  shape.bark = Image8(width, height, 4);
  std::size_t next = 0;
  for_each_block_corner(shape.bark, [&](int x, int y) {
    const BlockTexels texels = decompressed_block(blocks[next++]);
    for (int row = 0; row < 4; ++row) std::copy_n(texels.data() + 16 * row, 16, shape.bark.at(x, y + row));
  });
  return shape;
}

}  // namespace parvis::trees

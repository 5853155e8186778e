#include "capture/trees/kept_textures.h"

#include <algorithm>

#include "base/content_hash.h"
#include "base/sealed_file.h"

namespace parvis::trees {
namespace {

constexpr int texture_version = 1;  // to be raised whenever the same input gives other textures
const std::string side_part = "texels";

std::string part_of(std::size_t photograph) { return fmt::format("photograph_{:04}", photograph); }

void add(ContentHash& hash, const TreeView& view) { hash.add(view.camera), hash.add(view.picture.pixels); }

std::uint64_t side_key(std::uint64_t key, std::span<const TreeView> views) {
  ContentHash hash;
  hash.add(key);
  for (const TreeView& view : views) add(hash, view);
  return hash.value();
}

std::uint64_t view_key(std::uint64_t key, const TreeView& view, int side) {
  ContentHash hash;
  hash.add(key), hash.add(side);
  add(hash, view);
  return hash.value();
}

/// Each texture that a cell names is there, and no more are.
bool fits(const BillboardTextures& textures, const BillboardTree& tree) {
  const auto bytes = 4 * std::size_t(tree.texels_per_side) * std::size_t(tree.texels_per_side);
  const std::size_t count = textures.texels.size() / bytes;
  return textures.texture_of_cell.size() == tree.grid.size() && textures.texels.size() == count * bytes &&
         std::ranges::all_of(textures.texture_of_cell, [&](std::int32_t texture) {
           return texture >= -1 && texture < std::int64_t(count);
         });
}

}  // namespace

KeptTextures::KeptTextures(const KeptParts& checkpoint, const TreeVolume& volume,
                           const TextureOptions& options)
    : checkpoint_(checkpoint) {
  ContentHash hash;
  hash.add(texture_version);
  hash.add(volume.grid.box().min), hash.add(volume.grid.box().max);
  hash.add(volume.grid.branching()), hash.add(volume.grid.side()), hash.add(volume.grid.cells());
  hash.add(volume.extinction_per_m), hash.add(volume.colour);
  hash.add(options.method), hash.add(options.max_megabytes), hash.add(options.iterations);
  hash.add(options.parent_levels), hash.add(options.seed);
  key_ = hash.value();
}

std::optional<int> KeptTextures::find_side(std::span<const TreeView> views) const {
  const std::optional<std::string> bytes = checkpoint_.find(side_part, side_key(key_, views));
  if (!bytes) return std::nullopt;
  ByteReader reader(*bytes);
  const auto side = reader.take<std::int32_t>();
  if (!reader.is_at_end() || side < 1 || side > max_chosen_side) return std::nullopt;
  return side;
}

Status KeptTextures::keep_side(std::span<const TreeView> views, int side) const {
  std::string bytes;
  append_value(bytes, std::int32_t(side));
  return checkpoint_.keep(side_part, side_key(key_, views), bytes);
}

std::optional<BillboardTextures> KeptTextures::find(std::size_t index, const TreeView& view,
                                                    const BillboardTree& tree) const {
  const std::optional<std::string> bytes =
      checkpoint_.find(part_of(index), view_key(key_, view, tree.texels_per_side));
  if (!bytes) return std::nullopt;
  ByteReader reader(*bytes);
  BillboardTextures textures{view.camera, reader.take_values<std::int32_t>(), {}};
  textures.texels = reader.take_values<std::uint8_t>();
  if (!reader.is_at_end() || !fits(textures, tree)) return std::nullopt;
  return textures;
}

Status KeptTextures::keep(std::size_t index, const TreeView& view, const BillboardTree& tree) const {
  if (!checkpoint_.keeps_parts()) return Ok{};  // the bytes would be for nothing
  std::string bytes;
  append_values(bytes, tree.views[index].texture_of_cell), append_values(bytes, tree.views[index].texels);
  return checkpoint_.keep(part_of(index), view_key(key_, view, tree.texels_per_side), bytes);
}

}  // namespace parvis::trees

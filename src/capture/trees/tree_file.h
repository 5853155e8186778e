// A captured tree's file, .tree: cells, base colours, cameras and block-compressed textures, behind a
// checksum (base/sealed_file.h).
#pragma once

#include <filesystem>

#include "base/result.h"
#include "base/sealed_file.h"
#include "capture/trees/billboard_tree.h"

namespace parvis::trees {

/// Writes the tree, whole or not at all. Where textures repeat the same blocks (texture_codes.h makes them),
/// each is stored once. A file that ends in .glb is glTF 2.0: two crossed billboards for
/// other programs, with the tree in the extension PARVIS_captured_tree (docs/trees.md). Returns the tree's
/// size in bytes, without those two pictures. Errors: a texture side that is no multiple of 4; what the disk
/// says.
Result<std::size_t> write_tree(const std::filesystem::path& file, const BillboardTree& tree);

/// Reads a tree (.tree, or .glb with the extension) as it is displayed, its textures decompressed. Every
/// count is checked against the bytes that are left before memory is taken for it. Errors name the file and
/// what is wrong.
Result<BillboardTree> read_tree(const std::filesystem::path& file);

/// Appends a volume to the content of a file.
void append_volume(std::string& content, const TreeVolume& volume);
/// Takes it out of the content of `file`, checked. Errors name the file and what is wrong.
Result<TreeVolume> take_volume(ByteReader& reader, const std::filesystem::path& file);

/// The volume that textures are made from, between two commands. Returns the file's size in bytes.
Result<std::size_t> write_volume(const std::filesystem::path& file, const TreeVolume& volume);
/// Errors name the file and what is wrong.
Result<TreeVolume> read_volume(const std::filesystem::path& file);

/// Textures as the file keeps them, decompressed again: what the reader would see.
BillboardTree as_stored(BillboardTree tree);

/// The thesis's packing: two textures share one RGB texture where no texel is opaque in both, and keep an
/// alpha each.
struct Packing {
  std::size_t textures = 0, packed = 0;  ///< RGB textures before and after
  /// Bytes after over bytes before, at 4 bytes per texel before, 3 per shared RGB texel and 1 per alpha
  /// after.
  double ratio() const {
    return textures > 0 ? (3.0 * double(packed) + double(textures)) / (4.0 * double(textures)) : 1.0;
  }
};
/// Which textures of each photograph share a texture, greedily in order, among the last few hundred that have
/// room.
Packing packed_disjoint_alphas(const BillboardTree& tree);

}  // namespace parvis::trees

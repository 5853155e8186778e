// Blocks of textures as numbers into a table, which holds each block once.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "capture/trees/texture_blocks.h"

namespace parvis::trees {

/// Different blocks and their numbers.
class BlockTable {
 public:
  /// Numbers have 16 bits.
  static constexpr std::size_t max_blocks = 65536;

  /// The table of these blocks, in the order in which they first occur. None where they are too many, or
  /// where table and numbers would take no less than the blocks themselves.
  static std::optional<BlockTable> of(std::span<const std::vector<TextureBlock>> views);
  /// A table with these blocks, at most `max_blocks`.
  explicit BlockTable(std::vector<TextureBlock> blocks);

  /// The blocks by their numbers.
  const std::vector<TextureBlock>& blocks() const { return blocks_; }
  /// The numbers of blocks, all of which the table holds.
  std::vector<std::uint16_t> numbers_of(std::span<const TextureBlock> blocks) const;
  /// The blocks of numbers; none where one is beyond the table.
  std::optional<std::vector<TextureBlock>> blocks_of(std::span<const std::uint16_t> numbers) const;

 private:
  std::vector<TextureBlock> blocks_;
  std::map<TextureBlock, std::uint16_t> numbers_;
};

}  // namespace parvis::trees

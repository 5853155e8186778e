#include "capture/trees/block_table.h"

#include <cassert>
#include <set>

namespace parvis::trees {

std::optional<BlockTable> BlockTable::of(std::span<const std::vector<TextureBlock>> views) {
  std::vector<TextureBlock> different;
  std::set<TextureBlock> seen;
  std::size_t count = 0;
  for (const std::vector<TextureBlock>& view : views) {
    count += view.size();
    for (const TextureBlock& block : view) {
      if (!seen.insert(block).second) continue;
      if (different.size() == max_blocks) return std::nullopt;
      different.push_back(block);
    }
  }
  const std::size_t coded = different.size() * block_bytes + count * sizeof(std::uint16_t);
  if (coded >= count * block_bytes) return std::nullopt;
  return BlockTable(std::move(different));
}

BlockTable::BlockTable(std::vector<TextureBlock> blocks) : blocks_(std::move(blocks)) {
  assert(blocks_.size() <= max_blocks);
  for (std::size_t i = 0; i < blocks_.size(); ++i) numbers_.try_emplace(blocks_[i], std::uint16_t(i));
}

std::vector<std::uint16_t> BlockTable::numbers_of(std::span<const TextureBlock> blocks) const {
  std::vector<std::uint16_t> numbers;
  numbers.reserve(blocks.size());
  for (const TextureBlock& block : blocks) numbers.push_back(numbers_.at(block));
  return numbers;
}

std::optional<std::vector<TextureBlock>> BlockTable::blocks_of(std::span<const std::uint16_t> numbers) const {
  std::vector<TextureBlock> blocks;
  blocks.reserve(numbers.size());
  for (const std::uint16_t number : numbers) {
    if (number >= blocks_.size()) return std::nullopt;
    blocks.push_back(blocks_[number]);
  }
  return blocks;
}

}  // namespace parvis::trees

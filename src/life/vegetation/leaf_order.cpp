#include "life/vegetation/leaf_order.h"

#include <algorithm>
#include <numeric>

namespace parvis::vegetation {
namespace {

/// The lowest 10 bits, with two zeros between each.
std::uint32_t spread_bits(std::uint32_t v) {
  v &= 0x3FFu;
  v = (v | v << 16) & 0x030000FFu;
  v = (v | v << 8) & 0x0300F00Fu;
  v = (v | v << 4) & 0x030C30C3u;
  return (v | v << 2) & 0x09249249u;
}

std::uint32_t morton_code(glm::vec3 share) {
  const glm::uvec3 cell(glm::clamp(share * 1024.0f, 0.0f, 1023.0f));
  return spread_bits(cell.x) | spread_bits(cell.y) << 1 | spread_bits(cell.z) << 2;
}

std::uint32_t reversed_bits(std::uint32_t v) {
  v = (v >> 1 & 0x55555555u) | (v & 0x55555555u) << 1;
  v = (v >> 2 & 0x33333333u) | (v & 0x33333333u) << 2;
  v = (v >> 4 & 0x0F0F0F0Fu) | (v & 0x0F0F0F0Fu) << 4;
  v = (v >> 8 & 0x00FF00FFu) | (v & 0x00FF00FFu) << 8;
  return v >> 16 | v << 16;
}

/// Indices of the leaves along the curve.
std::vector<std::uint32_t> along_curve(const std::vector<Leaf>& leaves) {
  Bounds box;
  for (const Leaf& leaf : leaves) box.add(leaf.foot);
  const float side = std::max({box.size().x, box.size().y, box.size().z, 1e-6f});
  std::vector<std::uint32_t> codes(leaves.size()), order(leaves.size());
  for (std::size_t i = 0; i < leaves.size(); ++i) codes[i] = morton_code((leaves[i].foot - box.min) / side);
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::sort(order, {}, [&](std::uint32_t i) { return std::pair(codes[i], i); });
  return order;
}

}  // namespace

void order_leaves(PlantShape& shape) {
  const std::vector<std::uint32_t> curve = along_curve(shape.leaves);
  std::vector<std::uint32_t> places(curve.size());  // of the curve, in prefix order
  std::iota(places.begin(), places.end(), 0u);
  std::ranges::sort(places, {}, reversed_bits);
  std::vector<Leaf> ordered;
  ordered.reserve(curve.size());
  shape.clustered.resize(curve.size());
  for (std::uint32_t rank = 0; rank < places.size(); ++rank) {
    ordered.push_back(shape.leaves[curve[places[rank]]]);
    shape.clustered[places[rank]] = rank;
  }
  shape.leaves = std::move(ordered);
  shape.clusters.clear();
  for (std::uint32_t first = 0; first < shape.clustered.size(); first += max_cluster_leaves) {
    LeafCluster cluster{
        first, std::min(max_cluster_leaves, std::uint32_t(shape.clustered.size()) - first), {}};
    const auto begin = shape.clustered.begin() + first;
    std::sort(begin, begin + cluster.count);
    for (std::uint32_t i = 0; i < cluster.count; ++i) {
      const Leaf& leaf = shape.leaves[begin[i]];
      cluster.bounds.add(leaf.foot - leaf.length_m), cluster.bounds.add(leaf.foot + leaf.length_m);
    }
    shape.clusters.push_back(cluster);
  }
}

}  // namespace parvis::vegetation

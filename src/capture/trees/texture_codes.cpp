// A greedy tree of codes (Riskin and Gray, A Greedy Tree Growing Algorithm for the Design of Variable Rate
// Vector Quantizers, 1991): the set of blocks that differ most from their mean is divided in two, along its
// principal axis and then by Lloyd's iteration, until there are as many sets as codes. It takes seconds where
// Lloyd's iteration over all codes takes many minutes. Premultiplied: what is transparent has no colour.
#include "capture/trees/texture_codes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <queue>
#include <span>
#include <vector>

#include "base/checked.h"
#include "base/memory_budget.h"
#include "capture/trees/billboard_blocks.h"

namespace parvis::trees {
namespace {

constexpr int set_axis_steps = 4;  // of the power iteration for a set's principal axis
constexpr int lloyd_steps = 6;     // that a set is divided by
constexpr int texels_per_block = 16;

/// A block's texels, premultiplied sRGB and alpha, 0..1.
using Vector = std::array<glm::vec4, texels_per_block>;

float dot(const Vector& a, const Vector& b) {
  glm::vec4 sum(0.0f);
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum.x + sum.y + sum.z + sum.w;
}

float squared_distance(const Vector& a, const Vector& b) {
  glm::vec4 sum(0.0f);
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum.x + sum.y + sum.z + sum.w;
}

void add_scaled(Vector& sum, const Vector& v, float scale) {
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += scale * v[i];
}

Vector vector_of(const BlockTexels& texels) {
  Vector result;
  for (std::size_t i = 0; i < result.size(); ++i) {
    const glm::vec4 t =
        glm::vec4(texels[4 * i], texels[4 * i + 1], texels[4 * i + 2], texels[4 * i + 3]) / 255.0f;
    result[i] = t.w * glm::vec4(glm::vec3(t), 1.0f);
  }
  return result;
}

BlockTexels texels_of(const Vector& vector) {
  BlockTexels result{};
  for (std::size_t i = 0; i < vector.size(); ++i) {
    const glm::vec3 colour = glm::vec3(vector[i]) / std::max(vector[i].w, 1e-6f);
    const glm::vec4 bytes = glm::round(255.0f * glm::clamp(glm::vec4(colour, vector[i].w), 0.0f, 1.0f));
    for (int c = 0; c < 4; ++c) result[4 * i + std::size_t(c)] = std::uint8_t(bytes[c]);
  }
  return result;
}

/// Blocks that have one code.
struct Set {
  std::size_t first = 0, count = 0;  // in the order
  Vector mean{};
  double distortion = 0.0;  // sum of squared distances to the mean

  /// The order of a queue, by distortion; of equal ones the first.
  bool operator<(const Set& other) const {
    return distortion != other.distortion ? distortion < other.distortion : first > other.first;
  }
};

/// The vectors of all blocks in an order in which each set is one piece.
class Codes {
 public:
  explicit Codes(std::vector<Vector> vectors) : vectors_(std::move(vectors)), order_(vectors_.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
  }

  /// Divides the blocks into at most `max_codes` sets.
  std::vector<Set> sets(std::size_t max_codes) {
    std::priority_queue<Set> open;
    std::vector<Set> done;
    open.push(set(0, order_.size()));
    while (!open.empty()) {
      const Set widest = open.top();
      open.pop();
      const std::size_t front = open.size() + done.size() + 1 < max_codes ? divide(widest) : 0;
      if (front == 0) {
        done.push_back(widest);
        continue;
      }
      open.push(set(widest.first, front));
      open.push(set(widest.first + front, widest.count - front));
    }
    return done;
  }

  /// The blocks of a set.
  std::span<const std::uint32_t> members(const Set& set) const {
    return std::span(order_).subspan(set.first, set.count);
  }
  const Vector& vector(std::uint32_t block) const { return vectors_[block]; }

 private:
  Set set(std::size_t first, std::size_t count) const {
    Set result{first, count, {}, 0.0};
    for (const std::uint32_t i : members(result)) add_scaled(result.mean, vectors_[i], 1.0f / float(count));
    for (const std::uint32_t i : members(result))
      result.distortion += double(squared_distance(vectors_[i], result.mean));
    return result;
  }

  /// The direction in which a set's blocks differ most; 0: in none.
  Vector principal_axis(const Set& whole) const {
    Vector axis{};
    add_scaled(axis, vectors_[order_[whole.first]], 1.0f), add_scaled(axis, whole.mean, -1.0f);
    for (glm::vec4& part : axis) part += 1e-3f;  // a start that hardly any set is at right angles to
    for (int step = 0; step < set_axis_steps; ++step) {
      Vector next{};
      for (const std::uint32_t i : members(whole)) {
        Vector off = vectors_[i];
        add_scaled(off, whole.mean, -1.0f);
        add_scaled(next, off, dot(off, axis));
      }
      const float length = std::sqrt(dot(next, next));
      if (length < 1e-12f) return {};
      axis = {};
      add_scaled(axis, next, 1.0f / length);
    }
    return axis;
  }

  /// Orders a set's blocks as two sets; returns how many the first has. 0: they cannot be divided.
  std::size_t divide(const Set& whole) {
    if (whole.count < 2 || whole.distortion <= 0.0) return 0;
    const Vector axis = principal_axis(whole);
    const float reach = std::sqrt(float(whole.distortion / double(whole.count)));
    std::array<Vector, 2> means{whole.mean, whole.mean};
    add_scaled(means[0], axis, reach), add_scaled(means[1], axis, -reach);
    const auto is_first = [&](std::uint32_t i) {
      return squared_distance(vectors_[i], means[0]) < squared_distance(vectors_[i], means[1]);
    };
    for (int step = 0; step < lloyd_steps; ++step) {
      std::array<Vector, 2> sums{};
      std::array<float, 2> counts{};
      for (const std::uint32_t i : members(whole)) {
        const std::size_t side = is_first(i) ? 0 : 1;
        add_scaled(sums[side], vectors_[i], 1.0f), counts[side] += 1.0f;
      }
      for (std::size_t side = 0; side < 2; ++side) {
        if (counts[side] == 0.0f) return 0;
        means[side] = {};
        add_scaled(means[side], sums[side], 1.0f / counts[side]);
      }
    }
    const auto begin = order_.begin() + std::ptrdiff_t(whole.first);
    const auto end = begin + std::ptrdiff_t(whole.count);
    const auto front = std::size_t(std::partition(begin, end, is_first) - begin);
    return front < whole.count ? front : 0;
  }

  std::vector<Vector> vectors_;
  std::vector<std::uint32_t> order_;
};

}  // namespace

double Quantisation::psnr_db() const {
  return rmse > 0.0 ? -20.0 * std::log10(rmse) : std::numeric_limits<double>::infinity();
}

Result<Quantisation> quantise_textures(BillboardTree& tree, std::size_t max_codes) {
  if (tree.texels_per_side % 4 != 0)
    return error("textures of {} texels along a side have no blocks of 4 x 4", tree.texels_per_side);
  std::size_t count = 0;
  for (const BillboardTextures& view : tree.views)
    count += view.texels.size() / std::tuple_size_v<BlockTexels>;
  if (Status enough =
          check_memory(checked_product({count, sizeof(Vector)}), "the blocks of a tree's textures");
      !enough)
    return enough.errors();
  std::vector<Vector> vectors;
  vectors.reserve(count);
  for (const BillboardTextures& view : tree.views)
    for_each_block(view, tree.texels_per_side,
                   [&](const BlockTexels& texels) { vectors.push_back(vector_of(texels)); });
  Quantisation result{count, 0, 0.0};
  if (count == 0) return result;

  Codes codes(std::move(vectors));
  std::vector<const BlockTexels*> code_of(count);
  const std::vector<Set> sets = codes.sets(std::max(max_codes, std::size_t(1)));
  std::vector<BlockTexels> blocks;
  blocks.reserve(sets.size());
  double squares = 0.0;
  for (const Set& set : sets) {
    blocks.push_back(decompressed_block(compressed_block(texels_of(set.mean))));
    const Vector shown = vector_of(blocks.back());
    for (const std::uint32_t i : codes.members(set)) {
      code_of[i] = &blocks.back();
      squares += double(squared_distance(codes.vector(i), shown));
    }
  }
  std::size_t next = 0;
  for (BillboardTextures& view : tree.views)
    replace_blocks(view, tree.texels_per_side, [&] { return *code_of[next++]; });
  result.codes = sets.size();
  result.rmse = std::sqrt(squares / double(count * std::tuple_size_v<BlockTexels>));
  return result;
}

}  // namespace parvis::trees

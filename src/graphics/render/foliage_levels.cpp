// Cook et al. prune in a random order and correct the contrast of what is left. Here the order is even along
// the mesh (neighbours on a twig follow each other in it), so that fewer holes open; contrast is left alone:
// leaves of a level that is drawn are a few pixels large and do not yet average.
#include "graphics/render/foliage_levels.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "base/bounds.h"

namespace parvis::render {
namespace {

constexpr std::size_t min_pieces = 256;
constexpr float kept_share = 2.0f / 3.0f;  // from one level to the next: leaves grow by a fifth
// With a quarter of a pixel of error that a surface may have, the leaves of a level are 8 pixels or smaller.
constexpr float error_of_leaf = 1.0f / 32.0f;
// Of hidden pieces no more is seen from anywhere outside, in the mean of their corners: what lies behind them
// looks much like them. They are left out where leaves are 32 pixels or smaller.
constexpr float hidden_share = 0.5f, error_of_hidden = 0.25f;

/// A part of a mesh that shares no vertex with the rest.
struct Piece {
  Bounds bounds;
  double area_m2 = 0.0;
  float max_seen = 0.0f;  ///< from outside the crown, mean of its vertices
  float vertices = 0.0f;
  std::uint32_t order = 0;  ///< those below a limit are kept
};

/// The pieces, in the order of their first vertices, and which one each vertex is of.
struct Pieces {
  std::vector<Piece> all;
  std::vector<std::uint32_t> of_vertex;
};

Pieces pieces_of(const Mesh& mesh, std::span<const float> max_seen) {
  std::vector<std::uint32_t> lowest(mesh.positions.size());  // a vertex of the piece that comes earlier
  std::iota(lowest.begin(), lowest.end(), 0u);
  const auto root = [&](std::uint32_t vertex) {
    while (lowest[vertex] != vertex) vertex = lowest[vertex] = lowest[lowest[vertex]];
    return vertex;
  };
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
    for (std::size_t side = 1; side < 3; ++side) {
      const std::uint32_t a = root(mesh.indices[i]), b = root(mesh.indices[i + side]);
      lowest[std::max(a, b)] = std::min(a, b);
    }
  Pieces pieces{{}, std::vector<std::uint32_t>(mesh.positions.size())};
  for (std::uint32_t vertex = 0; vertex < lowest.size(); ++vertex) {
    const std::uint32_t first = root(vertex);
    if (first == vertex) {
      pieces.of_vertex[vertex] = std::uint32_t(pieces.all.size());
      pieces.all.emplace_back();
    }
    pieces.of_vertex[vertex] = pieces.of_vertex[first];
    Piece& piece = pieces.all[pieces.of_vertex[vertex]];
    piece.bounds.add(mesh.positions[vertex]);
    piece.max_seen += max_seen.empty() ? 1.0f : max_seen[vertex];
    ++piece.vertices;
  }
  for (Piece& piece : pieces.all) piece.max_seen /= piece.vertices;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const glm::vec3 a = mesh.positions[mesh.indices[i]];
    const glm::vec3 sides =
        glm::cross(mesh.positions[mesh.indices[i + 1]] - a, mesh.positions[mesh.indices[i + 2]] - a);
    pieces.all[pieces.of_vertex[mesh.indices[i]]].area_m2 += 0.5 * double(glm::length(sides));
  }
  return pieces;
}

/// Numbers the pieces that are shown so that those below any limit lie evenly among all: the van der Corput
/// sequence. Returns where the numbers end; hidden pieces have that one.
std::uint32_t order_evenly(std::vector<Piece>& pieces, bool leaves_out_hidden) {
  const std::uint32_t end = std::bit_ceil(std::uint32_t(pieces.size()));
  std::uint32_t number = 0;
  for (Piece& piece : pieces) {
    piece.order = end;
    if (leaves_out_hidden && piece.max_seen <= hidden_share) continue;
    piece.order = number;
    std::uint32_t bit = end >> 1;  // a step of a counter whose bits stand in reverse
    for (; bit > 0 && (number & bit) != 0; bit >>= 1) number ^= bit;
    number |= bit;
  }
  return end;
}

/// The pieces whose order is below `limit`, enlarged.
FoliageLevel with_pieces(const Mesh& mesh, const Pieces& pieces, std::uint32_t limit, float enlarged) {
  FoliageLevel level;
  Mesh& kept = level.mesh;
  const auto piece_of = [&](std::uint32_t vertex) -> const Piece& {
    return pieces.all[pieces.of_vertex[vertex]];
  };
  std::vector<std::uint32_t> place(mesh.positions.size());
  for (std::uint32_t vertex = 0; vertex < mesh.positions.size(); ++vertex) {
    const Piece& piece = piece_of(vertex);
    if (piece.order >= limit) continue;
    place[vertex] = std::uint32_t(kept.positions.size());
    const glm::vec3 middle = piece.bounds.centre();
    append_vertex(kept, mesh, vertex);
    kept.positions.back() = middle + enlarged * (mesh.positions[vertex] - middle);
    level.vertices.push_back(vertex);
  }
  for (const std::uint32_t vertex : mesh.indices)
    if (piece_of(vertex).order < limit) kept.indices.push_back(place[vertex]);
  return level;
}

/// Area of the pieces whose order is below `limit`.
double area_m2(const std::vector<Piece>& pieces, std::uint32_t limit) {
  double sum = 0.0;
  for (const Piece& piece : pieces) sum += piece.order < limit ? piece.area_m2 : 0.0;
  return sum;
}

float mean_size_m(const std::vector<Piece>& pieces) {
  double sum_m = 0.0;
  for (const Piece& piece : pieces) sum_m += 2.0 * double(piece.bounds.radius());
  return float(sum_m / double(pieces.size()));
}

}  // namespace

std::uint64_t max_level_bytes(const Mesh& mesh) {
  constexpr std::uint64_t vertex_bytes =
      2 * sizeof(glm::vec3) + sizeof(glm::vec2) + sizeof(std::uint32_t);  // and which it was
  const std::uint64_t mesh_bytes =
      vertex_bytes * mesh.positions.size() + sizeof(std::uint32_t) * mesh.indices.size();
  return std::uint64_t(double(mesh_bytes) * kept_share / (1.0 - kept_share));  // the geometric series
}

std::vector<FoliageLevel> foliage_levels(const Mesh& mesh, std::span<const float> max_seen) {
  Pieces pieces = pieces_of(mesh, max_seen);
  if (pieces.all.size() < min_pieces) return {};
  const auto hidden =
      std::ranges::count_if(pieces.all, [](const Piece& piece) { return piece.max_seen <= hidden_share; });
  const bool leaves_out_hidden = float(hidden) >= (1.0f - kept_share) * float(pieces.all.size());
  const std::uint32_t end = order_evenly(pieces.all, leaves_out_hidden);
  const float leaf_m = mean_size_m(pieces.all);
  const double whole_m2 = area_m2(pieces.all, end);
  std::vector<FoliageLevel> levels;
  if (leaves_out_hidden) {
    levels.push_back(with_pieces(mesh, pieces, end, 1.0f));
    levels.back().error_m = error_of_hidden * error_of_leaf * leaf_m;
  }
  for (float share = kept_share; levels.size() < max_foliage_levels; share *= kept_share) {
    const std::uint32_t limit = std::uint32_t(share * float(end));
    const double kept_m2 = area_m2(pieces.all, limit);
    if (!(kept_m2 > 0.0)) break;
    const float enlarged = float(std::sqrt(whole_m2 / kept_m2));
    levels.push_back(with_pieces(mesh, pieces, limit, enlarged));
    levels.back().error_m = error_of_leaf * enlarged * leaf_m;
  }
  return levels;
}

}  // namespace parvis::render

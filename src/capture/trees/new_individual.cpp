#include "capture/trees/new_individual.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>

#include "base/colour.h"
#include "base/parallel.h"
#include "base/random.h"
#include "capture/trees/tree_light.h"

namespace parvis::trees {
namespace {

constexpr float max_stretch = 0.1f;
constexpr float trunk_cells = 1.6f;  // round the axis: cells that stay
constexpr float min_light_factor = 0.4f, max_light_factor = 2.5f;
constexpr int min_crown_layer_cells = 12;  // a layer of so many cells or more is of the crown

/// How a quarter of the crown is placed: mirrored where x and y change places, then turned by quarter turns.
struct Move {
  int turns = 0;
  bool is_mirrored = false;

  /// Moves doubled coordinates about the axis, or a direction.
  template <class T>
  std::array<T, 2> forward(T x, T y) const {
    if (is_mirrored) std::swap(x, y);
    for (int i = 0; i < turns; ++i) std::tie(x, y) = std::pair(T(-y), T(x));
    return {x, y};
  }
  glm::vec3 backward(glm::vec3 direction) const {
    float x = direction.x, y = direction.y;
    for (int i = 0; i < turns; ++i) std::tie(x, y) = std::pair(y, -x);
    if (is_mirrored) std::swap(x, y);
    return {x, y, direction.z};
  }
};

/// 0: x and y positive, then counter-clockwise.
int quarter_of(int x, int y) { return x >= 0 && y > 0 ? 0 : x < 0 && y >= 0 ? 1 : x <= 0 ? 2 : 3; }

/// Where each quarter goes: never all of them turned alike, which is the same tree.
std::array<Move, 4> drawn_moves(std::uint64_t seed) {
  Random random(seed, 910);
  std::array<int, 4> places{0, 1, 2, 3};
  std::array<Move, 4> moves;
  bool is_other = false;
  while (!is_other) {
    for (int i = 3; i > 0; --i) std::swap(places[std::size_t(i)], places[std::size_t(random.index(i + 1))]);
    for (int i = 0; i < 4; ++i) {
      // Turned into the first quarter, mirrored there, and turned on: a mirror takes i turns to the other
      // side.
      const bool is_mirrored = random.uniform() < 0.5f;
      moves[std::size_t(i)] = {(places[std::size_t(i)] + (is_mirrored ? i : 4 - i)) % 4, is_mirrored};
    }
    for (const Move& move : moves)
      is_other |= move.turns != moves[0].turns || move.is_mirrored != moves[0].is_mirrored;
  }
  return moves;
}

/// A cell of the new tree and where it comes from.
struct Source {
  std::uint32_t cell;
  Move move;
};

/// The layers in which there is no crown: their cells stay.
int first_crown_layer(const CellGrid& grid) {
  std::vector<int> counts(std::size_t(grid.side()), 0);
  for (const glm::u16vec3 cell : grid.cells()) ++counts[cell.z];
  const auto first = std::ranges::find_if(counts, [](int count) { return count >= min_crown_layer_cells; });
  return int(first - counts.begin());
}

/// The photograph that shows the cell, as it was, from the side from which the view shows it as it is now.
std::size_t view_from(const BillboardTree& tree, glm::vec3 to_eye) {
  const glm::vec3 middle = tree.grid.box().centre();
  return std::size_t(std::ranges::max_element(
                         tree.views, {},
                         [&](const BillboardTextures& view) {
                           return glm::dot(glm::normalize(view.camera.position_in_world - middle), to_eye);
                         }) -
                     tree.views.begin());
}

glm::vec3 lit(glm::u8vec4 srgb, float factor) {
  const glm::vec3 light = factor * linear_from_srgb(glm::vec3(srgb) / 255.0f);
  return glm::round(255.0f * srgb_from_linear(glm::min(light, 1.0f)));
}

/// The textures of one photograph's place.
BillboardTextures moved_textures(const BillboardTree& tree, std::size_t view,
                                 const std::vector<Source>& sources,
                                 const std::vector<float>& light_factors) {
  BillboardTextures result{tree.views[view].camera, std::vector<std::int32_t>(sources.size(), -1), {}};
  const glm::vec3 to_eye = glm::normalize(result.camera.position_in_world - tree.grid.box().centre());
  std::array<std::array<std::size_t, 2>, 4> from{};  // by turns and mirroring
  for (int turns = 0; turns < 4; ++turns)
    for (const bool is_mirrored : {false, true})
      from[std::size_t(turns)][is_mirrored] = view_from(tree, Move{turns, is_mirrored}.backward(to_eye));
  const int side = tree.texels_per_side;
  std::int32_t next = 0;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const Move& move = sources[i].move;
    const BillboardTextures& source = tree.views[from[std::size_t(move.turns)][move.is_mirrored]];
    const std::int32_t texture = source.texture_of_cell[sources[i].cell];
    if (texture < 0) continue;
    result.texture_of_cell[i] = next++;
    const std::uint8_t* texels = source.texels.data() + 4 * std::size_t(texture) * std::size_t(side * side);
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        const std::uint8_t* t = texels + 4 * (y * side + (move.is_mirrored ? side - 1 - x : x));
        const glm::vec3 colour = lit({t[0], t[1], t[2], t[3]}, light_factors[i]);
        for (int c = 0; c < 3; ++c) result.texels.push_back(std::uint8_t(colour[c]));
        result.texels.push_back(t[3]);
      }
  }
  return result;
}

std::vector<float> light_of(const BillboardTree& tree) {
  std::vector<float> light = sun_visibility(tree, tree.light.to_sun);
  const std::vector<float> sky = sky_visibility(tree);
  for (std::size_t i = 0; i < light.size(); ++i)
    light[i] = tree.light.sun * light[i] + tree.light.sky * sky[i];
  return light;
}

}  // namespace

BillboardTree new_individual(const BillboardTree& tree, std::uint64_t seed) {
  const CellGrid& grid = tree.grid;
  const std::array<Move, 4> moves = drawn_moves(seed);
  const int crown = first_crown_layer(grid), last = grid.side() - 1;
  std::vector<glm::u16vec3> cells;
  std::vector<Source> sources;
  for (std::uint32_t i = 0; i < grid.size(); ++i) {
    const glm::u16vec3 cell = grid.cells()[i];
    const int x = 2 * int(cell.x) - last, y = 2 * int(cell.y) - last;
    const bool stays = cell.z < crown || std::hypot(float(x), float(y)) <= 2.0f * trunk_cells;
    const Move move = stays ? Move{} : moves[std::size_t(quarter_of(x, y))];
    const std::array<int, 2> to = move.forward(x, y);
    cells.emplace_back((to[0] + last) / 2, (to[1] + last) / 2, cell.z);
    sources.push_back({i, move});
  }
  // Mirroring may bring two cells of the diagonal to one place: the first stays.
  std::vector<std::size_t> order(cells.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  const auto key = [&](std::size_t i) { return std::array<int, 3>{cells[i].z, cells[i].y, cells[i].x}; };
  std::ranges::stable_sort(order, {}, key);
  order.erase(std::unique(order.begin(), order.end(), [&](auto a, auto b) { return key(a) == key(b); }),
              order.end());
  BillboardTree result;
  std::vector<glm::u16vec3> kept;
  std::vector<Source> kept_sources;
  for (const std::size_t i : order)
    kept.push_back(cells[i]), kept_sources.push_back(sources[i]),
        result.base.push_back(tree.base[sources[i].cell]);
  Random random(seed, 911);
  const float wide = 1.0f + max_stretch * random.uniform(-1.0f, 1.0f),
              high = 1.0f + max_stretch * random.uniform(-1.0f, 1.0f);
  const Bounds box = grid.box();
  const glm::vec3 foot(box.centre().x, box.centre().y, box.min.z), stretch(wide, wide, high);
  result.grid = CellGrid({foot + stretch * (box.min - foot), foot + stretch * (box.max - foot)},
                         grid.branching(), grid.side(), std::move(kept));
  result.texels_per_side = tree.texels_per_side, result.light = tree.light;
  result.trunk = tree.trunk;
  if (result.trunk)
    for (Trunk::Ring& ring : result.trunk->trunk.rings)
      ring.centre = foot + stretch * (ring.centre - foot), ring.radius_m *= wide;
  const std::vector<float> before = light_of(tree), now = light_of(result);
  std::vector<float> factors;
  for (std::size_t i = 0; i < kept_sources.size(); ++i) {
    factors.push_back(std::clamp(now[i] / std::max(before[kept_sources[i].cell], 1e-6f), min_light_factor,
                                 max_light_factor));
    const glm::u8vec4 base = result.base[i];
    result.base[i] = glm::u8vec4(glm::vec4(lit(base, factors.back()), float(base.w)));
  }
  result.views.resize(tree.views.size());
  parallel_for(tree.views.size(), [&](std::size_t view) {
    result.views[view] = moved_textures(tree, view, kept_sources, factors);
    // As high or wide as the tree.
    glm::vec3& eye = result.views[view].camera.position_in_world;
    eye = foot + stretch * (eye - foot);
  });
  return result;
}

}  // namespace parvis::trees

#include "places/dressing/terrain_plane.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/median.h"
#include "base/mesh.h"
#include "places/dressing/ground_cover.h"

namespace parvis::dressing {
namespace {

constexpr float below_own_m = 0.25f;  // where the place's own ground begins, the terrain goes on beneath it
constexpr float below_level_m = 0.008f;  // the same where that ground is level: no step is to be seen
constexpr float overlap_cells = 2.5f, level_overlap_cells = 1.5f;  // of the two grounds
constexpr float below_cracks_m = 0.4f;                             // deep below the place's own ground
constexpr float uneven_below_m = 0.15f;                            // of cells there that are drawn as one
constexpr float even_m = 0.01f;                                    // heights of cells that are drawn as one
constexpr float straight_m = 0.6f;                     // of the edge of paved ground, across such cells
constexpr int max_block = 32;                          // cells on a side of such a block
constexpr int max_even_points = 15;                    // of an edge, one after the other
constexpr float paved_m = 14.0f;                       // from what is built
constexpr float closed_m = 14.0f;                      // paved ground has no holes so wide, nor twice that
constexpr float paved_wander_m = 6.0f;                 // of the edge of the paved ground
constexpr float far_sheets = 3.0f;                     // size of pictures far away: fewer repeats
constexpr float skirt_m = 2.0f, skirt_drop_m = 0.05f;  // of the land around, inward and down
constexpr float min_reach_radii = 3.0f;                // of the land, times the radius of the place
constexpr float min_reach_drops = 150.0f;              // and times the drop from the place's highest ground
constexpr float level_after_m = 700.0f;                // beyond the place
constexpr std::array ring_factors{1.0f, 1.06f, 1.15f, 1.3f, 1.6f, 2.2f, 3.4f, 6.0f, 12.0f, 30.0f, 80.0f};

/// A point of the terrain; `edge_m` is negative on paved ground, positive beyond it.
struct Corner {
  glm::vec3 position;
  float edge_m;
};

struct Layer {
  Mesh mesh;
  float sheet_m;
  void add(const Corner& corner) {
    mesh.indices.push_back(std::uint32_t(mesh.positions.size()));
    mesh.positions.push_back(corner.position);
    mesh.uvs.push_back(glm::vec2(corner.position.x, -corner.position.y) / sheet_m);
  }
};

/// Adds the part of a triangle on one side of the edge: paved ground where `side` is -1, the rest where it
/// is 1.
void add_clipped(Layer& layer, const std::array<Corner, 3>& triangle, float side) {
  std::vector<Corner> inside;
  for (std::size_t i = 0; i < 3; ++i) {
    const Corner &a = triangle[i], &b = triangle[(i + 1) % 3];
    const float at_a = side * a.edge_m, at_b = side * b.edge_m;
    if (at_a >= 0.0f) inside.push_back(a);
    if ((at_a >= 0.0f) != (at_b >= 0.0f))
      inside.push_back({glm::mix(a.position, b.position, at_a / (at_a - at_b)), 0.0f});
  }
  for (std::size_t i = 2; i < inside.size(); ++i)
    layer.add(inside[0]), layer.add(inside[i - 1]), layer.add(inside[i]);
}

/// Whether the heights around a cell are all the same.
bool is_level(const scene::PlaceHeights& place, int x, int y) {
  const scene::HeightRaster& heights = place.heights();
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx)
      if (heights.contains(x + dx, y + dy) &&
          std::abs(heights.at(x + dx, y + dy) - heights.at(x, y)) > 0.5f * even_m)
        return false;
  return true;
}

/// How far the terrain lies below the heights of the place in a cell.
float lowered_m(const scene::PlaceHeights& place, int x, int y) {
  if (!place.own_ground().at(x, y)) return 0.0f;
  return is_level(place, x, y) ? below_level_m : below_own_m;
}

/// Cells that two triangles show, from the corner `low` on.
struct CellBlock {
  glm::ivec2 low, size;
};

/// Whether the corners of a block lie as its own four do: at one height but for a tolerance, and on the same
/// side of the edge of paved ground but for `straight_m`.
template <class CornerAt>
bool is_even(const CellBlock& block, const CornerAt& corner, float tolerance_m) {
  const glm::ivec2 high = block.low + block.size;
  const Corner a = corner(block.low.x, block.low.y), b = corner(high.x, block.low.y),
               c = corner(high.x, high.y), d = corner(block.low.x, high.y);
  for (int y = block.low.y; y <= high.y; ++y)
    for (int x = block.low.x; x <= high.x; ++x) {
      const Corner each = corner(x, y);
      if (std::abs(each.position.z - a.position.z) > tolerance_m) return false;
      const glm::vec2 fraction = glm::vec2(x - block.low.x, y - block.low.y) / glm::vec2(block.size);
      const float edge_m =
          fraction.x > fraction.y  // as the two triangles have it
              ? glm::mix(a.edge_m, b.edge_m, fraction.x) + fraction.y * (c.edge_m - b.edge_m)
              : glm::mix(a.edge_m, d.edge_m, fraction.y) + fraction.x * (c.edge_m - d.edge_m);
      if ((each.edge_m < 0.0f) != (edge_m < 0.0f) && std::abs(each.edge_m) > straight_m) return false;
    }
  return true;
}

/// Divides all cells but covered ones into blocks: each is as long as it can be, then as wide; one cell may
/// be uneven.
template <class Covered, class CornerAt>
std::vector<CellBlock> even_blocks(glm::ivec2 cells, const Covered& is_covered, const CornerAt& corner,
                                   float tolerance_m) {
  std::vector<char> is_taken(std::size_t(cells.x) * std::size_t(cells.y), 0);
  const auto taken = [&](int x, int y) -> char& {
    return is_taken[std::size_t(y) * std::size_t(cells.x) + std::size_t(x)];
  };
  for (int y = 0; y < cells.y; ++y)
    for (int x = 0; x < cells.x; ++x) taken(x, y) = is_covered(x, y);
  const auto is_free = [&](const CellBlock& block) {
    const glm::ivec2 high = block.low + block.size;
    if (high.x > cells.x || high.y > cells.y) return false;
    for (int y = block.low.y; y < high.y; ++y)
      for (int x = block.low.x; x < high.x; ++x)
        if (taken(x, y)) return false;
    return true;
  };
  std::vector<CellBlock> blocks;
  for (int y = 0; y < cells.y; ++y)
    for (int x = 0; x < cells.x; ++x) {
      if (taken(x, y)) continue;
      CellBlock block{{x, y}, {1, 1}};
      for (const glm::ivec2 step : {glm::ivec2(1, 0), glm::ivec2(0, 1)})
        for (CellBlock larger{block.low, block.size + step};
             std::max(larger.size.x, larger.size.y) <= max_block && is_free(larger) &&
             is_even(larger, corner, tolerance_m);
             larger.size += step)
          block = larger;
      for (int dy = 0; dy < block.size.y; ++dy)
        for (int dx = 0; dx < block.size.x; ++dx) taken(x + dx, y + dy) = 1;
      blocks.push_back(block);
    }
  return blocks;
}

/// The lowest height of a block's corners and of those beside them.
float lowest_around(const scene::HeightRaster& heights, const CellBlock& block) {
  float lowest_m = heights.at(block.low.x, block.low.y);
  for (int y = block.low.y - 1; y <= block.low.y + block.size.y + 1; ++y)
    for (int x = block.low.x - 1; x <= block.low.x + block.size.x + 1; ++x)
      if (heights.contains(x, y)) lowest_m = std::min(lowest_m, heights.at(x, y));
  return lowest_m;
}

/// 1 where a block has a corner.
scene::Mask corners_of(const std::vector<CellBlock>& blocks, const scene::HeightRaster& heights) {
  scene::Mask is_vertex(heights, 0);
  for (const CellBlock& block : blocks)
    for (int k = 0; k < 4; ++k)
      is_vertex.at(block.low.x + (k % 2) * block.size.x, block.low.y + (k / 2) * block.size.y) = 1;
  return is_vertex;
}

/// The triangles of a block: two, or more where corners of its neighbours lie on its sides, so that there are
/// no cracks.
template <class CornerAt>
std::vector<std::array<Corner, 3>> triangles_of(const CellBlock& block, const scene::Mask& is_vertex,
                                                const CornerAt& corner) {
  std::vector<Corner> outline;  // counter-clockwise
  glm::ivec2 at = block.low;
  for (const glm::ivec2 step : {glm::ivec2(1, 0), glm::ivec2(0, 1), glm::ivec2(-1, 0), glm::ivec2(0, -1)})
    for (int i = 0; i < (step.x != 0 ? block.size.x : block.size.y); ++i, at += step)
      if (is_vertex.at(at.x, at.y)) outline.push_back(corner(at.x, at.y));
  if (outline.size() == 4)
    return {{outline[0], outline[1], outline[2]}, {outline[0], outline[2], outline[3]}};
  const glm::ivec2 high = block.low + block.size;
  const Corner a = corner(block.low.x, block.low.y), c = corner(high.x, high.y);
  const Corner middle{0.5f * (a.position + c.position), 0.5f * (a.edge_m + c.edge_m)};
  std::vector<std::array<Corner, 3>> triangles;
  triangles.reserve(outline.size());
  for (std::size_t i = 0; i < outline.size(); ++i)
    triangles.push_back({outline[i], outline[(i + 1) % outline.size()], middle});
  return triangles;
}

/// Ground is smooth: each point takes the slope of the heights there, not that of its triangle.
void fill_normals_from(const scene::PlaceHeights& place, Mesh& mesh) {
  const float step_m = place.heights().cell_m;
  mesh.normals.clear();
  for (const glm::vec3& p : mesh.positions) {
    const auto at = [&](float dx, float dy) { return place.at(glm::vec2(p) + step_m * glm::vec2(dx, dy)); };
    mesh.normals.push_back(
        glm::normalize(glm::vec3(at(-1, 0) - at(1, 0), at(0, -1) - at(0, 1), 2.0f * step_m)));
  }
}

void add_part(scene::Model& model, const std::string& object, const std::string& cover, Mesh mesh) {
  if (mesh.indices.empty()) return;
  scene::Part part;
  part.object = object;
  part.mesh = std::move(mesh);
  part.material = add_cover_material(model, cover);
  part.casts_shadow = false;
  model.parts.push_back(std::move(part));
}

/// The ring without points between others of the same height on a straight side: every 16th stays.
std::vector<glm::vec3> without_even_points(const std::vector<glm::vec3>& ring) {
  std::vector<glm::vec3> kept;
  int left_out = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const glm::vec3 &before = ring[(i + ring.size() - 1) % ring.size()], &after = ring[(i + 1) % ring.size()];
    const bool is_even =
        glm::distance(0.5f * (before + after), ring[i]) < even_m && left_out < max_even_points;
    left_out = is_even ? left_out + 1 : 0;
    if (!is_even) kept.push_back(ring[i]);
  }
  return kept;
}

}  // namespace

scene::Model near_terrain(const scene::PlaceHeights& place, const TerrainLook& look) {
  const scene::HeightRaster& heights = place.heights();
  const scene::GroundRaster<float> to_foreign = scene::distances_to(place.own_ground(), 0);
  const scene::GroundRaster<float> to_built = scene::distances_to(place.built(), 1);
  // Closed (dilated, then eroded), so that no lawns are left as blots between houses.
  scene::Mask grown(heights, 0);
  for (std::size_t i = 0; i < grown.cells.size(); ++i)
    grown.cells[i] = to_built.cells[i] < paved_m + closed_m;
  const scene::GroundRaster<float> to_lawn = scene::distances_to(grown, 0);
  const auto corner = [&](int x, int y) {
    const glm::vec2 p = heights.centre_of({x, y});
    const float wander = paved_wander_m * std::sin(0.11f * p.x + 2.0f * std::sin(0.07f * p.y)) *
                         std::sin(0.09f * p.y + 1.5f * std::sin(0.06f * p.x));
    return Corner{glm::vec3(p, heights.at(x, y) - lowered_m(place, x, y)),
                  closed_m - to_lawn.at(x, y) + wander};
  };
  Layer paved{{}, cover_sheet_m(look.surface)}, beyond{{}, cover_sheet_m(look.beyond)};
  const auto overlap = [&](int x, int y) {
    return (is_level(place, x, y) ? level_overlap_cells : overlap_cells) * heights.cell_m;
  };
  const auto is_deep = [&](int x, int y) { return to_foreign.at(x, y) > overlap(x, y); };
  const auto add = [&](const std::vector<CellBlock>& blocks, const auto& corner_at) {
    const scene::Mask is_vertex = corners_of(blocks, heights);
    for (const CellBlock& block : blocks)
      for (const std::array<Corner, 3>& triangle : triangles_of(block, is_vertex, corner_at)) {
        add_clipped(paved, triangle, -1.0f);
        add_clipped(beyond, triangle, 1.0f);
      }
  };
  const glm::ivec2 cells(heights.width - 1, heights.height - 1);
  add(even_blocks(cells, is_deep, corner, even_m), corner);
  // Models of towns have cracks between their own grounds: below these, too, lies something.
  const auto deep_corner = [&](int x, int y) {
    return Corner{glm::vec3(heights.centre_of({x, y}), heights.at(x, y) - below_cracks_m), -1.0f};
  };
  std::vector<CellBlock> below = even_blocks(
      cells, [&](int x, int y) { return !is_deep(x, y); }, deep_corner, uneven_below_m);
  // A bank takes level squares below its foot, so that nothing is seen of them where a trench has walls.
  const auto banks = std::ranges::partition(
      below, [&](const CellBlock& block) { return is_even(block, deep_corner, uneven_below_m); });
  add({below.begin(), banks.begin()}, deep_corner);
  for (const CellBlock& bank : banks) {
    const float z = lowest_around(heights, bank) - below_cracks_m;
    const auto level = [&](glm::ivec2 at) { return Corner{glm::vec3(heights.centre_of(at), z), -1.0f}; };
    const Corner a = level(bank.low), c = level(bank.low + bank.size);
    paved.add(a), paved.add(level({bank.low.x + bank.size.x, bank.low.y})), paved.add(c);
    paved.add(a), paved.add(c), paved.add(level({bank.low.x, bank.low.y + bank.size.y}));
  }
  scene::Model model;
  model.name = "terrain";
  for (Layer* layer : {&paved, &beyond}) fill_normals_from(place, layer->mesh);
  add_part(model, "TINRelief near", look.surface, std::move(paved.mesh));
  add_part(model, "TINRelief beyond", look.beyond, std::move(beyond.mesh));
  return model;
}

scene::Model land_around(const scene::PlaceHeights& place, const TerrainLook& look) {
  const scene::HeightRaster& heights = place.heights();
  const glm::ivec2 last(heights.width - 1, heights.height - 1);
  std::vector<glm::vec3> edge;  // counter-clockwise
  const auto add = [&](int x, int y) {
    edge.emplace_back(heights.centre_of({x, y}), heights.at(x, y) - lowered_m(place, x, y));
  };
  for (int x = 0; x < last.x; ++x) add(x, 0);
  for (int y = 0; y < last.y; ++y) add(last.x, y);
  for (int x = last.x; x > 0; --x) add(x, last.y);
  for (int y = last.y; y > 0; --y) add(0, y);
  edge = without_even_points(edge);

  const glm::vec2 middle = 0.5f * (heights.centre_of({0, 0}) + heights.centre_of(last));
  const float radius_m = glm::distance(middle, heights.centre_of(last));
  std::vector<float> edge_heights;
  edge_heights.reserve(edge.size());
  for (const glm::vec3& p : edge) edge_heights.push_back(p.z);
  const float level_m = median(std::move(edge_heights));

  Mesh mesh;
  const float sheet_m = far_sheets * cover_sheet_m(look.beyond);
  const std::uint32_t row = std::uint32_t(edge.size());
  std::uint32_t rings = 1;
  const float drop_m = *std::ranges::max_element(heights.cells) - level_m;
  const float reach_m = std::max({look.reach_m, min_reach_radii * radius_m, min_reach_drops * drop_m});
  for (const glm::vec3& p : edge) {  // below the rim of the near terrain, whose points are others
    const glm::vec2 at = glm::vec2(p) - skirt_m * glm::normalize(glm::vec2(p) - middle);
    mesh.positions.emplace_back(at, p.z - skirt_drop_m);
    mesh.uvs.push_back(glm::vec2(at.x, -at.y) / sheet_m);
  }
  for (const float factor : ring_factors) {
    const float reached_m = std::min(factor * radius_m, reach_m);
    for (const glm::vec3& p : edge) {
      const glm::vec2 out = glm::vec2(p) - middle;
      // from the rectangle to a circle
      const glm::vec2 at = middle + glm::mix(out * (reached_m / radius_m), glm::normalize(out) * reached_m,
                                             glm::smoothstep(1.0f, 3.0f, reached_m / radius_m));
      const float levelled = glm::smoothstep(0.0f, level_after_m, reached_m - radius_m);
      mesh.positions.emplace_back(at, glm::mix(p.z, level_m, levelled));
      mesh.uvs.push_back(glm::vec2(at.x, -at.y) / sheet_m);
    }
    if (++rings > 2 && reached_m >= reach_m) break;
  }
  for (std::uint32_t ring = 0; ring + 1 < rings; ++ring)
    for (std::uint32_t i = 0; i < row; ++i) {
      const std::uint32_t a = ring * row + i, b = ring * row + (i + 1) % row;
      mesh.indices.insert(mesh.indices.end(), {a, a + row, b, b, a + row, b + row});
    }
  fill_normals(mesh);

  scene::Model model;
  model.name = "land around";
  add_part(model, "TINRelief around", look.beyond, std::move(mesh));
  return model;
}

}  // namespace parvis::dressing

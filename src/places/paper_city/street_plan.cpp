#include "places/paper_city/street_plan.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"

namespace parvis::city {
namespace {

constexpr std::array<float, roads_each_way> north_road_x{-236.0f, -74.0f, 78.0f, 232.0f};
constexpr std::array<float, roads_each_way> east_road_y{-234.0f, -82.0f, 72.0f, 238.0f};
constexpr int wide_north_road = 1, wide_east_road = 2;
constexpr float corner_plot_m = 15.0f;
constexpr float row_depth_m = 12.0f;

bool is_park(int column, int row) { return (column == 2 && row == 2) || (column == 3 && row == 1); }

std::vector<Road> make_roads() {
  std::vector<Road> roads;
  roads.reserve(2 * roads_each_way);
  for (int i = 0; i < roads_each_way; ++i)
    roads.push_back({true, north_road_x[std::size_t(i)], i == wide_north_road ? wide_road : narrow_road});
  for (int i = 0; i < roads_each_way; ++i)
    roads.push_back({false, east_road_y[std::size_t(i)], i == wide_east_road ? wide_road : narrow_road});
  return roads;
}

Block make_block(const std::vector<Road>& roads, int column, int row) {
  const auto road = [&](int first, int i) -> const Road* {
    return i < 0 || i >= roads_each_way ? nullptr : &roads[std::size_t(first) + std::size_t(i)];
  };
  Block block;
  block.roads = {road(roads_each_way, row - 1), road(0, column), road(roads_each_way, row),
                 road(0, column - 1)};
  const auto edge = [](const Road* r, float outward) {
    return r ? r->offset_m - outward * r->profile.half_width_m() : outward * city_half_m;
  };
  block.min = {edge(block.roads[west], -1.0f), edge(block.roads[south], -1.0f)};
  block.max = {edge(block.roads[east], 1.0f), edge(block.roads[north], 1.0f)};
  block.is_park = is_park(column, row), block.column = column, block.row = row;
  return block;
}

/// The frame at corner `side`, along that side of the block.
Frame side_frame(const Block& block, int side) {
  constexpr std::array<glm::vec3, 4> directions{{{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}};
  const glm::vec2 corner = block.corner(side);
  return {{corner.x, corner.y, kerb_m}, directions[std::size_t(side)], directions[std::size_t(side + 1) % 4]};
}

/// Widths of a row's plots: 9 to 22 m, narrower in the middle of the city, adding up to `length_m`.
std::vector<float> plot_widths(float length_m, float mean_m, Random& random) {
  const int count = std::max(1, int(std::lround(length_m / mean_m)));
  std::vector<float> widths;
  float sum = 0.0f;
  for (int i = 0; i < count; ++i) widths.push_back(random.uniform(0.65f, 1.4f)), sum += widths.back();
  for (float& width : widths) width *= length_m / sum;
  return widths;
}

void add_row(const Block& block, int block_index, int side, Random& random, std::vector<Plot>& plots) {
  const Frame frame = side_frame(block, side);
  const glm::vec2 size = block.max - block.min;
  const float side_m = side % 2 == 0 ? size.x : size.y;
  const bool starts_at_corner = block.has_corner(side), ends_at_corner = block.has_corner((side + 1) % 4);
  const float start = starts_at_corner ? corner_plot_m : 0.0f,
              end = side_m - (ends_at_corner ? corner_plot_m : 0.0f);
  const glm::vec3 middle = frame.point(0.5f * side_m, 0.0f, 0.0f);
  const float mean_m = glm::length(glm::vec2(middle) - main_crossing()) < 260.0f ? 15.5f : 21.0f;
  float x = start;
  const std::vector<float> widths = plot_widths(end - start, mean_m, random);
  for (std::size_t i = 0; i < widths.size(); ++i) {
    Plot plot;
    plot.frame = frame, plot.frame.origin = frame.point(x, 0.0f, 0.0f);
    plot.width_m = widths[i], plot.depth_m = row_depth_m, plot.block = block_index;
    plot.has_left_neighbour = starts_at_corner || i > 0;
    plot.has_right_neighbour = ends_at_corner || i + 1 < widths.size();
    plots.push_back(plot), x += widths[i];
  }
  if (!ends_at_corner) return;
  Plot corner;
  corner.frame = frame, corner.frame.origin = frame.point(end, 0.0f, 0.0f);
  corner.width_m = corner.depth_m = corner_plot_m, corner.is_corner = true, corner.block = block_index;
  corner.has_left_neighbour = corner.has_right_neighbour = true;
  plots.push_back(corner);
}

}  // namespace

bool Block::has_corner(int i) const { return roads[std::size_t(i % 4)] && roads[std::size_t((i + 3) % 4)]; }

glm::vec2 Block::corner(int i) const {
  return {i % 4 == 0 || i % 4 == 3 ? min.x : max.x, i % 4 < 2 ? min.y : max.y};
}

glm::vec2 main_crossing() { return {north_road_x[wide_north_road], east_road_y[wide_east_road]}; }

StreetPlan make_street_plan(std::uint64_t seed) {
  Random random(seed, 1);
  StreetPlan plan;
  plan.roads = make_roads();
  for (int row = 0; row < blocks_each_way; ++row)
    for (int column = 0; column < blocks_each_way; ++column)
      plan.blocks.push_back(make_block(plan.roads, column, row));
  for (std::size_t i = 0; i < plan.blocks.size(); ++i)
    for (int side = 0; side < 4; ++side)
      if (plan.blocks[i].roads[std::size_t(side)] && !plan.blocks[i].is_park)
        add_row(plan.blocks[i], int(i), side, random, plan.plots);
  return plan;
}

}  // namespace parvis::city

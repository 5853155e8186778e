// Gaps are filled by pull-push interpolation (Gortler and others 1996: The lumigraph, section 3.4.1): known
// heights are averaged over ever coarser grids, and each unknown cell takes the height of the finest grid
// that knows one, interpolated. Departure: all weights are 0 or 1.
#include "land/heights/place_heights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/bounds.h"
#include "land/heights/city_surfaces.h"
#include "scene/data/path.h"
#include "scene/data/surroundings.h"

namespace parvis::scene {
namespace {

constexpr float finest_place_cell_m = 2.0f;
constexpr float max_place_cells = 60'000.0f;
constexpr float finest_foot_cell_m = 8.0f;          // in each the lowest point counts
constexpr float max_foot_cells = 4e6f;              // 16 x 16 km of the finest: beside a far model they widen
constexpr float foot_slope = 0.12f, flat_m = 0.1f;  // of steep streets: what stands higher is no foot
constexpr int foot_reach_cells = 6;                 // in which lower feet are looked for
constexpr int own_reach_cells = 2;                  // of one building's feet around its lowest
constexpr float own_uneven_m = 0.5f;                // between them
constexpr float min_shown_m = 2.0f;                 // of a building that stands in a pit, over the ground
constexpr float near_ground_m = 24.0f;              // of known ground: feet say nothing new there
constexpr float road_step_m = 2.0f;
constexpr float unknown_ground = std::numeric_limits<float>::quiet_NaN();

bool stands_still(const Scene& scene, const Object& object) {
  return !object.is_dynamic && object.is_visible && !surrounds_place(scene, object);
}

/// Calls use(a, b, c, is_ground) for the triangles of an object but its cellars', in the world.
template <class Use>
void each_triangle(const Object& object, const Use& use) {
  const std::vector<glm::mat4> pose = object.pose.empty() ? rest_pose(*object.model) : object.pose;
  for (const Part& part : object.model->parts) {
    if (is_below_ground(part.object)) continue;
    const glm::mat4 world_from_mesh = object.world_from_model * pose[std::size_t(part.node)];
    const auto corner = [&](std::size_t i) {
      return glm::vec3(world_from_mesh * glm::vec4(part.mesh.positions[part.mesh.indices[i]], 1.0f));
    };
    const bool is_of_ground = is_ground(part.object);
    for (std::size_t i = 0; i + 2 < part.mesh.indices.size(); i += 3)
      use(corner(i), corner(i + 1), corner(i + 2), is_of_ground);
  }
}

/// A grid of half the resolution, each cell the mean of the known ones of four.
HeightRaster halved(const HeightRaster& fine) {
  HeightRaster coarse((fine.width + 1) / 2, (fine.height + 1) / 2, 2.0f * fine.cell_m, fine.origin,
                      unknown_ground);
  for (int y = 0; y < coarse.height; ++y)
    for (int x = 0; x < coarse.width; ++x) {
      float sum = 0.0f;
      int count = 0;
      for (int k = 0; k < 4; ++k) {
        const int fx = 2 * x + k % 2, fy = 2 * y + k / 2;
        if (fine.contains(fx, fy) && !std::isnan(fine.at(fx, fy))) sum += fine.at(fx, fy), ++count;
      }
      if (count > 0) coarse.at(x, y) = sum / float(count);
    }
  return coarse;
}

void fill(HeightRaster& heights) {
  if (std::ranges::none_of(heights.cells, [](float height) { return std::isnan(height); })) return;
  if (heights.width == 1 && heights.height == 1) {
    heights.cells[0] = 0.0f;  // nothing is known anywhere
    return;
  }
  HeightRaster coarse = halved(heights);
  fill(coarse);
  for (int y = 0; y < heights.height; ++y)
    for (int x = 0; x < heights.width; ++x)
      if (float& height = heights.at(x, y); std::isnan(height))
        height = height_at(coarse, heights.centre_of({x, y})).value_or(0.0f);
}

/// Calls use(cell) for the cells of a raster that are at most so many from a cell, until it returns false.
template <class Use>
bool each_around(const HeightRaster& raster, glm::ivec2 middle, int reach, const Use& use) {
  for (int dy = -reach; dy <= reach; ++dy)
    for (int dx = -reach; dx <= reach; ++dx) {
      const glm::ivec2 cell = middle + glm::ivec2(dx, dy);
      if (raster.contains(cell.x, cell.y) && !std::isnan(raster.at(cell.x, cell.y)) && !use(cell))
        return false;
    }
  return true;
}

/// How high a foot at `cell` may lie over one at `other` on a steep street.
float max_rise_m(const HeightRaster& feet_m, glm::ivec2 cell, glm::ivec2 other) {
  return flat_m + foot_slope * feet_m.cell_m * glm::length(glm::vec2(cell - other));
}

/// Whether the lowest point of a cell is a foot, where those of the cells that `is_left_out` do not count.
template <class IsLeftOut>
bool is_foot(const HeightRaster& feet_m, glm::ivec2 cell, const IsLeftOut& is_left_out) {
  const float foot_m = feet_m.at(cell.x, cell.y);
  if (std::isnan(foot_m) || is_left_out(cell)) return false;
  return each_around(feet_m, cell, foot_reach_cells, [&](glm::ivec2 other) {
    return is_left_out(other) || foot_m <= feet_m.at(other.x, other.y) + max_rise_m(feet_m, cell, other);
  });
}

/// Marks the cells of a building that alone lies deeper than all around it, as one does whose cellar is a
/// part of its solid: on three sides stand others, more steeply above it than streets are, and none is half
/// as low. What would be buried but for less than two metres does stand in a dip of the ground.
void mark_pit(const HeightRaster& feet_m, const HeightRaster& tops_m, glm::ivec2 lowest, Mask& pits) {
  const float foot_m = feet_m.at(lowest.x, lowest.y);
  const auto is_own = [&](glm::ivec2 cell) {
    const glm::ivec2 away = glm::abs(cell - lowest);
    return std::max(away.x, away.y) <= own_reach_cells && feet_m.at(cell.x, cell.y) <= foot_m + own_uneven_m;
  };
  std::array<bool, 4> is_higher{};  // by quadrants
  float around_m = std::numeric_limits<float>::max();
  each_around(feet_m, lowest, foot_reach_cells, [&](glm::ivec2 cell) {
    const float other_m = feet_m.at(cell.x, cell.y);
    if (other_m <= foot_m + max_rise_m(feet_m, cell, lowest) || !is_foot(feet_m, cell, is_own)) return true;
    is_higher[std::size_t(cell.x >= lowest.x) + 2 * std::size_t(cell.y >= lowest.y)] = true;
    around_m = std::min(around_m, other_m);
    return true;
  });
  if (std::ranges::count(is_higher, true) < 3) return;
  const float half_m = 0.5f * (foot_m + around_m);
  const bool is_alone = each_around(feet_m, lowest, foot_reach_cells, [&](glm::ivec2 cell) {
    return is_own(cell) || feet_m.at(cell.x, cell.y) > half_m;
  });
  if (!is_alone) return;
  float top_m = foot_m;
  each_around(feet_m, lowest, own_reach_cells, [&](glm::ivec2 cell) {
    if (is_own(cell)) top_m = std::max(top_m, tops_m.at(cell.x, cell.y));
    return true;
  });
  if (top_m < around_m + min_shown_m) return;
  each_around(feet_m, lowest, own_reach_cells, [&](glm::ivec2 cell) {
    if (is_own(cell)) pits.at(cell.x, cell.y) = 1;
    return true;
  });
}

Mask pits_among(const HeightRaster& feet_m, const HeightRaster& tops_m) {
  Mask pits(feet_m, 0);
  const auto none = [](glm::ivec2) { return false; };
  for (int y = 0; y < feet_m.height; ++y)
    for (int x = 0; x < feet_m.width; ++x)
      if (is_foot(feet_m, {x, y}, none)) mark_pit(feet_m, tops_m, {x, y}, pits);
  return pits;
}

}  // namespace

PlaceHeights::PlaceHeights(const Scene& scene, std::span<const Road> roads, float margin_m) {
  Bounds bounds;
  for (const Object& object : scene.objects)
    if (stands_still(scene, object))
      bounds.add(transformed(object.world_from_model, scene::bounds(*object.model)));
  for (const Road& road : roads)
    for (const glm::vec3& point : road.path) bounds.add(point);
  if (bounds.empty()) bounds.add(glm::vec3(0.0f));
  const glm::vec2 size = glm::vec2(bounds.size()) + 2.0f * margin_m;
  const float cell_m = std::max(finest_place_cell_m, std::sqrt(size.x * size.y / max_place_cells));
  const glm::ivec2 cells = glm::ivec2(glm::ceil(size / cell_m)) + 1;
  heights_m_ = HeightRaster(cells.x, cells.y, cell_m, glm::vec2(bounds.min) - margin_m, unknown_ground);
  own_ground_ = Mask(heights_m_, 0);
  built_ = Mask(heights_m_, 0);

  const float foot_cell_m = std::max(finest_foot_cell_m, std::sqrt(size.x * size.y / max_foot_cells));
  const glm::ivec2 foot_cells = glm::ivec2(glm::ceil(size / foot_cell_m)) + 1;
  HeightRaster feet_m(foot_cells.x, foot_cells.y, foot_cell_m, heights_m_.origin, unknown_ground);
  HeightRaster tops_m = feet_m;
  for (const Object& object : scene.objects)
    if (stands_still(scene, object)) note_own_ground(object), note_feet(object, feet_m, tops_m);
  note_roads(roads);
  note_lowest(feet_m, tops_m);
  fill_gaps();
}

void PlaceHeights::note_own_ground(const Object& object) {
  each_triangle(object, [&](glm::vec3 a, glm::vec3 b, glm::vec3 c, bool is_of_ground) {
    if (!is_of_ground) return;
    each_height(heights_m_, a, b, c, [&](glm::ivec2 cell, float height_m) {
      float& known_m = heights_m_.at(cell.x, cell.y);
      if (!(known_m >= height_m)) known_m = height_m;
      own_ground_.at(cell.x, cell.y) = 1;
    });
  });
}

void PlaceHeights::note_feet(const Object& object, HeightRaster& feet_m, HeightRaster& tops_m) {
  each_triangle(object, [&](glm::vec3 a, glm::vec3 b, glm::vec3 c, bool is_of_ground) {
    if (is_of_ground) return;
    for (const glm::vec3& corner : {a, b, c}) {
      const glm::ivec2 foot = feet_m.cell_at(glm::vec2(corner)), cell = built_.cell_at(glm::vec2(corner));
      if (!feet_m.contains(foot.x, foot.y)) continue;
      float& lowest_m = feet_m.at(foot.x, foot.y);
      if (!(lowest_m <= corner.z)) lowest_m = corner.z;
      float& highest_m = tops_m.at(foot.x, foot.y);
      if (!(highest_m >= corner.z)) highest_m = corner.z;
      if (built_.contains(cell.x, cell.y)) built_.at(cell.x, cell.y) = 1;
    }
    const std::vector<std::vector<glm::vec3>> rings{{a, b, c}};
    for (const glm::ivec2 cell : cells_inside(built_, rings)) built_.at(cell.x, cell.y) = 1;
  });
}

void PlaceHeights::note_roads(std::span<const Road> roads) {
  for (const Road& road : roads) {
    if (road.path.size() < 2) continue;
    const MeasuredPath path(road.path);
    const int steps = std::max(1, int(std::ceil(path.length() / road_step_m)));
    for (int step = 0; step <= steps; ++step) {
      const glm::vec3 point = path.at(path.length() * float(step) / float(steps));
      const glm::ivec2 cell = heights_m_.cell_at(glm::vec2(point));
      if (!heights_m_.contains(cell.x, cell.y)) continue;
      float& known_m = heights_m_.at(cell.x, cell.y);
      if (std::isnan(known_m)) known_m = point.z;
    }
  }
}

/// The feet of buildings: points below which no other rises more steeply than a street. Far from known ground
/// they are the ground.
void PlaceHeights::note_lowest(const HeightRaster& feet_m, const HeightRaster& tops_m) {
  const GroundRaster<float> to_ground = distances_to(own_ground_, 1);
  const Mask pits = pits_among(feet_m, tops_m);
  for (int y = 0; y < feet_m.height; ++y)
    for (int x = 0; x < feet_m.width; ++x) {
      if (!is_foot(feet_m, {x, y}, [&](glm::ivec2 cell) { return pits.at(cell.x, cell.y) != 0; })) continue;
      const glm::ivec2 cell = heights_m_.cell_at(feet_m.centre_of({x, y}));
      if (!heights_m_.contains(cell.x, cell.y) || to_ground.at(cell.x, cell.y) < near_ground_m) continue;
      float& known_m = heights_m_.at(cell.x, cell.y);
      if (std::isnan(known_m)) known_m = feet_m.at(x, y);
    }
}

void PlaceHeights::fill_gaps() { fill(heights_m_); }

float PlaceHeights::at(glm::vec2 point) const {
  const glm::vec2 low = heights_m_.origin + 0.5f * heights_m_.cell_m;
  const glm::vec2 high = low + heights_m_.cell_m * (glm::vec2(heights_m_.width, heights_m_.height) - 1.0f);
  return height_at(heights_m_, glm::clamp(point, low, high)).value_or(0.0f);
}

}  // namespace parvis::scene

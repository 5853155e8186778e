// Gaps are filled by pull-push interpolation (Gortler and others 1996: The lumigraph, section 3.4.1): known
// heights are averaged over ever coarser grids, and each unknown cell takes the height of the finest grid
// that knows one, interpolated. Departure: all weights are 0 or 1.
#include "formats/terrain/place_heights.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/bounds.h"
#include "formats/terrain/city_surfaces.h"
#include "scene/data/path.h"
#include "scene/data/surroundings.h"

namespace parvis::scene {
namespace {

constexpr float finest_cell_m = 2.0f;
constexpr float max_cells = 60'000.0f;
constexpr float foot_cell_m = 8.0f;                 // in each the lowest point counts
constexpr float foot_slope = 0.12f, flat_m = 0.1f;  // of steep streets: what stands higher is no foot
constexpr int foot_reach_cells = 6;                 // in which lower feet are looked for
constexpr float near_ground_m = 24.0f;              // of known ground: feet say nothing new there
constexpr float road_step_m = 2.0f;
constexpr float unknown = std::numeric_limits<float>::quiet_NaN();

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
  HeightRaster coarse((fine.width + 1) / 2, (fine.height + 1) / 2, 2.0f * fine.cell_m, fine.origin, unknown);
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
  const float cell_m = std::max(finest_cell_m, std::sqrt(size.x * size.y / max_cells));
  const glm::ivec2 cells = glm::ivec2(glm::ceil(size / cell_m)) + 1;
  heights_m_ = HeightRaster(cells.x, cells.y, cell_m, glm::vec2(bounds.min) - margin_m, unknown);
  own_ground_ = Mask(heights_m_, 0);
  built_ = Mask(heights_m_, 0);

  const glm::ivec2 foot_cells = glm::ivec2(glm::ceil(size / foot_cell_m)) + 1;
  HeightRaster feet_m(foot_cells.x, foot_cells.y, foot_cell_m, heights_m_.origin, unknown);
  for (const Object& object : scene.objects)
    if (stands_still(scene, object)) note_own_ground(object), note_feet(object, feet_m);
  note_roads(roads);
  note_lowest(feet_m);
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

void PlaceHeights::note_feet(const Object& object, HeightRaster& feet_m) {
  each_triangle(object, [&](glm::vec3 a, glm::vec3 b, glm::vec3 c, bool is_of_ground) {
    if (is_of_ground) return;
    for (const glm::vec3& corner : {a, b, c}) {
      const glm::ivec2 foot = feet_m.cell_at(glm::vec2(corner)), cell = built_.cell_at(glm::vec2(corner));
      if (!feet_m.contains(foot.x, foot.y)) continue;
      float& lowest_m = feet_m.at(foot.x, foot.y);
      if (!(lowest_m <= corner.z)) lowest_m = corner.z;
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
void PlaceHeights::note_lowest(const HeightRaster& feet_m) {
  const GroundRaster<float> to_ground = distances_to(own_ground_, 1);
  for (int y = 0; y < feet_m.height; ++y)
    for (int x = 0; x < feet_m.width; ++x) {
      const float foot_m = feet_m.at(x, y);
      if (std::isnan(foot_m)) continue;
      bool is_foot = true;
      for (int dy = -foot_reach_cells; dy <= foot_reach_cells && is_foot; ++dy)
        for (int dx = -foot_reach_cells; dx <= foot_reach_cells && is_foot; ++dx)
          is_foot = !feet_m.contains(x + dx, y + dy) ||
                    !(foot_m > feet_m.at(x + dx, y + dy) + flat_m +
                                   foot_slope * foot_cell_m * std::hypot(float(dx), float(dy)));
      if (!is_foot) continue;
      const glm::ivec2 cell = heights_m_.cell_at(feet_m.centre_of({x, y}));
      if (!heights_m_.contains(cell.x, cell.y) || to_ground.at(cell.x, cell.y) < near_ground_m) continue;
      float& known_m = heights_m_.at(cell.x, cell.y);
      if (std::isnan(known_m)) known_m = foot_m;
    }
}

void PlaceHeights::fill_gaps() { fill(heights_m_); }

float PlaceHeights::at(glm::vec2 point) const {
  const glm::vec2 low = heights_m_.origin + 0.5f * heights_m_.cell_m;
  const glm::vec2 high = low + heights_m_.cell_m * (glm::vec2(heights_m_.width, heights_m_.height) - 1.0f);
  return height_at(heights_m_, glm::clamp(point, low, high)).value_or(0.0f);
}

}  // namespace parvis::scene

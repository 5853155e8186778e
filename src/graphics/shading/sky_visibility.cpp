#include "graphics/shading/sky_visibility.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "base/parallel.h"

namespace parvis::shading {
namespace {

constexpr glm::vec3 cell_size_m{4.0f, 4.0f, 3.0f};
constexpr float max_cells = 2e6f;
constexpr int max_side = 2048;  // what OpenGL 4.5 promises of 3D textures
constexpr int directions = 12;
constexpr std::array<float, 10> distances_m{1.5f,  3.0f,  5.0f,  7.5f,  11.0f,
                                            16.0f, 23.0f, 33.0f, 48.0f, sky_visibility_reach_m};

/// Walls reflect some of the light that they keep off: an albedo of city walls, themselves lit by the open
/// share.
constexpr float wall_albedo = 0.35f;

/// Integrals of the sky's visibility over the upper hemisphere: of 1 and of the direction.
struct OpenSky {
  float solid_angle = 0.0f;
  vec3 direction{0.0f};

  /// A sector about azimuth `u` is open above the elevation whose tangent is `horizon`.
  void add_sector(glm::vec2 u, float horizon) {
    constexpr float width = 2.0f * glm::pi<float>() / float(directions);
    const float elevation = std::atan(std::max(horizon, 0.0f));
    const float s = std::sin(elevation), c = std::cos(elevation);
    solid_angle += width * (1.0f - s);
    direction += width * vec3(0.5f * (0.5f * glm::pi<float>() - elevation - s * c) * u, 0.5f * c * c);
  }

  /// The stored cell: hidden directions show walls and those below the horizon show ground, both lit by the
  /// same sky.
  vec4 cell(WallLight walls) const {
    if (walls == WallLight::none)
      return vec4(direction / (2.0f * glm::pi<float>()) + vec3(0.5f),
                  solid_angle / (4.0f * glm::pi<float>()));
    const float open = solid_angle / (2.0f * glm::pi<float>());
    const float wall = wall_albedo * open;
    const vec3 up(0.0f, 0.0f, glm::pi<float>());
    const float mean =
        (solid_angle + wall * (2.0f * glm::pi<float>() - solid_angle) + open * 2.0f * glm::pi<float>()) /
        (4.0f * glm::pi<float>());
    const vec3 along = (direction + wall * (up - direction) - open * up) / (2.0f * glm::pi<float>());
    return vec4(along + vec3(0.5f), mean);
  }
};

struct Grid {
  glm::ivec3 cells;
  glm::ivec2 first{0};  ///< column of a larger grid at which this one begins
  vec3 origin, cell_m;
  std::vector<vec4> values;
  std::vector<std::uint8_t> is_air;

  std::size_t index(int x, int y, int z) const {
    return (std::size_t(z) * std::size_t(cells.y) + std::size_t(y)) * std::size_t(cells.x) + std::size_t(x);
  }
};

/// The grid of a place, without its cells' values.
Grid layout(const Bounds& bounds) {
  Grid grid;
  // A cell of margin all round and above the roofs.
  grid.cell_m = cell_size_m;
  grid.origin = bounds.min - vec3(grid.cell_m.x, grid.cell_m.y, 0.0f);
  const vec3 size = bounds.max + grid.cell_m - grid.origin;
  const float wanted = (size.x / grid.cell_m.x) * (size.y / grid.cell_m.y) * (size.z / grid.cell_m.z);
  if (wanted > max_cells) grid.cell_m *= std::cbrt(wanted / max_cells);
  // A road of many kilometres has few cells and yet more in a row than a texture may have.
  grid.cell_m = glm::max(grid.cell_m, size / float(max_side - 1));
  grid.cells = glm::max(glm::ivec3(glm::ceil(size / grid.cell_m)), glm::ivec3(1));
  return grid;
}

void fill_column(Grid& grid, const Heightfield& heights, WallLight walls, int x, int y) {
  const glm::vec2 centre =
      glm::vec2(grid.origin) + (glm::vec2(grid.first + glm::ivec2(x, y)) + 0.5f) * glm::vec2(grid.cell_m);
  std::array<glm::vec2, directions> azimuths;
  std::array<std::array<float, distances_m.size()>, directions> surroundings;
  for (std::size_t d = 0; d < directions; ++d) {
    const float angle = 2.0f * glm::pi<float>() * (float(d) + 0.5f) / float(directions);
    azimuths[d] = {std::cos(angle), std::sin(angle)};
    for (std::size_t i = 0; i < distances_m.size(); ++i)
      surroundings[d][i] = heights.height_m(centre + distances_m[i] * azimuths[d]);
  }
  const float floor_m = heights.height_m(centre);
  for (int z = 0; z < grid.cells.z; ++z) {
    const float eye_m = grid.origin.z + (float(z) + 0.5f) * grid.cell_m.z;
    OpenSky sky;
    for (std::size_t d = 0; d < directions; ++d) {
      float horizon = 0.0f;
      for (std::size_t i = 0; i < distances_m.size(); ++i)
        horizon = std::max(horizon, (surroundings[d][i] - eye_m) / distances_m[i]);
      sky.add_sector(azimuths[d], horizon);
    }
    const std::size_t cell = grid.index(x, y, z);
    grid.values[cell] = sky.cell(walls);
    grid.is_air[cell] = eye_m > floor_m;
  }
}

/// Cells within buildings take the mean of the air beside them: filtering then does not darken the walls'
/// outsides.
void fill_solid_cells(Grid& grid) {
  const std::vector<vec4> values = grid.values;
  parallel_for(std::size_t(grid.cells.z), [&](std::size_t layer) {
    const int z = int(layer);
    for (int y = 0; y < grid.cells.y; ++y)
      for (int x = 0; x < grid.cells.x; ++x) {
        if (grid.is_air[grid.index(x, y, z)]) continue;
        vec4 sum(0.0f);
        float count = 0.0f;
        for (int dy = -1; dy <= 1; ++dy)
          for (int dx = -1; dx <= 1; ++dx) {
            const std::size_t beside = grid.index(std::clamp(x + dx, 0, grid.cells.x - 1),
                                                  std::clamp(y + dy, 0, grid.cells.y - 1), z);
            if (grid.is_air[beside]) sum += values[beside], count += 1.0f;
          }
        if (count > 0.0f) grid.values[grid.index(x, y, z)] = sum / count;
      }
  });
}

void fill(Grid& grid, const Heightfield& heights, WallLight walls) {
  const std::size_t count = grid.index(0, 0, grid.cells.z);
  grid.values.assign(count, vec4(0.0f));
  grid.is_air.assign(count, 0);
  parallel_for(std::size_t(grid.cells.y), [&](std::size_t y) {
    for (int x = 0; x < grid.cells.x; ++x) fill_column(grid, heights, walls, x, int(y));
  });
  fill_solid_cells(grid);
}

void store(const vec4& value, std::uint8_t* four_bytes) {
  for (int c = 0; c < 4; ++c)
    four_bytes[c] = std::uint8_t(std::lround(255.0f * std::clamp(value[c], 0.0f, 1.0f)));
}

}  // namespace

SkyVisibility make_sky_visibility(const Heightfield& heights, WallLight walls) {
  if (heights.bounds().empty()) return {};
  Grid grid = layout(heights.bounds());
  fill(grid, heights, walls);

  SkyVisibility result;
  result.grid = {grid.origin, grid.cell_m * vec3(grid.cells), 0.5f * std::min(grid.cell_m.x, grid.cell_m.y)};
  result.cells = grid.cells;
  result.values.resize(4 * grid.values.size());
  for (std::size_t i = 0; i < grid.values.size(); ++i) store(grid.values[i], &result.values[4 * i]);
  return result;
}

void renew_sky_visibility(SkyVisibility& visibility, const Heightfield& heights, const Bounds& changed,
                          WallLight walls) {
  if (heights.bounds().empty()) return;
  const Grid whole = layout(heights.bounds());
  if (whole.cells != visibility.cells || whole.origin != visibility.grid.origin) {
    visibility = make_sky_visibility(heights, walls);
    return;
  }
  // A change is seen from as far as horizons are looked for; a margin of one cell feeds the solid ones.
  const glm::ivec2 reach(glm::ceil(glm::vec2(distances_m.back()) / glm::vec2(whole.cell_m)));
  const glm::ivec2 last = glm::ivec2(whole.cells) - 1;
  const auto cell_of = [&](vec3 point) {
    return glm::ivec2(glm::floor((glm::vec2(point) - glm::vec2(whole.origin)) / glm::vec2(whole.cell_m)));
  };
  const glm::ivec2 low = glm::clamp(cell_of(changed.min) - reach, glm::ivec2(0), last);
  const glm::ivec2 high = glm::clamp(cell_of(changed.max) + reach, glm::ivec2(0), last);
  const glm::ivec2 first = glm::max(low - 1, glm::ivec2(0)), end = glm::min(high + 1, last) + 1;

  Grid part = whole;
  part.cells = glm::ivec3(end - first, whole.cells.z);
  part.first = first;
  fill(part, heights, walls);
  for (int z = 0; z < whole.cells.z; ++z)
    for (int y = low.y; y <= high.y; ++y)
      for (int x = low.x; x <= high.x; ++x)
        store(part.values[part.index(x - first.x, y - first.y, z)],
              &visibility.values[4 * whole.index(x, y, z)]);
}

vec4 SkyVisibility::at(vec3 coordinates) const {
  const vec3 p = coordinates * vec3(cells) - vec3(0.5f);
  const glm::ivec3 low(floor(p));
  const vec3 share = p - vec3(low);
  vec4 sum(0.0f);
  for (int corner = 0; corner < 8; ++corner) {
    const glm::ivec3 step(corner & 1, (corner >> 1) & 1, corner >> 2);
    const glm::ivec3 cell = glm::clamp(low + step, glm::ivec3(0), cells - 1);
    const vec3 weights = glm::mix(vec3(1.0f) - share, share, vec3(step));
    const std::size_t index =
        4 * ((std::size_t(cell.z) * std::size_t(cells.y) + std::size_t(cell.y)) * std::size_t(cells.x) +
             std::size_t(cell.x));
    const vec4 value(values[index], values[index + 1], values[index + 2], values[index + 3]);
    sum += weights.x * weights.y * weights.z / 255.0f * value;
  }
  return sum;
}

}  // namespace parvis::shading

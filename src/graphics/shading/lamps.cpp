#include "graphics/shading/lamps.h"

#include <algorithm>
#include <cmath>

namespace parvis::shading {
namespace {

constexpr float wanted_cell_m = 6.0f;
constexpr float max_lamp_cells = 256.0f;

float brightness(const Lamp& lamp) { return lamp.power.x + lamp.power.y + lamp.power.z; }

/// Brightness of a lamp at the ground of a cell, for choosing the strongest.
float strength(const Lamp& lamp, vec2 middle) {
  const vec2 away = middle - vec2(lamp.place);
  return brightness(lamp) / (1.0f + dot(away, away));
}

}  // namespace

uvec4 LampTable::cell(vec3 position) const {
  const glm::ivec2 at(floor((vec2(position) - corner) / cell_m));
  if (at.x < 0 || at.y < 0 || at.x >= cells.x || at.y >= cells.y) return uvec4(0u);
  return near[std::size_t(at.y) * std::size_t(cells.x) + std::size_t(at.x)];
}

float LampTable::visible(const Lamp& lamp, vec3 position, vec3 geometric_normal) const {
  if (lamp.power.w < 0.5f) return 1.0f;
  const vec4 at = lamp_map_coordinates(lamp, position, geometric_normal);
  constexpr int side = lamp_map_px;
  const std::uint16_t* map = depths.data() + std::size_t(at.z) * std::size_t(side) * std::size_t(side);
  const vec2 texel = float(side) * vec2(at) - vec2(0.5f), low = floor(texel), part = texel - low;
  float share = 0.0f;
  for (int corner_number = 0; corner_number < 4; ++corner_number) {
    const glm::ivec2 step(corner_number & 1, corner_number >> 1);
    const glm::ivec2 p = glm::clamp(glm::ivec2(low) + step, glm::ivec2(0), glm::ivec2(side - 1));
    const float weight = (step.x ? part.x : 1.0f - part.x) * (step.y ? part.y : 1.0f - part.y);
    share += at.w <= float(map[p.y * side + p.x]) / 65535.0f ? weight : 0.0f;
  }
  return share;
}

LampTable make_lamp_table(std::vector<Lamp> lamps) {
  LampTable table;
  if (lamps.size() > max_lamps) lamps.resize(max_lamps);
  if (lamps.empty()) return table;
  table.lamps = std::move(lamps);
  vec2 low(1e30f), high(-1e30f);
  for (const Lamp& lamp : table.lamps) {
    low = min(low, vec2(lamp.place) - lamp.place.w);
    high = max(high, vec2(lamp.place) + lamp.place.w);
  }
  const vec2 size = high - low;
  table.corner = low;
  table.cell_m = std::max(wanted_cell_m, std::max(size.x, size.y) / max_lamp_cells);
  table.cells = glm::ivec2(glm::ceil(size / table.cell_m));

  struct Reached {
    float strength;
    std::uint32_t number;
  };
  std::vector<std::vector<Reached>> reached(std::size_t(table.cells.x) * std::size_t(table.cells.y));
  for (std::size_t i = 0; i < table.lamps.size(); ++i) {
    const Lamp& lamp = table.lamps[i];
    const vec2 place(lamp.place);
    const glm::ivec2 first(floor((place - lamp.place.w - low) / table.cell_m)),
        last(floor((place + lamp.place.w - low) / table.cell_m));
    for (int y = std::max(first.y, 0); y <= std::min(last.y, table.cells.y - 1); ++y)
      for (int x = std::max(first.x, 0); x <= std::min(last.x, table.cells.x - 1); ++x) {
        const vec2 corner = low + table.cell_m * vec2(x, y);
        const vec2 nearest = clamp(place, corner, corner + table.cell_m);
        if (length(nearest - place) > lamp.place.w) continue;
        reached[std::size_t(y) * std::size_t(table.cells.x) + std::size_t(x)].push_back(
            {strength(lamp, corner + 0.5f * table.cell_m), std::uint32_t(i)});
      }
  }
  table.near.assign(reached.size(), uvec4(0u));
  for (std::size_t c = 0; c < reached.size(); ++c) {
    std::ranges::sort(reached[c], [](const Reached& a, const Reached& b) {
      return a.strength != b.strength ? a.strength > b.strength : a.number < b.number;
    });
    const std::size_t count = std::min(reached[c].size(), std::size_t(max_lamps_per_cell));
    for (std::size_t k = 0; k < count; ++k)
      table.near[c][int(k / 2)] |= (reached[c][k].number + 1) << (16 * (k % 2));
  }
  return table;
}

}  // namespace parvis::shading

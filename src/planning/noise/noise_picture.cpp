#include "planning/noise/noise_picture.h"

#include <algorithm>
#include <cmath>

#include "base/image_text.h"

namespace parvis::noise {
namespace {

constexpr int wanted_px = 1200, max_cell_px = 16, margin_px = 24, swatch_px = 22, text_px = 17, gap_px = 10;
constexpr int min_width_px = 560;  // of the scale
constexpr glm::u8vec3 ink{40, 40, 44}, building{176, 176, 180};

void fill_box(Image8& picture, glm::ivec2 from, glm::ivec2 to, glm::u8vec3 colour) {
  for (int y = std::max(from.y, 0); y < std::min(to.y, picture.height); ++y)
    for (int x = std::max(from.x, 0); x < std::min(to.x, picture.width); ++x)
      for (int c = 0; c < 3; ++c) picture.at(x, y)[c] = colour[c];
}

void draw_scale(Image8& picture, glm::ivec2 at, int width, std::span<const ScaleStep> scale) {
  const int step_px = width / int(scale.size());
  for (std::size_t i = 0; i < scale.size(); ++i) {
    const int left = at.x + int(i) * step_px;
    fill_box(picture, {left, at.y}, {left + step_px, at.y + swatch_px}, scale[i].colour);
    const std::string label =
        i == 0 ? fmt::format("< {:g}", scale[1].from) : fmt::format("{:g}", scale[i].from);
    write_text(picture, {left, at.y + swatch_px + gap_px + text_px / 2}, label, text_px, ink);
  }
}

/// A bar of 1, 2 or 5 times a power of ten metres, at most a quarter of the map's width.
void draw_bar(Image8& picture, glm::ivec2 right, const NoiseMap& map, int cell_px) {
  const double longest_m = 0.25 * map.columns * map.cell_m,
               power = std::pow(10.0, std::floor(std::log10(longest_m)));
  const double metres = power * (longest_m >= 5.0 * power ? 5.0 : longest_m >= 2.0 * power ? 2.0 : 1.0);
  const int length_px = std::max(2, int(std::lround(metres / map.cell_m * cell_px)));
  const std::string label = fmt::format("{:g} m", metres);
  fill_box(picture, right - glm::ivec2(length_px, 3), right, ink);
  write_text(picture, right - glm::ivec2(text_width(label, text_px), gap_px), label, text_px, ink);
}

}  // namespace

glm::u8vec3 colour_of_value(double value, std::span<const ScaleStep> scale) {
  glm::u8vec3 colour = scale.front().colour;
  for (const ScaleStep& step : scale)
    if (value >= step.from) colour = step.colour;
  return colour;
}

std::span<const ScaleStep> level_scale() {
  static constexpr ScaleStep steps[]{{0, {226, 240, 226}},  {35, {190, 220, 190}}, {40, {140, 190, 150}},
                                     {45, {250, 235, 150}}, {50, {248, 200, 90}},  {55, {240, 150, 60}},
                                     {60, {222, 80, 60}},   {65, {180, 30, 60}},   {70, {120, 20, 90}},
                                     {75, {50, 20, 90}}};
  return steps;
}

std::span<const ScaleStep> difference_scale() {
  static constexpr ScaleStep steps[]{{-1e3, {33, 80, 160}}, {-6, {80, 130, 200}},    {-3, {140, 180, 225}},
                                     {-1, {200, 220, 240}}, {-0.1, {242, 242, 242}}, {0.1, {250, 220, 205}},
                                     {1, {244, 170, 140}},  {3, {214, 96, 77}},      {6, {150, 20, 40}}};
  return steps;
}

Image8 noise_picture(const NoiseMap& map, const std::string& title, std::span<const ScaleStep> scale,
                     const std::function<std::optional<double>(int, int)>& value) {
  const int cell_px = std::clamp(wanted_px / std::max(map.columns, map.rows), 1, max_cell_px);
  const glm::ivec2 size = cell_px * glm::ivec2(map.columns, map.rows);
  const int width = std::max(size.x, min_width_px);
  const int scale_y = margin_px + size.y + margin_px + text_px + gap_px;
  Image8 picture(width + 2 * margin_px, scale_y + swatch_px + gap_px + text_px + margin_px, 4, 255);
  const glm::ivec2 corner(margin_px + (width - size.x) / 2, margin_px);
  for (int row = 0; row < map.rows; ++row)
    for (int column = 0; column < map.columns; ++column) {
      const glm::ivec2 at = corner + cell_px * glm::ivec2(column, map.rows - 1 - row);
      const std::optional<double> here = value(column, row);
      fill_box(picture, at, at + cell_px, here ? colour_of_value(*here, scale) : building);
    }
  write_text(picture, {margin_px, scale_y - gap_px}, title, text_px, ink);
  draw_scale(picture, {margin_px, scale_y}, width, scale);
  draw_bar(picture, {margin_px + width, scale_y - gap_px}, map, cell_px);
  return picture;
}

}  // namespace parvis::noise

#include "synthesis/lettering.h"

#include <array>
#include <cmath>
#include <cstdint>

namespace parvis::synthesis {
namespace {

constexpr int glyph_columns = 5, glyph_rows = 7, advance_columns = 6;

using Glyph = std::array<std::uint8_t, glyph_columns>;  // one byte a column, lowest bit at the top

constexpr std::array<Glyph, 26> letters{{
    {0x7c, 0x12, 0x11, 0x12, 0x7c}, {0x7f, 0x49, 0x49, 0x49, 0x36}, {0x3e, 0x41, 0x41, 0x41, 0x22},
    {0x7f, 0x41, 0x41, 0x22, 0x1c}, {0x7f, 0x49, 0x49, 0x49, 0x41}, {0x7f, 0x09, 0x09, 0x09, 0x01},
    {0x3e, 0x41, 0x41, 0x51, 0x32}, {0x7f, 0x08, 0x08, 0x08, 0x7f}, {0x00, 0x41, 0x7f, 0x41, 0x00},
    {0x20, 0x40, 0x41, 0x3f, 0x01}, {0x7f, 0x08, 0x14, 0x22, 0x41}, {0x7f, 0x40, 0x40, 0x40, 0x40},
    {0x7f, 0x02, 0x1c, 0x02, 0x7f}, {0x7f, 0x04, 0x08, 0x10, 0x7f}, {0x3e, 0x41, 0x41, 0x41, 0x3e},
    {0x7f, 0x09, 0x09, 0x09, 0x06}, {0x3e, 0x41, 0x51, 0x21, 0x5e}, {0x7f, 0x09, 0x19, 0x29, 0x46},
    {0x26, 0x49, 0x49, 0x49, 0x32}, {0x01, 0x01, 0x7f, 0x01, 0x01}, {0x3f, 0x40, 0x40, 0x40, 0x3f},
    {0x1f, 0x20, 0x40, 0x20, 0x1f}, {0x3f, 0x40, 0x38, 0x40, 0x3f}, {0x63, 0x14, 0x08, 0x14, 0x63},
    {0x03, 0x04, 0x78, 0x04, 0x03}, {0x61, 0x51, 0x49, 0x45, 0x43},
}};
constexpr std::array<Glyph, 10> digits{{
    {0x3e, 0x51, 0x49, 0x45, 0x3e},
    {0x00, 0x42, 0x7f, 0x40, 0x00},
    {0x42, 0x61, 0x51, 0x49, 0x46},
    {0x21, 0x41, 0x45, 0x4b, 0x31},
    {0x18, 0x14, 0x12, 0x7f, 0x10},
    {0x27, 0x45, 0x45, 0x45, 0x39},
    {0x3c, 0x4a, 0x49, 0x49, 0x30},
    {0x01, 0x71, 0x09, 0x05, 0x03},
    {0x36, 0x49, 0x49, 0x49, 0x36},
    {0x06, 0x49, 0x49, 0x29, 0x1e},
}};

Glyph glyph_of(char c) {
  if (c >= 'A' && c <= 'Z') return letters[std::size_t(c - 'A')];
  if (c >= '0' && c <= '9') return digits[std::size_t(c - '0')];
  return {};
}

float dot(const Glyph& glyph, int column, int row) {
  if (column < 0 || column >= glyph_columns || row < 0 || row >= glyph_rows) return 0.0f;
  return float((glyph[std::size_t(column)] >> row) & 1);
}

/// Ink at a place in dots from the glyph's top left: the dots joined and rounded by bilinear interpolation.
float ink(const Glyph& glyph, float x, float y) {
  const float column = std::floor(x - 0.5f), row = std::floor(y - 0.5f);
  const float tx = x - 0.5f - column, ty = y - 0.5f - row;
  const int i = int(column), j = int(row);
  const float value = glm::mix(glm::mix(dot(glyph, i, j), dot(glyph, i + 1, j), tx),
                               glm::mix(dot(glyph, i, j + 1), dot(glyph, i + 1, j + 1), tx), ty);
  return glm::smoothstep(0.38f, 0.54f, value);
}

}  // namespace

float lettering_width(std::string_view text, float height_m) {
  const int columns = int(text.size()) * advance_columns - (advance_columns - glyph_columns);
  return height_m / float(glyph_rows) * float(std::max(columns, 0));
}

void paint_lettering(SurfaceCanvas& canvas, std::string_view text, float x_m, float y_m, float height_m,
                     const Texel& material) {
  const float dot_m = height_m / float(glyph_rows);
  for (std::size_t i = 0; i < text.size(); ++i) {
    const Glyph glyph = glyph_of(text[i]);
    const float left = x_m + float(i) * dot_m * float(advance_columns);
    const Rect cell{left - dot_m, y_m - dot_m, left + dot_m * float(advance_columns), y_m + height_m + dot_m};
    canvas.paint(cell, [&](float x, float y, Texel& t) {
      const float share = ink(glyph, (x - left) / dot_m, (y_m + height_m - y) / dot_m);
      t.colour = glm::mix(t.colour, material.colour, share);
      t.height_m = glm::mix(t.height_m, t.height_m + material.height_m, share);
      t.roughness = glm::mix(t.roughness, material.roughness, share);
      t.metallic = glm::mix(t.metallic, material.metallic, share);
    });
  }
}

}  // namespace parvis::synthesis

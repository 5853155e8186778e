#include "places/dressing/brick_texture.h"

#include <cmath>

#include "base/colour.h"
#include "base/random.h"
#include "places/dressing/street_level_texture.h"
#include "synthesis/wall_texture.h"
#include "synthesis/window_texture.h"

namespace parvis::dressing {
namespace {

using synthesis::SurfaceCanvas, synthesis::SurfacePictures, synthesis::Texel, synthesis::Wall,
    synthesis::WindowStyle, synthesis::paint_wall, synthesis::paint_window;

constexpr int sheet_px = 1024;
WindowStyle window_style() {
  WindowStyle style;
  style.width_m = 1.2f, style.height_m = 1.85f, style.foot_m = 0.72f;
  style.panes_across = 1, style.panes_up = 2, style.surround_m = 0.0f;
  style.trim = linear_from_srgb8(0xB4, 0xAE, 0xA2), style.frame = linear_from_srgb8(0xE2, 0xDF, 0xD6);
  return style;
}

/// While painting, alpha is the fraction that is not brick and keeps its colour: mortar, which is greyer.
void mark_bricks(Texel& t) {
  t.alpha = glm::smoothstep(0.45f, 0.7f, t.colour.z / t.colour.x);
  t.colour *= 1.0f - 0.45f * t.alpha;
}

void paint_storeys(SurfaceCanvas& canvas, Random& random) {
  const WindowStyle style = window_style();
  for (int storey = 0; storey < brick_storeys; ++storey)
    for (int bay = 0; bay < brick_bays; ++bay) {
      const float x_m = brick_bay_m * (float(bay) + 0.5f), floor_m = brick_storey_m * float(storey);
      paint_brick_lintel(canvas, x_m, floor_m + style.foot_m + style.height_m, 0.5f * style.width_m + 0.08f);
      paint_window(canvas, style, x_m, floor_m, random);
    }
}

}  // namespace

glm::vec3 painted_brick() { return {0.30f, 0.16f, 0.105f}; }

std::array<glm::vec3, brick_colour_count> brick_colours() {
  return {linear_from_srgb8(0x97, 0x5D, 0x4A), linear_from_srgb8(0xA8, 0x7A, 0x5E),
          linear_from_srgb8(0x7C, 0x52, 0x44), linear_from_srgb8(0xBC, 0x9B, 0x79),
          linear_from_srgb8(0xC9, 0xBF, 0xAC)};
}

void paint_bricks(SurfaceCanvas& canvas, std::uint32_t seed) {
  paint_wall(canvas, Wall::brick, painted_brick(), seed);
  canvas.paint_all([](float, float, Texel& t) { mark_bricks(t); });
}

Image8 in_colour(const Image8& painted, glm::vec3 factor) {
  Image8 result = painted;
  const std::size_t pixels = painted.pixels.size() / 4;
  for (std::size_t i = 0; i < pixels; ++i) {
    const std::uint8_t* from = painted.pixels.data() + 4 * i;
    std::uint8_t* to = result.pixels.data() + 4 * i;
    to[3] = 255;
    if (from[3] == 255) continue;
    const float own = float(from[3]) / 255.0f;
    for (int c = 0; c < 3; ++c) {
      const float tinted =
          glm::mix(srgb_from_linear(factor[c]), 1.0f, own);  // a factor of light is one of sRGB, nearly
      to[c] = std::uint8_t(std::min(255.0f, float(from[c]) * tinted + 0.5f));
    }
  }
  return result;
}

void paint_brick_lintel(SurfaceCanvas& canvas, float x_m, float top_m, float half_m) {
  canvas.paint({x_m - half_m, top_m, x_m + half_m, top_m + 0.22f}, [&](float x, float y, Texel& t) {
    const float along = (x - x_m + half_m) / 0.0625f, place = along - std::floor(along);
    const bool is_joint = place < 0.17f || y - top_m > 0.21f;
    const float tone = 0.82f + 0.3f * (0.5f + 0.5f * std::sin(12.9898f * std::floor(along)));
    t.colour = is_joint ? glm::vec3(0.22f, 0.2f, 0.17f) : tone * painted_brick();
    t.alpha = is_joint ? 1.0f : 0.0f;
    t.height_m = is_joint ? -0.008f : 0.0f;
  });
}

glm::vec2 brick_sheet_m(BrickSheet sheet) {
  const glm::vec2 whole(brick_bay_m * float(brick_bays), brick_storey_m * float(brick_storeys));
  return sheet == BrickSheet::plain ? 0.5f * whole : whole;
}

BrickWalls brick_wall_pictures(BrickSheet sheet, std::uint32_t seed) {
  Random random(seed);
  const glm::vec2 size_m = brick_sheet_m(sheet);
  const int size_px = sheet == BrickSheet::plain ? sheet_px / 2 : sheet_px;
  SurfaceCanvas canvas(size_px, size_px, size_m.x, size_m.y);
  paint_bricks(canvas, random.next());
  if (sheet == BrickSheet::storeys) paint_storeys(canvas, random);
  if (sheet == BrickSheet::street) paint_street_level(canvas, random);
  SurfacePictures painted = canvas.pictures(1, 2);
  BrickWalls walls;
  for (std::size_t i = 0; i < walls.colours.size(); ++i)
    walls.colours[i] = in_colour(painted.colour, brick_colours()[i] / painted_brick());
  walls.normal = std::move(painted.normal), walls.surface = std::move(painted.surface);
  return walls;
}

}  // namespace parvis::dressing

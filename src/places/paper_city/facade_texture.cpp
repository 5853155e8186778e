#include "places/paper_city/facade_texture.h"

#include "base/colour.h"

namespace parvis::city {
namespace {

constexpr int facade_sheet_px = 1024;

std::array<FacadeStyle, facade_style_count> make_styles() {
  const glm::vec3 cream = linear_from_srgb8(0xEA, 0xDF, 0xC8), stone = linear_from_srgb8(0xCB, 0xBF, 0xA8);
  const glm::vec3 white = linear_from_srgb8(0xE4, 0xE0, 0xD6), oak = linear_from_srgb8(0x6B, 0x4F, 0x3A);
  const glm::vec3 green = linear_from_srgb8(0x5E, 0x7F, 0x6B), blue = linear_from_srgb8(0x6F, 0x8F, 0xA3);
  const glm::vec3 brown = linear_from_srgb8(0x8A, 0x6B, 0x4F), grey = linear_from_srgb8(0x8E, 0x90, 0x8C);
  // width, height, foot, panes across and up, hood, surround, shutters, railing, trim, frame, shutter
  return {{
      {"ochre_green_shutters",
       synthesis::Wall::plaster,
       linear_from_srgb8(0xD9, 0xA8, 0x66),
       {1.1f, 1.9f, 0.8f, 2, 3, synthesis::Hood::none, 0.12f, true, false, cream, white, green},
       true,
       false},
      {"stone_french_windows",
       synthesis::Wall::ashlar,
       linear_from_srgb8(0xCF, 0xC3, 0xAB),
       {1.15f, 2.35f, 0.3f, 2, 4, synthesis::Hood::flat, 0.17f, false, true, stone * 1.05f, white, green},
       true,
       false},
      {"rose_blue_shutters",
       synthesis::Wall::plaster,
       linear_from_srgb8(0xD8, 0xA0, 0x8C),
       {1.0f, 1.75f, 0.85f, 2, 3, synthesis::Hood::none, 0.14f, true, false, cream, white, blue},
       true,
       false},
      {"brick_stone_lintels",
       synthesis::Wall::brick,
       linear_from_srgb8(0xA4, 0x5E, 0x48),
       {1.2f, 1.9f, 0.8f, 2, 4, synthesis::Hood::keystone, 0.18f, false, false, stone, white, green},
       true,
       false},
      {"cream_hoods",
       synthesis::Wall::plaster,
       linear_from_srgb8(0xEA, 0xDF, 0xC8) * 0.92f,
       {1.15f, 2.1f, 0.6f, 2, 3, synthesis::Hood::flat, 0.15f, false, true, white, oak, brown},
       true,
       true},
      {"sienna_grey_shutters",
       synthesis::Wall::plaster,
       linear_from_srgb8(0xC6, 0x74, 0x52),
       {1.05f, 1.85f, 0.8f, 2, 3, synthesis::Hood::keystone, 0.13f, true, false, cream, white, grey},
       true,
       false},
      {"pale_stone",
       synthesis::Wall::ashlar,
       linear_from_srgb8(0xB9, 0xAE, 0x98),
       {1.3f, 2.05f, 0.7f, 2, 2, synthesis::Hood::keystone, 0.2f, false, false, stone, oak, green},
       true,
       true},
      {"light_ochre_shutters",
       synthesis::Wall::plaster,
       linear_from_srgb8(0xE6, 0xC0, 0x89),
       {1.1f, 1.8f, 0.8f, 2, 3, synthesis::Hood::none, 0.0f, true, false, stone, white, brown},
       false,
       false},
  }};
}

void paint_string_course(synthesis::SurfaceCanvas& canvas, glm::vec3 trim, float floor_m,
                         std::uint32_t seed) {
  const synthesis::Rect band{0.0f, floor_m - 0.02f, canvas.width_m(), floor_m + 0.2f};
  synthesis::paint_streaks(canvas, {0.0f, band.y0 - 0.5f, canvas.width_m(), band.y0}, 0.3f, seed);
  canvas.shade_below({band.x0, band.y0 - 0.2f, band.x1, band.y0}, 0.45f);
  canvas.fill(band, synthesis::matt(trim * 0.95f, 0.07f));
  canvas.fill({band.x0, band.y1 - 0.06f, band.x1, band.y1}, synthesis::matt(trim * 1.08f, 0.11f));
}

void paint_piers(synthesis::SurfaceCanvas& canvas, glm::vec3 trim) {
  for (int bay = 0; bay < facade_bays; bay += 2) {
    const float x = facade_bay_m * float(bay);
    constexpr float stone_m = 0.425f;
    for (int stone = 0; stone < int(canvas.height_m() / stone_m); ++stone) {
      const float y = stone_m * float(stone), half = stone % 2 == 1 ? 0.26f : 0.2f;
      canvas.fill({x - half, y + 0.015f, x + half, y + 0.41f},
                  synthesis::matt(trim * (0.92f + 0.02f * half), 0.05f));
    }
  }
}

}  // namespace

const std::array<FacadeStyle, facade_style_count>& facade_styles() {
  static const std::array<FacadeStyle, facade_style_count> styles = make_styles();
  return styles;
}

synthesis::SurfaceCanvas facade_canvas(const FacadeStyle& style, std::uint32_t seed) {
  Random random(seed);
  synthesis::SurfaceCanvas canvas(facade_sheet_px, facade_sheet_px, facade_bay_m * float(facade_bays),
                                  facade_floor_m * float(facade_floors));
  synthesis::paint_wall(canvas, style.wall, style.wall_colour, random.next());
  if (style.has_quoined_piers) paint_piers(canvas, style.window.trim);
  for (int floor = 0; floor < facade_floors; ++floor) {
    const float floor_m = facade_floor_m * float(floor);
    if (style.has_string_course) paint_string_course(canvas, style.window.trim, floor_m, random.next());
  }
  for (int floor = 0; floor < facade_floors; ++floor)
    for (int bay = 0; bay < facade_bays; ++bay)
      synthesis::paint_window(canvas, style.window, facade_bay_m * (float(bay) + 0.5f),
                              facade_floor_m * float(floor), random);
  return canvas;
}

synthesis::SurfacePictures facade_pictures(const FacadeStyle& style, std::uint32_t seed) {
  return facade_canvas(style, seed).pictures(2, 2);
}

}  // namespace parvis::city

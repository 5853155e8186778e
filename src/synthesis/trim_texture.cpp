#include "synthesis/trim_texture.h"

#include <algorithm>
#include <cmath>

#include "base/colour.h"
#include "synthesis/noise.h"
#include "synthesis/wall_texture.h"
#include "synthesis/window_texture.h"

namespace parvis::synthesis {
namespace {

constexpr float strip_m = 1.28f;  // height of a strip as painted; strips are stretched where they are used

Rect strip_rect(Trim trim) {
  const float foot = strip_m * float(static_cast<int>(trim));
  return {0.0f, foot, trim_sheet_m, foot + strip_m};
}

void paint_cornice(SurfaceCanvas& canvas, const Rect& r, glm::vec3 stone) {
  canvas.fill(r, matt(stone * 0.9f, 0.0f));
  const auto band = [&](float low, float high, float out, float tone) {
    canvas.fill({r.x0, r.y0 + low * strip_m, r.x1, r.y0 + high * strip_m}, matt(stone * tone, out));
  };
  band(0.0f, 0.16f, 0.03f, 0.95f), band(0.56f, 0.66f, 0.12f, 1.0f), band(0.66f, 0.86f, 0.2f, 1.04f);
  band(0.86f, 1.0f, 0.26f, 1.1f);
  for (int i = 0; i < 32; ++i) {  // dentils
    const float x = trim_sheet_m / 32.0f * float(i);
    canvas.fill({x + 0.06f, r.y0 + 0.26f * strip_m, x + 0.26f, r.y0 + 0.56f * strip_m}, matt(stone, 0.12f));
  }
  canvas.shade_below({r.x0, r.y0 + 0.2f * strip_m, r.x1, r.y0 + 0.56f * strip_m}, 0.5f);
}

void paint_soffit(SurfaceCanvas& canvas, const Rect& r, glm::vec3 stone) {
  canvas.fill(r, matt(stone * 0.62f, 0.0f));
  for (int i = 0; i < 16; ++i) {  // brackets
    const float x = trim_sheet_m / 16.0f * float(i);
    canvas.fill({x + 0.2f, r.y0, x + 0.44f, r.y0 + 0.85f * strip_m}, matt(stone * 0.95f, 0.1f));
  }
}

void paint_chimney(SurfaceCanvas& canvas, const Rect& r) {
  const glm::vec3 brick = linear_from_srgb8(0xA0, 0x60, 0x48);
  canvas.paint(r, [&](float x, float y, Texel& t) {
    const int row = int(y / 0.08f);
    const float along = x / 0.256f + 0.5f * float(row & 1);
    const float tx = along - std::floor(along), ty = y / 0.08f - float(row);
    const bool is_joint = tx < 0.07f || ty < 0.18f;
    t = matt(is_joint ? glm::vec3(0.36f, 0.33f, 0.29f)
                      : brick * (0.75f + 0.5f * lattice_value(int(along) % 40, row, 5)),
             is_joint ? -0.01f : 0.0f);
    t.colour *= 0.65f + 0.35f * (r.y1 - y) / strip_m;  // soot
  });
  canvas.fill({r.x0, r.y1 - 0.16f, r.x1, r.y1}, matt(glm::vec3(0.3f, 0.28f, 0.25f), 0.05f));
}

void paint_awning(SurfaceCanvas& canvas, const Rect& r, glm::vec3 colour, glm::vec3 stripe) {
  canvas.paint(r, [&](float x, float y, Texel& t) {
    const float phase = x / 0.64f - std::floor(x / 0.64f);
    const float share = glm::smoothstep(0.0f, 0.03f, phase) * glm::smoothstep(0.53f, 0.5f, phase);
    t = matt(glm::mix(stripe, colour, share) * (0.9f + 0.1f * std::sin(x * 3.0f)), 0.0f, 0.9f);
    if (y - r.y0 < 0.12f) t.colour *= 0.72f;  // hem
  });
}

void paint_dormers(SurfaceCanvas& canvas, const Rect& r, Random& random) {
  canvas.fill(r, matt(glm::vec3(0.5f, 0.47f, 0.4f), 0.0f));
  for (int i = 0; i < 8; ++i) {
    const float x = dormer_module_m * float(i);
    canvas.fill({x, r.y0, x + 0.09f, r.y1}, matt(linear_from_srgb8(0x7C, 0x85, 0x8C), 0.03f, 0.5f));
    canvas.fill({x + dormer_module_m - 0.09f, r.y0, x + dormer_module_m, r.y1},
                matt(linear_from_srgb8(0x7C, 0x85, 0x8C), 0.03f, 0.5f));
    paint_casement(canvas, {x + 0.2f, r.y0 + 0.12f, x + dormer_module_m - 0.2f, r.y1 - 0.14f}, 2, 3,
                   glm::vec3(0.62f), 0.1f, random);
  }
}

/// Rows of rounded tiles.
void paint_tiles(SurfaceCanvas& canvas, glm::vec3 colour, std::uint32_t seed) {
  const glm::ivec2 stains(3, 3);
  canvas.paint_all([&](float x, float y, Texel& t) {
    const float across = x / roof_sheet_m * float(roof_tile_columns),
                up = y / roof_sheet_m * float(roof_tile_rows);
    const int column = int(across), row = int(up);
    const float tx = across - float(column), ty = up - float(row);
    const float arch = std::sin(tx * 3.14159265f);  // a barrel: high in the middle
    const float own = lattice_value(column, row, seed);
    const float stain = fractal_noise(glm::vec2(x, y) * (3.0f / roof_sheet_m), stains, 5, seed + 3);
    t.height_m = 0.05f * arch + 0.03f * (1.0f - ty);
    t.colour = colour * (0.72f + 0.5f * own) * (0.7f + 0.6f * stain);
    t.colour = glm::mix(t.colour, glm::vec3(0.16f, 0.16f, 0.11f),
                        0.6f * glm::smoothstep(0.6f, 0.75f, stain));  // moss
    t.openness = glm::mix(0.45f, 1.0f, glm::smoothstep(0.0f, 0.5f, arch)) *
                 glm::mix(0.6f, 1.0f, glm::smoothstep(1.0f, 0.8f, ty));
    t.roughness = 0.85f;
  });
}

void paint_zinc(SurfaceCanvas& canvas, glm::vec3 colour, std::uint32_t seed) {
  const float seam_m = roof_sheet_m / 8.0f;
  const glm::ivec2 cloud(4, 4);
  canvas.paint_all([&](float x, float y, Texel& t) {
    const float across = x / seam_m, tx = across - std::floor(across);
    const float cloudy = fractal_noise(glm::vec2(x, y) * (4.0f / roof_sheet_m), cloud, 5, seed);
    const float streak =
        noise(glm::vec2(x * 96.0f / roof_sheet_m, y * 3.0f / roof_sheet_m), {96, 3}, seed + 7);
    const float seam = glm::smoothstep(0.05f, 0.025f, std::min(tx, 1.0f - tx));
    t.colour = colour * (0.72f + 0.4f * cloudy + 0.16f * streak) * (1.0f - 0.2f * seam);
    t.height_m = 0.035f * seam;
    t.roughness = 0.42f + 0.3f * cloudy;
    t.metallic = 0.35f;
    t.openness = 1.0f - 0.3f * glm::smoothstep(0.1f, 0.05f, std::min(tx, 1.0f - tx)) * (1.0f - seam);
  });
}

}  // namespace

glm::vec2 trim_strip(Trim trim) {
  const float height = 1.0f / float(trim_strips), gutter = 1.5f / 1024.0f;
  const float foot = 1.0f - height * float(static_cast<int>(trim));
  return {foot - gutter, foot - height + gutter};
}

SurfacePictures trim_pictures(std::uint32_t seed) {
  Random random(seed);
  SurfaceCanvas canvas(1024, 1024, trim_sheet_m, strip_m * float(trim_strips));
  const glm::vec3 stone = linear_from_srgb8(0xCB, 0xBF, 0xA8);
  paint_cornice(canvas, strip_rect(Trim::cornice), stone);
  paint_soffit(canvas, strip_rect(Trim::soffit), stone);
  canvas.fill(strip_rect(Trim::slab), matt(stone * 0.95f, 0.0f));
  paint_chimney(canvas, strip_rect(Trim::chimney));
  paint_awning(canvas, strip_rect(Trim::awning_red), linear_from_srgb8(0x9E, 0x2E, 0x2A),
               linear_from_srgb8(0xE2, 0xD8, 0xC4));
  paint_awning(canvas, strip_rect(Trim::awning_green), linear_from_srgb8(0x2F, 0x5A, 0x48),
               linear_from_srgb8(0xDE, 0xD6, 0xC0));
  paint_dormers(canvas, strip_rect(Trim::dormer), random);
  canvas.fill(strip_rect(Trim::metal), matt(glm::vec3(0.03f, 0.036f, 0.034f), 0.0f, 0.45f));
  canvas.paint_all([&](float x, float y, Texel& t) {
    const float stain = fractal_noise(glm::vec2(x, y) / trim_sheet_m * 12.0f, {12, 12}, 5, seed + 40);
    t.colour *= 0.8f + 0.4f * stain;
  });
  return canvas.pictures(2, 2);
}

SurfacePictures roof_tile_pictures(std::uint32_t seed) {
  SurfaceCanvas canvas(512, 512, roof_sheet_m, roof_sheet_m);
  paint_tiles(canvas, linear_from_srgb8(0xB0, 0x62, 0x3E), seed);
  return canvas.pictures(1, 2);
}

SurfacePictures roof_zinc_pictures(std::uint32_t seed) {
  SurfaceCanvas canvas(512, 512, roof_sheet_m, roof_sheet_m);
  paint_zinc(canvas, linear_from_srgb8(0x84, 0x8D, 0x94), seed);
  return canvas.pictures(1, 2);
}

SurfacePictures blank_wall_pictures(std::uint32_t seed) {
  SurfaceCanvas canvas(512, 512, blank_wall_sheet_m, blank_wall_sheet_m);
  paint_wall(canvas, Wall::plaster, linear_from_srgb8(0xD2, 0xC4, 0xA8), seed);
  paint_streaks(canvas, {0.0f, 0.0f, blank_wall_sheet_m, blank_wall_sheet_m}, 0.35f, seed + 9);
  return canvas.pictures(2, 2);
}

SurfacePictures railing_pictures() {
  Texel nothing = matt(glm::vec3(0.02f), 0.0f, 0.5f);
  nothing.alpha = 0.0f;
  const Texel iron = matt(glm::vec3(0.02f), 0.02f, 0.5f);
  SurfaceCanvas canvas(256, 128, railing_sheet_m, 1.0f, nothing);
  for (const float y : {0.06f, 0.2f, 0.8f, 0.93f}) canvas.fill({0.0f, y, railing_sheet_m, y + 0.05f}, iron);
  for (int i = 0; i < 16; ++i) {
    const float x = railing_sheet_m * (float(i) + 0.5f) / 16.0f;
    canvas.fill({x - 0.016f, 0.0f, x + 0.016f, 1.0f}, iron);
    canvas.paint({x + 0.0f, 0.4f, x + 0.125f, 0.6f}, [&](float px, float py, Texel& t) {
      const float r = glm::length(glm::vec2(px - x - 0.0625f, py - 0.5f));
      if (r > 0.03f && r < 0.058f) t = iron;
    });
  }
  return canvas.pictures(1, 2);
}

}  // namespace parvis::synthesis

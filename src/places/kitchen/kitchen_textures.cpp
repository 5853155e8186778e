#include "places/kitchen/kitchen_textures.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "base/colour.h"
#include "places/kitchen/kitchen_materials.h"
#include "synthesis/noise.h"

namespace parvis::kitchen {
namespace {

using synthesis::fractal_noise, synthesis::lattice_value, synthesis::nearest_cell, synthesis::Cell,
    synthesis::Texel, synthesis::SurfacePictures, synthesis::SurfaceCanvas;

constexpr float tile_m = 0.1f, joint_m = 0.0022f;

float grain(const SurfaceCanvas& canvas, float x, float y, glm::vec2 size_m, int octaves,
            std::uint32_t seed) {
  const glm::vec2 sheet(canvas.width_m(), canvas.height_m());
  const glm::ivec2 period = glm::max(glm::ivec2(glm::round(sheet / size_m)), 1);
  return fractal_noise(glm::vec2(x, y) * glm::vec2(period) / sheet, period, octaves, seed) - 0.5f;
}

/// 1 in the joint between square tiles, fading over half a millimetre.
float joint(glm::vec2 in_tile, float side_m, float width_m) {
  const glm::vec2 to_side = glm::min(in_tile, side_m - in_tile);
  return glm::smoothstep(width_m, width_m - 0.0009f, std::min(to_side.x, to_side.y));
}

/// A tulip in a blue ring; `p` from the tile's middle, in half tiles.
bool is_flower(glm::vec2 p) {
  const float radius = glm::length(p), angle = std::atan2(p.y, p.x);
  const bool is_ring = std::abs(radius - 0.78f) < 0.035f;
  const bool is_petal = radius < 0.52f * std::pow(std::abs(std::cos(2.0f * angle)), 0.6f) && radius > 0.13f;
  const bool is_corner = glm::length(glm::abs(p) - 1.0f) < 0.2f;
  return is_ring || is_petal || is_corner || radius < 0.07f;
}

}  // namespace

SurfacePictures wall_tile_pictures(std::uint32_t seed) {
  SurfaceCanvas canvas(3072, 512, tiled_m[0], tiled_m[1]);
  const glm::vec3 glaze = linear_from_srgb8(0xEA, 0xE8, 0xDC), ink = linear_from_srgb8(0x2E, 0x4F, 0x8C),
                  grout = linear_from_srgb8(0xA8, 0xA2, 0x94);
  canvas.paint_all([&](float x, float y, Texel& t) {
    const glm::ivec2 tile(int(x / tile_m), int(y / tile_m));
    const glm::vec2 in_tile(x - float(tile.x) * tile_m, y - float(tile.y) * tile_m);
    const float identity = lattice_value(tile.x, tile.y, seed), gap = joint(in_tile, tile_m, joint_m);
    const glm::vec2 p = in_tile / (0.5f * tile_m) - 1.0f;
    glm::vec3 colour = glaze * (0.94f + 0.1f * identity);
    if (lattice_value(tile.x, tile.y, seed + 1) < 0.2f && is_flower(p)) colour = glm::mix(colour, ink, 0.85f);
    t.colour = glm::mix(colour, grout, gap);
    const glm::vec2 swell = 1.0f - p * p * p * p;  // glaze runs thin toward the edges
    t.height_m = 0.0006f * std::min(swell.x, swell.y) - 0.0014f * gap;
    t.roughness = glm::mix(0.3f, 0.95f, gap);
    // The worktop below and the cupboards above keep light off.
    t.openness = (1.0f - 0.35f * std::exp(-y / 0.05f)) * (1.0f - 0.4f * std::exp((y - tiled_m[1]) / 0.09f));
  });
  return canvas.pictures(1, 2);
}

SurfacePictures floor_pictures(std::uint32_t seed) {
  constexpr float side_m = 0.3f;
  SurfaceCanvas canvas(1024, 1024, floor_sheet_m, floor_sheet_m);
  canvas.paint_all([&](float x, float y, Texel& t) {
    const glm::ivec2 tile(int(x / side_m), int(y / side_m));
    const glm::vec2 in_tile(x - float(tile.x) * side_m, y - float(tile.y) * side_m);
    const float gap = joint(in_tile, side_m, 0.002f);
    const bool is_dark = (tile.x + tile.y) % 2 == 1;
    const glm::vec3 base =
        is_dark ? linear_from_srgb8(0x4A, 0x3A, 0x30) : linear_from_srgb8(0xD8, 0xC6, 0xA4);
    const float cloud = grain(canvas, x, y, glm::vec2(0.15f), 4, seed);
    t.colour = glm::mix(base * (1.0f + 0.5f * cloud), glm::vec3(0.25f, 0.22f, 0.18f), gap);
    t.height_m = -0.001f * gap;
    t.roughness = 0.45f + 0.5f * gap;
  });
  return canvas.pictures(2, 2);
}

SurfacePictures worktop_pictures(std::uint32_t seed) {
  SurfaceCanvas canvas(3072, 560, worktop_m[0], worktop_m[1]);
  canvas.paint_all([&](float x, float y, Texel& t) {
    const glm::ivec2 endless(1 << 20);
    const Cell chip = nearest_cell(glm::vec2(x, y) / 0.011f, endless, seed);
    const float size = 0.16f + 0.3f * chip.identity;
    const glm::vec3 paste = linear_from_srgb8(0xB9, 0xB2, 0xA4);
    const glm::vec3 stone = glm::mix(linear_from_srgb8(0x5E, 0x58, 0x52), linear_from_srgb8(0xDC, 0xD2, 0xC2),
                                     std::fmod(chip.identity * 7.31f, 1.0f));
    t.colour = glm::mix(stone, paste, glm::smoothstep(size - 0.05f, size + 0.05f, chip.distance));
    t.colour *= 1.0f + 0.12f * grain(canvas, x, y, glm::vec2(0.3f), 3, seed + 1);
    t.roughness = 0.38f + 0.06f * grain(canvas, x, y, glm::vec2(0.05f), 3, seed + 2);
    t.openness = 1.0f - 0.4f * std::exp((y - worktop_m[1]) / 0.05f);  // below the wall
  });
  return canvas.pictures(2, 2);
}

SurfacePictures front_pictures(std::uint32_t seed) {
  SurfaceCanvas canvas(512, 512, front_sheet_m, front_sheet_m);
  canvas.paint_all([&](float x, float y, Texel& t) {
    const float brush = grain(canvas, x, y, {0.3f, 0.004f}, 3, seed);
    t.colour = linear_from_srgb8(0x8F, 0xA0, 0x8C) * (1.0f + 0.07f * brush);
    t.height_m = 0.0002f * brush;
    t.roughness = 0.5f;
  });
  return canvas.pictures(1, 2);
}

SurfacePictures wood_pictures(std::uint32_t seed) {
  SurfaceCanvas canvas(1024, 1024, wood_sheet_m, wood_sheet_m);
  canvas.paint_all([&](float x, float y, Texel& t) {
    const float wave = grain(canvas, x, y, {0.3f, 0.06f}, 3, seed);
    const float ring =
        0.5f + 0.5f * std::sin(2.0f * glm::pi<float>() * (10.0f * y / wood_sheet_m + 3.0f * wave));
    const float pore = grain(canvas, x, y, {0.04f, 0.002f}, 3, seed + 1);
    t.colour = glm::mix(linear_from_srgb8(0xA8, 0x76, 0x48), linear_from_srgb8(0xC8, 0x9A, 0x66), ring) *
               (1.0f + 0.45f * pore);
    t.height_m = 0.0003f * pore;
    t.roughness = 0.6f;
  });
  return canvas.pictures(2, 2);
}

SurfacePictures cloth_pictures(std::uint32_t seed) {
  SurfaceCanvas canvas(512, 512, cloth_sheet_m, cloth_sheet_m);
  const glm::vec3 white = linear_from_srgb8(0xE6, 0xE0, 0xD4), red = linear_from_srgb8(0xB0, 0x28, 0x2A);
  canvas.paint_all([&](float x, float y, Texel& t) {
    const auto stripe = [](float at) { return std::fmod(at, 0.03f) < 0.015f ? 0.5f : 0.0f; };
    const float weave =
        std::sin(2.0f * glm::pi<float>() * x / 0.0015f) * std::sin(2.0f * glm::pi<float>() * y / 0.0015f);
    t.colour = glm::mix(white, red, stripe(x) + stripe(y)) * (1.0f + 0.08f * weave) *
               (1.0f + 0.2f * grain(canvas, x, y, glm::vec2(0.06f), 3, seed));
    t.height_m = 0.0002f * weave;
    t.roughness = 0.95f;
  });
  return canvas.pictures(1, 2);
}

SurfacePictures orange_pictures(std::uint32_t seed) {
  SurfaceCanvas canvas(512, 256, 0.24f, 0.12f);
  canvas.paint_all([&](float x, float y, Texel& t) {
    const Cell pit = nearest_cell(glm::vec2(x, y) / 0.0025f, {96, 48}, seed);
    const float dent = glm::smoothstep(0.45f, 0.1f, pit.distance);
    t.colour = linear_from_srgb8(0xE6, 0x86, 0x1E) * (1.0f - 0.14f * dent) *
               (1.0f + 0.2f * grain(canvas, x, y, glm::vec2(0.03f), 3, seed + 1));
    t.height_m = -0.0003f * dent;
    t.roughness = 0.42f;
  });
  return canvas.pictures(1, 2);
}

SurfacePictures apple_pictures(std::uint32_t seed) {
  SurfaceCanvas canvas(512, 256, 0.24f, 0.12f);
  const glm::vec3 red = linear_from_srgb8(0xA4, 0x1E, 0x1C), yellow = linear_from_srgb8(0xD6, 0xB0, 0x4C);
  canvas.paint_all([&](float x, float y, Texel& t) {
    const float streak = grain(canvas, x, y, {0.006f, 0.12f}, 3, seed),
                side = grain(canvas, x, y, {0.12f, 0.12f}, 2, seed + 1);
    t.colour = glm::mix(yellow, red, glm::smoothstep(-0.18f, 0.12f, streak + 1.6f * side));
    const Cell dot = nearest_cell(glm::vec2(x, y) / 0.008f, {30, 15}, seed + 2);
    t.colour = glm::mix(t.colour, yellow, 0.6f * glm::smoothstep(0.1f, 0.06f, dot.distance));
    t.roughness = 0.4f;
  });
  return canvas.pictures(2, 2);
}

SurfacePictures banana_pictures(std::uint32_t seed) {
  SurfaceCanvas canvas(128, 256, 0.1f, 0.2f);
  const glm::vec3 yellow = linear_from_srgb8(0xE2, 0xBC, 0x38), brown = linear_from_srgb8(0x4A, 0x36, 0x20),
                  green = linear_from_srgb8(0xA4, 0xAE, 0x48);
  canvas.paint_all([&](float x, float y, Texel& t) {
    const float end = std::min(y, 0.2f - y), spots = grain(canvas, x, y, {0.012f, 0.03f}, 3, seed);
    t.colour = glm::mix(yellow, green, glm::smoothstep(0.05f, 0.015f, end));
    t.colour = glm::mix(t.colour, brown,
                        std::max(glm::smoothstep(0.012f, 0.004f, end), glm::smoothstep(0.16f, 0.24f, spots)));
    t.roughness = 0.5f;
  });
  return canvas.pictures(2, 2);
}

Image8 shade_picture() {
  Image8 image(64, 64, 4, 0);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      const float radius = glm::length(glm::vec2(float(x) + 0.5f, float(y) + 0.5f) / 32.0f - 1.0f);
      const float open = glm::smoothstep(0.55f, 1.0f, radius);
      image.at(x, y)[3] = std::uint8_t(185.0f * (1.0f - open) * (1.0f - open));
    }
  return image;
}

}  // namespace parvis::kitchen

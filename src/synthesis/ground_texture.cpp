#include "synthesis/ground_texture.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/colour.h"
#include "base/random.h"
#include "synthesis/noise.h"
#include "synthesis/window_texture.h"

namespace parvis::synthesis {
namespace {

const glm::vec3 road_paint = linear_from_srgb8(0xD4, 0xD2, 0xCA);

void paint_asphalt(SurfaceCanvas& canvas, std::uint32_t seed) {
  const glm::vec3 colour = linear_from_srgb8(0x5E, 0x5B, 0x57);
  const glm::vec2 size(canvas.width_m(), canvas.height_m());
  const glm::ivec2 stains = glm::max(glm::ivec2(size / 3.0f), 1), grains(size / 0.035f);
  canvas.paint_all([&](float x, float y, Texel& t) {
    const glm::vec2 p = glm::vec2(x, y) / size;
    const float stain = fractal_noise(p * glm::vec2(stains), stains, 5, seed) - 0.5f;
    const float grain = noise(p * glm::vec2(grains), grains, seed + 9) - 0.5f;
    t.colour = colour * (1.0f + 0.5f * stain + 0.55f * grain * std::abs(grain) * 4.0f + 0.25f * grain);
    t.height_m = 0.006f * grain;
    t.roughness = 0.86f + 0.12f * stain;
  });
}

/// Paint on the road, worn where the tyres and the stones take it off.
void paint_marking(SurfaceCanvas& canvas, const Rect& rect, std::uint32_t seed) {
  const glm::ivec2 period = glm::max(glm::ivec2(glm::vec2(canvas.width_m(), canvas.height_m()) / 0.12f), 1);
  const glm::vec2 scale = glm::vec2(period) / glm::vec2(canvas.width_m(), canvas.height_m());
  canvas.paint(rect, [&](float x, float y, Texel& t) {
    const float worn = glm::smoothstep(0.55f, 0.75f, fractal_noise(glm::vec2(x, y) * scale, period, 3, seed));
    t.colour = glm::mix(road_paint * (0.85f + 0.15f * t.roughness), t.colour, 0.25f + 0.6f * worn);
    t.roughness = 0.7f;
  });
}

void paint_manhole(SurfaceCanvas& canvas, float x0, float y0) {
  canvas.paint({x0 - 0.45f, y0 - 0.45f, x0 + 0.45f, y0 + 0.45f}, [&](float x, float y, Texel& t) {
    const float r = glm::length(glm::vec2(x - x0, y - y0));
    if (r > 0.42f) return;
    if (r > 0.34f) {
      t.colour *= 0.75f;  // the collar of fresh asphalt
      return;
    }
    const bool is_stud = (int(std::floor(x / 0.05f)) + int(std::floor(y / 0.05f))) & 1;
    t = matt(glm::vec3(is_stud ? 0.075f : 0.045f), is_stud ? 0.0f : -0.006f, 0.5f);
    t.metallic = 0.6f;
    if (r > 0.31f) t.colour *= 0.35f;
  });
}

void paint_patch(SurfaceCanvas& canvas, const Rect& rect, float tone) {
  canvas.paint(rect, [&](float x, float y, Texel& t) {
    const float edge = std::min(std::min(x - rect.x0, rect.x1 - x), std::min(y - rect.y0, rect.y1 - y));
    t.colour *= edge < 0.04f ? 0.55f : tone;  // sealed with tar round its edge
  });
}

void paint_tracks(SurfaceCanvas& canvas, float carriageway_m, float lane_m) {
  canvas.paint_all([&](float x, float, Texel& t) {
    const float from_middle = std::abs(x - 0.5f * carriageway_m), in_lane = from_middle - 0.5f * lane_m;
    const float track = std::exp(-std::pow((std::abs(in_lane) - 0.75f) / 0.3f, 2.0f));
    const float oil = std::exp(-std::pow(in_lane / 0.28f, 2.0f));
    t.colour *= 1.0f + 0.1f * track - 0.16f * oil;
    t.roughness -= 0.05f * track;
    const float gutter = std::min(x, carriageway_m - x);
    if (gutter < 0.3f) t = matt(t.colour * 1.5f + glm::vec3(0.03f), 0.0f, 0.8f);
    if (std::abs(gutter - 0.3f) < 0.02f) t.colour *= 0.5f;
    t.colour *= 0.72f + 0.28f * glm::smoothstep(0.0f, 0.7f, gutter);
    t.openness = 0.75f + 0.25f * glm::smoothstep(0.0f, 0.25f, gutter);
  });
}

/// Slabs in rows of staggered joints.
struct Slab {
  float to_joint_m, identity;
};
Slab slab_at(float x, float y, glm::vec2 size, glm::ivec2 count, std::uint32_t seed) {
  const int row = int(std::floor(y / size.y));
  const float along = x / size.x + (row & 1 ? 0.5f : 0.0f);
  const int column = int(std::floor(along)) % count.x;
  const float tx = along - std::floor(along), ty = y / size.y - float(row);
  return {std::min(std::min(tx, 1.0f - tx) * size.x, std::min(ty, 1.0f - ty) * size.y),
          lattice_value(column, row % count.y, seed)};
}

}  // namespace

SurfacePictures asphalt_pictures(std::uint32_t seed) {
  SurfaceCanvas canvas(1024, 1024, asphalt_sheet_m, asphalt_sheet_m);
  paint_asphalt(canvas, seed);
  paint_patch(canvas, {1.3f, 6.2f, 3.1f, 9.6f}, 0.8f);
  paint_manhole(canvas, 7.2f, 3.4f);
  return canvas.pictures(2, 4);
}

SurfacePictures road_pictures(float carriageway_m, bool has_parking, std::uint32_t seed) {
  const int across_px = has_parking ? 1024 : 512;
  SurfaceCanvas canvas(across_px, 2 * across_px, carriageway_m, road_sheet_length_m);
  Random random(seed);
  const float middle = 0.5f * carriageway_m, lane_m = has_parking ? 3.5f : middle - 0.3f;
  paint_asphalt(canvas, seed);
  paint_patch(canvas, {middle + 0.6f, 3.0f, middle + 2.1f, 8.2f}, 0.72f);
  paint_patch(canvas, {middle - 2.9f, 14.0f, middle - 1.7f, 15.6f}, 1.22f);
  paint_patch(canvas, {middle - 0.5f, 19.5f, middle + 3.3f, 20.3f}, 0.8f);
  paint_tracks(canvas, carriageway_m, lane_m);
  paint_manhole(canvas, middle + 1.7f, 11.5f);
  paint_manhole(canvas, middle - 1.5f, 22.7f);
  for (const float y : {5.0f, 18.0f})
    paint_marking(canvas, {middle - 0.06f, y, middle + 0.06f, y + 3.0f}, seed + 5);
  if (has_parking) {
    for (const float side : {-1.0f, 1.0f}) {
      const float line = middle + side * lane_m, kerb = middle + side * (middle - 0.3f);
      paint_marking(canvas, {line - 0.05f, 0.0f, line + 0.05f, road_sheet_length_m}, seed + 6);
      for (int bay = 0; bay < 5; ++bay) {
        const float y = road_sheet_length_m / 5.0f * float(bay);
        paint_marking(canvas, {std::min(line, kerb), y, std::max(line, kerb), y + 0.1f}, seed + 7);
      }
    }
  }
  return canvas.pictures(4, 4);
}

SurfacePictures zebra_pictures(float carriageway_m, std::uint32_t seed) {
  SurfaceCanvas canvas(1024, 512, carriageway_m, zebra_length_m);
  paint_asphalt(canvas, seed);
  for (int stripe = 0; stripe < int(carriageway_m - 0.05f); ++stripe) {
    const float x = 0.45f + float(stripe);
    paint_marking(canvas, {x, 0.4f, x + 0.5f, 3.6f}, seed + 1);
  }
  paint_marking(canvas, {0.4f, 4.7f, 0.5f * carriageway_m - 0.1f, 5.1f}, seed + 2);
  return canvas.pictures(2, 4);
}

SurfacePictures paving_pictures(std::uint32_t seed) {
  SurfaceCanvas canvas(1024, 1024, paving_sheet_m, paving_sheet_m);
  const glm::vec3 granite = linear_from_srgb8(0xA7, 0x9F, 0x94);
  const glm::ivec2 count(12, 16);  // slabs of 0.6 x 0.45 m
  const glm::vec2 size = glm::vec2(paving_sheet_m) / glm::vec2(count);
  canvas.paint_all([&](float x, float y, Texel& t) {
    const glm::vec2 p = glm::vec2(x, y) / paving_sheet_m;
    const Slab slab = slab_at(x, y, size, count, seed);
    const float joint = glm::smoothstep(0.012f, 0.004f, slab.to_joint_m);
    const float stain = fractal_noise(p * 4.0f, {4, 4}, 5, seed + 3) - 0.5f;
    const float speckle = noise(p * 360.0f, {360, 360}, seed + 4) - 0.5f;
    const float gum = nearest_cell(p * 14.0f, {14, 14}, seed + 5).distance < 0.045f ? 0.25f : 0.0f;
    t.colour =
        granite * (1.0f + 0.22f * (slab.identity - 0.5f) + 0.4f * stain + 0.3f * speckle) * (1.0f - gum);
    t.colour = glm::mix(t.colour, granite * 0.42f, joint);
    t.height_m = -0.008f * joint + 0.002f * speckle;
    t.roughness = 0.78f + 0.15f * stain;
  });
  return canvas.pictures(2, 4);
}

SurfacePictures lawn_pictures(std::uint32_t seed) {
  SurfaceCanvas canvas(1024, 1024, lawn_sheet_m, lawn_sheet_m);
  const glm::vec3 green = linear_from_srgb8(0x62, 0x7A, 0x3C), dry = linear_from_srgb8(0x8C, 0x8A, 0x52);
  canvas.paint_all([&](float x, float y, Texel& t) {
    const glm::vec2 p = glm::vec2(x, y) / lawn_sheet_m;
    const float patch = fractal_noise(p * 5.0f, {5, 5}, 5, seed);
    const float tuft = fractal_noise(p * 90.0f, {90, 90}, 2, seed + 6);
    const float blade = noise(p * glm::vec2(500.0f, 260.0f), {500, 260}, seed + 8);
    const Cell clover = nearest_cell(p * 40.0f, {40, 40}, seed + 9);
    t.colour = glm::mix(green, dry, glm::smoothstep(0.45f, 0.75f, patch) * 0.7f) *
               (0.45f + 0.6f * tuft + 0.4f * blade);
    if (clover.identity > 0.9f && clover.distance < 0.1f) t.colour = glm::vec3(0.6f, 0.6f, 0.5f);
    t.height_m = 0.05f * tuft + 0.02f * blade;
    t.roughness = 0.95f;
    t.openness = 0.7f + 0.3f * tuft;
  });
  return canvas.pictures(2, 4);
}

SurfacePictures gravel_pictures(std::uint32_t seed) {
  SurfaceCanvas canvas(512, 512, gravel_sheet_m, gravel_sheet_m);
  const glm::vec3 sand = linear_from_srgb8(0xC2, 0xB2, 0x94);
  canvas.paint_all([&](float x, float y, Texel& t) {
    const glm::vec2 p = glm::vec2(x, y) / gravel_sheet_m;
    const Cell pebble = nearest_cell(p * 150.0f, {150, 150}, seed);
    const float patch = fractal_noise(p * 3.0f, {3, 3}, 5, seed + 2) - 0.5f;
    t.colour = sand * (0.8f + 0.3f * pebble.identity + 0.35f * patch) *
               (0.75f + 0.5f * std::min(pebble.border, 0.5f));
    t.height_m = 0.012f * std::min(pebble.border, 0.4f);
    t.roughness = 0.95f;
  });
  return canvas.pictures(1, 4);
}

}  // namespace parvis::synthesis

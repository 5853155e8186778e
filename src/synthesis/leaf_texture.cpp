#include "synthesis/leaf_texture.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "synthesis/noise.h"
#include "synthesis/window_texture.h"

namespace parvis::synthesis {
namespace {

/// One leaf: pointed at its tip, rounded at its foot, folded a little along its rib.
void paint_leaf(SurfaceCanvas& canvas, glm::vec2 foot, float heading, float length, glm::vec3 colour) {
  const glm::vec2 along(std::sin(heading), std::cos(heading)), across(along.y, -along.x);
  const glm::vec2 middle = foot + 0.5f * length * along;
  const float reach = 0.62f * length;
  canvas.paint({middle.x - reach, middle.y - reach, middle.x + reach, middle.y + reach}, [&](float x, float y,
                                                                                             Texel& t) {
    const glm::vec2 p = glm::vec2(x, y) - foot;
    const float u = glm::dot(p, along) / length, v = glm::dot(p, across) / length;
    if (u < 0.0f || u > 1.0f) return;
    const float half = 0.36f * std::pow(u, 0.6f) * std::pow(1.0f - u, 0.75f) * 1.9f;
    if (std::abs(v) > half) return;
    const float rib = glm::smoothstep(0.025f, 0.008f, std::abs(v));
    const float vein = 0.5f + 0.5f * std::sin((u - 0.7f * std::abs(v)) * 60.0f);
    t.colour = colour * (0.86f + 0.14f * vein + (v > 0.0f ? 0.1f : -0.05f)) * (1.0f + 0.35f * rib);
    t.height_m = 0.01f * std::abs(v) / length;
    t.roughness = 0.55f;
    t.alpha = 1.0f;
  });
}

}  // namespace

SurfacePictures leaf_pictures(glm::vec3 colour, std::uint32_t seed) {
  Random random(seed);
  Texel nothing = matt(colour * 0.8f, 0.0f, 0.6f);
  nothing.alpha = 0.0f;
  SurfaceCanvas canvas(512, 512, 1.0f, 1.0f, nothing);
  Texel twig = matt(glm::vec3(0.09f, 0.07f, 0.04f), 0.0f);
  canvas.fill({0.492f, 0.0f, 0.508f, 0.75f}, twig);
  for (int i = 0; i < 17; ++i) {  // in turn to both sides, one at the tip
    const float up = 0.06f + 0.6f * float(i) / 16.0f, side = i == 16 ? 0.0f : i % 2 == 0 ? 1.0f : -1.0f;
    const float spread = random.uniform(0.7f, 1.35f), stray = random.uniform(-0.15f, 0.15f);
    const float heading = side * spread * (1.1f - 0.5f * up) + stray;
    const float red = random.uniform(0.9f, 1.15f), light = random.uniform(0.75f, 1.2f);
    const glm::vec3 own = colour * light * glm::vec3(red, 1.0f, 0.9f);
    paint_leaf(canvas, {0.5f, up}, heading, random.uniform(0.34f, 0.44f), own);
  }
  return canvas.pictures(2, 4);
}

SurfacePictures bark_pictures(glm::vec3 colour, std::uint32_t seed) {
  SurfaceCanvas canvas(256, 512, bark_sheet_m, 2.0f * bark_sheet_m);
  canvas.paint_all([&](float x, float y, Texel& t) {
    const glm::vec2 p(x / canvas.width_m(), y / canvas.height_m());
    const Cell plate = nearest_cell(
        p * glm::vec2(7.0f, 9.0f) + 0.6f * fractal_noise(p * 8.0f, {8, 8}, 3, seed), {7, 9}, seed + 4);
    const float grain = fractal_noise(p * glm::vec2(40.0f, 16.0f), {40, 16}, 3, seed + 7);
    const float crack = glm::smoothstep(0.16f, 0.02f, plate.border);
    t.colour = colour * (0.6f + 0.4f * plate.identity + 0.4f * grain) * (1.0f - 0.6f * crack);
    t.height_m = 0.02f * (0.5f * grain - crack);
    t.roughness = 0.92f;
    t.openness = 1.0f - 0.4f * crack;
  });
  return canvas.pictures(1, 2);
}

}  // namespace parvis::synthesis

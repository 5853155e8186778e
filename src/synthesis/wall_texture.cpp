#include "synthesis/wall_texture.h"

#include <algorithm>
#include <cmath>

#include "synthesis/noise.h"

namespace parvis::synthesis {
namespace {

/// Noise with features of about `size_m`, fitted to the canvas so that it tiles. The canvas must be larger
/// than them.
class FittedNoise {
 public:
  FittedNoise(const SurfaceCanvas& canvas, glm::vec2 size_m, int octaves, std::uint32_t seed)
      : period_(glm::max(glm::ivec2(glm::round(glm::vec2(canvas.width_m(), canvas.height_m()) / size_m)), 1)),
        scale_(glm::vec2(period_) / glm::vec2(canvas.width_m(), canvas.height_m())),
        octaves_(octaves),
        seed_(seed) {}

  float operator()(float x, float y) const {
    return fractal_noise(glm::vec2(x, y) * scale_, period_, octaves_, seed_);
  }

 private:
  glm::ivec2 period_;
  glm::vec2 scale_;
  int octaves_;
  std::uint32_t seed_;
};

struct Course {
  float to_joint_m;  ///< distance to the nearest joint
  float identity;    ///< random in 0..1, the stone's own
};

/// Stones of a size in running bond; the canvas holds a whole number of them.
Course course_at(const SurfaceCanvas& canvas, glm::vec2 size_m, float x, float y, std::uint32_t seed) {
  const int columns = std::max(int(std::lround(canvas.width_m() / size_m.x)), 1);
  const int rows = std::max(2 * int(std::lround(canvas.height_m() / size_m.y / 2.0f)), 2);
  const glm::vec2 size(canvas.width_m() / float(columns), canvas.height_m() / float(rows));
  const int row = int(std::floor(y / size.y));
  const float along = x / size.x + 0.5f * float(row & 1);
  const int column = (int(std::floor(along)) % columns + columns) % columns;
  const float tx = along - std::floor(along), ty = y / size.y - float(row);
  const float joint = std::min(std::min(tx, 1.0f - tx) * size.x, std::min(ty, 1.0f - ty) * size.y);
  return {joint, lattice_value(column, (row % rows + rows) % rows, seed)};
}

void paint_plaster(SurfaceCanvas& canvas, glm::vec3 colour, std::uint32_t seed) {
  const FittedNoise stains(canvas, {2.6f, 1.7f}, 4, seed), trowel(canvas, {0.35f, 0.22f}, 3, seed + 10);
  const FittedNoise grain(canvas, {0.03f, 0.03f}, 2, seed + 20);
  canvas.paint_all([&](float x, float y, Texel& t) {
    const float stain = stains(x, y) - 0.5f, mark = trowel(x, y) - 0.5f, dot = grain(x, y) - 0.5f;
    t.colour = colour * (1.0f + 0.34f * stain + 0.12f * mark + 0.14f * dot);
    t.colour =
        glm::mix(t.colour, t.colour * glm::vec3(0.92f, 0.97f, 1.03f), std::clamp(2.0f * stain, 0.0f, 1.0f));
    t.height_m = 0.006f * mark + 0.003f * dot;
    t.roughness = 0.9f + 0.1f * stain;
  });
}

void paint_ashlar(SurfaceCanvas& canvas, glm::vec3 colour, std::uint32_t seed) {
  const FittedNoise stains(canvas, {2.2f, 1.6f}, 4, seed), veins(canvas, {0.25f, 0.1f}, 3, seed + 10);
  const FittedNoise grain(canvas, {0.025f, 0.025f}, 2, seed + 20);
  canvas.paint_all([&](float x, float y, Texel& t) {
    const Course stone = course_at(canvas, {0.8f, 0.34f}, x, y, seed + 30);
    const float joint = glm::smoothstep(0.012f, 0.004f, stone.to_joint_m);
    const float tone = 0.16f * (stone.identity - 0.5f) + 0.24f * (stains(x, y) - 0.5f) +
                       0.16f * (veins(x, y) - 0.5f) + 0.14f * (grain(x, y) - 0.5f);
    t.colour = colour * (1.0f + tone) * glm::mix(glm::vec3(1.0f), glm::vec3(0.62f, 0.6f, 0.56f), joint);
    t.height_m = -0.012f * joint + 0.004f * (veins(x, y) - 0.5f);
    t.roughness = 0.82f;
    t.openness = 1.0f - 0.25f * joint;
  });
}

void paint_brick(SurfaceCanvas& canvas, glm::vec3 colour, std::uint32_t seed) {
  const FittedNoise stains(canvas, {2.4f, 1.8f}, 4, seed), grain(canvas, {0.03f, 0.02f}, 2, seed + 10);
  const glm::vec3 mortar(0.42f, 0.39f, 0.34f);
  canvas.paint_all([&](float x, float y, Texel& t) {
    const Course brick = course_at(canvas, {0.22f, 0.072f}, x, y, seed + 20);
    const float joint = glm::smoothstep(0.011f, 0.003f, brick.to_joint_m);
    const float burnt = glm::smoothstep(0.82f, 1.0f, brick.identity);
    const float tone = 0.5f * (brick.identity - 0.5f) + 0.3f * (stains(x, y) - 0.5f) +
                       0.24f * (grain(x, y) - 0.5f) - 0.3f * burnt;
    t.colour = glm::mix(colour * (1.0f + tone), mortar * (0.85f + 0.3f * stains(x, y)), joint);
    t.height_m = -0.008f * joint + 0.002f * grain(x, y);
    t.roughness = 0.88f;
  });
}

}  // namespace

void paint_wall(SurfaceCanvas& canvas, Wall wall, glm::vec3 colour, std::uint32_t seed) {
  switch (wall) {
    case Wall::plaster:
      return paint_plaster(canvas, colour, seed);
    case Wall::ashlar:
      return paint_ashlar(canvas, colour, seed);
    case Wall::brick:
      return paint_brick(canvas, colour, seed);
  }
}

void paint_streaks(SurfaceCanvas& canvas, const Rect& rect, float strength, std::uint32_t seed) {
  const FittedNoise columns(canvas, {0.09f, 3.0f}, 3, seed);
  canvas.paint(rect, [&](float x, float y, Texel& t) {
    const float fallen =
        std::clamp((y - rect.y0) / rect.height(), 0.0f, 1.0f);  // 1 where the rain leaves the ledge
    const float edge = std::min(1.0f, std::min(x - rect.x0, rect.x1 - x) / (0.2f * rect.width() + 0.01f));
    const float dirt = strength * fallen * std::max(edge, 0.0f) * glm::smoothstep(0.35f, 0.8f, columns(x, y));
    t.colour *= glm::vec3(1.0f) - dirt * glm::vec3(0.55f, 0.58f, 0.62f);
  });
}

}  // namespace parvis::synthesis

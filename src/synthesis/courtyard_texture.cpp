// Back yards as they are seen from above: plots between walls and hedges, laid out square to the houses.
#include <algorithm>
#include <cmath>

#include "base/colour.h"
#include "synthesis/ground_texture.h"
#include "synthesis/noise.h"
#include "synthesis/window_texture.h"

namespace parvis::synthesis {
namespace {

constexpr int plots_per_side = 8;
constexpr float plot_m = courtyard_sheet_m / float(plots_per_side);
constexpr float terrace_m = 3.0f;
constexpr float path_m = 0.9f;

enum class PlotKind { lawn, paved, gravel, beds };

/// Where a point lies in its plot: rows of plots are shifted against those beside them.
struct GardenPlot {
  float x = 0.0f, y = 0.0f;  ///< metres from its south-west corner
  float to_border_m = 0.0f;
  float identity = 0.0f, second_identity = 0.0f;

  PlotKind kind() const {
    if (identity < 0.38f) return PlotKind::lawn;
    if (identity < 0.62f) return PlotKind::paved;
    return identity < 0.8f ? PlotKind::gravel : PlotKind::beds;
  }
};

GardenPlot plot_at(float x, float y, std::uint32_t seed) {
  const int column = int(std::floor(x / plot_m)) % plots_per_side;
  const float shifted = y + plot_m * lattice_value(column, 0, seed);
  const int row = int(std::floor(shifted / plot_m)) % plots_per_side;
  GardenPlot plot;
  plot.x = std::fmod(x, plot_m), plot.y = std::fmod(shifted, plot_m);
  plot.to_border_m = std::min(std::min(plot.x, plot_m - plot.x), std::min(plot.y, plot_m - plot.y));
  plot.identity = lattice_value(column, row, seed + 1);
  plot.second_identity = lattice_value(column, row, seed + 2);
  return plot;
}

float to_grid_line(float x, float y, float pitch_m) {
  const float fx = x / pitch_m - std::floor(x / pitch_m), fy = y / pitch_m - std::floor(y / pitch_m);
  return pitch_m * std::min(std::min(fx, 1.0f - fx), std::min(fy, 1.0f - fy));
}

/// Grain of a centimetre or two and patches of some metres, about 1.
struct Wear {
  float grain, patch;
};

Texel lawn(const Wear& wear) {
  const glm::vec3 green = linear_from_srgb8(0x66, 0x7B, 0x40), dry = linear_from_srgb8(0x8A, 0x88, 0x58);
  return matt(glm::mix(green, dry, glm::smoothstep(0.5f, 0.75f, wear.patch)) * (0.6f + 0.7f * wear.grain),
              0.0f, 0.95f);
}

Texel slabs(float x, float y, float pitch_m, const Wear& wear) {
  const glm::vec3 stone = linear_from_srgb8(0xA9, 0xA0, 0x93);
  const float joint = glm::smoothstep(0.05f, 0.02f, to_grid_line(x, y, pitch_m));
  return matt(stone * (0.7f + 0.25f * wear.grain + 0.35f * wear.patch) * (1.0f - 0.45f * joint), 0.0f, 0.9f);
}

Texel gravel(const Wear& wear) {
  return matt(linear_from_srgb8(0xBE, 0xAF, 0x94) * (0.6f + 0.45f * wear.grain + 0.3f * wear.patch), 0.0f,
              0.95f);
}

Texel bed(float along, const Wear& wear) {
  const bool is_row = along - std::floor(along) < 0.55f;
  const glm::vec3 earth = linear_from_srgb8(0x6A, 0x58, 0x44), leaves = linear_from_srgb8(0x5A, 0x74, 0x38);
  return matt((is_row ? leaves : earth) * (0.55f + 0.7f * wear.grain), is_row ? 0.25f : 0.0f, 0.95f);
}

Texel ground_of(const GardenPlot& plot, const Wear& wear) {
  switch (plot.kind()) {
    case PlotKind::paved:
      return slabs(plot.x, plot.y, 0.6f, wear);
    case PlotKind::gravel:
      return gravel(wear);
    case PlotKind::beds:
      if (plot.y > terrace_m && std::abs(plot.x - 0.5f * plot_m) > path_m) return bed(plot.y / 0.8f, wear);
      return gravel(wear);
    case PlotKind::lawn:
      if (plot.y < terrace_m) return slabs(plot.x, plot.y, 0.5f, wear);
      return std::abs(plot.x - (1.0f + 3.0f * plot.second_identity)) < 0.5f * path_m
                 ? slabs(plot.x, plot.y, 0.9f, wear)
                 : lawn(wear);
  }
  return {};
}

/// Leaves seen from above, darker towards the rim of a crown; `height` 1 in its middle, 0 at its rim.
Texel leaves(float height, float height_m, float leaf, float tone) {
  const glm::vec3 green =
      glm::mix(linear_from_srgb8(0x5C, 0x74, 0x36), linear_from_srgb8(0x7C, 0x86, 0x44), tone);
  Texel texel = matt(green * (0.45f + 0.55f * leaf + 0.3f * height), height_m, 0.95f);
  texel.openness = 0.7f + 0.3f * height;
  return texel;
}

void paint_plants(const GardenPlot& plot, float leaf, const Cell& shrub, Texel& texel) {
  const bool has_tree = plot.second_identity > 0.62f && plot.kind() != PlotKind::beds;
  const glm::vec2 trunk(plot_m * (0.35f + 0.3f * plot.identity), plot_m * 0.62f);
  const float radius = 1.9f + 1.3f * plot.second_identity;
  const float reach = glm::distance(glm::vec2(plot.x, plot.y), trunk) + 0.9f * (leaf - 0.5f);
  const float shrub_reach = shrub.distance * 2.0f + 0.5f * (leaf - 0.5f),
              shrub_radius = 0.35f + 0.5f * shrub.identity;
  if (has_tree && reach < radius) {
    const float dome = std::sqrt(1.0f - reach * reach / (radius * radius));
    texel = leaves(dome, 4.0f * dome, leaf, plot.identity);
  } else if (plot.to_border_m < 1.9f && shrub.identity > 0.45f && shrub_reach < shrub_radius) {
    const float dome = 1.0f - shrub_reach / shrub_radius;
    texel = leaves(dome, 0.9f * dome, leaf, shrub.identity);
  } else if (has_tree) {
    texel.openness *= 0.6f + 0.4f * glm::smoothstep(0.0f, 1.2f, reach - radius);
  }
}

void paint_border(const GardenPlot& plot, float leaf, const Wear& wear, Texel& texel) {
  const bool is_hedge = plot.second_identity < 0.4f;
  const float half_m = is_hedge ? 0.45f : 0.14f;
  if (plot.to_border_m > half_m) {
    texel.openness *= 0.7f + 0.3f * glm::smoothstep(0.0f, 0.6f, plot.to_border_m - half_m);
    return;
  }
  texel = is_hedge ? leaves(1.0f - plot.to_border_m / half_m, 1.4f, leaf, 0.2f)
                   : matt(linear_from_srgb8(0xB4, 0xA4, 0x8C) * (0.75f + 0.4f * wear.patch), 1.8f, 0.9f);
}

}  // namespace

SurfacePictures courtyard_pictures(std::uint32_t seed) {
  SurfaceCanvas canvas(1536, 1536, courtyard_sheet_m, courtyard_sheet_m);
  canvas.paint_all([&](float x, float y, Texel& texel) {
    const glm::vec2 p = glm::vec2(x, y) / courtyard_sheet_m;
    const GardenPlot plot = plot_at(x, y, seed);
    const Wear wear{fractal_noise(p * 480.0f, {480, 480}, 1, seed + 3),
                    fractal_noise(p * 14.0f, {14, 14}, 3, seed + 4)};
    const float leaf = fractal_noise(p * 180.0f, {180, 180}, 3, seed + 5);
    texel = ground_of(plot, wear);
    paint_plants(plot, leaf, nearest_cell(p * 48.0f, {48, 48}, seed + 6), texel);
    paint_border(plot, leaf, wear, texel);
  });
  return canvas.pictures(2, 4);
}

}  // namespace parvis::synthesis

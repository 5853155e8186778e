#include "reflections/local_maps/local_map_level.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace parvis::local_maps {
namespace {

constexpr int min_tile = 16;  // borders leave half of it
constexpr int max_tile = 1024;
constexpr float blended_below_px = 40.0f;  // smaller bodies show too little for a map of their own
constexpr float texels_per_pixel =
    0.5f;  // a face spans a quarter turn, of which a body shows a part in half its width
constexpr float blurs_from_px = 16.0f;  // a frame: an eye that stays sees no more of such a body than a smear

// The declared costs: of a map, and of each of its texels, mesh included.
constexpr double map_ms = 0.1, texel_ms = 30e-6;
constexpr double blend_ms = 0.01;
// How much of the best a map of half or a quarter as many texels per side is worth, and simple blending.
constexpr std::array<double, LevelLadder::max_rungs> worths{0.4, 0.75, 0.9, 1.0};

}  // namespace

int tile_of(int resolution) {
  return std::clamp(int(std::bit_ceil(unsigned(std::max(resolution, 1)))), min_tile, max_tile);
}

/// The paper's smallest quad, "the projected box divided by the map's resolution", grows with a body on the
/// screen; what it is to do (no quad smaller than a pixel of the picture) takes the map's resolution divided
/// by the projected box. Motion blur doubles what a texel and a quad span.
LocalMapLevel level_for(float size_px, float speed_px, int resolution) {
  if (size_px < blended_below_px) return {0, 1.0f};
  const bool is_smeared = speed_px > blurs_from_px;
  const float wanted = size_px * texels_per_pixel * (is_smeared ? 0.5f : 1.0f);
  const int tile = std::min(tile_of(int(std::lround(wanted))), tile_of(resolution));
  const float texels_per_pixel = std::exp2(std::floor(std::log2(std::max(float(tile) / size_px, 1.0f))));
  return {tile, texels_per_pixel * (is_smeared ? 2.0f : 1.0f)};
}

LevelLadder ladder_below(const LocalMapLevel& best) {
  LevelLadder ladder{};
  ladder.qualities[0] = {blend_ms, worths[0]};
  ladder.rungs = 1;
  for (std::size_t rung = 1; rung < LevelLadder::max_rungs; ++rung) {
    const int tile = best.tile >> (LevelLadder::max_rungs - 1 - rung);
    if (tile < min_tile) continue;
    ladder.levels[ladder.rungs] = {tile, best.smallest_texels};
    ladder.qualities[ladder.rungs] = {map_ms + texel_ms * 6.0 * tile * tile, worths[rung]};
    ++ladder.rungs;
  }
  return ladder;
}

}  // namespace parvis::local_maps

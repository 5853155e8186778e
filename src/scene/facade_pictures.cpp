#include "scene/facade_pictures.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "scene/tiling_noise.h"

namespace parvis::scene {

namespace {

constexpr int side = 1024;
constexpr float width_m = bay_m * picture_bays, height_m = storey_m * picture_storeys;
constexpr float course_m = 0.0625f, brick_m = 0.21f;  // Dutch "waalformaat", joints included
constexpr float joint_m = 0.012f;
constexpr float window_width_m = 1.15f, window_height_m = 1.75f, parapet_m = 0.75f;
constexpr float frame_m = 0.075f, sill_m = 0.09f, lintel_m = 0.22f;

struct Rectangle {
  float left, bottom, right, top;  ///< metres from the picture's lower left corner
};

/// Calls `colour_at(x_m, y_m)` for each pixel of a rectangle and stores what it returns.
template <class ColourAt>
void paint(Image8& image, const Rectangle& r, ColourAt&& colour_at) {
  const int left = int(std::round(r.left / width_m * side)),
            right = int(std::round(r.right / width_m * side));
  const int top = side - int(std::round(r.top / height_m * side));
  const int bottom = side - int(std::round(r.bottom / height_m * side));
  for (int y = std::max(top, 0); y < std::min(bottom, side); ++y)
    for (int x = std::max(left, 0); x < std::min(right, side); ++x) {
      const glm::vec3 colour =
          colour_at((float(x) + 0.5f) * width_m / side, (float(side - y) - 0.5f) * height_m / side);
      for (int c = 0; c < 3; ++c) image.at(x, y)[c] = std::uint8_t(std::clamp(colour[c], 0.0f, 255.0f));
    }
}

void paint(Image8& image, const Rectangle& r, glm::vec3 colour) {
  paint(image, r, [&](float, float) { return colour; });
}

void paint_bricks(Image8& image, glm::vec3 brick_srgb, Random& random) {
  const TilingNoise stains(5, random), clouds(23, random);
  // A whole number of bricks and courses, so that the picture repeats without a seam.
  const int courses = int(std::round(height_m / course_m)), bricks = int(std::round(width_m / brick_m));
  std::vector<float> tones(std::size_t(courses) * std::size_t(bricks));
  for (float& tone : tones) tone = random.uniform(0.86f, 1.12f);
  paint(image, {0.0f, 0.0f, width_m, height_m}, [&](float x, float y) {
    const float row = y / height_m * float(courses);
    const float column = x / width_m * float(bricks) + (int(row) % 2 ? 0.5f : 0.0f);
    const bool is_joint =
        (row - std::floor(row)) * course_m < joint_m || (column - std::floor(column)) * brick_m < joint_m;
    const glm::vec2 place(x / width_m, (height_m - y) / height_m);
    const float weather = 1.0f + 0.16f * stains.at(place) + 0.12f * clouds.at(place);
    if (is_joint) return weather * glm::mix(brick_srgb, glm::vec3(150, 145, 136), 0.45f);
    return weather * tones[std::size_t(int(row) * bricks + int(column) % bricks)] * brick_srgb;
  });
}

/// A pane: dark and bluish, lighter upward where it shows the sky; the reveal shades its top and left.
void paint_pane(Image8& image, const Rectangle& pane, float curtain, bool has_drapes) {
  paint(image, pane, [&](float x, float y) {
    const float up = (y - pane.bottom) / (pane.top - pane.bottom);
    const float across = (x - pane.left) / (pane.right - pane.left);
    glm::vec3 colour = glm::mix(glm::vec3(34, 38, 42), glm::vec3(62, 70, 78), up);
    if (has_drapes && std::abs(across - 0.5f) > 0.3f)
      colour = glm::vec3(150, 143, 130) * (0.8f + 0.2f * std::sin(90.0f * across));
    if (up < curtain) colour = glm::mix(colour, glm::vec3(172, 170, 162), 0.55f);
    const bool is_shaded = pane.top - y < 0.12f || x - pane.left < 0.06f;
    return is_shaded ? 0.45f * colour : colour;
  });
}

Rectangle window_of(int bay, int storey) {
  const float left = (float(bay) + 0.5f) * bay_m - 0.5f * window_width_m;
  const float bottom = float(storey) * storey_m + parapet_m;
  return {left, bottom, left + window_width_m, bottom + window_height_m};
}

void paint_window(Image8& image, const Rectangle& w, glm::vec3 brick_srgb, Random& random) {
  paint(image, {w.left - 0.06f, w.top, w.right + 0.06f, w.top + lintel_m}, [&](float x, float) {
    const float place = x / course_m;  // bricks on end
    return (place - std::floor(place) < 0.2f ? 1.05f : 0.82f) * brick_srgb;
  });
  const glm::vec3 frame = random.chance(0.8f) ? glm::vec3(222, 220, 212) : glm::vec3(70, 92, 82);
  paint(image, w, frame);
  const float curtain = random.chance(0.5f) ? random.uniform(0.2f, 0.5f) : 0.0f;
  const bool has_drapes = random.chance(0.4f);
  const float bar = w.bottom + 0.68f * window_height_m;  // the upper lights of older houses
  paint_pane(image, {w.left + frame_m, w.bottom + frame_m, w.right - frame_m, bar}, curtain, has_drapes);
  paint_pane(image, {w.left + frame_m, bar + 0.05f, w.right - frame_m, w.top - frame_m}, 0.0f, false);
  paint(image, {w.left - 0.07f, w.bottom - sill_m, w.right + 0.07f, w.bottom}, glm::vec3(176, 170, 158));
  paint(image, {w.left - 0.07f, w.bottom - sill_m - 0.05f, w.right + 0.07f, w.bottom - sill_m},
        0.55f * brick_srgb);
}

}  // namespace

Texture brick_wall_picture(glm::vec3 brick_srgb, bool has_windows, std::uint64_t seed) {
  Random random(seed);
  Texture texture{has_windows ? "brick wall with windows" : "brick wall", Image8(side, side, 4, 255)};
  paint_bricks(texture.image, brick_srgb, random);
  for (int storey = 0; has_windows && storey < picture_storeys; ++storey)
    for (int bay = 0; bay < picture_bays; ++bay)
      paint_window(texture.image, window_of(bay, storey), brick_srgb, random);
  return texture;
}

Texture brick_wall_surface() {
  Texture texture{"brick wall surface", Image8(side, side, 4, 255)};
  texture.is_srgb = false;
  const glm::vec3 rough(255, 230, 0), glassy(255, 20, 0);  // ambient occlusion, roughness, metallic
  paint(texture.image, {0.0f, 0.0f, width_m, height_m}, rough);
  for (int storey = 0; storey < picture_storeys; ++storey)
    for (int bay = 0; bay < picture_bays; ++bay) {
      const Rectangle w = window_of(bay, storey);
      paint(texture.image, {w.left + frame_m, w.bottom + frame_m, w.right - frame_m, w.top - frame_m},
            glassy);
    }
  return texture;
}

}  // namespace parvis::scene

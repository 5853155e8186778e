// A canvas in metres on which materials are painted: colour, relief, roughness and occlusion together, so
// that the textures of a material (colour, normal, surface) always agree.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "base/image.h"

namespace parvis::synthesis {

/// One point of a surface.
struct Texel {
  glm::vec3 colour{0.5f};  ///< linear
  float height_m = 0.0f;   ///< above the sheet
  float roughness = 0.85f;
  float metallic = 0.0f;
  float openness = 1.0f;  ///< ambient occlusion, 1 = open
  float alpha = 1.0f;
};

/// A rectangle in metres; x to the right, y up from the bottom of the sheet.
struct Rect {
  float x0 = 0.0f, y0 = 0.0f, x1 = 0.0f, y1 = 0.0f;

  float width() const { return x1 - x0; }   ///< metres
  float height() const { return y1 - y0; }  ///< metres
  /// The rectangle with each side moved inward by `by` metres.
  Rect inset(float by) const { return {x0 + by, y0 + by, x1 - by, y1 - by}; }
};

/// Depth of relief in a normal texture: its alpha is 0 this far below the sheet, 1 on it.
inline constexpr float canvas_relief_m = 0.25f;

/// The three textures of glTF's metallic-roughness material.
struct SurfacePictures {
  Image8 colour, normal, surface;
};

/// The sheet under construction.
class SurfaceCanvas {
 public:
  /// Fills the sheet with `ground`. Painting wraps around all four edges, so the sheet tiles.
  SurfaceCanvas(int width_px, int height_px, float width_m, float height_m, const Texel& ground = {});

  float width_m() const { return width_m_; }    ///< of the sheet
  float height_m() const { return height_m_; }  ///< of the sheet

  /// Calls paint(x_m, y_m, texel) for the texels whose centres lie in `rect`; x_m and y_m are not wrapped.
  template <class Paint>
  void paint(const Rect& rect, Paint&& paint);
  /// Calls paint(x_m, y_m, texel) for all texels.
  template <class Paint>
  void paint_all(Paint&& body) {
    paint(Rect{0.0f, 0.0f, width_m_, height_m_}, body);
  }

  /// Fills a rectangle with a material; texels on its edges are blended by coverage.
  void fill(const Rect& rect, const Texel& material);
  /// Adds ambient occlusion in a rectangle: `amount` at its top, fading to zero at its bottom.
  void shade_below(const Rect& rect, float amount);
  /// Adds ambient occlusion from the left edge to the right (right to left for a negative amount).
  void shade_beside(const Rect& rect, float amount);

  /// The textures: colour (sRGB, with alpha), normals from the relief with its depth as alpha, and
  /// occlusion-roughness-metallic. `normal_shrink` and `surface_shrink` divide the resolution of the latter
  /// two.
  SurfacePictures pictures(int normal_shrink, int surface_shrink) const;

  /// The glass alone, lit from inside: what is seen in it, brighter than by day, with an alpha of 1. Its
  /// resolution is divided by `shrink`.
  Image8 lit_glass(int shrink) const;

 private:
  Texel& texel(int x, int y);
  const Texel& texel(int x, int y) const;
  ImageF relief() const;

  int width_px_, height_px_;
  float width_m_, height_m_;
  std::vector<Texel> texels_;
};

template <class Paint>
void SurfaceCanvas::paint(const Rect& rect, Paint&& paint) {
  const float x_m = width_m_ / float(width_px_), y_m = height_m_ / float(height_px_);
  const int left = int(glm::ceil(rect.x0 / x_m - 0.5f)), right = int(glm::ceil(rect.x1 / x_m - 0.5f));
  const int foot = int(glm::ceil(rect.y0 / y_m - 0.5f)), top = int(glm::ceil(rect.y1 / y_m - 0.5f));
  for (int y = foot; y < top; ++y)
    for (int x = left; x < right; ++x) paint((float(x) + 0.5f) * x_m, (float(y) + 0.5f) * y_m, texel(x, y));
}

}  // namespace parvis::synthesis

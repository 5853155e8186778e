#include "synthesis/surface_canvas.h"

#include <algorithm>
#include <cmath>

#include "base/colour.h"
#include "synthesis/noise.h"

namespace parvis::synthesis {
namespace {

Texel mixed(const Texel& a, const Texel& b, float t) {
  Texel m;
  m.colour = glm::mix(a.colour, b.colour, t);
  m.height_m = glm::mix(a.height_m, b.height_m, t);
  m.roughness = glm::mix(a.roughness, b.roughness, t);
  m.metallic = glm::mix(a.metallic, b.metallic, t);
  m.openness = glm::mix(a.openness, b.openness, t);
  m.alpha = glm::mix(a.alpha, b.alpha, t);
  return m;
}

/// Share of the cell [i, i + 1] that [low, high] covers.
float covered(int i, float low, float high) {
  return std::clamp(std::min(high, float(i + 1)) - std::max(low, float(i)), 0.0f, 1.0f);
}

std::uint8_t byte(float value) { return std::uint8_t(std::lround(std::clamp(value, 0.0f, 1.0f) * 255.0f)); }

/// sRGB encoding through a table: pow for every pixel of every texture would take a second.
std::uint8_t srgb_byte(float linear) {
  static const std::vector<std::uint8_t> table = [] {
    std::vector<std::uint8_t> values(4096);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = byte(srgb_from_linear(float(i) / 4095.0f));
    return values;
  }();
  return table[std::size_t(std::lround(std::clamp(linear, 0.0f, 1.0f) * 4095.0f))];
}

/// Means over squares of `shrink` pixels, as bytes; without a fourth channel alpha is 1.
Image8 shrunk(const ImageF& image, int shrink) {
  Image8 result(image.width / shrink, image.height / shrink, 4, 255);
  for (int y = 0; y < result.height; ++y)
    for (int x = 0; x < result.width; ++x)
      for (int c = 0; c < image.channels; ++c) {
        float sum = 0.0f;
        for (int j = 0; j < shrink; ++j)
          for (int i = 0; i < shrink; ++i) sum += image.at(x * shrink + i, y * shrink + j)[c];
        result.at(x, y)[c] = byte(sum / float(shrink * shrink));
      }
  return result;
}

}  // namespace

SurfaceCanvas::SurfaceCanvas(int width_px, int height_px, float width_m, float height_m, const Texel& ground)
    : width_px_(width_px),
      height_px_(height_px),
      width_m_(width_m),
      height_m_(height_m),
      texels_(std::size_t(width_px) * std::size_t(height_px), ground) {}

Texel& SurfaceCanvas::texel(int x, int y) {
  return texels_[std::size_t(wrapped(y, height_px_)) * std::size_t(width_px_) +
                 std::size_t(wrapped(x, width_px_))];
}

const Texel& SurfaceCanvas::texel(int x, int y) const {
  return texels_[std::size_t(wrapped(y, height_px_)) * std::size_t(width_px_) +
                 std::size_t(wrapped(x, width_px_))];
}

void SurfaceCanvas::fill(const Rect& rect, const Texel& material) {
  const float px = float(width_px_) / width_m_, py = float(height_px_) / height_m_;
  const float x0 = rect.x0 * px, x1 = rect.x1 * px, y0 = rect.y0 * py, y1 = rect.y1 * py;
  for (int y = int(std::floor(y0)); float(y) < y1; ++y)
    for (int x = int(std::floor(x0)); float(x) < x1; ++x) {
      const float share = covered(x, x0, x1) * covered(y, y0, y1);
      if (share > 0.0f) texel(x, y) = mixed(texel(x, y), material, share);
    }
}

void SurfaceCanvas::shade_below(const Rect& rect, float amount) {
  paint(rect, [&](float, float y, Texel& t) {
    const float near = std::clamp((y - rect.y0) / rect.height(), 0.0f, 1.0f);
    t.openness *= 1.0f - amount * near * near;
  });
}

void SurfaceCanvas::shade_beside(const Rect& rect, float amount) {
  paint(rect, [&](float x, float, Texel& t) {
    float near = std::clamp((rect.x1 - x) / rect.width(), 0.0f, 1.0f);
    if (amount < 0.0f) near = 1.0f - near;
    t.openness *= 1.0f - std::abs(amount) * near * near;
  });
}

ImageF SurfaceCanvas::relief() const {
  ImageF relief(width_px_, height_px_, 4);
  const float x_m = width_m_ / float(width_px_), y_m = height_m_ / float(height_px_);
  // A step of 0.2 m between two pixels would stand upright and be lost in the mipmaps: slopes are held to 2.
  const auto slope = [](float rise, float run) { return std::clamp(rise / run, -2.0f, 2.0f); };
  for (int y = 0; y < height_px_; ++y)
    for (int x = 0; x < width_px_; ++x) {
      const float dx = slope(texel(x + 1, y).height_m - texel(x - 1, y).height_m, 2.0f * x_m);
      const float dy = slope(texel(x, y + 1).height_m - texel(x, y - 1).height_m, 2.0f * y_m);
      const glm::vec3 normal = glm::normalize(glm::vec3(-dx, -dy, 1.0f));
      float* out = relief.at(x, height_px_ - 1 - y);
      for (int c = 0; c < 3; ++c) out[c] = 0.5f + 0.5f * normal[c];
      out[3] = 1.0f + std::min(texel(x, y).height_m, 0.0f) / canvas_relief_m;
    }
  return relief;
}

Image8 SurfaceCanvas::lit_glass(int shrink) const {
  constexpr float max_glass_roughness = 0.08f;  // nothing else on a sheet is so smooth
  constexpr float room = 0.35f, cloth = 2.2f;   // of a lit wall behind, and how much light things let through
  ImageF lit(width_px_, height_px_, 4);
  for (int y = 0; y < height_px_; ++y)
    for (int x = 0; x < width_px_; ++x) {
      const Texel& t = texel(x, y);
      float* out = lit.at(x, height_px_ - 1 - y);
      const bool is_glass = t.roughness < max_glass_roughness;
      for (int c = 0; c < 3; ++c)
        out[c] =
            srgb_from_linear(is_glass ? std::min((room + cloth * t.colour[c]) * t.openness, 1.0f) : 0.0f);
      out[3] = is_glass ? 1.0f : 0.0f;
    }
  return shrunk(lit, shrink);
}

SurfacePictures SurfaceCanvas::pictures(int normal_shrink, int surface_shrink) const {
  SurfacePictures result;
  result.colour = Image8(width_px_, height_px_, 4);
  ImageF surface(width_px_, height_px_, 3);
  for (int y = 0; y < height_px_; ++y)
    for (int x = 0; x < width_px_; ++x) {
      const Texel& t = texel(x, y);
      std::uint8_t* colour = result.colour.at(x, height_px_ - 1 - y);
      // Part of the occlusion goes into the colour: crevices also lose the light that walls reflect onto each
      // other.
      for (int c = 0; c < 3; ++c) colour[c] = srgb_byte(t.colour[c] * (0.4f + 0.6f * t.openness));
      colour[3] = byte(t.alpha);
      float* values = surface.at(x, height_px_ - 1 - y);
      values[0] = t.openness, values[1] = t.roughness, values[2] = t.metallic;
    }
  result.normal = shrunk(relief(), normal_shrink);
  result.surface = shrunk(surface, surface_shrink);
  return result;
}

}  // namespace parvis::synthesis

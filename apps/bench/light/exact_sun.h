// What the pixels of a view truly see of the sun, by the tracer in double precision, and how many of a
// picture's pixels say otherwise.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "base/camera.h"
#include "bench/light/double_tracer.h"

namespace parvis::bench {

/// Of a picture of `width` x `height` pixels those that are judged: the first of each square of `step` x
/// `step`, top row first.
struct JudgedPixels {
  int width = 0, height = 0, step = 1;

  int columns() const { return (width + step - 1) / step; }
  int rows() const { return (height + step - 1) / step; }
  std::size_t count() const { return std::size_t(columns()) * std::size_t(rows()); }
};

/// What the middle of each judged pixel sees of the sun: -1 nothing that faces it, or nothing that is known;
/// 0 shadow, 1 light.
using SunPicture = std::vector<signed char>;

/// A middle is in shadow if the line from the very point that it shows to the middle of the sun crosses a
/// triangle whose front the sun sees: shadows as they are drawn. Where a surface of `unknown` (null: there
/// are none) may lie on the line from the eye, or on that to the sun, the pixel is -1.
SunPicture exact_sun(const DoubleTracer& tracer, const Camera& camera, const JudgedPixels& pixels,
                     glm::dvec3 to_sun, const DoubleTracer* unknown = nullptr);

/// The share of the sun in each judged pixel; 1 where nothing faces it.
using SunShares = std::vector<float>;

/// `share_at(x, y)`, y from the top, of each judged pixel of a picture.
template <class ShareAt>
SunShares judged_shares(const JudgedPixels& pixels, const ShareAt& share_at) {
  SunShares shares;
  shares.reserve(pixels.count());
  for (int y = 0; y < pixels.height; y += pixels.step)
    for (int x = 0; x < pixels.width; x += pixels.step)
      shares.push_back(share_at(std::size_t(x), std::size_t(y)));
  return shares;
}

/// From this share on a pixel counts as lit.
inline constexpr float half_lit = 0.5f;

/// Wrong pixels among those of which a truth is known.
struct WrongSun {
  long wrong = 0, pixels = 0;
  double off = 0.0;  ///< sum of the differences of shares

  /// Counts the pixels of one more picture.
  void add(const SunPicture& truth, const SunShares& shares);
  /// NaN of no pixels, which meets no target.
  double percent() const;
  /// Mean difference of the share from the truth; NaN of no pixels.
  double mean_off_percent() const;
};

/// A unit direction to the sun turned sideways, along the great circle that is level there, by exactly so
/// many degrees: a control's sun. Not of a sun in the zenith.
glm::vec3 turned_sun(glm::vec3 to_sun, float degrees);

}  // namespace parvis::bench

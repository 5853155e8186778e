// How well rendered views agree with photographs that were held out (virtual rephotography, Waechter et al.
// 2017).
#pragma once

#include "base/image.h"

namespace parvis::facades {

struct Rephotography {
  double psnr_db = 0.0;  ///< of 8-bit sRGB values, covered pixels
  double psnr_cc_db =
      0.0;             ///< after the affine map per channel that fits best: exposure and white balance aside
  double error = 1.0;  ///< mean of 1 - NCC of luminance in windows of 2 * ncc_radius + 1 pixels
  double covered_percent = 0.0;  ///< pixels of alpha > 0, of those that count
};

inline constexpr int ncc_radius = 5;

/// `rendered`: RGBA, 8-bit sRGB, alpha 0 where nothing was rendered; `photograph`: 3 or 4 channels of the
/// same size. `counts` (1 channel, empty: all): the pixels that should be covered, those > 127.
Rephotography rephotography(const Image8& rendered, const Image8& photograph, const Image8& counts = {});

}  // namespace parvis::facades

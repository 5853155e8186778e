// How different two pictures are: FLIP (Andersson et al. 2020, LDR), PSNR and SSIM (Wang et al. 2004), over
// all pixels or those of a mask.
#pragma once

#include "base/image.h"
#include "base/result.h"

namespace parvis::reference {

struct Difference {
  double flip = 0.0;  ///< mean, 0 (same) to 1
  double psnr = 0.0;  ///< dB over the three sRGB channels; infinite where the pictures are equal
  double ssim = 1.0;  ///< mean, of luminance
  ImageF flip_map;    ///< a channel, of the whole picture
};

/// Compares two 8-bit sRGB pictures of one size (3 or 4 channels; alpha is passed over). FLIP takes a display
/// of 67 pixels a degree. `mask` (empty: all pixels) has their size; pixels whose first channel is 128 or
/// more count. The filters run over the whole pictures, and the means over the masked pixels. A mask without
/// pixels is an error.
Result<Difference> compare(const Image8& test, const Image8& reference, const Image8& mask = {});

/// FLIP in false colours, from black over purple and orange to white-yellow.
Image8 heat_map(const ImageF& flip_map);

}  // namespace parvis::reference

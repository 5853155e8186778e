// Vector quantisation of billboard textures: many blocks of 4x4 texels share few.
#pragma once

#include "base/result.h"
#include "capture/trees/billboard_tree.h"

namespace parvis::trees {

/// Result of a quantisation.
struct Quantisation {
  std::size_t blocks = 0;  ///< of all textures
  std::size_t codes = 0;   ///< that they share
  /// Root mean square difference of texels over RGBA, premultiplied sRGB, 0..1.
  double rmse = 0.0;

  double psnr_db() const;  ///< of that difference; infinite without one
};

/// Replaces the 4x4 blocks of all textures by at most `max_codes` blocks, which are as a file stores them
/// (texture_blocks.h): write_tree then stores each once. Errors: a texture side that is no multiple of 4; not
/// enough memory.
Result<Quantisation> quantise_textures(BillboardTree& tree, std::size_t max_codes);

}  // namespace parvis::trees

// How far a picture is from the one that is expected.
#pragma once

#include "graphics/reference/metrics.h"

namespace parvis::bench {

/// FLIP of two pictures, over the pixels of a mask (empty: all). Fails where `picture` is an error, or as
/// reference::compare.
inline Result<double> flip_between(const Result<Image8>& picture, const Image8& expected,
                                   const Image8& mask = {}) {
  if (!picture) return picture.errors();
  const Result<reference::Difference> difference = reference::compare(*picture, expected, mask);
  if (!difference) return difference.errors();
  return difference->flip;
}

}  // namespace parvis::bench

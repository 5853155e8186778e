// Heights of a surface over a rectangle of its plane, from photographs: for each height they are projected
// onto the lifted rectangle and compared (plane sweep, Collins 1996), and the heights are chosen together
// (semi-global matching, Hirschmueller 2008).
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "base/image.h"
#include "capture/facades/view.h"

namespace parvis::facades {

/// A photograph as the sweep looks at it: luminance, halved again and again.
struct GreyPhoto {
  View view;
  std::vector<Image8> levels;  ///< 1 channel; the first of the photograph's size
};

/// The luminance of an sRGB picture (3 or 4 channels) with its halved copies.
GreyPhoto grey_photo(const View& view, const Image8& picture);

/// A rectangle on a plane, divided into a grid that includes its edges, and the heights to try.
struct SweptRectangle {
  glm::dvec3 origin{0.0}, u{0.0}, v{0.0};  ///< a corner and the edges from it, world
  glm::dvec3 normal{0.0};                  ///< unit, towards the cameras
  int columns = 0, rows = 0;               ///< grid points along u and v
  double low = 0.0, high = 0.0;            ///< heights along the normal, world units
};

/// The sweep's results at each grid point, row by row (columns along u).
struct SweptHeights {
  std::vector<float> heights;    ///< world units along the normal
  std::vector<float> agreement;  ///< correlation of the photographs that agree best there, 0..1
  int photographs = 0;  ///< that were compared; 0: fewer than two show the rectangle, and nothing was found
};

/// The photographs that a sweep of the rectangle compares, those that show most of it first; indices into
/// `photos`.
std::vector<std::size_t> photos_of_sweep(const SweptRectangle& rectangle, std::span<const GreyPhoto> photos);

/// Sweeps the rectangle. Photographs are chosen by what they show of it.
SweptHeights swept_heights(const SweptRectangle& rectangle, std::span<const GreyPhoto> photos);

}  // namespace parvis::facades

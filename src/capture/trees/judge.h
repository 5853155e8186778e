// How close a picture of a captured tree comes to the photograph from the same place.
#pragma once

#include "base/result.h"
#include "capture/trees/tree_view.h"

namespace parvis::trees {

/// Errors of one view, or their mean.
struct ViewErrors {
  double psnr_db = 0.0;     ///< over white, sRGB
  double ssim = 0.0;        ///< over white
  double flip = 0.0;        ///< over white, mean
  double alpha_rmse = 0.0;  ///< 0..1
  /// Intersection over union of where the two have an alpha of half or more, 0..1; 1 where neither has.
  double silhouette_iou = 0.0;

  ViewErrors& operator+=(const ViewErrors& other);
  ViewErrors& operator/=(double count);
};

/// A premultiplied picture of linear light over white, 8-bit sRGB. Light adds up before it is encoded, as in
/// a camera and in Parvis.
Image8 over_white(const ImageF& premultiplied);
/// A view over white, 8-bit sRGB.
Image8 over_white(const Image8& straight);

/// Compares a premultiplied picture of linear light with the view of the same size.
Result<ViewErrors> judged(const ImageF& premultiplied, const TreeView& view);

}  // namespace parvis::trees

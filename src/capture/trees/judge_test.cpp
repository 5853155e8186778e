// What two silhouettes have in common, on pictures whose answer is known.
#include "capture/trees/judge.h"

#include <gtest/gtest.h>

namespace parvis::trees {
namespace {

constexpr int picture_side = 32;

/// White, opaque in columns [first, first + 8).
TreeView columns(int first) {
  TreeView view{"columns", {}, Image8(picture_side, picture_side, 4)};
  for (int y = 0; y < picture_side; ++y)
    for (int x = 0; x < picture_side; ++x) {
      std::uint8_t* pixel = view.picture.at(x, y);
      pixel[0] = pixel[1] = pixel[2] = 255, pixel[3] = x >= first && x < first + 8 ? 255 : 0;
    }
  return view;
}

/// The same with this alpha, premultiplied.
ImageF shown_columns(int first, float alpha) {
  ImageF picture(picture_side, picture_side, 4);
  for (int y = 0; y < picture_side; ++y)
    for (int x = first; x < first + 8; ++x)
      for (std::size_t c = 0; c < 4; ++c)
        picture.pixels[4 * (std::size_t(y) * picture_side + std::size_t(x)) + c] = alpha;
  return picture;
}

double iou(const ImageF& picture, const TreeView& view) {
  const Result<ViewErrors> errors = judged(picture, view);
  EXPECT_TRUE(errors) << to_string(errors.errors());
  return errors->silhouette_iou;
}

TEST(Judge, SilhouettesAreComparedByIntersectionOverUnion) {
  EXPECT_DOUBLE_EQ(iou(shown_columns(4, 1.0f), columns(4)), 1.0);
  EXPECT_DOUBLE_EQ(iou(shown_columns(8, 1.0f), columns(4)), 4.0 / 12.0);
  EXPECT_DOUBLE_EQ(iou(shown_columns(20, 1.0f), columns(4)), 0.0);
  EXPECT_DOUBLE_EQ(iou(shown_columns(4, 0.6f), columns(4)), 1.0) << "half opaque or more is shown";
  EXPECT_DOUBLE_EQ(iou(shown_columns(4, 0.4f), columns(4)), 0.0);
  EXPECT_DOUBLE_EQ(iou(ImageF(picture_side, picture_side, 4), columns(picture_side)), 1.0)
      << "neither shows anything";
}

}  // namespace
}  // namespace parvis::trees

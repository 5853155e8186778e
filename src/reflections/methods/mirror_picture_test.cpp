#include "reflections/methods/mirror_picture.h"

#include <gtest/gtest.h>

namespace parvis::methods {
namespace {

/// Northward from the origin, 90 degrees wide and high.
render::View view_of_200_pixels() {
  Camera camera;
  camera.world_from_camera = look_at({0, 0, 0}, {0, 10, 0});
  camera.vertical_fov = 1.5707963f;
  return render::camera_view(camera, 0, 200, 200);
}

TEST(PixelsOf, ABoxAreItsProjectionAndAMargin) {
  // Its front stands 10 m away, where a metre has ten pixels.
  EXPECT_EQ(pixels_of(view_of_200_pixels(), {{-2.05f, 10, -1.05f}, {3.05f, 12, 4.05f}}),
            glm::ivec4(78, 88, 54, 54));
}

TEST(PixelsOf, ABoxThatLeavesTheViewEndAtItsBorder) {
  const glm::ivec4 pixels = pixels_of(view_of_200_pixels(), {{5, 10, -1}, {30, 12, 1}});
  EXPECT_EQ(pixels.x + pixels.z, 200);
  EXPECT_EQ(pixels.x, 140);  // 141.6 at its far end
  EXPECT_LE(pixels_of(view_of_200_pixels(), {{30, 10, -1}, {40, 12, 1}}).z, 1);
}

TEST(PixelsOf, ABoxBesideTheEyeMayBeAll) {
  EXPECT_EQ(pixels_of(view_of_200_pixels(), {{-1, -1, -1}, {1, 1, 1}}), glm::ivec4(0, 0, 200, 200));
}

}  // namespace
}  // namespace parvis::methods

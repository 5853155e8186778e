#include "capture/trees/crossed_billboards.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/colour.h"
#include "capture/trees/judge.h"
#include "capture/trees/test_volume.h"

namespace parvis::trees {
namespace {

TEST(CrossedBillboards, TwoPhotographsAtRightAnglesAreTaken) {
  const TestVolume ball(27, 0.3f);
  const std::vector<TreeView> views = ball.ring(12, 32);
  const CrossedBillboards found = crossed_billboards(views, ball.grid.box());
  EXPECT_NEAR(glm::dot(found.normals[0], found.normals[1]), 0.0f, 1e-4f);
  EXPECT_EQ(found.cameras[0].position_in_world, views[0].camera.position_in_world);
}

TEST(CrossedBillboards, FromTheFirstPhotographsPlaceThePictureIsThatPhotograph) {
  const TestVolume ball(27, 0.3f);
  const std::vector<TreeView> views = ball.ring(12, 96);
  const CrossedBillboards crossed = crossed_billboards(views, ball.grid.box());
  const auto alpha_error = [&](const TreeView& view) {
    const ImageF shown = render_crossed_billboards(crossed, view.camera);
    double sum = 0.0;
    for (std::size_t i = 3; i < shown.pixels.size(); i += 4)
      sum += std::abs(double(shown.pixels[i]) - double(view.picture.pixels[i]) / 255.0);
    return sum / (double(shown.pixels.size()) / 4.0);
  };
  // The other picture is seen edge on: it adds a stripe of a pixel's width.
  EXPECT_LT(alpha_error(views[0]), 0.01);
  // Halfway between the two the pictures cover each other, and are foreshortened.
  EXPECT_GT(alpha_error(ball.view(0.785f, 1.2f, 96)), 5.0 * alpha_error(views[0]));
}

}  // namespace
}  // namespace parvis::trees

// The GPU's sky equals the C++ build of the same files.
#include <gtest/gtest.h>

#include "graphics/gl/test_context.h"
#include "graphics/light/test_drawn_sky_check.h"
#include "graphics/light/test_sky_gpu_check.h"

namespace parvis::light {
namespace {

class SkyOnGpu : public gl::ContextTest {};

TEST_F(SkyOnGpu, TheSameNumbersOnBothSides) {
  for (const double elevation : {-3.0, 8.0, 70.0}) {
    const Result<SkyGpuCheck> check = check_sky_on_gpu(Air{3.0}, elevation);
    ASSERT_TRUE(check) << to_string(check.errors());
    EXPECT_LE(check->max_relative_error, 1e-3) << elevation;
    EXPECT_EQ(check->bad_samples, 0);
    EXPECT_GT(check->samples, 50'000);
  }
}

TEST_F(SkyOnGpu, AWrongTableIsSeen) {
  const Result<SkyGpuCheck> check = check_sky_on_gpu(Air{3.0}, 8.0, 1.0f);
  ASSERT_TRUE(check) << to_string(check.errors());
  EXPECT_GT(check->max_relative_error, 1e-2);
}

TEST_F(SkyOnGpu, ATableBelowZeroGivesBadSamples) {
  const Result<SkyGpuCheck> check = check_sky_on_gpu(Air{3.0}, 10.0, -1.0f);
  ASSERT_TRUE(check) << to_string(check.errors());
  EXPECT_GT(check->bad_samples, 0);
}

TEST_F(SkyOnGpu, TheDrawnSkyIsThatOfTheRayTracer) {
  for (const double elevation : {-3.0, 2.0, 10.0, 70.0}) {
    const Result<DrawnSkyError> error = drawn_sky_error(SkyKind::atmosphere, 3.0, elevation);
    ASSERT_TRUE(error) << to_string(error.errors());
    EXPECT_LE(error->of_build, 1e-3) << elevation;
    EXPECT_GT(error->samples, 250'000) << "all channels of six views";
    std::printf("sun at %g degrees: %.1e of the model in the mean\n", elevation, error->of_model);
    EXPECT_LE(error->of_model, 1e-3) << elevation;
  }
  const Result<DrawnSkyError> turned = drawn_sky_error(SkyKind::atmosphere, 3.0, 10.0, 1.0f);
  ASSERT_TRUE(turned) << to_string(turned.errors());
  EXPECT_GT(turned->of_build, 1e-2) << "turned by a degree";
  EXPECT_GT(turned->of_model, 2e-3) << "turned by a degree";
}

}  // namespace
}  // namespace parvis::light

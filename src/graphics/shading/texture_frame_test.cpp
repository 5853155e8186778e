#include "graphics/shading/texture_frame.h"

#include <gtest/gtest.h>

#include "graphics/shading/test_axes.h"

namespace parvis::shading {
namespace {

/// A level surface whose u runs east and whose v runs south, as the rows of an upright picture do.
const TextureFrame upright{{2, 0, 0}, {0, 3, 0}, {0.5f, 0.0f}, {0.0f, -0.5f}};

vec3 texel_of(vec3 n) { return 0.5f * n + vec3(0.5f); }

TEST(TextureFrame, AFlatMapLeavesTheNormal) {
  EXPECT_LT(length(mapped_normal(upright, up, vec3(0.5f, 0.5f, 1.0f), 1.0f) - up), 1e-6f);
}

TEST(TextureFrame, XLeansAlongUAndYAgainstV) {
  const vec3 east = mapped_normal(upright, up, texel_of({0.6f, 0.0f, 0.8f}), 1.0f);
  EXPECT_LT(length(east - vec3(0.6f, 0.0f, 0.8f)), 1e-6f);
  const vec3 north = mapped_normal(upright, up, texel_of({0.0f, 0.6f, 0.8f}), 1.0f);
  EXPECT_LT(length(north - vec3(0.0f, 0.6f, 0.8f)), 1e-6f);
}

TEST(TextureFrame, AMirroredTextureLeansTheOtherWay) {
  const TextureFrame mirrored{{2, 0, 0}, {0, 3, 0}, {-0.5f, 0.0f}, {0.0f, -0.5f}};
  const vec3 west = mapped_normal(mirrored, up, texel_of({0.6f, 0.0f, 0.8f}), 1.0f);
  EXPECT_LT(length(west - vec3(-0.6f, 0.0f, 0.8f)), 1e-6f);
  const vec3 north = mapped_normal(mirrored, up, texel_of({0.0f, 0.6f, 0.8f}), 1.0f);
  EXPECT_LT(length(north - vec3(0.0f, 0.6f, 0.8f)), 1e-6f);
}

TEST(TextureFrame, ScaleSteepensIt) {
  const vec3 east = mapped_normal(upright, up, texel_of({0.6f, 0.0f, 0.8f}), 2.0f);
  EXPECT_LT(length(east - normalize(vec3(1.2f, 0.0f, 0.8f))), 1e-6f);
}

TEST(TextureFrame, WithoutGradientsTheNormalStays) {
  const TextureFrame none{{2, 0, 0}, {0, 3, 0}, {0.5f, 0.0f}, {1.0f, 0.0f}};
  EXPECT_EQ(mapped_normal(none, up, texel_of({0.6f, 0.0f, 0.8f}), 1.0f), up);
  const TextureFrame along_normal{{0, 0, 2}, {0, 0, 2}, {0.5f, 0.0f}, {0.0f, 0.5f}};
  EXPECT_EQ(mapped_normal(along_normal, up, texel_of({0.6f, 0.0f, 0.8f}), 1.0f), up);
}

}  // namespace
}  // namespace parvis::shading

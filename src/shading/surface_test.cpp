#include "shading/surface.h"

#include <gtest/gtest.h>

#include <initializer_list>

namespace parvis::shading {
namespace {

Surface surface(float base, float metallic, float roughness, float coat = 0.0f) {
  return {vec3(0, 0, 1), vec3(base), metallic, roughness, coat, 0.2f, 0.0f, 1.0f, vec3(0.0f)};
}

vec3 at_angle(float cosine) { return {std::sqrt(1.0f - cosine * cosine), 0.0f, cosine}; }

/// What a surface sends to the viewer when light of radiance 1 comes from everywhere above it: integrated
/// over the hemisphere at the middles of cells of equal solid angle.
float furnace(const Surface& s, vec3 to_viewer) {
  constexpr int rings = 512, sectors = 1024;
  const float solid_angle = 2.0f * pi / (rings * sectors);
  double sum = 0.0;
  for (int r = 0; r < rings; ++r)
    for (int a = 0; a < sectors; ++a) {
      const float z = (float(r) + 0.5f) / rings, azimuth = 2.0f * pi * (float(a) + 0.5f) / sectors;
      const float across = std::sqrt(1.0f - z * z);
      const vec3 to_light(across * std::cos(azimuth), across * std::sin(azimuth), z);
      sum += double(direct_radiance(s, to_viewer, to_light, vec3(solid_angle)).x);
    }
  return float(sum);
}

/// One bounce between facets is modelled: light that would bounce again is lost, the more the rougher, up to
/// seven tenths of it (Heitz 2016).
TEST(WhiteFurnace, MetalReflectsAllButWhatBouncesAgain) {
  for (const float cosine : {1.0f, 0.7f, 0.4f}) {
    float smoother = 1.02f;
    for (const float roughness : {0.3f, 0.5f, 0.7f, 1.0f}) {
      const float reflected = furnace(surface(1, 1, roughness), at_angle(cosine));
      EXPECT_LT(reflected, smoother) << roughness << ", " << cosine;
      EXPECT_GT(reflected, roughness < 0.6f ? 0.7f : 0.3f) << roughness << ", " << cosine;
      smoother = reflected;
    }
  }
}

/// Of the roughest metal seen from straight above, Smith's integral has a closed form: of l / (1 + l), 0
/// to 1.
TEST(WhiteFurnace, TheRoughestMetalReflectsWhatSmithsIntegralSays) {
  EXPECT_NEAR(furnace(surface(1, 1, 1), {0, 0, 1}), 1.0f - std::log(2.0f), 1e-3f);
}

/// Layers share light by Fresnel's weight of the half vector, which makes up to six percent of light under a
/// coat.
TEST(WhiteFurnace, WhiteThingsGiveBackMostLightAndMakeLittle) {
  for (const float coat : {0.0f, 1.0f})
    for (const float cosine : {1.0f, 0.7f, 0.4f}) {
      const float reflected = furnace(surface(1, 0, 0.6f, coat), at_angle(cosine));
      EXPECT_LT(reflected, coat > 0.0f ? 1.07f : 1.03f) << coat << ", " << cosine;
      EXPECT_GT(reflected, 0.85f) << coat << ", " << cosine;
    }
}

/// The same furnace for light from the surroundings: irradiance pi, radiance 1 in every mirror direction.
TEST(WhiteFurnace, TheSurroundingsLightMakesNoLight) {
  for (const float coat : {0.0f, 0.5f, 1.0f})
    for (const float roughness : {0.0f, 0.3f, 0.6f, 1.0f})
      for (const float cosine : {1.0f, 0.7f, 0.4f, 0.1f}) {
        const auto seen = [&](float metallic) {
          return ambient_radiance(surface(1, metallic, roughness, coat), at_angle(cosine), vec3(pi), vec3(pi),
                                  vec3(1), vec3(1))
              .x;
        };
        EXPECT_NEAR(seen(0.0f), 1.0f, 1e-3f) << coat << ", " << roughness << ", " << cosine;
        EXPECT_LT(seen(1.0f), 1.001f) << coat << ", " << roughness << ", " << cosine;
        EXPECT_GT(seen(1.0f), 0.4f) << coat << ", " << roughness << ", " << cosine;
      }
}

/// The polynomial of the split sum stands for the integral of the lobe that the sun's light takes. It was
/// fitted to dielectrics: of metals it loses up to a fifth (roughness 0.4).
TEST(Surface, TheSurroundingsReflectanceIsThatOfTheSunsLobe) {
  for (const float roughness : {0.4f, 0.7f, 1.0f})
    for (const float cosine : {1.0f, 0.7f, 0.4f}) {
      const Surface metal = surface(1, 1, roughness);
      EXPECT_NEAR(base_reflectance(metal, cosine).x, furnace(metal, at_angle(cosine)), 0.2f)
          << roughness << ", " << cosine;
    }
}

TEST(Surface, APerfectMirrorReflectsAll) {
  for (const float cosine : {1.0f, 0.5f, 0.05f})
    EXPECT_NEAR(base_reflectance(surface(1, 1, 0), cosine).x, 1.0f, 1e-3f);
}

TEST(Surface, LightAndViewMayBeExchanged) {
  for (const float roughness : {0.2f, 0.6f, 1.0f}) {
    const Surface s = surface(0.5f, 0.3f, roughness, 0.7f);
    const vec3 a = at_angle(0.8f), b(0.0f, std::sqrt(1.0f - 0.3f * 0.3f), 0.3f);
    const float forth = direct_radiance(s, a, b, vec3(1)).x / 0.3f,
                back = direct_radiance(s, b, a, vec3(1)).x / 0.8f;
    EXPECT_NEAR(forth, back, 1e-4f * forth);
  }
}

TEST(Surface, LightFromBehindShowsInLeavesOnly) {
  Surface s = surface(0.5f, 0, 1);
  EXPECT_EQ(direct_radiance(s, {0, 0, 1}, {0, 0, -1}, vec3(1)).x, 0.0f);
  s.translucency = 0.5f;
  EXPECT_NEAR(direct_radiance(s, {0, 0, 1}, {0, 0, -1}, vec3(1)).x, 0.25f / pi, 1e-5f);
}

TEST(Surface, GrazingAndOppositeDirectionsAreFinite) {
  for (const vec3 to_viewer : {vec3(1, 0, 0), vec3(1, 0, 1e-6f), vec3(0, 0, 1)})
    for (const vec3 to_light : {vec3(-1, 0, 0), vec3(-1, 0, 1e-6f), vec3(0, 0, 1), vec3(0, 0, -1)})
      for (const float roughness : {0.0f, 0.05f, 1.0f}) {
        const float radiance =
            direct_radiance(surface(1, 0.5f, roughness, 1), to_viewer, to_light, vec3(1)).x;
        EXPECT_TRUE(std::isfinite(radiance) && radiance >= 0.0f) << to_viewer.z << ", " << to_light.z;
      }
}

}  // namespace
}  // namespace parvis::shading

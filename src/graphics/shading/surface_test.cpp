#include "graphics/shading/surface.h"

#include <gtest/gtest.h>

#include <initializer_list>

namespace parvis::shading {
namespace {

Surface surface(float base, float metallic, float roughness, float coat = 0.0f) {
  return {vec3(0, 0, 1), vec3(base), metallic, roughness, coat, 0.2f, 0.0f, 1.0f, vec3(0.0f)};
}

vec3 at_angle(float cosine) { return {std::sqrt(1.0f - cosine * cosine), 0.0f, cosine}; }

/// Radiance of a surface toward the viewer under light of radiance 1 from everywhere above it: integrated
/// over the hemisphere at the middles of cells that are small near the normal and opposite to the viewer,
/// where highlights are.
float furnace(const Surface& s, vec3 to_viewer) {
  constexpr int rings = 400, sectors = 400;
  double sum = 0.0;
  for (int r = 0; r < rings; ++r)
    for (int a = 0; a < sectors; ++a) {
      const float outward = (float(r) + 0.5f) / rings, z = 1.0f - outward * outward;
      const float aside = 2.0f * (float(a) + 0.5f) / sectors - 1.0f,
                  azimuth = pi + pi * aside * aside * aside;
      const float solid_angle = 2.0f * outward * 3.0f * aside * aside * 2.0f * pi / (rings * sectors);
      const float across = std::sqrt(1.0f - z * z);
      const vec3 to_light(across * std::cos(azimuth), across * std::sin(azimuth), z);
      sum += double(direct_radiance(s, to_viewer, to_light, vec3(solid_angle)).x);
    }
  return float(sum);
}

constexpr float roughnesses[]{0.15f, 0.3f, 0.45f, 0.6f, 0.8f, 1.0f};
constexpr float cosines[]{1.0f, 0.7f, 0.4f, 0.2f};

/// Light that bounces between facets again comes back, too. Tolerance: the residual of the fitted shares,
/// 0.01, and that of their means.
TEST(WhiteFurnace, WhiteMetalReflectsAll) {
  for (const float cosine : cosines)
    for (const float roughness : roughnesses)
      EXPECT_NEAR(furnace(surface(1, 1, roughness), at_angle(cosine)), 1.0f, 0.015f)
          << roughness << ", " << cosine;
}

TEST(WhiteFurnace, WhitePaintGivesBackAll) {
  for (const float cosine : cosines)
    for (const float roughness : roughnesses)
      EXPECT_NEAR(furnace(surface(1, 0, roughness), at_angle(cosine)), 1.0f, 0.015f)
          << roughness << ", " << cosine;
}

/// The base's highlight loses by the lower direction, and so somewhat too much where it is wide.
TEST(WhiteFurnace, CoatsKeepLight) {
  for (const float metallic : {0.0f, 1.0f})
    for (const float cosine : cosines)
      for (const float roughness : roughnesses) {
        const float reflected = furnace(surface(1, metallic, roughness, 1.0f), at_angle(cosine));
        EXPECT_LT(reflected, 1.02f) << metallic << ", " << roughness << ", " << cosine;
        EXPECT_GT(reflected, metallic > 0.0f ? 0.96f : 0.98f)
            << metallic << ", " << roughness << ", " << cosine;
      }
}

/// The same furnace for light from the surroundings: irradiance pi, radiance 1 in every mirror direction.
TEST(WhiteFurnace, TheSurroundingsLightMakesNoLight) {
  for (const float coat : {0.0f, 0.5f, 1.0f})
    for (const float roughness : {0.0f, 0.3f, 0.6f, 1.0f})
      for (const float cosine : {1.0f, 0.7f, 0.4f, 0.1f})
        for (const float metallic : {0.0f, 1.0f})
          EXPECT_NEAR(ambient_radiance(surface(1, metallic, roughness, coat), at_angle(cosine), vec3(pi),
                                       vec3(pi), vec3(1), vec3(1))
                          .x,
                      1.0f, 1e-3f)
              << coat << ", " << roughness << ", " << cosine << ", " << metallic;
}

/// Smith's integral has a closed form for the roughest lobe seen from straight above: the integral of l / (1
/// + l), 0 to 1.
TEST(Surface, TheRoughestLobeLosesWhatSmithsIntegralSays) {
  EXPECT_NEAR(lobe_shares(1.0f, 1.0f).lost, std::log(2.0f), 0.01f);
}

TEST(Surface, TheSurroundingsReflectanceIsThatOfTheSunsLobe) {
  for (const float base : {0.04f, 0.5f, 1.0f})
    for (const float roughness : roughnesses)
      for (const float cosine : cosines) {
        const Surface metal = surface(base, 1, roughness);
        EXPECT_NEAR(base_reflectance(metal, cosine).x, furnace(metal, at_angle(cosine)), 0.015f)
            << base << ", " << roughness << ", " << cosine;
      }
}

TEST(Surface, APerfectMirrorReflectsAll) {
  for (const float cosine : {1.0f, 0.5f, 0.05f})
    EXPECT_NEAR(base_reflectance(surface(1, 1, 0), cosine).x, 1.0f, 2e-3f);
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

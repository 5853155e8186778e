#include "graphics/light/cloud_cover.h"

#include <gtest/gtest.h>

namespace parvis::light {
namespace {

TEST(CloudCover, GreyIsCloudAndBlueIsNot) {
  EXPECT_EQ(cloud_share({0.1f, 0.3f, 0.9f}), 0.0f);
  EXPECT_EQ(cloud_share({0.8f, 0.8f, 0.85f}), 1.0f);
  EXPECT_EQ(cloud_share(glm::vec3(0.0f)), 0.0f);  // black is no cloud; nothing is divided by zero
}

/// Blue with one grey cloud in the south, half way up; green land below.
ImageF dome() {
  ImageF picture(128, 64, 3);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 128; ++x) {
      const bool is_cloud = y > 12 && y < 24 && (x < 16 || x > 112);
      const glm::vec3 sky = is_cloud ? glm::vec3(3.0f) : glm::vec3(0.2f, 0.4f, 1.0f);
      const glm::vec3 colour = y >= 32 ? glm::vec3(0.2f, 0.25f, 0.1f) : sky;
      for (int c = 0; c < 3; ++c) picture.at(x, y)[c] = colour[c];
    }
  return picture;
}

TEST(CloudCover, CloudsStandInTodaysLight) {
  const ImageF photograph = dome();
  const Air air{3.0};
  const auto evening = make_sky(SkyKind::preetham, air, {.azimuth_deg = 290.0, .zenith_deg = 86.0}).value();
  const CloudLight light(*evening, air, photograph, 0.0f);
  const glm::vec3 clear(0.1f, 0.2f, 0.5f);
  const glm::vec3 south = glm::normalize(glm::vec3(0, -1, 0.7f)),
                  north = glm::normalize(glm::vec3(0, 1, 0.7f));
  const glm::vec3 cloud = light.with_dome(clear, south);
  EXPECT_GT(cloud.x, cloud.z);                      // lit by a red sun
  EXPECT_EQ(light.with_dome(clear, north), clear);  // no cloud there
  const glm::vec3 land = light.with_dome(clear, {0, 0, -1});
  EXPECT_GT(land.y, 1.5f * land.z);  // the photograph's green, as bright as now
  EXPECT_LT(land.y, evening->irradiance_xyz({0, 0, 1}).y);
  // Turned by half, the cloud stands in the north.
  EXPECT_NE(CloudLight(*evening, air, photograph, 3.14159265f).with_dome(clear, north), clear);
}

TEST(CloudCover, AtNightCloudsAreDark) {
  const ImageF photograph = dome();
  const auto night = make_sky(SkyKind::preetham, Air{3.0}, {.azimuth_deg = 0.0, .zenith_deg = 120.0}).value();
  const glm::vec3 cloud = CloudLight(*night, Air{3.0}, photograph, 0.0f)
                              .with_dome(glm::vec3(0.0f), glm::normalize(glm::vec3(0, -1, 0.7f)));
  EXPECT_LT(cloud.x + cloud.y + cloud.z, 1e-3f);
}

}  // namespace
}  // namespace parvis::light

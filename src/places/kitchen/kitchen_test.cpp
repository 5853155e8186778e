#include "places/kitchen/kitchen.h"

#include <gtest/gtest.h>

#include "places/kitchen/kitchen_glass.h"
#include "places/kitchen/kitchen_light.h"
#include "places/kitchen/kitchen_mirrors.h"
#include "places/kitchen/kitchen_room.h"
#include "places/kitchen/kitchen_script.h"

namespace parvis::kitchen {
namespace {

TEST(Kitchen, IsWholeAndOnTheWorktop) {
  const scene::Model kitchen = make_kitchen(1);
  for (const scene::Part& part : kitchen.parts) {
    EXPECT_TRUE(check(part.mesh, part.object)) << part.object;
    EXPECT_LT(std::size_t(part.material), kitchen.materials.size());
    EXPECT_FALSE(kitchen.materials[std::size_t(part.material)].is_mirror_like) << part.object;
    if (part.object == "orange" || part.object == "pot") {
      EXPECT_GT(part.mesh.bounds().min.z, worktop_height_m - 0.002f) << part.object;
    }
  }
  EXPECT_GT(kitchen.triangle_count(), 40000u);
}

TEST(Kitchen, ItsMirrorsMirrorAndStandApart) {
  const std::vector<KitchenMirror> mirrors = kitchen_mirrors();
  ASSERT_EQ(mirrors.size(), 7u);
  for (const KitchenMirror& mirror : mirrors) {
    int mirror_like = 0;
    for (const scene::Part& part : mirror.model.parts) {
      EXPECT_TRUE(check(part.mesh, part.object)) << mirror.model.name;
      mirror_like += mirror.model.materials[std::size_t(part.material)].is_mirror_like;
    }
    EXPECT_GE(mirror_like, 1) << mirror.model.name;
    EXPECT_NEAR(bounds(mirror.model).min.z, 0.0f, 0.004f) << mirror.model.name;
  }
}

TEST(Kitchen, ItsGlassIsSolidAndStandsOnTheWorktop) {
  for (const KitchenMirror& body : kitchen_glass()) {
    ASSERT_EQ(body.model.parts.size(), 1u);
    EXPECT_TRUE(check(body.model.parts[0].mesh, body.model.name));
    EXPECT_TRUE(body.model.materials[0].refracts());
    EXPECT_NEAR(bounds(body.model).min.z, 0.0f, 1e-4f);
    EXPECT_FLOAT_EQ(body.foot.z, worktop_height_m);
    EXPECT_NE(kitchen_glass_script(kitchen_mirrors(), kitchen_glass()).find(body.model.name),
              std::string::npos);
  }
}

/// A turned outline that runs upward shows its outside, one that runs downward its inside.
TEST(Kitchen, TheMixingBowlIsConcave) {
  const std::vector<KitchenMirror> mirrors = kitchen_mirrors();
  for (const KitchenMirror& mirror : mirrors)
    for (const scene::Part& part : mirror.model.parts) {
      if (mirror.model.name != "mixing_bowl" || part.object == "rim") continue;
      const float wanted = part.object == "inside" ? -1.0f : 1.0f;
      for (std::size_t i = 0; i < part.mesh.positions.size(); ++i) {
        const glm::vec2 out(part.mesh.positions[i]), normal(part.mesh.normals[i]);
        if (part.mesh.positions[i].z > 0.03f) {
          EXPECT_GT(wanted * glm::dot(out, normal), 0.0f) << part.object;
        }
      }
    }
}

TEST(Kitchen, ItsLightIsBrightestAtTheWindow) {
  const ImageF light = room_light_picture(64);
  const auto brightness = [&](int x, int y) {
    return light.at(x, y)[0] + light.at(x, y)[1] + light.at(x, y)[2];
  };
  for (int y = 0; y < light.height; ++y)
    for (int x = 0; x < light.width; ++x) EXPECT_GT(brightness(x, y), 0.1f);
  EXPECT_GT(brightness(16, 15), 3.0f * brightness(48, 15)) << "west over east";
  EXPECT_EQ(room_light_picture(64).pixels, light.pixels);
}

}  // namespace
}  // namespace parvis::kitchen

#include "places/car_bodies/car_script.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "places/car_bodies/picture_masks.h"
#include "places/car_bodies/wheel_arches.h"

namespace parvis::car_bodies {
namespace {

constexpr float axle_x = 1.3f, arch_z = 0.3f, arch_radius = 0.36f;

void add_quad(scene::Part& part, const glm::vec3 (&corners)[4], glm::vec2 uv_low, glm::vec2 uv_high) {
  const std::uint32_t first = std::uint32_t(part.mesh.positions.size());
  const glm::vec3 normal = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
  const glm::vec2 uvs[4]{uv_low, {uv_high.x, uv_low.y}, uv_high, {uv_low.x, uv_high.y}};
  for (std::size_t k = 0; k < 4; ++k) {
    part.mesh.positions.push_back(corners[k]);
    part.mesh.normals.push_back(normal);
    part.mesh.uvs.push_back(uvs[k]);
  }
  for (const std::uint32_t k : {0u, 1u, 2u, 0u, 2u, 3u}) part.mesh.indices.push_back(first + k);
}

/// Sides of a body 4.4 m long with two round arches, a bonnet at +x, and a cabin whose panes are grey in the
/// picture: left half blue paint, right half grey glass.
scene::Model body() {
  scene::Model model;
  scene::Texture picture{.name = "body", .image = Image8(8, 8, 4, 255)};
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) {
      std::uint8_t* texel = picture.image.at(x, y);
      const std::uint8_t blue[3]{30, 60, 200}, grey[3]{120, 122, 124};
      std::copy_n(x < 4 ? blue : grey, 3, texel);
    }
  model.textures.push_back(picture);
  model.materials.push_back({.name = "body", .base_colour = glm::vec3(1.0f), .base_colour_texture = 0});
  scene::Part part;
  part.object = "body";
  const auto arch = [](float x) {
    float low = 0.12f;
    for (const float axle : {-axle_x, axle_x})
      if (const float off = x - axle; std::abs(off) < arch_radius)
        low = std::max(low, arch_z + std::sqrt(arch_radius * arch_radius - off * off));
    return low;
  };
  constexpr float step = 0.02f;
  for (float x = -2.2f; x < 2.19f; x += step)
    for (const float side : {-0.85f, 0.85f}) {
      const float low = arch(x + 0.5f * step);
      add_quad(part, {{x, side, low}, {x + step, side, low}, {x + step, side, 0.85f}, {x, side, 0.85f}},
               {0.05f, 0.1f}, {0.45f, 0.9f});
      if (x > -1.9f && x < 0.7f)
        add_quad(part, {{x, side, 0.85f}, {x + step, side, 0.85f}, {x + step, side, 1.4f}, {x, side, 1.4f}},
                 {0.55f, 0.3f}, {0.8f, 0.6f});
    }
  model.parts.push_back(part);
  return model;
}

TEST(CarScript, WheelsFillTheArches) {
  const std::optional<WheelFit> fit = fit_wheels(SideView(body()));
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->left_x, -axle_x, 0.03f);
  EXPECT_NEAR(fit->right_x, axle_x, 0.03f);
  EXPECT_NEAR(fit->radius, 0.82f * arch_radius, 0.05f);
  EXPECT_LT(fit->axle_z + fit->radius, arch_z + arch_radius);
  EXPECT_NEAR(fit->track, 1.7f - fit->width, 0.05f);
}

TEST(CarScript, TheCabinSaysWhereTheFrontIs) {
  scene::Model model = body();
  EXPECT_FALSE(faces_back(SideView(model)));
  for (glm::vec3& position : model.parts[0].mesh.positions) position.x = -position.x;
  EXPECT_TRUE(faces_back(SideView(model)));
}

TEST(CarScript, PanesAreTheGreyOfThePicture) {
  const scene::Model model = body();
  const PictureMasks masks = find_masks(model, scene::bounds(model), false);
  ASSERT_EQ(masks.glass.size(), 1u);
  float low_u = 0, low_v = 0, high_u = 0, high_v = 0;
  ASSERT_EQ(std::sscanf(masks.glass[0].c_str(), "box %f %f %f %f grey", &low_u, &low_v, &high_u, &high_v), 4);
  EXPECT_NEAR(low_u, 0.55f, 0.02f);
  EXPECT_NEAR(high_v, 0.6f, 0.02f);
  EXPECT_TRUE(masks.lamps.empty());
}

TEST(CarScript, TheScriptSaysWhatWasNotFound) {
  scene::Model model = body();
  const Result<std::string> whole = car_script(model, "body.obj");
  ASSERT_TRUE(whole);
  EXPECT_NE(whole->find("wheels(front_axle_x=1."), std::string::npos) << *whole;
  EXPECT_NE(whole->find("preset=\"glass\""), std::string::npos);
  model.materials[0].base_colour_texture = scene::no_index;
  for (glm::vec3& position : model.parts[0].mesh.positions)
    if (position.z < 0.85f) position.z = 0.12f;  // sides without arches
  const Result<std::string> plain = car_script(model, "body.obj");
  ASSERT_TRUE(plain);
  EXPECT_NE(plain->find("No two arches were found"), std::string::npos) << *plain;
  EXPECT_NE(plain->find("No grey panes were found"), std::string::npos);
}

TEST(CarScript, ABodyThatLiesAcrossOrIsNoCarIsAnError) {
  scene::Model model = body();
  for (glm::vec3& position : model.parts[0].mesh.positions) std::swap(position.x, position.y);
  const Result<std::string> across = car_script(model, "body.obj");
  ASSERT_FALSE(across);
  EXPECT_NE(to_string(across.errors()).find("lies along y"), std::string::npos);
  for (glm::vec3& position : model.parts[0].mesh.positions) position *= 0.01f;
  EXPECT_FALSE(car_script(model, "body.obj"));
}

}  // namespace
}  // namespace parvis::car_bodies

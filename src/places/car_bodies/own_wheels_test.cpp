#include "places/car_bodies/own_wheels.h"

#include <gtest/gtest.h>

#include "places/car_bodies/test_car.h"

namespace parvis::car_bodies {
namespace {

using namespace test;

std::size_t count_wheels(const scene::Model& model) { return find_own_wheels(Body(model)).size(); }

TEST(OwnWheels, AreKnownByTheirShapeAndPlace) {
  const scene::Model model = car_with_wheels();
  const std::vector<OwnWheel> wheels = find_own_wheels(Body(model));
  ASSERT_EQ(wheels.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(wheels[i].centre.x, i < 2 ? -axle_x : axle_x, 1e-3f);
    EXPECT_NEAR(wheels[i].centre.y, i % 2 == 0 ? wheel_y : -wheel_y, 1e-3f);
    EXPECT_NEAR(wheels[i].radius, wheel_radius, 1e-3f);
    EXPECT_NEAR(wheels[i].width, wheel_width, 1e-3f);
    ASSERT_EQ(wheels[i].triangles.size(), 1u);
    const auto& [part, triangles] = *wheels[i].triangles.begin();
    EXPECT_TRUE(model.parts[part].object.starts_with("Circle"));
    EXPECT_EQ(triangles.size(), model.parts[part].mesh.triangle_count());
  }
}

TEST(OwnWheels, MayBeOneObjectWithTheBody) {
  scene::Model model = car_with_wheels();
  scene::Part whole = model.parts[0];
  const std::size_t of_body = whole.mesh.triangle_count();
  for (std::size_t i = 1; i < model.parts.size(); ++i) append(whole.mesh, model.parts[i].mesh);
  model.parts = {whole};
  const std::vector<OwnWheel> wheels = find_own_wheels(Body(model));
  ASSERT_EQ(wheels.size(), 4u);
  std::size_t of_wheels = 0;
  for (const OwnWheel& wheel : wheels) of_wheels += wheel.triangles.at(0).size();
  EXPECT_EQ(of_wheels + of_body, model.triangle_count());
}

TEST(OwnWheels, HaveRimsAndOctagonsAreWheels) {
  scene::Model model = car_with_wheels();
  for (std::size_t i = 1; i < model.parts.size(); ++i) {
    const glm::vec3 centre = model.parts[i].mesh.bounds().centre();
    model.parts[i].mesh = Mesh();
    add_disc(model.parts[i], centre, wheel_radius, wheel_width, 8);
    scene::Part rim;
    rim.object = "rim";
    add_disc(rim, centre, 0.6f * wheel_radius, 0.5f * wheel_width);
    model.parts.push_back(rim);
    if (model.parts.size() == 9) break;
  }
  const std::vector<OwnWheel> wheels = find_own_wheels(Body(model));
  ASSERT_EQ(wheels.size(), 4u);
  for (const OwnWheel& wheel : wheels) EXPECT_EQ(wheel.triangles.size(), 2u);
}

TEST(OwnWheels, ThreeOrSquareOrHighOnesAreNone) {
  EXPECT_EQ(count_wheels(bare_body()), 0u);
  scene::Model three = car_with_wheels();
  three.parts.pop_back();
  EXPECT_EQ(count_wheels(three), 0u);
  for (const auto& [corners, up] : {std::pair(4, 0.0f), std::pair(24, 0.4f)}) {
    scene::Model model = bare_body();
    scene::Part ground;  // so that the lowest point is the road
    add_quad(ground, {{-1, -0.1f, 0}, {1, -0.1f, 0}, {1, 0.1f, 0}, {-1, 0.1f, 0}});
    model.parts.push_back(ground);
    for (const float x : {-axle_x, axle_x})
      for (const float y : {-wheel_y, wheel_y}) {
        scene::Part part;
        add_disc(part, {x, y, wheel_radius + up}, wheel_radius, wheel_width, corners);
        model.parts.push_back(part);
      }
    EXPECT_EQ(count_wheels(model), 0u) << corners;
  }
}

TEST(OwnWheels, TurnWhereTheirNodesAreCalledWheels) {
  scene::Model model = car_with_wheels();
  const std::vector<OwnWheel> wheels = find_own_wheels(Body(model));
  ASSERT_EQ(wheels.size(), 4u);
  EXPECT_FALSE(turns_in_traffic(model, wheels[0]));
  model.nodes.push_back({.name = "Wheel_FL", .parent = 0});
  model.nodes.push_back({.name = "", .parent = 1});
  model.parts[wheels[0].triangles.begin()->first].node = 2;
  EXPECT_TRUE(turns_in_traffic(model, wheels[0]));
  EXPECT_FALSE(turns_in_traffic(model, wheels[1]));
}

}  // namespace
}  // namespace parvis::car_bodies

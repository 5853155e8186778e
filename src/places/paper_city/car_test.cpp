#include "places/paper_city/car.h"

#include <gtest/gtest.h>

#include <set>

#include "places/paper_city/car_body.h"

namespace parvis::city {
namespace {

const std::vector<CarShape>& shapes() {
  static const std::vector<CarShape> all{saloon_shape(), hatchback_shape(), van_shape(), bus_shape()};
  return all;
}

TEST(Cars, AreWholeMeshesOfAboutTenThousandTriangles) {
  for (const scene::Model& car : city_cars()) {
    for (const scene::Part& part : car.parts) {
      const Status status = check(part.mesh, car.name + " " + part.object);
      EXPECT_TRUE(status) << to_string(status.errors());
    }
    EXPECT_GT(car.triangle_count(), 7000u) << car.name;
    EXPECT_LT(car.triangle_count(), 16000u) << car.name;
  }
}

TEST(Cars, EachKindAndPaintHasANumberPlateOfItsOwn) {
  std::set<std::vector<std::uint8_t>> plates;
  const std::vector<scene::Model> cars = city_cars();
  for (const scene::Model& car : cars) plates.insert(car.textures.front().image.pixels);
  EXPECT_EQ(plates.size(), cars.size());
  EXPECT_EQ(city_cars().front().textures.front().image.pixels, cars.front().textures.front().image.pixels)
      << "the same again";
}

TEST(Cars, StandOnFourWheels) {
  for (const scene::Model& car : city_cars()) {
    int wheels = 0;
    for (const scene::ModelNode& node : car.nodes) {
      if (node.name.find("wheel") == std::string::npos) continue;
      ++wheels;
      EXPECT_EQ(node.name.find("front") != std::string::npos, node.translation.x > 0.0f) << node.name;
      EXPECT_EQ(node.name.find("left") != std::string::npos, node.translation.y > 0.0f) << node.name;
    }
    EXPECT_EQ(wheels, 4) << car.name;
    EXPECT_NEAR(bounds(car).min.z, 0.0f, 0.01f) << car.name;
  }
}

TEST(Cars, BodiesAreSymmetric) {
  for (const CarShape& shape : shapes())
    for (const Mesh& mesh : body_meshes(shape)) {
      if (mesh.positions.empty()) continue;
      EXPECT_NEAR(mesh.bounds().min.y, -mesh.bounds().max.y, 1e-4f) << shape.name;
    }
}

TEST(Cars, NormalsPointOutOfTheBody) {
  for (const CarShape& shape : shapes()) {
    const synthesis::SplineSurface surface = body_surface(shape);
    for (float u = 0.05f; u < surface.end_u(); u += 0.35f)
      for (float v = 0.5f; v < surface.end_v(); v += 0.45f) {
        const glm::vec3 p = surface.position(u, v), n = surface.normal(u, v);
        const glm::vec3 inside(0.8f * p.x, 0.0f, 0.5f);
        EXPECT_GT(glm::dot(n, p - inside), -0.12f) << shape.name << " at " << u << " " << v;
      }
  }
}

TEST(SplineSurface, IsSmoothAcrossTheMiddle) {
  for (const CarShape& shape : shapes()) {
    const synthesis::SplineSurface surface = body_surface(shape);
    for (float u = 1.0f; u < surface.end_u() - 1.0f; u += 0.5f) {
      EXPECT_NEAR(surface.position(u, surface.end_v()).y, 0.0f, 1e-5f);
      EXPECT_NEAR(surface.normal(u, surface.end_v()).y, 0.0f, 1e-4f);
    }
    for (float v = 0.5f; v < surface.end_v() - 1.0f; v += 0.5f) {
      EXPECT_NEAR(surface.position(0.0f, v).y, 0.0f, 1e-5f);
      EXPECT_NEAR(surface.normal(0.0f, v).y, 0.0f, 1e-4f);
    }
  }
}

}  // namespace
}  // namespace parvis::city

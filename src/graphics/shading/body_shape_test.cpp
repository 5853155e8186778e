#include "graphics/shading/body_shape.h"

#include <gtest/gtest.h>

namespace parvis::shading {
namespace {

using glm::vec3;

void add_box(Mesh& mesh, vec3 minimum, vec3 maximum) {
  for (int axis = 0; axis < 3; ++axis)
    for (const vec3 side : {minimum, maximum}) {
      const auto first = std::uint32_t(mesh.positions.size());
      for (int corner = 0; corner < 4; ++corner) {
        vec3 p;
        p[axis] = side[axis];
        p[(axis + 1) % 3] = (corner & 1 ? maximum : minimum)[(axis + 1) % 3];
        p[(axis + 2) % 3] = (corner & 2 ? maximum : minimum)[(axis + 2) % 3];
        mesh.positions.push_back(p);
      }
      for (const std::uint32_t i : {0u, 1u, 2u, 1u, 3u, 2u}) mesh.indices.push_back(first + i);
    }
}

BodyShape shape_of(const Mesh& mesh, const glm::mat4& model_from_mesh = glm::mat4(1.0f)) {
  const BodyMesh part{&mesh, model_from_mesh};
  return body_shape(std::span(&part, 1));
}

TEST(BodyShape, ABoxFillsItsBoundsButForItsFeet) {
  Mesh box;
  add_box(box, {1, 2, 3}, {5, 4, 4});
  const BodyShape shape = shape_of(box);
  EXPECT_NEAR(glm::distance(shape.box.max, vec3(1)), 0.0f, 1e-5f);
  EXPECT_NEAR(glm::length(glm::vec2(shape.box.min)), 0.0f, 1e-5f);
  EXPECT_GT(shape.box.min.z, 0.05f);
  for (int axis = 0; axis < 3; ++axis) EXPECT_EQ(shape.coverage[axis], 1.0f) << axis;
}

TEST(BodyShape, AnUmbrellaIsItsCanopyNotItsPole) {
  Mesh umbrella;
  add_box(umbrella, {-0.05f, -0.05f, 0}, {0.05f, 0.05f, 2.2f});
  add_box(umbrella, {-1.5f, -1.5f, 2.2f}, {1.5f, 1.5f, 2.5f});
  const BodyShape shape = shape_of(umbrella);
  EXPECT_NEAR(shape.box.min.z, 2.2f / 2.5f, 1.0f / 16.0f);  // a slice
  EXPECT_EQ(shape.box.max.z, 1.0f);
  EXPECT_EQ(shape.coverage.z, 1.0f);
}

TEST(BodyShape, MirrorsDoNotWidenACar) {
  Mesh car;
  add_box(car, {-2, -0.8f, 0.2f}, {2, 0.8f, 1.4f});
  add_box(car, {0.5f, -1, 0.9f}, {0.7f, 1, 1.0f});
  const BodyShape shape = shape_of(car);
  EXPECT_GT(shape.box.min.y, 0.07f);
  EXPECT_LT(shape.box.max.y, 0.93f);
}

TEST(BodyShape, SlatsCoverTheShareThatTheyFill) {
  Mesh bench;
  for (int i = 0; i < 5; ++i) add_box(bench, {0, 0.2f * float(i), 0.4f}, {2, 0.2f * float(i) + 0.12f, 0.5f});
  EXPECT_NEAR(shape_of(bench).coverage.z, 0.6f / 0.92f, 0.05f);  // two cells of 32
}

TEST(BodyShape, PlacesOfPartsCount) {
  Mesh box;
  add_box(box, {0, 0, 0}, {1, 1, 1});
  const glm::mat4 away(glm::vec4(1, 0, 0, 0), glm::vec4(0, 1, 0, 0), glm::vec4(0, 0, 1, 0),
                       glm::vec4(3, 0, 0, 1));
  const BodyMesh parts[]{{&box, glm::mat4(1.0f)}, {&box, away}};
  EXPECT_NEAR(body_shape(parts).coverage.z, 0.5f, 0.04f);
}

TEST(BodyShape, NothingAndFlatThingsFillTheirBounds) {
  Mesh flat;
  add_box(flat, {0, 0, 0}, {1, 1, 0});
  for (const BodyShape& shape : {body_shape({}), shape_of(flat)}) {
    EXPECT_EQ(shape.box.min, vec3(0));
    EXPECT_EQ(shape.box.max, vec3(1));
    EXPECT_EQ(shape.coverage, vec3(1));
  }
}

}  // namespace
}  // namespace parvis::shading

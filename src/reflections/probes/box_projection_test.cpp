#include "reflections/probes/box_projection.h"

#include <gtest/gtest.h>

#include "base/random.h"

namespace parvis::probes {
namespace {

struct Box {
  glm::vec3 centre, half_size;
  float turn;  ///< about z
  vec2 heading() const { return {std::cos(turn), std::sin(turn)}; }
  glm::dmat3 world_from_box() const {
    const double c = std::cos(double(turn)), s = std::sin(double(turn));
    return {{c, s, 0}, {-s, c, 0}, {0, 0, 1}};
  }
};

glm::vec3 random_vector(Random& random, float maximum) {
  return {random.uniform(-maximum, maximum), random.uniform(-maximum, maximum),
          random.uniform(-maximum, maximum)};
}

Box random_box(Random& random) {
  return {random_vector(random, 50), glm::vec3(21) + random_vector(random, 20), random.uniform(-4, 4)};
}

/// Where a ray from within leaves a box: the nearest of the six planes that lie ahead.
glm::dvec3 exit_point(const Box& box, glm::dvec3 position, glm::dvec3 direction) {
  const glm::dmat3 box_from_world = glm::transpose(box.world_from_box());
  const glm::dvec3 o = box_from_world * (position - glm::dvec3(box.centre)), d = box_from_world * direction;
  double nearest = 1e300;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      const double distance = (side * double(box.half_size[axis]) - o[axis]) / d[axis];
      if (distance > 0.0) nearest = std::min(nearest, distance);
    }
  return position + nearest * direction;
}

TEST(BoxProjection, LooksTowardThePointWhereTheRayLeavesTheBox) {
  Random random(5);
  for (int i = 0; i < 2000; ++i) {
    const Box box = random_box(random);
    const glm::vec3 inside = 0.95f * box.half_size * random_vector(random, 1);
    const glm::vec3 position = box.centre + glm::vec3(box.world_from_box() * glm::dvec3(inside));
    const glm::vec3 direction = glm::normalize(random_vector(random, 1)),
                    map_centre = random_vector(random, 50);
    const glm::vec3 found =
        box_projected_direction(position, direction, map_centre, box.centre, box.half_size, box.heading());
    const glm::vec3 expected(exit_point(box, position, direction) - glm::dvec3(map_centre));
    ASSERT_LT(glm::distance(found, expected), 1e-3f * glm::length(box.half_size)) << "case " << i;
  }
}

TEST(BoxProjection, ARayAlongAnAxisOfTheBoxIsNoSpecialCase) {
  const vec3 found =
      box_projected_direction({1, 2, 3}, {1, 0, 0}, vec3(0.0f), vec3(0.0f), {10, 10, 10}, {1, 0});
  EXPECT_LT(glm::distance(found, vec3(10, 2, 3)), 1e-4f);
}

TEST(BoxProjection, FromOutsideTheDirectionStays) {
  const vec3 direction = glm::normalize(vec3(1, 2, 3));
  for (const vec3 outside : {vec3(10.5f, 0, 0), vec3(0, -11, 0), vec3(0, 0, 10)})
    EXPECT_EQ(box_projected_direction(outside, direction, vec3(0.0f), vec3(0.0f), vec3(10.0f), {1, 0}),
              direction);
}

}  // namespace
}  // namespace parvis::probes

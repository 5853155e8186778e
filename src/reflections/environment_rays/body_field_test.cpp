#include "reflections/environment_rays/body_field.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "scene/data/test_scene.h"

namespace parvis::environment_rays {
namespace {

glm::vec3 direction_of(Random& random) {
  const float z = random.uniform(-1.0f, 1.0f), turn = random.uniform(0.0f, 6.2831853f);
  return {std::sqrt(1.0f - z * z) * std::cos(turn), std::sqrt(1.0f - z * z) * std::sin(turn), z};
}

/// A ball of radius 1 about (2, 3, 4), finely meshed: red in its upper half.
scene::Model ball() {
  scene::Model model;
  model.materials.resize(2);
  model.materials[0].base_colour = {0.04f, 0.04f, 0.04f};
  model.materials[1].base_colour = {0.81f, 0.04f, 0.04f};
  model.parts.resize(2);
  constexpr int rings = 48, around = 96;
  const auto point = [](int ring, int step) {
    const float polar = 3.14159265f * float(ring) / rings, turn = 6.2831853f * float(step) / around;
    return glm::vec3(std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn), std::cos(polar));
  };
  for (int ring = 0; ring < rings; ++ring)
    for (int step = 0; step < around; ++step) {
      scene::Part& part = model.parts[ring < rings / 2 ? 1 : 0];
      part.material = ring < rings / 2 ? 1 : 0;
      const auto first = std::uint32_t(part.mesh.positions.size());
      for (const glm::vec3 p :
           {point(ring, step), point(ring + 1, step), point(ring + 1, step + 1), point(ring, step + 1)}) {
        part.mesh.positions.push_back(glm::vec3(2, 3, 4) + p);
        part.mesh.normals.push_back(p);
        part.mesh.uvs.emplace_back(0.0f);
      }
      for (const std::uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u}) part.mesh.indices.push_back(first + corner);
    }
  return model;
}

BodyField field_of(const scene::Model& model) { return body_field(model, model.materials); }

TEST(BodyField, RaysHitABallWhereItIs) {
  const BodyField field = field_of(ball());
  const glm::vec3 centre(2, 3, 4);
  constexpr float cell_m = 2.0f / 17.0f;  // of the fewest cells
  Random random(3);
  for (int i = 0; i < 2000; ++i) {
    const glm::vec3 from = centre + 4.0f * direction_of(random);
    const glm::vec3 aim = centre + 0.8f * direction_of(random) * random.uniform(0.0f, 1.0f);
    const glm::vec3 direction = glm::normalize(aim - from);
    const float half = glm::dot(centre - from, direction);
    const float off = glm::length(from + half * direction - centre);
    const float exact_m = half - std::sqrt(1.0f - off * off);
    EXPECT_NEAR(distance_to_body(field, from, direction, 100.0f), exact_m, 0.6f * cell_m);
    EXPECT_EQ(distance_to_body(field, from, -direction, 100.0f), 100.0f);
    EXPECT_EQ(distance_to_body(field, from, direction, exact_m - cell_m), exact_m - cell_m) << "too far";
  }
}

/// Cells are compared with every face as far as half of it; beyond, they take over what their neighbours
/// found.
TEST(BodyField, CellsKnowDistancesAsFarAsTheReach) {
  const BodyField field = field_of(ball());
  const glm::ivec3 size = BodyField::size();
  const glm::vec3 cell_m = field.box.size() / glm::vec3(size);
  const float reach_m = field.reach_m(), byte_m = reach_m / 127.5f;
  // Facets lie within the ball, and the nearest of some that are alike may not be among the neighbours'.
  const float tolerance_m = byte_m + 0.1f * std::max(cell_m.x, std::max(cell_m.y, cell_m.z));
  for (int z = 0; z < size.z; ++z)
    for (int y = 0; y < size.y; ++y)
      for (int x = 0; x < size.x; ++x) {
        const glm::vec3 at = field.box.min + (glm::vec3(x, y, z) + 0.5f) * cell_m;
        const float exact_m = glm::distance(at, {2, 3, 4}) - 1.0f;
        if (std::abs(exact_m) > 0.95f * reach_m) continue;
        const float byte = float(field.cells[std::size_t(x + size.x * (y + size.y * z))].w);
        ASSERT_NEAR(byte_m * (byte - 127.5f), exact_m, tolerance_m) << x << ' ' << y << ' ' << z;
      }
}

/// A door in the mirror on its wing.
TEST(BodyField, ACarShowsItsOwnPartsFromFifteenCentimetresOn) {
  scene::Model car;
  car.materials.resize(1);
  car.parts.resize(1);
  append(car.parts[0].mesh, scene::box({-2.2f, -0.9f, 0.0f}, {2.2f, 0.9f, 1.4f}));
  append(car.parts[0].mesh, scene::box({0.6f, -1.15f, 0.85f}, {0.75f, -1.02f, 1.0f}));
  const BodyField field = field_of(car);
  EXPECT_EQ(own_share(field, 0.03f), 0.0f);
  EXPECT_GT(own_share(field, 0.15f), 0.95f);
  EXPECT_NEAR(distance_to_body(field, {0.675f, -1.02f, 0.925f}, {0, 1, 0}, 10.0f, true), 0.12f, 0.02f);
}

/// A closed cabin with opaque panes: behind them a driver, a lining 3 cm behind the skin, and one in its
/// plane that faces inward.
scene::Model cabin(bool is_furnished) {
  scene::Model car;
  car.materials.resize(1);
  car.parts.resize(1);
  Mesh& mesh = car.parts[0].mesh;
  if (is_furnished)
    append(mesh,
           scene::quad({-1.0f, -0.7f, 1.4f}, {-1.0f, 0.7f, 1.4f}, {1.0f, 0.7f, 1.4f}, {1.0f, -0.7f, 1.4f}));
  append(mesh, scene::box({-2.2f, -0.9f, 0.0f}, {2.2f, 0.9f, 1.4f}));
  if (!is_furnished) return car;
  append(mesh, scene::box({-0.2f, -0.5f, 0.4f}, {0.3f, 0.1f, 1.2f}));
  append(mesh, scene::box({-2.1f, -0.8f, 0.1f}, {2.1f, 0.8f, 1.37f}));
  return car;
}

TEST(BodyField, WhatIsBehindOpaquePanesIsInside) {
  const BodyField field = field_of(cabin(true));
  const glm::ivec3 size = BodyField::size();
  const glm::vec3 cell_m = field.box.size() / glm::vec3(size);
  int outside = 0;
  for (int z = 0; z < size.z; ++z)
    for (int y = 0; y < size.y; ++y)
      for (int x = 0; x < size.x; ++x) {
        const glm::vec3 at = field.box.min + (glm::vec3(x, y, z) + 0.5f) * cell_m;
        const bool is_within =
            std::abs(at.x) < 2.19f && std::abs(at.y) < 0.89f && at.z > 0.01f && at.z < 1.39f;
        outside += is_within && field.cells[std::size_t(x + size.x * (y + size.y * z))].w > 128;
      }
  EXPECT_EQ(outside, 0) << "of the cells within the skin";
}

/// Rays that leave the roof with its lining, and rays to it, run as those of a car that is empty.
TEST(BodyField, ALiningCloseBehindTheSkinChangesNoRay) {
  const BodyField empty = field_of(cabin(false)), furnished = field_of(cabin(true));
  Random random(7);
  int leave = 0;
  for (int i = 0; i < 4000; ++i) {
    const glm::vec3 on_roof(random.uniform(-2.0f, 2.0f), random.uniform(-0.8f, 0.8f), 1.4f);
    glm::vec3 way = direction_of(random);
    way.z = std::max(std::abs(way.z), 0.05f);
    way = glm::normalize(way);
    leave += distance_to_body(furnished, on_roof, way, 10.0f, true) == 10.0f;
    const float met = distance_to_body(furnished, on_roof + 3.0f * way, -way, 10.0f);
    EXPECT_NEAR(met, distance_to_body(empty, on_roof + 3.0f * way, -way, 10.0f), 0.03f);
  }
  EXPECT_EQ(leave, 4000);
}

TEST(BodyField, RaysThatLeaveTheBodyDoNotMeetWhereTheyStart) {
  const BodyField field = field_of(ball());
  Random random(5);
  for (int i = 0; i < 2000; ++i) {
    const glm::vec3 normal = direction_of(random);
    const glm::vec3 direction = glm::normalize(normal + 0.9f * direction_of(random));
    EXPECT_EQ(distance_to_body(field, glm::vec3(2, 3, 4) + normal, direction, 100.0f, true), 100.0f);
  }
}

TEST(BodyField, CellsHaveTheColourOfWhatIsNearest) {
  const BodyField field = field_of(ball());
  const glm::ivec3 size = BodyField::size();
  const auto cell_at = [&](glm::vec3 at) {
    const glm::ivec3 cell((at - field.box.min) / field.box.size() * glm::vec3(size));
    return field.cells[std::size_t(cell.x + size.x * (cell.y + size.y * cell.z))];
  };
  EXPECT_NEAR(cell_at({2, 3, 5}).x, 255 * 0.9, 1) << "the square root of 0.81";
  EXPECT_NEAR(cell_at({2, 3, 5}).y, 255 * 0.2, 1);
  EXPECT_NEAR(cell_at({2, 3, 3}).x, 255 * 0.2, 1);
}

TEST(BodyField, PaintColoursTheSameBody) {
  const scene::Model model = ball();
  std::vector<scene::Material> paint = model.materials;
  paint[0].base_colour = {0.04f, 0.04f, 0.81f};
  const BodyField plain = field_of(model), painted = body_field(model, paint);
  ASSERT_EQ(plain.cells.size(), painted.cells.size());
  bool is_blue = false;
  for (std::size_t i = 0; i < plain.cells.size(); ++i) {
    ASSERT_EQ(plain.cells[i].w, painted.cells[i].w) << "the same distances";
    is_blue |= plain.cells[i].z < 60 && painted.cells[i].z > 200;
  }
  EXPECT_TRUE(is_blue);
}

TEST(BodyField, NothingFlatAndUncolouredThingsAreStood) {
  EXPECT_TRUE(field_of({}).box.empty());
  EXPECT_EQ(distance_to_body(field_of({}), {}, {1, 0, 0}, 7.0f), 7.0f);
  scene::Model panel;
  panel.materials.resize(1);
  panel.parts.resize(1);
  panel.parts[0].mesh.positions = {{0, 0, 0}, {0, 1, 0}, {0, 1, 1}};
  panel.parts[0].mesh.indices = {0, 1, 2, 0, 0, 0};
  const float met = distance_to_body(field_of(panel), {-1, 0.6f, 0.4f}, {1, 0, 0}, 100.0f);
  EXPECT_NEAR(met, 1.0f, 0.05f);
}

}  // namespace
}  // namespace parvis::environment_rays

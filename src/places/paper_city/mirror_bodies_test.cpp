#include "places/paper_city/mirror_bodies.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace parvis::city {
namespace {

/// Volume that a closed mesh encloses; negative where it is inside out.
double volume_m3(const Mesh& mesh) {
  double volume = 0.0;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const auto at = [&](std::size_t k) { return glm::dvec3(mesh.positions[mesh.indices[i + k]]); };
    volume += glm::dot(at(0), glm::cross(at(1), at(2))) / 6.0;
  }
  return volume;
}

/// Length of the edges that have a triangle on one side only.
double rim_m(const Mesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = mesh.indices[i + k], to = mesh.indices[i + (k + 1) % 3];
      from < to ? ++edges[{from, to}] : --edges[{to, from}];
    }
  double length_m = 0.0;
  for (const auto& [edge, count] : edges)
    length_m +=
        std::abs(count) * double(glm::distance(mesh.positions[edge.first], mesh.positions[edge.second]));
  return length_m;
}

TEST(MirrorBodies, AreClosedAndFaceOutward) {
  for (const scene::Model& model : {make_ball(), make_whale()}) {
    EXPECT_TRUE(model.materials.front().is_mirror_like);
    EXPECT_LT(rim_m(model.parts.front().mesh), 1e-4) << model.name;  // fins are open where they are rooted
    for (const scene::Part& part : model.parts) {
      EXPECT_TRUE(check(part.mesh, part.object));

      EXPECT_GT(volume_m3(part.mesh), 0.0) << model.name;
    }
  }
}

TEST(MirrorBodies, HaveTheirSizes) {
  const scene::Model ball = make_ball(), whale = make_whale();
  EXPECT_NEAR(volume_m3(ball.parts.front().mesh), 4.0 / 3.0 * std::numbers::pi, 0.02);
  for (const glm::vec3& position : ball.parts.front().mesh.positions)
    EXPECT_NEAR(glm::length(position), 1.0f, 1e-5f);
  for (std::size_t i = 0; i < ball.parts.front().mesh.normals.size(); ++i)
    EXPECT_GT(glm::dot(ball.parts.front().mesh.normals[i], ball.parts.front().mesh.positions[i]), 0.99f);
  EXPECT_NEAR(bounds(whale).size().x, 12.0f, 1.5f);
  EXPECT_GT(bounds(whale).size().y, 4.0f) << "fins";
}

}  // namespace
}  // namespace parvis::city

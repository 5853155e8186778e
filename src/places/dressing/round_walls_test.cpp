#include "places/dressing/round_walls.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <glm/gtc/constants.hpp>
#include <map>
#include <set>

#include "base/test_data.h"
#include "formats/readers/readers.h"
#include "places/dressing/brick_texture.h"
#include "places/dressing/facades.h"
#include "places/dressing/test_walls.h"
#include "rooms/rooms.h"

namespace parvis::dressing {
namespace {

/// A wall along an outline, counter-clockwise, each side a polygon of its own.
void add_walls(scene::Model& model, const std::vector<glm::vec2>& outline, float height_m, bool is_ring) {
  Mesh& mesh = model.parts.front().mesh;
  for (std::size_t i = 0; i + (is_ring ? 0 : 1) < outline.size(); ++i) {
    const glm::vec2 a = outline[i], b = outline[(i + 1) % outline.size()];
    add_quad(mesh, {a, 0.0f}, {b, 0.0f}, {b, height_m}, {a, height_m});
  }
  fill_normals(mesh);
  mesh.uvs.resize(mesh.positions.size());
}

std::vector<glm::vec2> circle(int sides, float radius_m) {
  std::vector<glm::vec2> outline;
  outline.reserve(std::size_t(sides));
  for (int i = 0; i < sides; ++i) {
    const float angle = glm::two_pi<float>() * float(i) / float(sides);
    outline.push_back(glm::vec2(40.0f, -25.0f) + radius_m * glm::vec2(std::cos(angle), std::sin(angle)));
  }
  return outline;
}

scene::Model tower(int sides, float radius_m, float height_m = 9.0f) {
  scene::Model model = no_walls();
  add_walls(model, circle(sides, radius_m), height_m, true);
  return model;
}

std::vector<WallPanel> panels_of(scene::Model model) {
  return wall_panels(take_triangles(model, "*", [](const scene::Part&, glm::vec3) { return true; }));
}

TEST(RoundWalls, FacetsOfACircleAreOneRun) {
  for (const int sides : {16, 32, 64}) {
    const std::vector<WallPanel> panels = panels_of(tower(sides, 6.0f));
    ASSERT_EQ(panels.size(), std::size_t(sides));
    const float facet_m = 12.0f * std::sin(glm::pi<float>() / float(sides));
    std::set<int> places;
    for (const WallPanel& panel : panels) {
      EXPECT_EQ(panel.run.facets, sides);
      EXPECT_TRUE(panel.run.is_ring && panel.run.is_even);
      EXPECT_NEAR(panel.run.length_m, float(sides) * facet_m, 1e-2f);
      places.insert(int(std::lround(panel.run.before_m / facet_m)));
    }
    EXPECT_EQ(places.size(), std::size_t(sides)) << "one after the other";
  }
}

TEST(RoundWalls, SharpCornersAndWideWallsStayApart) {
  for (const scene::Model& model : {tower(8, 3.0f), tower(16, 20.0f)})
    for (const WallPanel& panel : panels_of(model)) EXPECT_EQ(panel.run.facets, 1);
}

TEST(RoundWalls, HousesOfABentRowStayApart) {
  scene::Model row = no_walls();
  const std::vector<glm::vec2> front = circle(48, 38.0f), back = circle(48, 28.0f);
  for (std::size_t i = 0; i < 6; ++i)
    add_walls(row, {front[i], front[i + 1], back[i + 1], back[i]}, 8.0f, true);
  for (const WallPanel& panel : panels_of(row)) EXPECT_EQ(panel.run.facets, 1);
}

TEST(RoundWalls, AQuarterOfACircleBetweenWallsIsARun) {
  scene::Model corner = no_walls();
  const std::vector<glm::vec2> round = circle(32, 6.0f);
  std::vector<glm::vec2> outline(round.begin(), round.begin() + 9);
  outline.insert(outline.begin(), outline.front() - glm::vec2(0.0f, 15.0f));
  outline.push_back(outline.back() - glm::vec2(15.0f, 0.0f));
  add_walls(corner, outline, 8.0f, false);
  int facets = 0;
  for (const WallPanel& panel : panels_of(corner)) {
    const bool is_straight = panel.high.x - panel.low.x > 10.0f;
    EXPECT_EQ(panel.run.facets, is_straight ? 1 : 8);
    EXPECT_FALSE(panel.run.is_ring);
    facets += !is_straight;
  }
  EXPECT_EQ(facets, 8);
}

TEST(RoundWalls, BaysFitEvenFacets) {
  const auto ring = [](int facets, float facet_m) {
    return WallRun{.length_m = float(facets) * facet_m, .facets = facets, .is_ring = true, .is_even = true};
  };
  EXPECT_EQ(bays_of(ring(16, 2.8f), 3.0f).count, 16.0f);
  EXPECT_EQ(bays_of(ring(16, 5.8f), 3.0f).count, 32.0f);
  EXPECT_EQ(bays_of(ring(64, 1.0f), 2.9f).count, 22.0f) << "no whole number of three facets";
  const RunBays of_two = bays_of(ring(32, 1.4f), 2.9f), of_three = bays_of(ring(33, 1.0f), 2.9f);
  EXPECT_EQ(of_two.count, 16.0f);
  EXPECT_EQ(of_two.shift, 0.25f) << "else the middle of each bay would be an edge";
  EXPECT_EQ(of_three.count, 11.0f);
  EXPECT_EQ(of_three.shift, 0.0f);
}

const std::string& material_of(const scene::Model& model, const scene::Part& part) {
  return model.materials[std::size_t(part.material)].name;
}

TEST(RoundWalls, AreDressedInOneRhythm) {
  for (const int sides : {16, 32, 64}) {
    scene::Model model = tower(sides, 6.0f);
    add_facades(model, "*", 3);
    int strips = 0;
    for (const scene::Part& part : model.parts) {
      if (material_of(model, part) == "brick wall") continue;
      ++strips;
      const Mesh& mesh = part.mesh;
      std::map<std::array<int, 3>, std::set<int>> across;  // in thousandths of a bay, at each point
      float low = 1e9f, high = -1e9f;
      for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::ivec3 at(glm::round(1000.0f * mesh.positions[i]));
        const float bays = mesh.uvs[i].x * float(brick_bays);
        across[{at.x, at.y, at.z}].insert(int(std::lround(1000.0f * bays)));
        low = std::min(low, bays), high = std::max(high, bays);
      }
      EXPECT_NEAR(high - low, std::round(high - low), 2e-3f) << "whole bays around the tower";
      EXPECT_GT(high - low, 8.0f);
      int seams = 0;
      for (const auto& [point, places] : across) seams += *places.rbegin() - *places.begin() > 3;
      EXPECT_LE(seams, 4) << "the ends of the run alone";
    }
    EXPECT_EQ(strips, 2) << "street level and the storeys above";
  }
}

TEST(RoundWalls, AreShadedAsRound) {
  scene::Model model = tower(24, 6.0f);
  model.nodes.front().rotation = glm::angleAxis(0.7f, glm::vec3(0.0f, 0.0f, 1.0f));
  add_facades(model, "*", 3);
  for (const scene::Part& part : model.parts)
    for (std::size_t i = 0; i < part.mesh.positions.size(); ++i) {
      const glm::vec2 outward = glm::normalize(glm::vec2(part.mesh.positions[i]) - glm::vec2(40.0f, -25.0f));
      EXPECT_GT(glm::dot(glm::vec3(outward, 0.0f), part.mesh.normals[i]), 0.9999f);
    }
}

TEST(RoundWalls, ChimneysAndSilosHaveNoDoors) {
  scene::Model chimney = tower(24, 1.0f, 30.0f), silo = tower(24, 5.0f, 14.0f);
  silo.parts.front().object = "WallSurface industry";
  for (scene::Model* model : {&chimney, &silo}) {
    add_facades(*model, "*", 3);
    for (const scene::Part& part : model->parts)
      EXPECT_NE(material_of(*model, part).find("wall"), std::string::npos) << material_of(*model, part);
  }
}

TEST(RoundWalls, OfTheMarketHaveDoorsAndWindows) {
  Errors warnings;
  Result<scene::Model> market = rooms::all_registries().get<formats::Readers>().read(
      source_folder() / "scenes/market.osm", {}, warnings);
  ASSERT_TRUE(market) << to_string(market.errors());
  EXPECT_TRUE(warnings.empty()) << to_string(warnings);
  std::set<std::string> names;
  for (const scene::Part& part : market->parts) names.insert(part.object);
  for (const char* shown :
       {"OuterCeilingSurface", "CityFurniture", "RoofSurface metal", "RoofSurface copper"})
    EXPECT_TRUE(names.contains(shown)) << shown << ": passage, posts of the market's roof, slab, dome";
  add_facades(*market, "WallSurface*");
  const glm::vec2 middle(23.5f, 7.5f);  // of the round house, whose facets are a metre wide
  std::map<std::string, int> corners;   // on its wall
  for (const scene::Part& part : market->parts)
    for (const glm::vec3& position : part.mesh.positions)
      if (std::abs(glm::distance(glm::vec2(position), middle) - 8.0f) < 0.2f)
        ++corners[material_of(*market, part)];
  EXPECT_GE(corners["street level"], 48);
  EXPECT_GE(corners["facade"], 48);
}

}  // namespace
}  // namespace parvis::dressing

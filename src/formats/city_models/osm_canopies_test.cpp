#include "formats/city_models/osm_canopies.h"

#include <gtest/gtest.h>

#include "formats/city_models/test_osm.h"
#include "formats/city_models/test_rings.h"
#include "scene/data/test_scene.h"

namespace parvis::scene {
namespace {

constexpr const char *slab = "RoofSurface metal", *posts = "CityFurniture";
constexpr std::size_t triangles_per_post = 10;

TestTown canopy(const TestTags& tags, const GroundOnMap& ground = {}) {
  TestMap map;
  map.add_area(rectangle, tags);
  return read(map, ground);
}

std::size_t count(const Model& model, const std::string& object) {
  std::size_t triangles = 0;
  for (const Part& part : model.parts)
    if (part.object == object) triangles += part.mesh.triangle_count();
  return triangles;
}

bool has_walls(const Model& model) {
  return std::ranges::any_of(model.parts,
                             [](const Part& part) { return part.object.starts_with("WallSurface"); });
}

TEST(OsmCanopies, RoofsStandOnPostsAndAreOpenBelow) {
  const TestTown town = canopy({{"building", "roof"}, {"height", "5"}});
  ASSERT_TRUE(town.model) << to_string(town.model.errors());
  EXPECT_EQ(town.warnings, "");
  EXPECT_FALSE(has_walls(*town.model));
  const Bounds roof = bounds_of(*town.model, slab);
  EXPECT_NEAR(roof.min.z, 4.7f, 1e-3f);
  EXPECT_NEAR(roof.max.z, 5.0f, 1e-3f);
  EXPECT_NEAR(area_m2(*town.model, "OuterCeilingSurface"), 96.0, 0.2) << "its underside";
  const Bounds standing = bounds_of(*town.model, posts);
  EXPECT_NEAR(standing.min.z, 0.0f, 1e-4f);
  EXPECT_NEAR(standing.max.z, 4.7f, 1e-3f);
  EXPECT_GT(standing.min.x, roof.min.x + 0.1f) << "inside its edge";
  EXPECT_LT(standing.max.y, roof.max.y - 0.1f);
  EXPECT_EQ(count(*town.model, posts), triangles_per_post * 8) << "at its corners and between them";
}

TEST(OsmCanopies, TheSlabBeginsAtMinHeight) {
  const TestTown town = canopy({{"building", "roof"}, {"min_height", "4.5"}, {"height", "6"}});
  ASSERT_TRUE(town.model);
  EXPECT_NEAR(bounds_of(*town.model, slab).min.z, 4.5f, 1e-3f);
  EXPECT_NEAR(bounds_of(*town.model, posts).max.z, 4.5f, 1e-3f);
}

TEST(OsmCanopies, CarportsAndWhatHasNoWallsAreOpenToo) {
  for (const TestTags& tags : {TestTags{{"building", "carport"}}, TestTags{{"building:part", "roof"}},
                               TestTags{{"building", "yes"}, {"wall", "no"}},
                               TestTags{{"building", "roof"}, {"building:levels", "0"}}}) {
    const TestTown town = canopy(tags);
    ASSERT_TRUE(town.model);
    EXPECT_FALSE(has_walls(*town.model)) << tags.back().second;
    EXPECT_GT(bounds_of(*town.model, "OuterCeilingSurface").min.z, 2.0f) << tags.back().second;
    EXPECT_GT(count(*town.model, posts), 0u) << tags.back().second;
  }
}

TEST(OsmCanopies, GablesOfCanopiesAreRoofAndNotWall) {
  const TestTown town =
      canopy({{"building", "roof"}, {"height", "6"}, {"roof:shape", "gabled"}, {"roof:height", "2"}});
  ASSERT_TRUE(town.model);
  EXPECT_FALSE(has_walls(*town.model));
  EXPECT_NEAR(bounds_of(*town.model, slab).max.z, 6.0f, 1e-3f);
  EXPECT_NEAR(bounds_of(*town.model, slab).min.z, 3.7f, 1e-3f);
}

TEST(OsmCanopies, RoofsThatBeginAboveHeadsStandOnTheirBuilding) {
  const TestTown town = canopy({{"building:part", "roof"}, {"min_height", "6"}, {"height", "8"}});
  ASSERT_TRUE(town.model);
  EXPECT_TRUE(has_walls(*town.model));
  EXPECT_EQ(count(*town.model, posts), 0u);
}

TEST(OsmCanopies, PostsReachDownToTheGroundThatIsGiven) {
  double west_m = 1e9;
  const auto ground = [&](glm::dvec2 on_map) {
    west_m = std::min(west_m, on_map.x);
    return 50.0 + 0.1 * (on_map.x - 500'000.0);  // the map's middle meridian lies at 500 km
  };
  const TestTown town = canopy({{"building", "roof"}, {"height", "5"}}, ground);
  ASSERT_TRUE(town.model) << to_string(town.model.errors());
  const double lowest_m = 50.0 + 0.1 * (west_m - 500'000.0);
  const Bounds standing = bounds_of(*town.model, posts);
  EXPECT_NEAR(standing.max.z, lowest_m + 4.7, 0.01) << "as high as from its lowest corner";
  for (const Part& part : town.model->parts)
    for (const glm::vec3& p : part.mesh.positions)
      if (part.object == posts && p.z < standing.max.z - 2.0f) {
        EXPECT_NEAR(p.z, 50.0 + 0.1 * (double(p.x) + town.model->origin.x - 500'000.0), 0.05);
      }
}

TEST(OsmCanopies, RoundRoofsHaveNoFenceOfPosts) {
  TestMap map;
  std::vector<glm::dvec2> ring;
  for (int i = 0; i < 400; ++i) {
    const double angle = 6.283185307179586 * i / 400.0;
    ring.push_back(5.0 * glm::dvec2(std::cos(angle), std::sin(angle)));
  }
  map.add_area(ring, {{"building", "roof"}});
  const TestTown town = read(map);
  ASSERT_TRUE(town.model);
  EXPECT_LE(count(*town.model, posts), triangles_per_post * 26);
  EXPECT_GE(count(*town.model, posts), triangles_per_post * 10);
}

TEST(OsmCanopies, ManyLargeCanopiesHavePostsAtTheirCornersAlone) {
  TestMap map;
  constexpr int canopies = 150;
  for (int i = 0; i < canopies; ++i) {
    const double x = 250.0 * (i % 12), y = 250.0 * (i / 12);
    map.add_area({{x, y}, {x + 240, y}, {x + 240, y + 240}, {x, y + 240}}, {{"building", "roof"}});
  }
  const TestTown town = read(map);
  ASSERT_TRUE(town.model) << to_string(town.model.errors());
  EXPECT_NE(town.warnings.find("its canopies have more than 20000 posts"), std::string::npos)
      << town.warnings;
  EXPECT_EQ(town.warnings.find("none is a WallSurface"), std::string::npos) << town.warnings;
  EXPECT_LT(count(*town.model, posts), triangles_per_post * (20'000 + 200 + 4 * canopies));
}

}  // namespace
}  // namespace parvis::scene

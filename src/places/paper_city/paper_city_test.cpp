#include "places/paper_city/paper_city.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/files.h"
#include "life/traffic/demand.h"
#include "places/paper_city/facade_texture.h"
#include "places/paper_city/paper_script.h"
#include "places/paper_city/street_furniture.h"
#include "scene/script/schema.h"
#include "scene/script/script_reader.h"
#include "synthesis/sky_picture.h"
#include "synthesis/tree.h"

namespace parvis::city {
namespace {
namespace fs = std::filesystem;

/// An empty folder of this test's own.
fs::path fresh_folder(const std::string& name) {
  const fs::path folder = fs::path(testing::TempDir()) / ("parvis_city_" + name);
  fs::remove_all(folder);
  return folder;
}

TEST(PaperCity, LeavesNothingBehindWhereItCannotWrite) {
  const fs::path folder = fresh_folder("blocked");
  ASSERT_TRUE(write_file(folder / "a_file", "in the way"));
  const Status status = write_paper_city(folder / "a_file" / "city", 1);
  ASSERT_FALSE(status);
  EXPECT_NE(to_string(status.errors()).find("a_file"), std::string::npos);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 1);
  fs::remove_all(folder);
}

/// The text written for an attribute; empty where it is absent.
std::string written(const scene::ScriptNode& node, const std::string& name) {
  for (const scene::ScriptAttribute& attribute : node.attributes)
    if (attribute.name == name) return attribute.value;
  return "";
}

glm::vec2 place_of(const scene::ScriptNode& node) {
  const std::vector<double> numbers = scene::parse_numbers(written(node, "position"));
  return numbers.size() == 3 ? glm::vec2(numbers[0], numbers[1]) : glm::vec2(NAN);
}

TEST(PaperCity, TheDayHasATourPastParkedCars) {
  constexpr float near_m = 8.0f;
  const std::vector<std::string> cars{"a.glb", "b.glb"};
  const auto script = scene::parse_script(day_script(cars), "day.xp");
  ASSERT_TRUE(script) << to_string(script.errors());
  const auto tour = std::ranges::find(*script, "tour", &scene::ScriptNode::type);
  ASSERT_NE(tour, script->end());
  EXPECT_EQ(tour->children.size(), 2u);
  for (const scene::ScriptNode& stop : tour->children) {
    const auto camera = std::ranges::find_if(*script, [&](const scene::ScriptNode& node) {
      return node.type == "camera" && written(node, "name") == written(stop, "camera");
    });
    ASSERT_NE(camera, script->end());
    EXPECT_TRUE(std::ranges::any_of(*script, [&](const scene::ScriptNode& node) {
      return written(node, "name").starts_with("parked") &&
             glm::distance(place_of(node), place_of(*camera)) < near_m;
    })) << written(stop, "camera");
  }
}

TEST(PaperCity, IsTheSameForTheSameSeed) {
  const auto colour = [](std::uint32_t seed) {
    return facade_pictures(facade_styles()[0], seed).colour.pixels;
  };
  EXPECT_EQ(colour(4), colour(4));
  EXPECT_NE(colour(4), colour(5));
  EXPECT_EQ(synthesis::sky_picture(64, to_sun(), 4).pixels, synthesis::sky_picture(64, to_sun(), 4).pixels);
  EXPECT_EQ(synthesis::make_tree(0, 4).parts[1].mesh.positions,
            synthesis::make_tree(0, 4).parts[1].mesh.positions);
  EXPECT_EQ(paper_script({}, 4), paper_script({}, 4));
}

TEST(Trees, HaveThePapersCountForAnySeed) {
  EXPECT_EQ(tree_places().size(), 8u);
  for (std::uint64_t seed = 0; seed < 3; ++seed)
    for (int species = 0; species < tree_species; ++species) {
      const scene::Model tree = synthesis::make_tree(species, seed);
      EXPECT_EQ(tree.triangle_count(), synthesis::tree_triangles);
      for (const scene::Part& part : tree.parts) EXPECT_TRUE(check(part.mesh, part.object));
      EXPECT_GT(bounds(tree).max.z, 7.0f);
      EXPECT_NEAR(bounds(tree).min.z, 0.0f, 0.2f);
    }
}

TEST(SkyPicture, IsFiniteBrightAboveAndWithoutSeam) {
  const ImageF sky = synthesis::sky_picture(256, to_sun(), 2);
  ASSERT_EQ(sky.height, 128);
  for (const float value : sky.pixels) {
    EXPECT_TRUE(std::isfinite(value));
    EXPECT_GT(value, 0.0f);
    EXPECT_LT(value, 20.0f);
  }
  for (int y = 0; y < 50; ++y)  // the last and the first column are neighbours
    EXPECT_NEAR(sky.at(0, y)[2], sky.at(255, y)[2], 0.35f) << "row " << y;
}

}  // namespace
}  // namespace parvis::city

#include "scene/city_json.h"

#include <gtest/gtest.h>

#include "base/files.h"
#include "base/random.h"
#include "base/test_data.h"
#include "base/test_folder.h"
#include "scene/polygon_triangles.h"

namespace parvis::scene {
namespace {

/// A house of 10 x 8 x 6 m, far from the origin, with a hole in its roof.
std::string house() {
  return R"({"type":"CityJSON","version":"1.1","transform":{"scale":[0.001,0.001,0.001],"translate":[80000,450000,2]},
    "CityObjects":{"house":{"type":"Building","geometry":[{"type":"Solid","lod":"2.2","boundaries":[[
      [[0,3,2,1]],[[4,5,6,7],[8,11,10,9]],[[0,1,5,4]],[[1,2,6,5]],[[2,3,7,6]],[[3,0,4,7]]]]}]}},
    "vertices":[[0,0,0],[10000,0,0],[10000,8000,0],[0,8000,0],[0,0,6000],[10000,0,6000],[10000,8000,6000],[0,8000,6000],
      [2000,2000,6000],[4000,2000,6000],[4000,4000,6000],[2000,4000,6000]]})";
}

Result<Model> read(const std::string& text) {
  const TestFolder folder;
  Errors warnings;
  return read_city_model(folder.write("city.json", text), warnings);
}

std::string with(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

double area(const Model& model, const std::string& name) {
  double sum = 0.0;
  for (const Part& part : model.parts)
    if (part.object == name)
      for (std::size_t i = 0; i + 2 < part.mesh.indices.size(); i += 3) {
        const auto at = [&](std::size_t k) { return part.mesh.positions[part.mesh.indices[i + k]]; };
        sum += 0.5 * double(glm::length(glm::cross(at(1) - at(0), at(2) - at(0))));
      }
  return sum;
}

TEST(CityJson, AHouseKeepsItsSizeAndItsHole) {
  const Result<Model> city = read(house());
  ASSERT_TRUE(city) << to_string(city.errors());
  EXPECT_NEAR(area(*city, "RoofSurface"), 76.0, 1e-3);  // 80 less the hole of 4
  EXPECT_NEAR(area(*city, "WallSurface"), 216.0, 1e-3);
  EXPECT_NEAR(area(*city, "GroundSurface"), 80.0, 1e-3);
}

TEST(CityJson, TheOriginIsKeptAndTheModelStandsAroundIt) {
  const Result<Model> city = read(house());
  ASSERT_TRUE(city);
  EXPECT_EQ(city->origin, glm::dvec3(80005.0, 450004.0, 0.0));
  const Bounds box = bounds(*city);
  EXPECT_NEAR(box.min.x, -5.0f, 1e-4f);
  EXPECT_NEAR(box.min.z, 2.0f, 1e-4f);
  EXPECT_NEAR(box.max.z, 8.0f, 1e-4f);
}

TEST(CityJson, FacesLookOutward) {
  const Result<Model> city = read(house());
  ASSERT_TRUE(city);
  const glm::vec3 middle = bounds(*city).centre();
  for (const Part& part : city->parts)
    for (std::size_t i = 0; i + 2 < part.mesh.indices.size(); i += 3) {
      const auto at = [&](std::size_t k) { return part.mesh.positions[part.mesh.indices[i + k]]; };
      EXPECT_GT(glm::dot(glm::cross(at(1) - at(0), at(2) - at(0)), at(0) - middle), 0.0f) << part.object;
    }
}

TEST(CityJson, BadFilesAreRefusedByName) {
  const auto expect = [](const std::string& text, const std::string& reason) {
    const Result<Model> city = read(text);
    ASSERT_FALSE(city) << reason;
    EXPECT_NE(to_string(city.errors()).find(reason), std::string::npos) << to_string(city.errors());
  };
  expect(with(house(), "[3,0,4,7]", "[3,0,4,99]"), "object \"house\": vertex 99 is out of range");
  expect(with(house(), "[3,0,4,7]", "[3,0,4,-1]"), "vertex -1 is out of range");
  expect(with(house(), "\"1.1\"", "\"7.3\""), "version \"7.3\" is not known");
  expect(with(house(), "\"CityJSON\"", "\"GeoJSON\""), "no CityJSON");
  expect(with(house(), "\"Solid\"", "\"MultiPoint\""), "none of the 1 city objects has polygons");
  expect(with(house(), "[2000,4000,6000]]", "[2000,4000]]"), "three numbers");
  expect("{", "not what CityJSON asks for");
  expect("[]", "no CityJSON");
}

TEST(CityJson, AnObjectWithoutPolygonsIsNamed) {
  const TestFolder folder;
  Errors warnings;
  const auto file = folder.write(
      "city.json", with(house(), "\"CityObjects\":{", "\"CityObjects\":{\"shed\":{\"type\":\"Building\"},"));
  ASSERT_TRUE(read_city_model(file, warnings));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].message.find("shed"), std::string::npos);
}

TEST(CityJson, DamagedTextNeverCrashes) {
  Random random(3);
  for (int round = 0; round < 500; ++round) {
    std::string text = house();
    for (int change = 0; change <= round % 4; ++change)
      text[std::size_t(random.index(int(text.size())))] = "0123456789[]{},:\"-e.x"[random.index(21)];
    static_cast<void>(read(text));
  }
}

TEST(PolygonTriangles, ACrossedRingGivesTrianglesAndANewPoint) {
  std::vector<glm::dvec3> points;
  const auto triangles = triangulated({{{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 2, 0}}}, {0, 0, 1}, points);
  EXPECT_EQ(triangles.size() % 3, 0u);
  EXPECT_GT(points.size(), 4u);
  for (const std::uint32_t index : triangles) EXPECT_LT(index, points.size());
}

/// Every city among the shared data gives a sound model about its origin.
TEST(CityJson, ReadsRealCities) {
  for (const char* name : {"cities/DenHaag_01.city.json", "cities/delft_context.city.json",
                           "cities/zurich_subset_lod2.city.json",
                           "cities/rotterdam_two_buildings_textured/twobuildings_t.json"}) {
    const auto file = shared_data(name, PARVIS_SOURCE_DIR);
    if (!file) GTEST_SKIP() << "skipped: shared data absent";
    Errors warnings;
    const Result<Model> city = read_city_model(*file, warnings);
    ASSERT_TRUE(city) << to_string(city.errors());
    EXPECT_GT(city->triangle_count(), 50u) << name;
    EXPECT_GT(area(*city, "WallSurface"), 100.0) << name;
    EXPECT_GT(area(*city, "RoofSurface"), 100.0) << name;
    EXPECT_NE(city->origin, glm::dvec3(0.0)) << name;
  }
}

}  // namespace
}  // namespace parvis::scene

#include "formats/city_models/city_json_clues.h"

#include <gtest/gtest.h>

#include "base/test_folder.h"
#include "formats/city_models/city_json.h"

namespace parvis::scene {
namespace {

constexpr glm::dvec2 in_delft_deg{4.36, 52.01};  // east, north
constexpr const char* latitude_first_system = "urn:ogc:def:crs:EPSG::4979";
constexpr const char* longitude_first_system = "urn:ogc:def:crs:OGC:1.3:CRS84";

/// The form of the surfaces of a test's house in its file.
enum class Written { solid, named_surfaces };

/// A house whose plan is an L, open to the north east: 0.0002 x 0.00015 degrees, 6 m high.
Json house_at(glm::dvec2 at_deg, bool is_north_first, const char* system, Written written) {
  Json city = Json::parse(R"({"type":"CityJSON","version":"1.1","CityObjects":{"house":{"type":"Building"}},
    "transform":{"scale":[1e-7,1e-7,1]}})");
  city["metadata"]["referenceSystem"] = system;
  if (is_north_first) std::swap(at_deg.x, at_deg.y);
  city["transform"]["translate"] = {at_deg.x, at_deg.y, 0};
  const std::vector<glm::ivec2> plan{{0, 0}, {2000, 0}, {2000, 500}, {1000, 500}, {1000, 1500}, {0, 1500}};
  for (const int height : {0, 6})
    for (const glm::ivec2 corner : plan)
      city["vertices"].push_back(is_north_first ? Json{corner.y, corner.x, height}
                                                : Json{corner.x, corner.y, height});
  Json surfaces = Json::parse("[[[5,4,3,2,1,0]],[[6,7,8,9,10,11]]]");
  for (int i = 0; i < 6; ++i) {
    const int next = (i + 1) % 6;
    surfaces.push_back({{i, next, next + 6, i + 6}});
  }
  Json geometry;
  geometry["lod"] = "2.2";
  geometry["type"] = written == Written::solid ? "Solid" : "MultiSurface";
  geometry["boundaries"] = written == Written::solid ? Json::array({surfaces}) : surfaces;
  if (written == Written::named_surfaces)
    geometry["semantics"] = Json::parse(R"({"values":[0,1,2,2,2,2,2,2],
      "surfaces":[{"type":"GroundSurface"},{"type":"RoofSurface"},{"type":"WallSurface"}]})");
  city["CityObjects"]["house"]["geometry"] = Json::array({geometry});
  return city;
}

struct Place {
  Result<Model> model;
  std::optional<glm::dvec2> deg;
  std::string warnings;
};

Place read(const Json& city) {
  const TestFolder folder;
  Errors warnings;
  std::optional<glm::dvec2> deg;
  Result<Model> model = read_city_model(folder.write("house.city.json", city.dump()), warnings, {}, &deg);
  return {std::move(model), deg, to_string(warnings)};
}

/// The roof, which lies in plan, seen from above: its area less that of triangles that face down, and whether
/// it lies in the north east of the house.
struct Roof {
  double up_m2 = 0.0;
  bool is_in_north_east = false;
};

Roof roof_of(const Model& model) {
  const Bounds box = bounds(model);
  const glm::vec3 inner = box.centre() + 0.25f * box.size();
  Roof roof;
  for (const Part& part : model.parts) {
    if (model.materials[std::size_t(part.material)].name != "RoofSurface") continue;
    for (std::size_t i = 0; i + 2 < part.mesh.indices.size(); i += 3) {
      const auto at = [&](std::size_t k) { return part.mesh.positions[part.mesh.indices[i + k]]; };
      const glm::vec3 across = glm::cross(at(1) - at(0), at(2) - at(0));
      roof.up_m2 += 0.5 * double(across.z);
      const auto is_left_of = [&](std::size_t a, std::size_t b) {
        const glm::vec3 side = at(b) - at(a), there = inner - at(a);
        return (side.x * there.y - side.y * there.x) * across.z > 0.0f;
      };
      roof.is_in_north_east =
          roof.is_in_north_east || (is_left_of(0, 1) && is_left_of(1, 2) && is_left_of(2, 0));
    }
  }
  return roof;
}

void expect_house_of_delft(const Place& place, const std::string& what) {
  ASSERT_TRUE(place.model) << what << ": " << to_string(place.model.errors());
  ASSERT_TRUE(place.deg) << what;
  EXPECT_LT(glm::distance(*place.deg, in_delft_deg), 1e-3) << what;
  const glm::vec3 size = bounds(*place.model).size();
  EXPECT_NEAR(size.x, 13.7f, 0.6f) << what << ": 0.0002 degrees of longitude";
  EXPECT_NEAR(size.y, 16.7f, 0.6f) << what << ": 0.00015 degrees of latitude";
  const Roof roof = roof_of(*place.model);
  EXPECT_NEAR(roof.up_m2, 0.5 * 13.7 * 16.7 * (1.0 + 1.0 / 3.0), 4.0) << what;
  EXPECT_FALSE(roof.is_in_north_east) << what << ": the L is open there; it is mirrored";
}

TEST(CityJsonClues, HousesInDegreesStandWhereTheyAreInEitherOrderOfTheAxes) {
  for (const Written written : {Written::solid, Written::named_surfaces})
    for (const bool is_north_first : {false, true}) {
      const std::string what = fmt::format("{}, {}", is_north_first ? "latitude first" : "longitude first",
                                           written == Written::solid ? "solid" : "named surfaces");
      const Place as_named =
          read(house_at(in_delft_deg, is_north_first,
                        is_north_first ? latitude_first_system : longitude_first_system, written));
      expect_house_of_delft(as_named, what);
      EXPECT_EQ(as_named.warnings, "") << what;
      const Place exchanged =
          read(house_at(in_delft_deg, is_north_first,
                        is_north_first ? longitude_first_system : latitude_first_system, written));
      expect_house_of_delft(exchanged, what + ", against its name");
      EXPECT_NE(exchanged.warnings.find("by its roofs it has " +
                                        std::string(is_north_first ? "latitude first" : "longitude first")),
                std::string::npos)
          << what << ": " << exchanged.warnings;
    }
}

TEST(CityJsonClues, VerticesThatNoObjectNamesDoNotCount) {
  for (const bool is_north_first : {false, true}) {
    Json city = house_at(in_delft_deg, is_north_first, latitude_first_system, Written::solid);
    // Of another town: both of its coordinates could only be a longitude and a latitude in one order.
    city["vertices"].push_back({1'350'000'000, -160'000'000, 900});
    const Place place = read(city);
    expect_house_of_delft(place, is_north_first ? "latitude first" : "longitude first");
    EXPECT_NEAR(bounds(*place.model).centre().x, 0.0f, 1.0f) << "the origin is the middle of the house";
  }
  Json named = house_at(in_delft_deg, true, latitude_first_system, Written::solid);
  named["vertices"].push_back({1'350'000'000, -160'000'000, 900});
  named["CityObjects"]["house"]["geometry"][0]["boundaries"][0].push_back({{0, 1, 12}});
  EXPECT_NE(read(named).warnings.find("read as metres"), std::string::npos)
      << "control: an object names that vertex";
}

TEST(CityJsonClues, IndicesOutOfRangeAreLeftToTheReader) {
  Json city = house_at(in_delft_deg, true, latitude_first_system, Written::named_surfaces);
  city["CityObjects"]["house"]["geometry"][0]["boundaries"][1][0][0] = 99;
  const Place place = read(city);
  ASSERT_FALSE(place.model);
  EXPECT_NE(to_string(place.model.errors()).find("vertex 99 is out of range"), std::string::npos);
}

}  // namespace
}  // namespace parvis::scene

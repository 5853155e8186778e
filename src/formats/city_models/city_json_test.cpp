#include "formats/city_models/city_json.h"

#include <gtest/gtest.h>

#include "base/files.h"
#include "base/random.h"
#include "base/test_data.h"
#include "base/test_folder.h"
#include "formats/city_models/polygon_triangles.h"
#include "formats/readers/test_packing.h"
#include "scene/data/test_scene.h"

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

Result<Model> read_city_json(const std::string& text) {
  const TestFolder folder;
  Errors warnings;
  return read_city_model(folder.write("city.json", text), warnings);
}

std::string with(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(CityJson, AHouseKeepsItsSizeAndItsHole) {
  const Result<Model> city = read_city_json(house());
  ASSERT_TRUE(city) << to_string(city.errors());
  EXPECT_NEAR(area_m2(*city, "RoofSurface"), 76.0, 1e-3);  // 80 less the hole of 4
  EXPECT_NEAR(area_m2(*city, "WallSurface"), 216.0, 1e-3);
  EXPECT_NEAR(area_m2(*city, "GroundSurface"), 80.0, 1e-3);
}

TEST(CityJson, WallsAreNamedAfterTheKindOfTheirBuilding) {
  const auto walls_of = [](const std::string& attributes) {
    const Result<Model> city = read_city_json(
        with(house(), R"("house":{"type":"Building",)",
             R"("whole":{"type":"Building","attributes":{"oorspronkelijkbouwjaar":1911,"function":["1000"]}},
                     "house":{"type":"BuildingPart","parents":["whole"],"attributes":)" +
                 attributes + ","));
    EXPECT_TRUE(city) << to_string(city.errors());
    for (const Part& part : city->parts)
      if (city->materials[std::size_t(part.material)].name == "WallSurface") return part.object;
    return std::string();
  };
  EXPECT_EQ(walls_of("{}"), "WallSurface dwelling 1870-1918") << "of the whole";
  EXPECT_EQ(walls_of(R"({"function":{"value":"1120"},"storeysAboveGround":2})"),
            "WallSurface office 1870-1918 2-storeys");
  EXPECT_EQ(walls_of(R"({"function":[[]],"storeysAboveGround":{},"yearOfConstruction":null})"),
            "WallSurface dwelling 1870-1918");
  EXPECT_EQ(walls_of("7"), "WallSurface dwelling 1870-1918");
}

TEST(CityJson, TheOriginIsKeptAndTheModelStandsAroundIt) {
  const Result<Model> city = read_city_json(house());
  ASSERT_TRUE(city);
  EXPECT_EQ(city->origin, glm::dvec3(80005.0, 450004.0, 0.0));
  const Bounds box = bounds(*city);
  EXPECT_NEAR(box.min.x, -5.0f, 1e-4f);
  EXPECT_NEAR(box.min.z, 2.0f, 1e-4f);
  EXPECT_NEAR(box.max.z, 8.0f, 1e-4f);
}

TEST(CityJson, FacesLookOutward) {
  const Result<Model> city = read_city_json(house());
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
    const Result<Model> city = read_city_json(text);
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

TEST(CityJson, CoordinatesInDegreesAreRefused) {
  std::string degrees = house();
  const std::string scale = "\"scale\":[0.001,0.001,0.001]";
  ASSERT_NE(degrees.find(scale), std::string::npos);
  const Result<Model> city = read_city_json(with(degrees, scale, "\"scale\":[0.00000001,0.00000001,0.001]"));
  ASSERT_FALSE(city);
  EXPECT_NE(to_string(city.errors()).find("seem to be degrees"), std::string::npos);
}

TEST(CityJson, NamedDegreesAndFeetBecomeMetres) {
  const auto named = [](const char* scale, const char* translate, const char* system) {
    const std::string placed =
        with(with(house(), "\"scale\":[0.001,0.001,0.001]", fmt::format("\"scale\":{}", scale)),
             "\"translate\":[80000,450000,2]", fmt::format("\"translate\":{}", translate));
    return with(placed, "\"CityObjects\"",
                fmt::format("\"metadata\":{{\"referenceSystem\":\"{}\"}},\"CityObjects\"", system));
  };
  const TestFolder folder;
  Errors warnings;
  std::optional<glm::dvec2> place_deg;
  const Result<Model> tokyo =
      read_city_model(folder.write("city.json", named("[1e-8,1e-8,0.001]", "[35.68,139.77,2]",
                                                      "https://www.opengis.net/def/crs/EPSG/0/6697")),
                      warnings, {}, &place_deg);
  ASSERT_TRUE(tokyo) << to_string(tokyo.errors());
  EXPECT_EQ(to_string(warnings), "");
  ASSERT_TRUE(place_deg);
  EXPECT_NEAR(place_deg->x, 139.77, 1e-3);
  const glm::vec3 size = bounds(*tokyo).size();
  constexpr double off_north_m = 0.15;  // the map's north is 0.7 degrees off that of the place
  EXPECT_NEAR(size.y, 1e-4 * 110'950.0, off_north_m) << "a ten thousandth of a degree of latitude";
  EXPECT_NEAR(size.x, 8e-5 * 90'530.0, off_north_m);
  EXPECT_NEAR(size.z, 6.0f, 1e-3f);
  const Result<Model> feet =
      read_city_json(named("[0.001,0.001,0.001]", "[971000,190600,2]", "urn:ogc:def:crs:EPSG::2263"));
  ASSERT_TRUE(feet) << to_string(feet.errors());
  EXPECT_NEAR(bounds(*feet).size().x, 3.048f, 1e-3f);
  EXPECT_NEAR(bounds(*feet).size().z, 6.0f * 0.3048f, 1e-3f);
}

TEST(CityJson, PackedFilesAndSequencesAreReadAsTheyAre) {
  const TestFolder folder;
  Errors warnings;
  const Result<Model> packed =
      read_city_model(folder.write("city.json.gz", formats::gzipped(house())), warnings);
  ASSERT_TRUE(packed) << to_string(packed.errors());
  EXPECT_EQ(packed->name, "city");
  const std::string lines =
      R"({"type":"CityJSON","version":"2.0","transform":{"scale":[0.001,0.001,0.001],"translate":[0,0,0]},
"CityObjects":{},"vertices":[]})";
  const std::string feature =
      R"({"type":"CityJSONFeature","id":"a","CityObjects":{"a":{"type":"Building","geometry":[
{"type":"MultiSurface","lod":"1","boundaries":[[[0,1,2]]]}]}},"vertices":[[0,0,0],[9000,0,0],[0,9000,0]]})";
  std::string sequence = lines + "\n" + feature;
  std::erase(sequence, '\n');
  sequence.insert(sequence.find("{\"type\":\"CityJSONFeature\""), "\n");
  const Result<Model> of_lines =
      read_city_model(folder.write("city.city.JSONL.gz", formats::gzipped(sequence)), warnings);
  ASSERT_TRUE(of_lines) << to_string(of_lines.errors());
  EXPECT_EQ(of_lines->triangle_count(), 1u);
  const Result<Model> cut =
      read_city_model(folder.write("cut.json.gz", formats::gzipped(house()).substr(0, 200)), warnings);
  ASSERT_FALSE(cut);
  EXPECT_NE(to_string(cut.errors()).find("cut.json.gz: its packing (gzip) ends too early"), std::string::npos)
      << to_string(cut.errors());
}

TEST(CityJson, Version02AsItWasPublishedIsRead) {
  const std::string early = with(with(house(), "\"CityJSON\"", "\"CityModel\""), "\"1.1\"",
                                 "\"http://www.cityjson.org/version/0.2\"");
  const Result<Model> city = read_city_json(early);
  ASSERT_TRUE(city) << to_string(city.errors());
  EXPECT_NEAR(area_m2(*city, "RoofSurface"), 76.0, 1e-3);
  EXPECT_FALSE(read_city_json(with(early, "/0.2", "/7.2")));
}

/// The house as towns publish it: roof, footprint and walls are a geometry each, of one level, beside a
/// coarser one.
std::string house_in_three() {
  const std::string all = house();
  const std::size_t begin = all.find("{\"type\":\"Solid\""), end = all.find("}]}},");
  return all.substr(0, begin) + R"({"type":"MultiSurface","lod":1,"boundaries":[[[0,1,2,3]]]},
    {"type":"MultiSurface","lod":2,"boundaries":[[[4,5,6,7],[8,11,10,9]]]},
    {"type":"MultiSurface","lod":2,"boundaries":[[[0,1,2,3]]]},
    {"type":"MultiSurface","lod":2,"boundaries":[[[0,1,5,4]],[[1,2,6,5]],[[2,3,7,6]],[[3,0,4,7]]]})" +
         all.substr(end + 1);
}

TEST(CityJson, KindsThatAListCallsWallsInAllGeometriesAreInferred) {
  std::string early = with(with(house_in_three(), "\"CityJSON\"", "\"CityModel\""), "\"1.1\"",
                           "\"http://www.cityjson.org/version/0.2\"");
  early = with(early, R"("lod":2,"boundaries":[[[4,5,6,7],[8,11,10,9]]])",
               R"("lod":2,"boundaries":[[[4,5,6,7],[8,11,10,9]]],"semantics":["WallSurface"])");
  early = with(early, R"("lod":2,"boundaries":[[[0,1,2,3]]])",
               R"("lod":2,"boundaries":[[[0,1,2,3]]],"semantics":["WallSurface"])");
  early = with(early, R"([[3,0,4,7]]])",
               R"([[3,0,4,7]]],"semantics":["WallSurface","WallSurface","WallSurface","WallSurface"])");
  const Result<Model> city = read_city_json(early);
  ASSERT_TRUE(city) << to_string(city.errors());
  EXPECT_NEAR(area_m2(*city, "RoofSurface"), 76.0, 1e-3) << "of a geometry with one surface";
  EXPECT_NEAR(area_m2(*city, "GroundSurface"), 80.0, 1e-3);
}

TEST(CityJson, AllGeometriesOfTheChosenLevelAreRead) {
  const Result<Model> city = read_city_json(house_in_three());
  ASSERT_TRUE(city) << to_string(city.errors());
  EXPECT_NEAR(area_m2(*city, "RoofSurface"), 76.0, 1e-3);
  EXPECT_NEAR(area_m2(*city, "WallSurface"), 216.0, 1e-3);
  EXPECT_NEAR(area_m2(*city, "GroundSurface"), 80.0, 1e-3);  // wound upward, and yet no roof
}

TEST(CityJson, AShapeThatIsGivenTwiceIsReadOnce) {
  const std::string twice =
      with(house(), "\"geometry\":[",
           R"("geometry":[{"type":"MultiSurface","lod":"2.2","boundaries":[[[1,5,4,0]]]},)");
  const Result<Model> city = read_city_json(twice);
  ASSERT_TRUE(city) << to_string(city.errors());
  EXPECT_NEAR(area_m2(*city, "WallSurface"), 216.0, 1e-3);
}

TEST(CityJson, ASolidOfOneKindIsDividedBySlope) {
  const std::string alike =
      with(house(), "\"lod\":\"2.2\"",
           R"("lod":"2.2","semantics":{"surfaces":[{"type":"WallSurface"}],"values":[[0,0,0,0,0,0]]})");
  const Result<Model> city = read_city_json(alike);
  ASSERT_TRUE(city) << to_string(city.errors());
  EXPECT_NEAR(area_m2(*city, "RoofSurface"), 76.0, 1e-3);
  EXPECT_NEAR(area_m2(*city, "GroundSurface"), 80.0, 1e-3);
}

TEST(CityJson, SurfacesOfOneKindAreDividedBySlope) {
  std::string alike = house_in_three();
  const std::string walls = R"("lod":2,"boundaries":[[[4,5,6,7],[8,11,10,9]]])";
  for (const std::string& boundaries :
       {walls, std::string(R"("lod":2,"boundaries":[[[0,1,2,3]]])"),
        std::string(R"("lod":2,"boundaries":[[[0,1,5,4]],[[1,2,6,5]],[[2,3,7,6]],[[3,0,4,7]]])")}) {
    const std::string kinds = boundaries.ends_with("[[3,0,4,7]]]") ? "[0,0,0,0]" : "[0]";
    alike = with(alike, boundaries,
                 fmt::format(R"({},"semantics":{{"surfaces":[{{"type":"WallSurface"}}],"values":{}}})",
                             boundaries, kinds));
  }
  const Result<Model> city = read_city_json(alike);
  ASSERT_TRUE(city) << to_string(city.errors());
  EXPECT_NEAR(area_m2(*city, "RoofSurface"), 76.0, 1e-3);
  EXPECT_NEAR(area_m2(*city, "WallSurface"), 216.0, 1e-3);
  EXPECT_NEAR(area_m2(*city, "GroundSurface"), 80.0, 1e-3);
}

TEST(CityJson, RoofsWithoutWallsAreAWarning) {
  const TestFolder folder;
  std::string roofs;
  for (int i = 0; i < 25; ++i)
    roofs += fmt::format(
        R"({}"r{}":{{"type":"Building","geometry":[{{"type":"MultiSurface","lod":2,"boundaries":[[[4,5,6]]],
      "semantics":{{"surfaces":[{{"type":"RoofSurface"}}],"values":[0]}}}}]}})",
        i == 0 ? "" : ",", i);
  const std::string all = house();
  const std::size_t begin = all.find("\"house\""), end = all.find("},\n    \"vertices\"");
  Errors warnings;
  ASSERT_TRUE(
      read_city_model(folder.write("city.json", all.substr(0, begin) + roofs + all.substr(end)), warnings));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].message.find("none is a WallSurface"), std::string::npos) << warnings[0].message;
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

/// The house with a geometry template of a mast of 1 x 1 x 4 m, placed twice as large on the house's
/// corner 6.
std::string house_with_mast() {
  return with(house(), "\"CityObjects\":{",
              R"("geometry-templates":{"templates":[{"type":"MultiSurface","lod":"2",
    "boundaries":[[[0,1,2,3]]]}],"vertices-templates":[[0,0,0],[1,0,0],[1,0,4],[0,0,4]]},
    "CityObjects":{"mast":{"type":"CityFurniture","geometry":[{"type":"GeometryInstance","template":0,"boundaries":[6],
    "transformationMatrix":[2,0,0,0.5, 0,2,0,0, 0,0,2,0, 0,0,0,1]}]},)");
}

TEST(CityJson, TemplatesStandAtTheirPlaces) {
  const Result<Model> city = read_city_json(house_with_mast());
  ASSERT_TRUE(city) << to_string(city.errors());
  EXPECT_NEAR(area_m2(*city, "CityFurniture"), 16.0, 1e-3);
  for (const Part& part : city->parts)
    if (part.object == "CityFurniture") {
      EXPECT_NEAR(part.mesh.bounds().min.x, 5.5f, 1e-4f);   // corner 6 lies at x 5 of the model
      EXPECT_NEAR(part.mesh.bounds().max.z, 16.0f, 1e-4f);  // 8 m up, and 2 x 4 m
    }
  EXPECT_FALSE(read_city_json(with(house_with_mast(), "\"template\":0", "\"template\":3")));
  EXPECT_FALSE(read_city_json(with(house_with_mast(), "[6]", "[66]")));
}

TEST(CityJson, MirroredTemplatesKeepTheirFaces) {
  const Result<Model> city = read_city_json(with(house_with_mast(), "[2,0,0,0.5, 0,2", "[2,0,0,0.5, 0,-2"));
  ASSERT_TRUE(city) << to_string(city.errors());
  const auto mast = std::find_if(city->parts.begin(), city->parts.end(),
                                 [](const Part& part) { return part.object == "CityFurniture"; });
  ASSERT_NE(mast, city->parts.end());
  EXPECT_GT(mast->mesh.normals.front().y, 0.9f);  // unmirrored it looks to -y
}

/// The house with two materials, of which the wall of the last face takes the second by the default theme.
std::string house_with_materials() {
  return with(with(house(), "\"CityObjects\":{", R"("appearance":{"default-theme-material":"day","materials":[
    {"name":"a","diffuseColor":[1,0,0]},{"name":"b","diffuseColor":[0,1,0],"transparency":0.25,"shininess":0.5},
    {"name":"c","diffuseColor":[1,0,0]}]},"CityObjects":{)"),
              "\"lod\":\"2.2\"",
              R"("lod":"2.2","material":{"autumn":{"value":0},"day":{"values":[[0,null,2,0,0,1]]}})");
}

TEST(CityJson, MaterialsOfTheDefaultTheme) {
  const Result<Model> city = read_city_json(house_with_materials());
  ASSERT_TRUE(city) << to_string(city.errors());
  std::size_t red = 0, green = 0;
  for (const Material& material : city->materials) {
    red += material.base_colour == glm::vec3(1, 0, 0) ? 1 : 0;
    if (material.base_colour != glm::vec3(0, 1, 0)) continue;
    ++green;
    EXPECT_EQ(material.name, "WallSurface");
    EXPECT_NEAR(material.alpha, 0.75f, 1e-6f);
    EXPECT_EQ(material.alpha_mode, Alpha::blend);
    EXPECT_LT(material.roughness, 0.5f);
  }
  EXPECT_EQ(red, 2u);  // of the ground and of the walls: materials that look alike are one
  EXPECT_EQ(green, 1u);
  EXPECT_FALSE(read_city_json(with(house_with_materials(), "0,1]]}}", "0,9]]}}")));
}

TEST(CityJson, SemanticsOfTheFirstVersionsStandInTheirList) {
  const std::string old =
      with(with(house(), "\"1.1\"", "\"0.2\""), "\"lod\":\"2.2\"",
           R"("lod":2,"semantics":[[{"type":"GroundSurface"},{"type":"WallSurface"},null,{},
                                  {"type":"RoofSurface"}]])");
  const Result<Model> city = read_city_json(old);
  ASSERT_TRUE(city) << to_string(city.errors());
  EXPECT_NEAR(area_m2(*city, "RoofSurface"), 60.0, 1e-3);  // what the list calls a roof
}

TEST(CityJson, WithoutTransformVerticesAreMetres) {
  std::string text =
      with(house(), R"("transform":{"scale":[0.001,0.001,0.001],"translate":[80000,450000,2]},)", "");
  const Result<Model> city = read_city_json(text);
  ASSERT_TRUE(city) << to_string(city.errors());
  EXPECT_NEAR(bounds(*city).size().x, 10000.0f, 1e-2f);
}

TEST(CityJson, TheLevelOfDetailAskedFor) {
  const std::string text = with(house(), "\"geometry\":[", R"("geometry":[{"type":"MultiSurface","lod":"0",
    "boundaries":[[[0,1,2,3]]]},{"type":"MultiLineString","lod":"3","boundaries":[[0,1]]},)");
  const TestFolder folder;
  Errors warnings;
  const auto file = folder.write("city.json", text);
  const auto triangles = [&](std::optional<double> level) {
    const Result<Model> city = read_city_model(file, warnings, level);
    return city ? city->triangle_count() : 0;
  };
  EXPECT_GT(triangles({}), 10u);
  EXPECT_EQ(triangles(1.0), 2u);
  EXPECT_GT(triangles(2.5), 10u);
  EXPECT_EQ(triangles(-1.0), 2u);
}

TEST(CityJson, ExtensionsAreTakenByTheirGeometry) {
  const Result<Model> tower = read_city_json(with(house(), "\"Building\"", "\"+NoiseBuilding\""));
  ASSERT_TRUE(tower) << to_string(tower.errors());
  EXPECT_NEAR(area_m2(*tower, "WallSurface"), 216.0, 1e-3);
  const Result<Model> thing = read_city_json(with(house(), "\"Building\"", "\"+Pavilion\""));
  ASSERT_TRUE(thing) << to_string(thing.errors());
  EXPECT_NEAR(area_m2(*thing, "GenericCityObject"), 372.0, 1e-3);
}

TEST(CityJson, SolidsOfManySolids) {
  std::string text = with(house(), "\"Solid\"", "\"MultiSolid\"");
  text = with(text, "\"boundaries\":[[", "\"boundaries\":[[[");
  text = with(text, "[[3,0,4,7]]]]", "[[3,0,4,7]]]]]");
  const Result<Model> city = read_city_json(text);
  ASSERT_TRUE(city) << to_string(city.errors());
  EXPECT_NEAR(area_m2(*city, "WallSurface"), 216.0, 1e-3);
}

TEST(CityJson, DamagedTextNeverCrashes) {
  Random random(3);
  for (int round = 0; round < 600; ++round) {
    std::string text = house();
    if (round % 3 == 1) text = house_with_mast();
    if (round % 3 == 2) text = house_with_materials();
    for (int change = 0; change <= round % 4; ++change)
      text[std::size_t(random.index(int(text.size())))] = "0123456789[]{},:\"-e.x"[random.index(21)];
    static_cast<void>(read_city_json(text));
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
    const auto file = shared_data(name);
    if (!file) GTEST_SKIP() << "skipped: shared data absent";
    Errors warnings;
    const Result<Model> city = read_city_model(*file, warnings);
    ASSERT_TRUE(city) << to_string(city.errors());
    EXPECT_GT(city->triangle_count(), 50u) << name;
    EXPECT_GT(area_m2(*city, "WallSurface"), 100.0) << name;
    EXPECT_GT(area_m2(*city, "RoofSurface"), 100.0) << name;
    EXPECT_NE(city->origin, glm::dvec3(0.0)) << name;
  }
}

/// A roof of 10 x 8 m `at` metres east, whose own vertices, picture and material have index 0.
std::string feature(int at, const std::string& red) {
  return fmt::format(
      R"({{"type":"CityJSONFeature","id":"f{0}","CityObjects":{{"f{0}":{{"type":"Building","geometry":[
      {{"type":"MultiSurface","lod":"2","boundaries":[[[0,1,2,3]]],"material":{{"all":{{"values":[0]}}}},
      "semantics":{{"surfaces":[{{"type":"RoofSurface"}}],"values":[0]}}}}]}}}},
      "appearance":{{"materials":[{{"name":"m","diffuseColor":[{1},0,0]}}]}},
      "vertices":[[{0},0,3],[{2},0,3],[{2},8,3],[{0},8,3]]}})",
      at, red, at + 10);
}

std::string one_line(std::string text) {
  std::erase(text, '\n');
  return text + "\n";
}

Result<Model> read_sequence(const std::string& text) {
  const TestFolder folder;
  Errors warnings;
  return read_city_model(folder.write("city.jsonl", text), warnings);
}

TEST(CityJson, ASequenceOfFeaturesIsOneCity) {
  const std::string head =
      R"({"type":"CityJSON","version":"2.0","transform":{"scale":[1,1,1],"translate":[80000,450000,0]},)"
      R"("CityObjects":{},"vertices":[]})";
  const std::string both = one_line(head) + one_line(feature(0, "1")) + "\n" + one_line(feature(20, "0"));
  const Result<Model> city = read_sequence(both);
  ASSERT_TRUE(city) << to_string(city.errors());
  EXPECT_NEAR(area_m2(*city, "RoofSurface"), 160.0, 1e-3);
  EXPECT_NEAR(bounds(*city).size().x, 30.0f, 1e-3f);
  ASSERT_EQ(city->materials.size(), 2u) << "each feature counts its own materials from 0";
  EXPECT_NE(city->materials[0].base_colour, city->materials[1].base_colour);

  const auto expect_error = [](const std::string& text, const std::string& words, int line) {
    const Result<Model> bad = read_sequence(text);
    ASSERT_FALSE(bad) << words;
    EXPECT_NE(to_string(bad.errors()).find(words), std::string::npos) << to_string(bad.errors());
    EXPECT_EQ(bad.errors().front().where.line, line);
  };
  expect_error("", "empty", 0);
  expect_error(one_line(feature(0, "1")), "expected \"CityJSON\"", 1);
  expect_error(one_line(head) + one_line(head), "expected \"CityJSONFeature\"", 2);
  expect_error(one_line(head) + "{\n", "no JSON object", 2);
  std::string outside = feature(0, "1");
  expect_error(one_line(head) + one_line(with(outside, "[0,1,2,3]", "[0,1,2,9]")), "vertex 9", 0);
}

TEST(CityJson, PicturesMayLieInTheUsualFolderBesideTheFile) {
  const auto two = shared_data("cities/rotterdam_two_buildings_textured/twobuildings_t.json");
  if (!two) GTEST_SKIP() << "cities/rotterdam_two_buildings_textured/twobuildings_t.json";
  Errors warnings;
  const Result<Model> model = read_city_model(*two, warnings);
  ASSERT_TRUE(model) << to_string(model.errors());
  EXPECT_EQ(to_string(warnings), "");
  // Alone, without its folder of pictures, it names a few of those that are missing and counts the others.
  const TestFolder folder;
  std::filesystem::copy(*two, folder.path());
  const Result<Model> bare = read_city_model(folder.path() / two->filename(), warnings);
  ASSERT_TRUE(bare);
  for (const Material& material : bare->materials) EXPECT_EQ(material.base_colour_texture, no_index);
  EXPECT_EQ(warnings.size(), 4u) << to_string(warnings);
  EXPECT_NE(to_string(warnings).find("11 pictures more of 14"), std::string::npos) << to_string(warnings);
}

}  // namespace
}  // namespace parvis::scene

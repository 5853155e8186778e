#include "formats/city_models/city_gml.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "base/files.h"
#include "base/image_io.h"
#include "base/random.h"
#include "base/test_data.h"
#include "base/test_folder.h"
#include "formats/city_models/city_json.h"
#include "formats/terrain/map_projection.h"
#include "scene/data/test_scene.h"

namespace parvis::scene {
namespace {

/// A building of one wall of 4 x 3 m with a hole of 1 m2, far from the origin.
std::string wall() {
  return R"(<?xml version="1.0"?>
<CityModel xmlns="http://www.opengis.net/citygml/2.0" xmlns:bldg="http://www.opengis.net/citygml/building/2.0"
  xmlns:gml="http://www.opengis.net/gml">
<cityObjectMember><bldg:Building gml:id="house"><bldg:boundedBy><bldg:WallSurface gml:id="w"><bldg:lod2MultiSurface>
<gml:MultiSurface><gml:surfaceMember><gml:Polygon gml:id="p"><gml:exterior><gml:LinearRing gml:id="r">
<gml:posList>80000 450000 0 80004 450000 0 80004 450000 3 80000 450000 3 80000 450000 0</gml:posList>
</gml:LinearRing></gml:exterior><gml:interior><gml:LinearRing gml:id="h">
<gml:posList>80001 450000 1 80001 450000 2 80002 450000 2 80002 450000 1 80001 450000 1</gml:posList>
</gml:LinearRing></gml:interior></gml:Polygon></gml:surfaceMember></gml:MultiSurface>
</bldg:lod2MultiSurface></bldg:WallSurface></bldg:boundedBy></bldg:Building></cityObjectMember></CityModel>)";
}

Result<Model> read_gml(const std::string& text) {
  const TestFolder folder;
  Errors warnings;
  return read_city_gml(folder.write("city.gml", text), warnings);
}

TEST(CityGml, WallsAreNamedAfterTheKindOfTheirBuilding) {
  std::string text = wall();
  const std::string before = "<bldg:boundedBy>";
  text.insert(
      text.find(before),
      "<bldg:function>31001_2020</bldg:function><bldg:yearOfConstruction>1931</bldg:yearOfConstruction>"
      "<bldg:storeysAboveGround>3</bldg:storeysAboveGround>");
  const Result<Model> city = read_gml(text);
  ASSERT_TRUE(city) << to_string(city.errors());
  ASSERT_EQ(city->parts.size(), 1u);
  EXPECT_EQ(city->parts.front().object, "WallSurface office 1919-1945 3-storeys");
  EXPECT_EQ(city->materials.front().name, "WallSurface");
}

/// A building of 10 x 8 x 6 m as a closed shell of six named surfaces, which a solid lists once more.
std::string box_building(const std::string& version) {
  const auto polygon = [](const std::string& kind, const std::string& corners) {
    return fmt::format(R"(<bldg:boundedBy><bldg:{0}Surface><bldg:lod2MultiSurface><gml:MultiSurface>
<gml:surfaceMember><gml:Polygon gml:id="p{2}"><gml:exterior><gml:LinearRing><gml:posList>{1}</gml:posList>
</gml:LinearRing></gml:exterior></gml:Polygon></gml:surfaceMember></gml:MultiSurface></bldg:lod2MultiSurface>
</bldg:{0}Surface></bldg:boundedBy>
)",
                       kind, corners, std::hash<std::string>()(corners));
  };
  return fmt::format(R"(<?xml version="1.0"?>
<CityModel xmlns="http://www.opengis.net/citygml/{0}" xmlns:bldg="http://www.opengis.net/citygml/building/{0}"
  xmlns:gml="http://www.opengis.net/gml" xmlns:xlink="http://www.w3.org/1999/xlink">
<cityObjectMember><bldg:Building gml:id="house">
)",
                     version) +
         polygon("Ground", "0 0 0 0 8 0 10 8 0 10 0 0 0 0 0") +
         polygon("Roof", "0 0 6 10 0 6 10 8 6 0 8 6 0 0 6") +
         polygon("Wall", "0 0 0 10 0 0 10 0 6 0 0 6 0 0 0") +
         polygon("Wall", "10 0 0 10 8 0 10 8 6 10 0 6 10 0 0") +
         polygon("Wall", "10 8 0 0 8 0 0 8 6 10 8 6 10 8 0") +
         polygon("Wall", "0 8 0 0 0 0 0 0 6 0 8 6 0 8 0") + "</bldg:Building></cityObjectMember></CityModel>";
}

void expect_refused(const std::string& text, const std::string& reason, int line) {
  const Result<Model> city = read_gml(text);
  ASSERT_FALSE(city) << reason;
  EXPECT_NE(to_string(city.errors()).find(reason), std::string::npos) << to_string(city.errors());
  EXPECT_EQ(city.errors().front().where.line, line);
}

/// A surface of 4 x 3 m at a height, which faces down where `corners` run clockwise.
std::string lod2_surface(const std::string& corners) {
  return "<gml:surfaceMember><gml:Polygon><gml:exterior><gml:LinearRing><gml:posList>" + corners +
         "</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon></gml:surfaceMember>";
}

TEST(CityGml, RoomsKeepTheirCeilingsAndTheirFurniture) {
  const auto bounded = [](const char* kind, const std::string& corners) {
    return fmt::format(
        "<bldg:boundedBy><bldg:{0}><bldg:lod4MultiSurface><gml:MultiSurface>{1}</gml:MultiSurface>"
        "</bldg:lod4MultiSurface></bldg:{0}></bldg:boundedBy>",
        kind, lod2_surface(corners));
  };
  const Result<Model> city = read_gml(
      R"(<?xml version="1.0"?><CityModel xmlns="http://www.opengis.net/citygml/2.0"
xmlns:bldg="http://www.opengis.net/citygml/building/2.0" xmlns:gml="http://www.opengis.net/gml">
<cityObjectMember><bldg:Building gml:id="house"><bldg:interiorRoom><bldg:Room gml:id="room">)" +
      bounded("CeilingSurface", "0 0 3 0 3 3 4 3 3 4 0 3 0 0 3") +
      bounded("FloorSurface", "0 0 0 4 0 0 4 3 0 0 3 0 0 0 0") +
      bounded("InteriorWallSurface", "0 0 0 4 0 0 4 0 3 0 0 3 0 0 0") +
      "<bldg:interiorFurniture><bldg:BuildingFurniture><bldg:lod4Geometry><gml:MultiSurface>" +
      lod2_surface("1 1 0.8 2 1 0.8 2 2 0.8 1 2 0.8 1 1 0.8") +
      "</gml:MultiSurface></bldg:lod4Geometry></bldg:BuildingFurniture></bldg:interiorFurniture>"
      "</bldg:Room></bldg:interiorRoom></bldg:Building></cityObjectMember></CityModel>");
  ASSERT_TRUE(city) << to_string(city.errors());
  EXPECT_NEAR(area_m2(*city, "BuildingFurniture"), 1.0, 1e-3);
  EXPECT_NEAR(area_m2(*city, "RoofSurface"), 0.0, 1e-3) << "a level table is no roof";
  EXPECT_NEAR(area_m2(*city, "CeilingSurface"), 12.0, 1e-3);
  EXPECT_NEAR(area_m2(*city, "FloorSurface"), 12.0, 1e-3);
  EXPECT_NEAR(area_m2(*city, "InteriorWallSurface"), 12.0, 1e-3);
  for (const Part& part : city->parts)
    if (part.object == "CeilingSurface") {
      EXPECT_LT(part.mesh.normals.front().z, 0.0f) << "it is seen from below";
    }
}

TEST(CityGml, TerrainKeepsItsName) {
  const Result<Model> city = read_gml(
      R"(<?xml version="1.0"?><CityModel xmlns="http://www.opengis.net/citygml/2.0"
xmlns:dem="http://www.opengis.net/citygml/relief/2.0" xmlns:gml="http://www.opengis.net/gml">
<cityObjectMember><dem:ReliefFeature gml:id="hill"><dem:lod>1</dem:lod><dem:reliefComponent><dem:TINRelief gml:id="tin">
<dem:lod>1</dem:lod><dem:tin><gml:TriangulatedSurface><gml:trianglePatches><gml:Triangle><gml:exterior><gml:LinearRing>
<gml:posList>0 0 0 4 0 0 4 3 0 0 0 0</gml:posList></gml:LinearRing></gml:exterior></gml:Triangle></gml:trianglePatches>
</gml:TriangulatedSurface></dem:tin></dem:TINRelief></dem:reliefComponent></dem:ReliefFeature></cityObjectMember>
</CityModel>)");
  ASSERT_TRUE(city) << to_string(city.errors());
  EXPECT_NEAR(area_m2(*city, "TINRelief"), 6.0, 1e-3) << "ground(target=\"TINRelief\") finds it";
}

TEST(CityGml, AWallKeepsItsSizeItsHoleAndItsPlace) {
  const Result<Model> city = read_gml(wall());
  ASSERT_TRUE(city) << to_string(city.errors());
  EXPECT_NEAR(area_m2(*city, "WallSurface"), 11.0, 1e-3);
  EXPECT_EQ(city->origin, glm::dvec3(80002.0, 450000.0, 0.0));
  EXPECT_NEAR(bounds(*city).min.x, -2.0f, 1e-4f);
}

TEST(CityGml, Versions1And2ReadTheSame) {
  for (const char* version : {"1.0", "2.0"}) {
    const Result<Model> city = read_gml(box_building(version));
    ASSERT_TRUE(city) << version << to_string(city.errors());
    EXPECT_NEAR(area_m2(*city, "RoofSurface"), 80.0, 1e-3) << version;
    EXPECT_NEAR(area_m2(*city, "GroundSurface"), 80.0, 1e-3) << version;
    EXPECT_NEAR(area_m2(*city, "WallSurface"), 216.0, 1e-3) << version;
  }
}

TEST(CityGml, TheBackOfAClosedBodyIsNotShownButThatOfAnOpenOneIs) {
  const Result<Model> closed = read_gml(box_building("2.0"));
  ASSERT_TRUE(closed) << to_string(closed.errors());
  for (const Part& part : closed->parts) {
    EXPECT_FALSE(closed->materials[std::size_t(part.material)].is_double_sided) << part.object;
    const glm::vec3 middle(0.0f, 0.0f, 3.0f);
    for (std::size_t i = 0; i + 2 < part.mesh.indices.size(); i += 3) {
      const auto at = [&](std::size_t k) { return part.mesh.positions[part.mesh.indices[i + k]]; };
      EXPECT_GT(glm::dot(glm::cross(at(1) - at(0), at(2) - at(0)), at(0) - middle), 0.0f) << part.object;
    }
  }
  std::string without_roof = box_building("2.0");
  const std::size_t roof = without_roof.find("0 0 6 10 0 6 10 8 6");
  without_roof.replace(roof, 5, "0 0 7");  // one corner off: a gap
  const Result<Model> open = read_gml(without_roof);
  ASSERT_TRUE(open) << to_string(open.errors());
  for (const Part& part : open->parts)
    if (part.object == "WallSurface") {
      EXPECT_TRUE(open->materials[std::size_t(part.material)].is_double_sided);
    }
}

TEST(CityGml, WallsAndRoofsAreWhatCityJsonMakesThem) {
  const TestFolder folder;
  Errors warnings;
  Result<Model> json = read_city_model(folder.write("city.json", R"({"type":"CityJSON","version":"1.1",
    "CityObjects":{"house":{"type":"Building","geometry":[{"type":"Solid","lod":"2","boundaries":[[
      [[0,3,2,1]],[[4,5,6,7]],[[0,1,5,4]],[[1,2,6,5]],[[2,3,7,6]],[[3,0,4,7]]]]}]}},
    "vertices":[[0,0,0],[10,0,0],[10,8,0],[0,8,0],[0,0,6],[10,0,6],[10,8,6],[0,8,6]]})"),
                                       warnings);
  Result<Model> gml = read_gml(box_building("2.0"));
  ASSERT_TRUE(json && gml);
  ASSERT_EQ(gml->parts.size(), json->parts.size());
  for (const Part& part : json->parts)
    EXPECT_NEAR(area_m2(*gml, part.object), area_m2(*json, part.object), 1e-3) << part.object;
}

/// The building of `box_building` at a place in degrees, latitude first, in a file that names its system.
std::string box_in_degrees(glm::dvec2 place_deg) {
  constexpr double metres_per_degree = 111'320.0;
  const double east_m_per_degree = metres_per_degree * std::cos(glm::radians(place_deg.y));
  std::string text = box_building("2.0"), moved;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t begin = text.find("<gml:posList>", at);
    if (begin == std::string::npos) {
      moved += text.substr(at);
      break;
    }
    const std::size_t first = begin + std::string("<gml:posList>").size(), end = text.find('<', first);
    moved += text.substr(at, first - at);
    std::istringstream numbers(text.substr(first, end - first));
    for (double x = 0, y = 0, z = 0; numbers >> x >> y >> z;)
      moved += fmt::format("{:.10f} {:.10f} {} ", place_deg.y + y / metres_per_degree,
                           place_deg.x + x / east_m_per_degree, z);
    at = end;
  }
  const std::string member = "<cityObjectMember>";
  return moved.insert(moved.find(member),
                      "<gml:boundedBy><gml:Envelope srsName=\"http://www.opengis.net/def/crs/EPSG/0/6697\" "
                      "srsDimension=\"3\"><gml:lowerCorner>35 139 0</gml:lowerCorner><gml:upperCorner>36 140 "
                      "10</gml:upperCorner></gml:Envelope></gml:boundedBy>");
}

TEST(CityGml, DegreesBecomeMetresAsInMapsOfOpenStreetMap) {
  const TestFolder folder;
  constexpr glm::dvec2 tokyo_deg(139.77, 35.68);
  Errors warnings;
  std::optional<glm::dvec2> place_deg;
  const Result<Model> city =
      read_city_gml(folder.write("tokyo.gml", box_in_degrees(tokyo_deg)), warnings, {}, &place_deg);
  ASSERT_TRUE(city) << to_string(city.errors());
  EXPECT_EQ(to_string(warnings), "");
  EXPECT_NEAR(area_m2(*city, "RoofSurface"), 80.0, 1.0);
  EXPECT_NEAR(area_m2(*city, "WallSurface"), 216.0, 1.5);
  for (const Part& part : city->parts)
    if (part.object == "RoofSurface") {
      EXPECT_GT(part.mesh.normals.front().z, 0.9f) << "it is no mirror image";
    }
  const MapProjection utm = MapProjection::utm(tokyo_deg);
  EXPECT_LT(glm::distance(glm::dvec2(city->origin), utm(tokyo_deg)), 20.0);
  ASSERT_TRUE(place_deg);
  EXPECT_NEAR(place_deg->x, tokyo_deg.x, 1e-3);
  EXPECT_NEAR(place_deg->y, tokyo_deg.y, 1e-3);
}

TEST(CityGml, DegreesInTheOtherOrderThanTheirNameAreKnownByTheRoofs) {
  // Written as if 52 degrees east and 4 north: latitude first, 4.36 52.01. With roof and ground exchanged its
  // roof faces down, so that it is a place at 4 degrees east whose axes are in the other order.
  std::string text = box_in_degrees({52.01, 4.36});
  for (const auto& [from, to] :
       {std::pair("RoofSurface", "SomeSurface"), std::pair("GroundSurface", "RoofSurface"),
        std::pair("SomeSurface", "GroundSurface")})
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at))
      text.replace(at, std::string(from).size(), to);
  const TestFolder folder;
  Errors warnings;
  std::optional<glm::dvec2> place_deg;
  ASSERT_TRUE(read_city_gml(folder.write("delft.gml", text), warnings, {}, &place_deg));
  ASSERT_TRUE(place_deg);
  EXPECT_NEAR(place_deg->x, 4.36, 1e-3);
  EXPECT_NE(to_string(warnings).find("by its roofs"), std::string::npos) << to_string(warnings);
}

TEST(CityGml, SeveralSystemsInOneFileAreNamed) {
  std::string text = wall();
  const auto named = [&](const char* ring, const char* system) {
    const std::string tag = ring;
    text.insert(text.find(tag) + tag.size(), fmt::format(" srsName=\"{}\"", system));
  };
  named("gml:id=\"r\"", "EPSG:28992");
  named("gml:id=\"h\"", "EPSG:25831");
  const TestFolder folder;
  Errors warnings;
  ASSERT_TRUE(read_city_gml(folder.write("a.gml", text), warnings));
  EXPECT_NE(to_string(warnings).find("several coordinate systems, \"EPSG:28992\" and \"EPSG:25831\""),
            std::string::npos)
      << to_string(warnings);
}

TEST(CityGml, PicturesThatLieByTheirCoordinatesAreNamed) {
  std::string text = wall();
  const std::string member = "<cityObjectMember>";
  text.insert(text.find(member),
              R"(<app:appearanceMember xmlns:app="http://www.opengis.net/citygml/appearance/2.0">
<app:Appearance><app:theme>air</app:theme><app:surfaceDataMember><app:GeoreferencedTexture gml:id="g">
<app:imageURI>aerial.jpg</app:imageURI><app:target>#p</app:target></app:GeoreferencedTexture>
</app:surfaceDataMember></app:Appearance></app:appearanceMember>)");
  const TestFolder folder;
  Errors warnings;
  const Result<Model> city = read_city_gml(folder.write("a.gml", text), warnings);
  ASSERT_TRUE(city) << to_string(city.errors());
  EXPECT_NEAR(area_m2(*city, "WallSurface"), 11.0, 1e-3);
  EXPECT_NE(to_string(warnings).find("a.gml: pictures that lie on it by their coordinates are left "
                                     "out (1 GeoreferencedTexture: aerial.jpg)"),
            std::string::npos)
      << to_string(warnings);
}

/// A level surface of 4 x 3 m with a hole, on which a picture lies by its coordinates.
std::string draped(const std::string& target, const std::string& elements) {
  std::string text = wall();
  const auto replace = [&](const std::string& old, const std::string& by) {
    text.replace(text.find(old), old.size(), by);
  };
  replace("0 80004 450000 0 80004 450000 3 80000 450000 3 80000 450000 0",
          "0 80004 450000 0 80004 450003 0 80000 450003 0 80000 450000 0");
  replace("80001 450000 1 80001 450000 2 80002 450000 2 80002 450000 1 80001 450000 1",
          "80001 450001 0 80001 450002 0 80002 450002 0 80002 450001 0 80001 450001 0");
  replace("<gml:MultiSurface>", "<gml:MultiSurface gml:id=\"all\">");
  text.insert(text.find("<cityObjectMember>"),
              fmt::format(R"(<app:appearanceMember xmlns:app="http://www.opengis.net/citygml/appearance/2.0">
<app:Appearance><app:theme>air</app:theme><app:surfaceDataMember><app:GeoreferencedTexture gml:id="g">
<app:imageURI>aerial.png</app:imageURI>{}<app:target>#{}</app:target></app:GeoreferencedTexture>
</app:surfaceDataMember></app:Appearance></app:appearanceMember>)",
                          elements, target));
  return text;
}

TEST(CityGml, APictureLiesWhereItsWorldFileOrItsElementsSay) {
  // Elements take precedence over the world file, preferWorldFile or not.
  const auto in_elements = [](const char* point, const char* orientation) {
    return fmt::format(
        "<app:preferWorldFile>true</app:preferWorldFile><app:referencePoint><gml:Point><gml:pos>{}"
        "</gml:pos></gml:Point></app:referencePoint><app:orientation>{}</app:orientation>",
        point, orientation);
  };
  for (const auto& [target, elements] :
       {std::pair<std::string, std::string>{"p", ""},
        {"all", ""},
        {"p", in_elements("80000 450000", "0.25 0 0 0.333333333")},
        {"p", in_elements("80000.25 450002.75", "0.5 0 0 -0.5")}}) {  // as in a world file
    const TestFolder folder;
    ASSERT_TRUE(write_image(folder.path() / "aerial.png", Image8(8, 6, 3)));
    // Half a metre to a pixel, from the middle of the first one in the north-west.
    folder.write("aerial.pgw",
                 elements.empty() ? "+0.5\n0\n0\n-0.5\n80000.25\n450002.75\n" : "1\n0\n0\n-1\n0\n0\n");
    Errors warnings;
    const Result<Model> city = read_city_gml(folder.write("a.gml", draped(target, elements)), warnings);
    ASSERT_TRUE(city) << to_string(city.errors());
    EXPECT_TRUE(warnings.empty()) << to_string(warnings);
    std::size_t corners = 0;
    for (const Part& part : city->parts) {
      EXPECT_NE(city->materials[std::size_t(part.material)].base_colour_texture, no_index) << target;
      ASSERT_EQ(part.mesh.uvs.size(), part.mesh.positions.size());
      for (std::size_t i = 0; i < part.mesh.uvs.size(); ++i, ++corners) {
        const glm::dvec3 in_file = glm::dvec3(part.mesh.positions[i]) + city->origin;
        EXPECT_NEAR(part.mesh.uvs[i].x, (in_file.x - 80000.0) / 4.0, 1e-3) << target;
        EXPECT_NEAR(part.mesh.uvs[i].y, (450003.0 - in_file.y) / 3.0, 1e-3) << target;
      }
    }
    EXPECT_GE(corners, 8u);
  }
}

TEST(CityGml, APictureThatLiesBesideWhatItCoversIsReported) {
  const TestFolder folder;
  ASSERT_TRUE(write_image(folder.path() / "aerial.png", Image8(8, 6, 3)));
  folder.write("aerial.pgw", "0.5\n0\n0\n-0.5\n80000.25\n449999.75\n");  // south of it, to the centimetre
  Errors warnings;
  ASSERT_TRUE(read_city_gml(folder.write("a.gml", draped("p", "")), warnings));
  EXPECT_NE(
      to_string(warnings).find("a.gml: 1 of 1 polygons that a picture covers by its coordinates lie wholly "
                               "beside it (GeoreferencedTexture: aerial.png)"),
      std::string::npos)
      << to_string(warnings);
  folder.write("aerial.pgw", "0.5\n0\n0\n-0.5\n80003.25\n450000.75\n");  // an eighth of it is covered
  warnings.clear();
  ASSERT_TRUE(read_city_gml(folder.write("a.gml", draped("p", "")), warnings));
  EXPECT_TRUE(warnings.empty()) << to_string(warnings);
}

TEST(CityGml, APictureWithoutAPlaceCoversNothing) {
  const TestFolder folder;
  ASSERT_TRUE(write_image(folder.path() / "aerial.png", Image8(8, 6, 3)));
  folder.write("aerial.pgw", "0.5\n0\n0\n0\n80000.25\n450002.75\n");  // all rows in one
  Errors warnings;
  const Result<Model> city = read_city_gml(folder.write("a.gml", draped("p", "")), warnings);
  ASSERT_TRUE(city) << to_string(city.errors());
  EXPECT_NE(to_string(warnings).find("left out (1 GeoreferencedTexture: aerial.png)"), std::string::npos)
      << to_string(warnings);
  for (const Part& part : city->parts)
    EXPECT_EQ(city->materials[std::size_t(part.material)].base_colour_texture, no_index);
}

TEST(CityGml, HostileXmlIsRefusedByItsLine) {
  std::string entity = wall();
  entity.insert(entity.find('\n') + 1, "<!DOCTYPE a [<!ENTITY b SYSTEM \"file:///etc/passwd\">]>\n");
  expect_refused(entity, "DOCTYPE", 2);
  expect_refused("<a>\n<b>\n</a>", "well-formed", 3);
  expect_refused("", "well-formed", 1);
  expect_refused("<a/>", "no CityGML", 0);
  std::string deep;
  for (int i = 0; i < 600; ++i) deep += "<a>\n";
  expect_refused(deep, "deep", 501);
  std::string empty = wall();
  empty.erase(empty.find("<cityObjectMember>"),
              empty.rfind("</CityModel>") - empty.find("<cityObjectMember>"));
  expect_refused(empty, "has polygons", 0);
}

TEST(CityGml, CornersFarBeyondTheEarthGiveNoInfinitePlaces) {
  for (const char* far : {"4e38", "1e86", "1e300", "1e400", "nan"}) {
    std::string text = wall();
    text.replace(text.find("80004"), 5, far);
    const Result<Model> model = read_gml(text);
    if (!model) continue;
    for (const Part& part : model->parts)
      for (const glm::vec3& corner : part.mesh.positions)
        EXPECT_TRUE(std::isfinite(corner.x) && std::isfinite(corner.y) && std::isfinite(corner.z)) << far;
  }
}

TEST(CityGml, DamagedBytesNeverCrash) {
  Random random(5);
  for (int round = 0; round < 200; ++round) {
    std::string text = wall();
    for (int change = 0; change <= round % 4; ++change)
      text[std::size_t(random.index(int(text.size())))] = "0123456789<>/\" -e.x"[random.index(19)];
    static_cast<void>(read_gml(text));
  }
}

TEST(CityGml, ReadsATexturedBuilding) {
  const auto file = shared_data("cities/citygml/lod3_building_v2.gml");
  if (!file) GTEST_SKIP() << "skipped: shared data absent";
  Errors warnings;
  const Result<Model> city = read_city_gml(*file, warnings);
  ASSERT_TRUE(city) << to_string(city.errors());
  EXPECT_GT(area_m2(*city, "WallSurface dwelling"), 100.0) << "its function is 1070";
  EXPECT_GT(area_m2(*city, "RoofSurface"), 50.0);
  EXPECT_GT(area_m2(*city, "Window"), 1.0);
  EXPECT_TRUE(warnings.empty()) << to_string(warnings);
  const auto pictured = std::count_if(city->parts.begin(), city->parts.end(), [&](const Part& part) {
    return city->materials[std::size_t(part.material)].base_colour_texture != no_index;
  });
  EXPECT_GT(pictured, 4);
}

}  // namespace
}  // namespace parvis::scene

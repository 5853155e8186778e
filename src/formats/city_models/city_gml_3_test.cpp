#include "formats/city_models/city_gml_3.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "base/random.h"
#include "base/test_data.h"
#include "base/test_folder.h"
#include "formats/city_models/city_gml.h"
#include "formats/city_models/city_json.h"
#include "scene/data/test_scene.h"

namespace parvis::scene {
namespace {

/// A city of these members.
std::string city(const std::string& members) {
  return R"(<?xml version="1.0" encoding="UTF-8"?>
<CityModel xmlns="http://www.opengis.net/citygml/3.0" xmlns:con="http://www.opengis.net/citygml/construction/3.0"
  xmlns:bldg="http://www.opengis.net/citygml/building/3.0" xmlns:gml="http://www.opengis.net/gml/3.2"
  xmlns:tran="http://www.opengis.net/citygml/transportation/3.0" xmlns:dem="http://www.opengis.net/citygml/relief/3.0"
  xmlns:wtr="http://www.opengis.net/citygml/waterbody/3.0" xmlns:veg="http://www.opengis.net/citygml/vegetation/3.0"
  xmlns:luse="http://www.opengis.net/citygml/landuse/3.0" xmlns:gen="http://www.opengis.net/citygml/generics/3.0"
  xmlns:app="http://www.opengis.net/citygml/appearance/3.0" xmlns:ver="http://www.opengis.net/citygml/versioning/3.0"
  xmlns:ade="http://example.org/ade" xmlns:xlink="http://www.w3.org/1999/xlink">
)" + members +
         "</CityModel>";
}

std::string member(const std::string& object) {
  return "<cityObjectMember>" + object + "</cityObjectMember>\n";
}

/// A geometry of one polygon, `id` being its own and its ring's.
std::string surface(const std::string& corners, const std::string& id = "p", const std::string& lod = "2") {
  return fmt::format(
      R"(<lod{0}MultiSurface><gml:MultiSurface><gml:surfaceMember><gml:Polygon gml:id="{2}"><gml:exterior>
<gml:LinearRing gml:id="{2}ring"><gml:posList srsDimension="3">{1}</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon>
</gml:surfaceMember></gml:MultiSurface></lod{0}MultiSurface>)",
      lod, corners, id);
}

/// One surface that bounds an object.
std::string boundary(const std::string& kind, const std::string& corners, const std::string& id,
                     const std::string& inside = "") {
  return fmt::format("<boundary><{0}>{1}{2}</{0}></boundary>\n", kind, surface(corners, id), inside);
}

const std::string floor_corners = "0 0 0 4 0 0 4 3 0 0 3 0 0 0 0",
                  wall_corners = "0 0 0 4 0 0 4 0 3 0 0 3 0 0 0",
                  ceiling_corners = "0 0 3 0 3 3 4 3 3 4 0 3 0 0 3";

struct ReadCity {
  Result<Model> model;
  std::string warnings;
};

ReadCity read_gml_3(const std::string& text) {
  const TestFolder folder;
  Errors warnings;
  Result<Model> model = read_city_gml(folder.write("city.gml", text), warnings);
  return {std::move(model), to_string(warnings)};
}

TEST(CityGml3, WallsHaveWindowsAndDoorsAndTheKindOfTheirBuilding) {
  const std::string window = "<con:fillingSurface><con:WindowSurface>" +
                             surface("1 0 1 2 0 1 2 0 2 1 0 2 1 0 1", "w") +
                             "</con:WindowSurface></con:fillingSurface>",
                    door = "<con:fillingSurface><con:DoorSurface>" +
                           surface("3 0 0 3.8 0 0 3.8 0 2 3 0 2 3 0 0", "d") +
                           "</con:DoorSurface></con:fillingSurface>";
  const ReadCity town = read_gml_3(city(member(
      "<bldg:Building gml:id=\"house\">" + boundary("con:WallSurface", wall_corners, "p1", window + door) +
      boundary("con:RoofSurface", "0 0 3 4 0 3 4 3 3 0 3 3 0 0 3", "p2") +
      boundary("con:GroundSurface", "0 0 0 0 3 0 4 3 0 4 0 0 0 0 0", "p3") +
      "<con:dateOfConstruction>1931-05-01</con:dateOfConstruction>"
      "<con:height><con:Height><con:value uom=\"m\">3</con:value></con:Height></con:height>"
      "<bldg:function>31001_2020</bldg:function><bldg:storeysAboveGround>3</bldg:storeysAboveGround>"
      "</bldg:Building>")));
  ASSERT_TRUE(town.model) << to_string(town.model.errors());
  EXPECT_NEAR(area_m2(*town.model, "WallSurface office 1919-1945 3-storeys"), 12.0, 1e-3);
  EXPECT_NEAR(area_m2(*town.model, "Window"), 1.0, 1e-3);
  EXPECT_NEAR(area_m2(*town.model, "Door"), 1.6, 1e-3);
  EXPECT_NEAR(area_m2(*town.model, "RoofSurface"), 12.0, 1e-3);
  EXPECT_NEAR(area_m2(*town.model, "GroundSurface"), 12.0, 1e-3);
  EXPECT_EQ(town.warnings, "");
}

TEST(CityGml3, RoomsKeepTheirSurfacesAndFurnitureAlsoInStoreys) {
  const std::string room = "<bldg:BuildingRoom>" + boundary("con:CeilingSurface", ceiling_corners, "c") +
                           boundary("con:FloorSurface", floor_corners, "f") +
                           boundary("con:InteriorWallSurface", wall_corners, "i") +
                           "<bldg:buildingFurniture><bldg:BuildingFurniture>" +
                           surface("1 1 0.8 2 1 0.8 2 2 0.8 1 2 0.8 1 1 0.8", "t", "3") +
                           "</bldg:BuildingFurniture></bldg:buildingFurniture></bldg:BuildingRoom>";
  for (const bool is_in_storey : {false, true}) {
    const std::string rooms = "<bldg:buildingRoom>" + room + "</bldg:buildingRoom>";
    const ReadCity town = read_gml_3(
        city(member("<bldg:Building>" +
                    (is_in_storey ? "<bldg:buildingSubdivision><bldg:Storey><bldg:class>x</bldg:class>" +
                                        rooms + "</bldg:Storey></bldg:buildingSubdivision>"
                                  : rooms) +
                    "</bldg:Building>")));
    ASSERT_TRUE(town.model) << to_string(town.model.errors());
    EXPECT_NEAR(area_m2(*town.model, "CeilingSurface"), 12.0, 1e-3) << is_in_storey;
    EXPECT_NEAR(area_m2(*town.model, "FloorSurface"), 12.0, 1e-3) << is_in_storey;
    EXPECT_NEAR(area_m2(*town.model, "InteriorWallSurface"), 12.0, 1e-3) << is_in_storey;
    EXPECT_NEAR(area_m2(*town.model, "BuildingFurniture"), 1.0, 1e-3) << is_in_storey;
  }
}

TEST(CityGml3, RoomsThatAStoreyRefersToAreReadOnce) {
  const ReadCity town =
      read_gml_3(city(member("<bldg:Building><bldg:buildingSubdivision><bldg:Storey><bldg:buildingRoom "
                             "xlink:href=\"#r\"/></bldg:Storey>"
                             "</bldg:buildingSubdivision><boundary "
                             "xlink:href=\"#f\"/><bldg:buildingRoom><bldg:BuildingRoom gml:id=\"r\">" +
                             boundary("con:FloorSurface", floor_corners, "f") +
                             "</bldg:BuildingRoom></bldg:buildingRoom></bldg:Building>")));
  ASSERT_TRUE(town.model) << to_string(town.model.errors());
  EXPECT_NEAR(area_m2(*town.model, "FloorSurface"), 12.0, 1e-3);
}

TEST(CityGml3, TheHighestLevelOfDetailCounts) {
  const ReadCity town =
      read_gml_3(city(member("<bldg:Building>" + surface("0 0 3 4 0 3 4 3 3 0 3 3 0 0 3", "a", "0") +
                             surface("0 0 3 9 0 3 9 3 3 0 3 3 0 0 3", "b", "3") + "</bldg:Building>")));
  ASSERT_TRUE(town.model) << to_string(town.model.errors());
  EXPECT_NEAR(area_m2(*town.model, "RoofSurface"), 27.0, 1e-3);
}

TEST(CityGml3, ReadsWhatElseACityHas) {
  const ReadCity town = read_gml_3(city(
      member("<luse:LandUse>" + surface(floor_corners, "l") + "</luse:LandUse>") +
      member("<wtr:WaterBody>" + boundary("wtr:WaterSurface", "0 9 0 4 9 0 4 14 0 0 14 0 0 9 0", "w") +
             "</wtr:WaterBody>") +
      member("<veg:PlantCover>" + surface("9 0 0 10 0 0 10 1 0 9 1 0 9 0 0", "v") + "</veg:PlantCover>") +
      member("<tran:Road><tran:section><tran:Section><tran:trafficSpace><tran:TrafficSpace>" +
             surface("0 20 4 9 20 4 9 29 4 0 29 4 0 20 4", "space") +
             boundary("tran:TrafficArea", "0 20 0 5 20 0 5 24 0 0 24 0 0 20 0", "r") +
             "</tran:TrafficSpace></tran:trafficSpace></tran:Section></tran:section></tran:Road>") +
      member(
          "<dem:ReliefFeature><dem:lod>1</dem:lod><dem:reliefComponent><dem:TINRelief><dem:lod>1</"
          "dem:lod><dem:tin>"
          "<gml:TriangulatedSurface><gml:patches><gml:Triangle><gml:exterior><gml:LinearRing>"
          "<gml:posList>0 0 0 4 0 0 4 3 0 0 0 0</gml:posList></gml:LinearRing></gml:exterior></gml:Triangle>"
          "</gml:patches></gml:TriangulatedSurface></dem:tin></dem:TINRelief></dem:reliefComponent>"
          "</dem:ReliefFeature>")));
  ASSERT_TRUE(town.model) << to_string(town.model.errors());
  EXPECT_NEAR(area_m2(*town.model, "LandUse"), 12.0, 1e-3);
  EXPECT_NEAR(area_m2(*town.model, "WaterSurface") + area_m2(*town.model, "WaterBody"), 20.0, 1e-3);
  EXPECT_NEAR(area_m2(*town.model, "PlantCover"), 1.0, 1e-3);
  EXPECT_NEAR(area_m2(*town.model, "Road"), 20.0, 1e-3) << "without the space that vehicles take";
  EXPECT_NEAR(area_m2(*town.model, "TINRelief"), 6.0, 1e-3);
}

TEST(CityGml3, ReadsGenericAttributesAndTextureCoordinates) {
  const FileLocation where{"city.gml", 0, 0};
  const Result<std::string> in_2 = city_gml_2_of(
      city("<appearanceMember><app:Appearance><app:theme>t</"
           "app:theme><app:surfaceData><app:ParameterizedTexture>"
           "<app:imageURI>a&amp;b.jpg</app:imageURI><app:textureParameterization><app:TextureAssociation>"
           "<app:target>#p</app:target><app:textureParameterization><app:TexCoordList>"
           "<app:textureCoordinates>0 0 1 0 1 1 0 0</app:textureCoordinates><app:ring>#pring</app:ring>"
           "</app:TexCoordList></app:textureParameterization></app:TextureAssociation></"
           "app:textureParameterization>"
           "</app:ParameterizedTexture></app:surfaceData></app:Appearance></appearanceMember>" +
           member("<bldg:Building><genericAttribute><gen:IntAttribute><gen:name>floors \"x\"</gen:name>"
                  "<gen:value>4</gen:value></gen:IntAttribute></genericAttribute></bldg:Building>")),
      where);
  ASSERT_TRUE(in_2) << to_string(in_2.errors());
  for (const char* expected :
       {"<gen:intAttribute name=\"floors &quot;x&quot;\"><gen:value>4</gen:value></gen:intAttribute>",
        "<app:imageURI>a&amp;b.jpg</app:imageURI>",
        "<app:target uri=\"#p\"><app:TexCoordList><app:textureCoordinates ring=\"#pring\">0 0 1 0 1 1 0 0"
        "</app:textureCoordinates></app:TexCoordList></app:target>"})
    EXPECT_NE(in_2->find(expected), std::string::npos) << expected << "\n" << *in_2;
}

TEST(CityGml3, WhatVersion2DoesNotKnowIsLeftOut) {
  const ReadCity town =
      read_gml_3(city(member("<ver:Version><ver:tag>1</ver:tag></ver:Version>") +
                      member("<bldg:Building><ade:energy><ade:Zone>" + surface(floor_corners, "z") +
                             "</ade:Zone></ade:energy>" + boundary("con:WallSurface", wall_corners, "p1") +
                             "</bldg:Building>")));
  ASSERT_TRUE(town.model) << to_string(town.model.errors());
  EXPECT_NEAR(area_m2(*town.model, "WallSurface"), 12.0, 1e-3);
  EXPECT_EQ(town.model->parts.size(), 1u);
}

TEST(CityGml3, HostileFilesAreRefused) {
  const auto expect_refused = [](const std::string& text, const std::string& reason, int line) {
    const ReadCity town = read_gml_3(text);
    ASSERT_FALSE(town.model) << reason;
    EXPECT_NE(to_string(town.model.errors()).find(reason), std::string::npos)
        << to_string(town.model.errors());
    EXPECT_EQ(town.model.errors().front().where.line, line);
  };
  std::string entity = city(member("<bldg:Building/>"));
  entity.insert(entity.find('\n') + 1, "<!DOCTYPE a [<!ENTITY b SYSTEM \"file:///etc/passwd\">]>\n");
  expect_refused(entity, "DOCTYPE", 2);
  expect_refused(city("\n<nobody:knows/>"), "namespaces", 10);
  expect_refused(city(member("<bldg:Building/>")), "has polygons", 0);
  expect_refused(R"(<a xmlns="http://www.opengis.net/citygml/3.0"/>)", "no CityGML", 0);
}

TEST(CityGml3, DamagedBytesNeverCrash) {
  const std::string whole = city(member(
      "<bldg:Building>" + boundary("con:WallSurface", wall_corners, "p1") +
      "<genericAttribute><gen:IntAttribute><gen:name>a</gen:name><gen:value>4</gen:value></gen:IntAttribute>"
      "</genericAttribute></bldg:Building>"));
  Random random(6);
  for (int round = 0; round < 200; ++round) {
    std::string text = whole;
    for (int change = 0; change <= round % 4; ++change)
      text[std::size_t(random.index(int(text.size())))] = "0123456789<>/\" -e.x"[random.index(19)];
    static_cast<void>(read_gml_3(text));
  }
}

TEST(CityGml3, ATownIsWhatCityJsonMakesIt) {
  const auto in_3 = shared_data("cities/citygml/lod2_buildings_v3.gml"),
             json = shared_data("cities/citygml/lod2_buildings_v2.json");
  if (!in_3 || !json) GTEST_SKIP() << "skipped: shared data absent";
  Errors warnings;
  const Result<Model> gml_town = read_city_gml(*in_3, warnings), json_town = read_city_model(*json, warnings);
  ASSERT_TRUE(gml_town && json_town) << to_string(gml_town ? json_town.errors() : gml_town.errors());
  std::map<std::string, double> areas;
  for (const Part& part : json_town->parts) areas[part.object] = area_m2(*json_town, part.object);
  EXPECT_GT(areas.size(), 10u) << "walls of several kinds of buildings";
  for (const auto& [name, area] : areas) EXPECT_NEAR(area_m2(*gml_town, name), area, 1e-3 * area) << name;
}

}  // namespace
}  // namespace parvis::scene

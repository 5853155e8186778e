#include "formats/city_models/gml_geometry.h"

#include <gtest/gtest.h>

#include "base/test_folder.h"
#include "formats/city_models/city_gml.h"

namespace parvis::scene {
namespace {

std::string polygon_of(const std::string& id, const std::string& ring) {
  return R"(<gml:Polygon gml:id=")" + id + R"("><gml:exterior><gml:LinearRing>)" + ring +
         "</gml:LinearRing></gml:exterior></gml:Polygon>";
}

std::string member_of(const std::string& surface) {
  return "<gml:surfaceMember>" + surface + "</gml:surfaceMember>";
}

std::string oriented(const std::string& orientation, const std::string& base) {
  return R"(<gml:OrientableSurface orientation=")" + orientation + "\">" + base + "</gml:OrientableSurface>";
}

/// A town of one building whose surfaces these are, and its model.
Model model_of(const std::string& members, const std::string& attributes = "") {
  const TestFolder folder;
  Errors warnings;
  const auto file = folder.write(
      "town.gml",
      R"(<?xml version="1.0"?><core:CityModel xmlns:core="http://www.opengis.net/citygml/2.0" xmlns:gml="http://www.opengis.net/gml" xmlns:xlink="http://www.w3.org/1999/xlink" xmlns:bldg="http://www.opengis.net/citygml/building/2.0"><core:cityObjectMember><bldg:Building gml:id="b"><bldg:lod1Solid><gml:Solid><gml:exterior><gml:CompositeSurface)" +
          attributes + ">" + members +
          "</gml:CompositeSurface></gml:exterior></gml:Solid></bldg:lod1Solid></bldg:Building></"
          "core:cityObjectMember></core:CityModel>");
  Result<Model> model = read_city_gml(file, warnings);
  EXPECT_TRUE(model) << to_string(model.errors());
  return model ? *std::move(model) : Model();
}

/// Sum of the areas of all triangles as vectors.
glm::vec3 area_of(const Model& model) {
  glm::vec3 sum(0.0f);
  for (const Part& part : model.parts)
    for (std::size_t i = 0; i + 2 < part.mesh.indices.size(); i += 3) {
      const auto at = [&](std::size_t k) { return part.mesh.positions[part.mesh.indices[i + k]]; };
      sum += 0.5f * glm::cross(at(1) - at(0), at(2) - at(0));
    }
  return sum;
}

const std::string square = "<gml:posList>0 0 3 8 0 3 8 8 3 0 8 3 0 0 3</gml:posList>";

TEST(GmlGeometry, CoordinatesAndPointsAreRings) {
  const std::string wall =
      member_of(polygon_of("w", "<gml:posList>0 0 0 8 0 0 8 0 3 0 0 3 0 0 0</gml:posList>"));
  for (const char* ring :
       {"<gml:coordinates>0,0,3 8,0,3 8,8,3 0,8,3 0,0,3</gml:coordinates>",
        "<gml:coordinates decimal=\",\" cs=\" \" ts=\";\">0 0 3,0;8,0 0 3;8 8 3;0 8 3;0 0 "
        "3;\n</gml:coordinates>",
        "<gml:pointProperty><gml:Point><gml:pos>0 0 3</gml:pos></gml:Point></gml:pointProperty>"
        "<gml:pointProperty><gml:Point><gml:pos>8 0 3</gml:pos></gml:Point></gml:pointProperty>"
        "<gml:pointProperty><gml:Point><gml:pos>8 8 3</gml:pos></gml:Point></gml:pointProperty>"
        "<gml:pointProperty><gml:Point><gml:pos>0 8 3</gml:pos></gml:Point></gml:pointProperty>"
        "<gml:pointProperty><gml:Point><gml:pos>0 0 3</gml:pos></gml:Point></gml:pointProperty>"})
    EXPECT_NEAR(area_of(model_of(wall + member_of(polygon_of("p", ring)))).z, 64.0f, 1e-3f) << ring;
}

TEST(GmlGeometry, TwoDimensionsLieAtHeightZero) {
  const std::string flat = "0 0 8 0 8 8 0 8 0 0";
  EXPECT_NEAR(area_of(model_of(member_of(
                          polygon_of("p", "<gml:posList srsDimension=\"2\">" + flat + "</gml:posList>"))))
                  .z,
              64.0f, 1e-3f);
  EXPECT_NEAR(area_of(model_of(member_of(polygon_of("p", "<gml:posList>" + flat + "</gml:posList>")),
                               " srsDimension=\"2\""))
                  .z,
              64.0f, 1e-3f);
}

TEST(GmlGeometry, OrientableSurfacesFaceTheirOwnWay) {
  const std::string base = "<gml:baseSurface>" + polygon_of("p", square) + "</gml:baseSurface>";
  EXPECT_NEAR(area_of(model_of(member_of(oriented("+", base)))).z, 64.0f, 1e-3f);
  EXPECT_NEAR(area_of(model_of(member_of(oriented("-", base)))).z, -64.0f, 1e-3f);
  EXPECT_NEAR(area_of(model_of(member_of(
                          oriented("-", "<gml:baseSurface>" + oriented("-", base) + "</gml:baseSurface>"))))
                  .z,
              64.0f, 1e-3f);
  const std::string both =
      plain_gml_geometry("<g xmlns:gml='g' xmlns:xlink='x'>" + member_of(polygon_of("p", square)) +
                         member_of(oriented("-", "<gml:baseSurface xlink:href=\"#p\"/>")) + "</g>");
  EXPECT_NE(both.find("<gml:posList>0 0 3 0 8 3 8 8 3 8 0 3 0 0 3 </gml:posList>"), std::string::npos)
      << both;
  EXPECT_EQ(both.find("gml:id=\"p\""), both.rfind("gml:id=\"p\"")) << "the copy has no id\n" << both;
}

TEST(GmlGeometry, PolygonsAreCountedBeforeAndAfterTheLibrary) {
  const TestFolder folder;
  Errors warnings;
  FileAccount account("CityGML");
  const auto file = folder.write(
      "town.gml",
      R"(<core:CityModel xmlns:core="http://www.opengis.net/citygml/2.0" xmlns:gml="http://www.opengis.net/gml" xmlns:bldg="http://www.opengis.net/citygml/building/2.0"><core:cityObjectMember><bldg:Building gml:id="b"><bldg:lod1MultiSurface><gml:MultiSurface>)" +
          member_of(polygon_of("p", square)) +
          R"(</gml:MultiSurface></bldg:lod1MultiSurface></bldg:Building></core:cityObjectMember></core:CityModel>)");
  ASSERT_TRUE(read_city_gml(file, warnings, {}, nullptr, {}, &account));
  EXPECT_EQ(account.count(Fate::used, "polygons"), 1u) << account.text();
  EXPECT_EQ(account.count(Fate::left_out, "polygons"), 0u) << account.text();
}

TEST(GmlGeometry, OtherFilesAndDamagedOnesComeBackAsTheyAre) {
  for (const std::string& text :
       {std::string("<a><gml:posList>1 2 3</gml:posList></a>"), std::string("<a><gml:coordinates>"),
        std::string("<OrientableSurface"), std::string()})
    EXPECT_EQ(plain_gml_geometry(text), text);
  const std::string around = plain_gml_geometry(
      "<a xmlns:gml='g'><gml:OrientableSurface gml:id=\"o\" orientation=\"-\"><gml:baseSurface "
      "xlink:href=\"#o\"/>"
      "</gml:OrientableSurface></a>");
  EXPECT_LT(around.size(), 2000u) << "a surface that refers to itself ends";
}

}  // namespace
}  // namespace parvis::scene

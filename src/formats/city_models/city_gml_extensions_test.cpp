#include "formats/city_models/city_gml_extensions.h"

#include <gtest/gtest.h>

#include "base/test_folder.h"
#include "formats/city_models/city_gml.h"

namespace parvis::scene {
namespace {

std::string extended_roof(const std::string& id, int z) {
  return fmt::format(
      "<gml:MultiSurface><gml:surfaceMember><gml:Polygon gml:id=\"{0}\"><gml:exterior><gml:LinearRing "
      "gml:id=\"{0}r\"><gml:posList>0 0 {1} 9 0 {1} 9 9 {1} 0 9 {1} 0 0 {1}</gml:posList></gml:LinearRing>"
      "</gml:exterior></gml:Polygon></gml:surfaceMember></gml:MultiSurface>",
      id, z);
}

/// A city of one building, in which `in_building` stands, and further members.
std::string extended_city(const std::string& in_building, const std::string& members) {
  return "<?xml version=\"1.0\"?>\n<core:CityModel xmlns:core=\"http://www.opengis.net/citygml/2.0\" "
         "xmlns:bldg=\"http://www.opengis.net/citygml/building/2.0\" "
         "xmlns:gml=\"http://www.opengis.net/gml\" "
         "xmlns:xlink=\"http://www.w3.org/1999/xlink\" xmlns:lift=\"https://example.org/lifts/1.0\">\n"
         "<core:cityObjectMember><bldg:Building gml:id=\"house\"><bldg:lod1MultiSurface>" +
         extended_roof("p", 9) + "</bldg:lod1MultiSurface>" + in_building +
         "</bldg:Building></core:cityObjectMember>" + members + "</core:CityModel>\n";
}

struct ExtendedCity {
  Result<Model> model;
  FileAccount account;
};

ExtendedCity read_extended(const std::string& text) {
  const TestFolder folder;
  Errors warnings;
  FileAccount account("CityGML");
  Result<Model> model = read_city_gml(folder.write("town.gml", text), warnings, {}, nullptr, "", &account);
  return {std::move(model), std::move(account)};
}

/// The height of the highest corner, or -1 where it is not read.
double highest_corner_m(const ExtendedCity& read) {
  return read.model ? double(bounds(*read.model).max.z) : -1.0;
}

TEST(CityGmlExtensions, ACityObjectOfAnotherSchemaIsShownByItsGeometry) {
  const ExtendedCity read = read_extended(extended_city(
      "",
      "<core:cityObjectMember><lift:Lift gml:id=\"l\" lift:kind=\"a > b\"><lift:load>800</lift:load>"
      "<bldg:lod1MultiSurface>" +
          extended_roof("q", 30) + "</bldg:lod1MultiSurface></lift:Lift></core:cityObjectMember>"));
  ASSERT_TRUE(read.model) << to_string(read.model.errors());
  EXPECT_EQ(read.model->triangle_count(), 4u);
  EXPECT_NEAR(highest_corner_m(read), 30.0, 1e-4);
  EXPECT_EQ(read.account.count(Fate::changed, "city objects"), 1u);
  EXPECT_EQ(read.account.count(Fate::left_out, "elements of extensions"), 1u);
  EXPECT_NE(read.account.text().find("Lift"), std::string::npos) << read.account.text();
}

TEST(CityGmlExtensions, ElementsOfAnotherSchemaAreNamedWithTheirPolygons) {
  const ExtendedCity read = read_extended(
      extended_city("<lift:shaft><lift:Shaft>" + extended_roof("q", 30) + extended_roof("s", 31) +
                        "</lift:Shaft></lift:shaft><lift:count>2</lift:count>",
                    ""));
  ASSERT_TRUE(read.model) << to_string(read.model.errors());
  EXPECT_EQ(read.model->triangle_count(), 2u);
  EXPECT_NEAR(highest_corner_m(read), 9.0, 1e-4);
  EXPECT_EQ(read.account.count(Fate::left_out, "elements of extensions"), 2u);
  EXPECT_EQ(read.account.count(Fate::left_out, "polygons of extensions"), 2u);
}

TEST(CityGmlExtensions, PropertiesThatHoldNothingElseGoWithThem) {
  for (const char* members :
       {"<core:cityObjectMember><lift:Lift/></core:cityObjectMember>",
        "<core:cityObjectMember xlink:href=\"#house\"/>", "<core:cityObjectMember></core:cityObjectMember>",
        "<lift:member><lift:Lift gml:id=\"l\"/></lift:member>"}) {
    const ExtendedCity read =
        read_extended(extended_city("<bldg:boundedBy><lift:Door/></bldg:boundedBy>", members));
    ASSERT_TRUE(read.model) << members << '\n' << to_string(read.model.errors());
    EXPECT_EQ(read.model->triangle_count(), 2u) << members;
  }
}

TEST(CityGmlExtensions, ACityOfExtensionsIsReadInVersion3) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<core:CityModel xmlns:core=\"http://www.opengis.net/citygml/3.0\" "
      "xmlns:con=\"http://www.opengis.net/citygml/construction/3.0\" "
      "xmlns:gml=\"http://www.opengis.net/gml/3.2\" xmlns:lift=\"https://example.org/lifts/1.0\">"
      "<core:cityObjectMember><lift:Lift gml:id=\"l\"><core:lod2MultiSurface>" +
      extended_roof("q", 12) +
      "</core:lod2MultiSurface></lift:Lift></core:cityObjectMember></core:CityModel>";
  const ExtendedCity read = read_extended(text);
  ASSERT_TRUE(read.model) << to_string(read.model.errors());
  EXPECT_NEAR(highest_corner_m(read), 12.0, 1e-4);
  EXPECT_EQ(read.account.count(Fate::changed, "city objects"), 1u);
}

TEST(CityGmlExtensions, AFileWithoutThemComesBackAsItIs) {
  FileAccount account("CityGML");
  const std::string text = extended_city("", "");
  std::string plain = text;
  plain.erase(plain.find(" xmlns:lift"), std::string(" xmlns:lift=\"https://example.org/lifts/1.0\"").size());
  EXPECT_EQ(without_gml_extensions(plain, account), plain);
  EXPECT_EQ(without_gml_extensions(text, account), text) << "what is declared need not be used";
  EXPECT_TRUE(account.lines().empty());
}

}  // namespace
}  // namespace parvis::scene

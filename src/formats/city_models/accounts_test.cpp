// Accounts as they come through the registry of readers, from the child processes that read.
#include <gtest/gtest.h>

#include "base/registries.h"
#include "base/test_folder.h"
#include "formats/readers/readers.h"
#include "room_list.h"

namespace parvis::city_models {
namespace {

/// The account of a file of this name and text.
scene::FileAccount account_of(const std::string& name, const std::string& text) {
  const TestFolder folder;
  Registries registries;
  register_room(registries);
  Errors warnings;
  const Result<scene::Model> model =
      registries.get<formats::Readers>().read(folder.write(name, text), {}, warnings);
  EXPECT_TRUE(model) << to_string(model.errors());
  return model && model->account ? *model->account : scene::FileAccount("none");
}

TEST(CityAccounts, OfCityJsonCountObjectsAndNameWhatIsNoSurface) {
  const scene::FileAccount account = account_of("town.city.json", R"({"type": "CityJSON", "version": "2.0",
    "transform": {"scale": [1, 1, 1], "translate": [0, 0, 0]}, "vertices": [[0, 0, 3], [9, 0, 3], [9, 9, 3]],
    "CityObjects": {
      "roof": {"type": "Building", "geometry": [{"type": "MultiSurface", "lod": "2", "boundaries": [[[0, 1, 2]]]}]},
      "lift": {"type": "+Lift", "geometry": [{"type": "MultiSurface", "lod": "2", "boundaries": [[[0, 2, 1]]]}]},
      "mast": {"type": "CityFurniture", "geometry": [{"type": "MultiPoint", "lod": "1", "boundaries": [0]}]}}})");
  EXPECT_EQ(account.count(scene::Fate::used, "city objects"), 2u) << account.text();
  EXPECT_EQ(account.count(scene::Fate::changed, "city objects"), 1u) << account.text();
  EXPECT_EQ(account.count(scene::Fate::left_out, "geometries MultiPoint"), 1u) << account.text();
}

TEST(CityAccounts, OfCityGmlCountPolygons) {
  const scene::FileAccount account = account_of("town.gml", R"(<?xml version="1.0"?>
<CityModel xmlns="http://www.opengis.net/citygml/2.0" xmlns:bldg="http://www.opengis.net/citygml/building/2.0"
  xmlns:gml="http://www.opengis.net/gml"><cityObjectMember><bldg:Building gml:id="b"><bldg:lod1MultiSurface>
<gml:MultiSurface><gml:surfaceMember><gml:Polygon gml:id="p"><gml:exterior><gml:LinearRing gml:id="r">
<gml:posList>0 0 3 9 0 3 9 9 3 0 0 3</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon></gml:surfaceMember>
</gml:MultiSurface></bldg:lod1MultiSurface></bldg:Building></cityObjectMember></CityModel>)");
  EXPECT_EQ(account.count(scene::Fate::used, "polygons"), 1u) << account.text();
}

TEST(CityAccounts, OfOpenStreetMapNameWhatIsNotDrawnAndWhatCannotBeRead) {
  const scene::FileAccount account = account_of("town.osm", R"(<?xml version="1.0"?>
<osm version="0.6"><node id="1" lat="48" lon="9"/><node id="2" lat="48" lon="9.0002"/>
<node id="3" lat="48.0002" lon="9.0002"/><node id="4" lat="48.0002" lon="9"/>
<node id="5" lat="48.0001" lon="9.0005"><tag k="amenity" v="telephone"/></node>
<way id="7"><nd ref="1"/><nd ref="2"/><nd ref="3"/><nd ref="4"/><nd ref="1"/><tag k="building" v="yes"/>
<tag k="height" v="about ten"/></way></osm>)");
  EXPECT_GE(account.count(scene::Fate::used, "elements with a kind"), 1u) << account.text();
  EXPECT_EQ(account.count(scene::Fate::left_out, "tags height"), 1u) << account.text();
}

}  // namespace
}  // namespace parvis::city_models

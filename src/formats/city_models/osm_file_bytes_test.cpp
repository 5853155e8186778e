#include "formats/city_models/osm_file_bytes.h"

#include <gtest/gtest.h>

#include <limits>

#include "base/test_folder.h"
#include "formats/city_models/osm_reader.h"

namespace parvis::scene {
namespace {

OsmFile small_map() {
  OsmFile osm;
  osm.corners = {{{4.0, 52.0}, {4.01, 52.0}, {4.01, 52.01}, {4.0, 52.01}}};
  osm.map = "EPSG:32631";
  osm.nodes = {{1, {4.0, 52.0}}, {-2, {4.01, 52.01}}};
  osm.tagged_nodes = {{1, {{"natural", "tree"}}}};
  osm.ways = {{7, {1, -2, 1}, {{"highway", "primary"}, {"name", "A"}}}};
  osm.way_of = {{7, 0}};
  osm.relations = {{9, {{"way", "outer", 7}}, {{"building", "yes"}}}};
  return osm;
}

TEST(OsmFileBytes, AMapComesBackWhole) {
  const std::string bytes = bytes_of(small_map());
  const Result<OsmFile> back = osm_file_of(bytes, "m.osm");
  ASSERT_TRUE(back.ok()) << to_string(back.errors());
  EXPECT_EQ(bytes_of(*back).size(), bytes.size());
  EXPECT_EQ(back->nodes.at(-2), glm::dvec2(4.01, 52.01));
  EXPECT_EQ(back->ways.at(back->way_of.at(7)).tags.at("name"), "A");
  EXPECT_EQ(back->relations.at(0).members.at(0).role, "outer");
}

TEST(OsmFileBytes, CutShortAnywhereOrWithoutPlacesItIsAnError) {
  const std::string bytes = bytes_of(small_map());
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_FALSE(osm_file_of(std::string_view(bytes).substr(0, size), "m.osm")) << size;
  OsmFile nowhere = small_map();
  nowhere.nodes[1].x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(osm_file_of(bytes_of(nowhere), "m.osm"));
}

TEST(OsmFileBytes, AFileReadInAChildIsTheOneReadHere) {
  const TestFolder folder;
  const auto file = folder.write(
      "m.osm",
      "<?xml version=\"1.0\"?><osm version=\"0.6\"><node id=\"1\" lat=\"52\" lon=\"4\"><tag k=\"natural\" "
      "v=\"tree\"/></node><node id=\"2\" lat=\"91\" lon=\"4\"/><way id=\"3\"><nd ref=\"1\"/><nd "
      "ref=\"2\"/></way></osm>");
  Errors here, there;
  const Result<OsmFile> read = read_osm_file(file, here), isolated = read_osm_file_isolated(file, {}, there);
  ASSERT_TRUE(read.ok() && isolated.ok());
  EXPECT_EQ(bytes_of(*read), bytes_of(*isolated));
  EXPECT_EQ(to_string(here), to_string(there));
  EXPECT_FALSE(here.empty()) << "a node beyond the pole";
  Errors warnings;
  EXPECT_FALSE(read_osm_file_isolated(folder.write("n.osm", "<osm><node"), {}, warnings));
}

}  // namespace
}  // namespace parvis::scene

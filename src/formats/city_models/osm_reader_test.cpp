#include "formats/city_models/osm_reader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <osmium/io/pbf_output.hpp>
#include <osmium/io/reader.hpp>
#include <osmium/io/writer.hpp>
#include <osmium/io/xml_input.hpp>
#include <sstream>

#include "base/files.h"
#include "base/random.h"
#include "base/test_data.h"
#include "base/test_folder.h"
#include "formats/city_models/osm_things.h"
#include "formats/city_models/osm_woods.h"
#include "formats/city_models/test_osm.h"
#include "formats/readers/test_packing.h"
#include "formats/terrain/map_projection.h"
#include "land/roads/places_on_map.h"
#include "land/roads/road_builder.h"
#include "scene/data/model_parts.h"
#include "scene/data/test_scene.h"

namespace parvis::scene {
namespace {

/// A map at Leiden, where a thousandth of a degree is about 71 m east and 111 m north.
std::string osm(const std::string& elements) {
  return R"(<?xml version="1.0" encoding="UTF-8"?>
<osm version="0.6"><bounds minlat="52.159" minlon="4.489" maxlat="52.161" maxlon="4.492"/>
<node id="1" lat="52.1600" lon="4.4900"/><node id="2" lat="52.1600" lon="4.4902"/>
<node id="3" lat="52.1601" lon="4.4902"/><node id="4" lat="52.1601" lon="4.4900"/>
<node id="5" lat="52.16003" lon="4.49005"/><node id="6" lat="52.16003" lon="4.49015"/>
<node id="7" lat="52.16007" lon="4.49015"/><node id="8" lat="52.16007" lon="4.49005"/>
<node id="11" lat="52.1595" lon="4.4895"/><node id="12" lat="52.1595" lon="4.4905"/>
<node id="13" lat="52.1595" lon="4.4915"/><node id="14" lat="52.1605" lon="4.4905"/>)" +
         elements + "</osm>";
}

std::string way(int id, const std::string& nodes,
                const std::vector<std::pair<std::string, std::string>>& tags) {
  std::string text = fmt::format("<way id=\"{}\">", id);
  std::stringstream list(nodes);
  for (std::string node; list >> node;) text += fmt::format("<nd ref=\"{}\"/>", node);
  for (const auto& [key, value] : tags) text += fmt::format("<tag k=\"{}\" v=\"{}\"/>", key, value);
  return text + "</way>\n";
}

struct Read {
  Result<Model> model;
  std::string warnings;
};

Read read(const std::string& text) {
  const TestFolder folder;
  Errors warnings;
  Result<Model> model = read_osm(folder.write("quarter.osm", text), warnings);
  return {std::move(model), to_string(warnings)};
}

// Of the footprint 1-2-3-4: 0.0002 by 0.0001 degrees at 52.16 north, on the ellipsoid and in UTM's scale.
constexpr float wide_m = 13.69f, deep_m = 11.13f;

TEST(Osm, StoreysBelowTheGroundAreNotDrawn) {
  using Tags = std::vector<std::pair<std::string, std::string>>;
  const auto roofs_m2 = [](const Tags& tags) {
    const Read town = read(osm(way(100, "1 2 3 4 1", {{"building", "yes"}}) + way(101, "5 6 7 8 5", tags)));
    EXPECT_TRUE(town.model) << to_string(town.model.errors());
    return town.model ? area_m2(*town.model, "RoofSurface") : 0.0;
  };
  const double alone_m2 = double(wide_m * deep_m);
  EXPECT_GT(roofs_m2({{"building", "yes"}, {"building:levels:underground", "2"}}), alone_m2 + 10.0);
  EXPECT_NEAR(roofs_m2({{"building", "yes"}, {"location", "underground"}}), alone_m2, 0.3);
  EXPECT_NEAR(roofs_m2({{"building", "yes"}, {"building:levels", "0"}, {"building:levels:underground", "2"}}),
              alone_m2, 0.3);
}

TEST(Osm, ABuildingStandsOnItsFootprintAsHighAsItsTagsSay) {
  const Read house = read(osm(way(100, "1 2 3 4 1", {{"building", "yes"}, {"height", "9.5 m"}})));
  ASSERT_TRUE(house.model) << to_string(house.model.errors());
  EXPECT_EQ(house.warnings, "");
  const Bounds walls = bounds_of(*house.model, "WallSurface");
  EXPECT_NEAR(walls.size().z, 9.5f, 1e-4f);
  EXPECT_NEAR(walls.size().x, wide_m, 0.3f);  // the map is turned against the meridian by 1.2 degrees
  EXPECT_NEAR(walls.size().y, deep_m, 0.3f);
  EXPECT_NEAR(area_m2(*house.model, "RoofSurface"), double(wide_m * deep_m), 0.3);
  EXPECT_EQ(bounds_of(*house.model, "LandUse").max.z, 0.0f);
  for (const Part& part : house.model->parts)
    for (std::size_t i = 0; part.object == "WallSurface" && i < part.mesh.positions.size(); ++i) {
      const glm::vec3 outward = part.mesh.positions[i] - walls.centre();
      EXPECT_GT(glm::dot(glm::vec2(part.mesh.normals[i]), glm::vec2(outward)), 0.0f);
    }
}

TEST(Osm, LevelsGiveTheHeightWhereNoHeightDoes) {
  const auto top_m = [](const std::vector<std::pair<std::string, std::string>>& tags) {
    const Read house = read(osm(way(100, "1 2 3 4 1", tags)));
    return house.model ? bounds_of(*house.model, "RoofSurface").max.z : 0.0f;
  };
  EXPECT_NEAR(top_m({{"building", "yes"}, {"building:levels", "4"}}), 12.0f, 1e-4f);
  EXPECT_NEAR(top_m({{"building", "yes"}}), 6.0f, 1e-4f);
  EXPECT_NEAR(top_m({{"building", "yes"}, {"height", "30'"}}), 9.144f, 1e-4f);
  EXPECT_NEAR(top_m({{"building", "yes"}, {"height", "tall"}, {"building:levels", "1"}}), 3.0f, 1e-4f);
  EXPECT_NEAR(top_m({{"building", "yes"}, {"min_height", "20"}, {"height", "5"}}), 23.0f, 1e-4f);
}

TEST(Osm, HousesOfNoLevelsAreAllRoof) {
  const auto house = [](const std::string& key, const std::string& value) {
    return read(
        osm(way(100, "1 2 3 4 1",
                {{"building", "yes"}, {"roof:shape", "gabled"}, {"building:levels", "0"}, {key, value}})));
  };
  for (const auto& [key, value, top_m] :
       {std::tuple{"roof:height", "4.5", 4.5f}, std::tuple{"roof:levels", "2", 6.0f}}) {
    const Read hall = house(key, value);
    ASSERT_TRUE(hall.model) << to_string(hall.model.errors());
    const Bounds roof = bounds_of(*hall.model, "RoofSurface");
    EXPECT_NEAR(roof.min.z, 0.0f, 1e-4f) << key;
    EXPECT_NEAR(roof.max.z, top_m, 1e-4f) << key;
    EXPECT_NEAR(area_m2(*hall.model, "WallSurface"), double(deep_m * top_m), 0.3) << "two gables alone";
  }
}

TEST(Osm, RoofsRiseByTheirAngle) {
  const Read house =
      read(osm(way(100, "1 2 3 4 1",
                   {{"building", "yes"}, {"height", "12"}, {"roof:shape", "gabled"}, {"roof:angle", "45"}})));
  ASSERT_TRUE(house.model);
  const Bounds roof = bounds_of(*house.model, "RoofSurface");
  EXPECT_NEAR(roof.size().z, 0.5f * deep_m, 0.02f);
  EXPECT_NEAR(roof.max.z, 12.0f, 1e-4f);
}

TEST(Osm, ElementsThatAnEditorHasDeletedAreLeftOut) {
  // A house by its way, a corner of another by its node, a courtyard by its relation.
  const Read town = read(
      osm(way(100, "1 2 3 4 1", {{"building", "yes"}}) +
          R"(<way id="101" action='delete' visible="true"><nd ref="5"/><nd ref="6"/><nd ref="7"/><nd ref="8"/>
<nd ref="5"/><tag k="building" v="yes"/><tag k="height" v="40"/></way>
<relation id="9" action="delete"><member type="way" ref="100" role="outer"/><tag k="type" v="multipolygon"/>
<tag k="building" v="yes"/><tag k="height" v="50"/></relation>
<node id="-7" lat="52.17" lon="4.49" action="delete"><tag k="natural" v="tree"/></node>)"));
  ASSERT_TRUE(town.model) << to_string(town.model.errors());
  EXPECT_NEAR(bounds_of(*town.model, "RoofSurface").max.z, 6.0f, 1e-4f);
  EXPECT_FALSE(bounds_of(*town.model, "SolitaryVegetationObject").max.z > 0.0f);
  EXPECT_EQ(town.warnings, "");
}

TEST(Osm, RoofsHaveTheirShapes) {
  for (const char* shape : {"gabled", "hipped", "pyramidal", "mansard", "dome", "gambrel", "round"}) {
    const Read house =
        read(osm(way(100, "1 2 3 4 1",
                     {{"building", "yes"}, {"height", "10"}, {"roof:shape", shape}, {"roof:height", "4"}})));
    ASSERT_TRUE(house.model) << shape;
    const bool is_round = shape == std::string_view("dome") || shape == std::string_view("round");
    const std::string name = is_round ? "RoofSurface metal" : "RoofSurface";
    const Bounds roof = bounds_of(*house.model, name);
    EXPECT_NEAR(roof.min.z, 6.0f, 1e-4f) << shape;
    EXPECT_NEAR(roof.max.z, 10.0f, 1e-4f) << shape;
    EXPECT_GT(area_m2(*house.model, name), double(wide_m * deep_m)) << shape;
  }
}

TEST(Osm, BuildingsAndRoadsStandOnTheGroundThatIsGiven) {
  const TestFolder folder;
  const auto file = folder.write(
      "hill.osm", osm(way(100, "1 2 3 4 1", {{"building", "yes"}, {"height", "9"}}) +
                      way(101, "5 6 7 8 5", {{"building:part", "yes"}, {"height", "5"}}) +
                      way(102, "11 12 13", {{"highway", "residential"}}) +
                      way(103, "5 6 7 8 5", {{"building", "yes"}, {"height", "4"}, {"min_height", "1"}})));
  const double middle_m = MapProjection::utm({4.49, 52.16})({4.4905, 52.16}).x;
  const auto ground = [&](glm::dvec2 on_map) {
    return 100.0 + 0.1 * (on_map.x - middle_m);
  };  // rises eastward
  Errors warnings;
  const Result<Model> model = read_osm(file, warnings, ground);
  ASSERT_TRUE(model) << to_string(model.errors());
  EXPECT_EQ(bounds_of(*model, "LandUse").min.x, Bounds().min.x) << "no level ground of its own";
  const Bounds walls = bounds_of(*model, "WallSurface");
  const double west_m = 100.0 + 0.1 * (double(walls.min.x) + model->origin.x - middle_m);
  EXPECT_NEAR(walls.min.z, west_m, 0.8) << "on the lowest ground below it";
  ASSERT_EQ(model->roads.size(), 1u);
  EXPECT_GT(model->roads[0].path.size(), 10u) << "with points between its own";
  for (const glm::vec3& point : model->roads[0].path)
    EXPECT_NEAR(point.z, ground(glm::dvec2(point) + glm::dvec2(model->origin)), 1e-3);
}

TEST(Osm, RelationsHaveCourtyards) {
  const Read block = read(osm(way(100, "1 2 3", {}) + way(101, "1 4 3", {}) + way(102, "5 6 7 8 5", {}) +
                              R"(<relation id="200"><member type="way" ref="100" role="outer"/>
    <member type="way" ref="101" role="outer"/><member type="way" ref="102" role="inner"/>
    <member type="way" ref="999" role="inner"/>
    <tag k="type" v="multipolygon"/><tag k="building" v="yes"/></relation>)"));
  ASSERT_TRUE(block.model) << to_string(block.model.errors());
  EXPECT_NE(block.warnings.find("relation 200: its way 999 is not in the file"), std::string::npos)
      << block.warnings;
  const double courtyard = double(wide_m * deep_m) * 0.5 * 0.4;
  EXPECT_NEAR(area_m2(*block.model, "RoofSurface"), double(wide_m * deep_m) - courtyard, 0.3);
}

/// A pond of 20,000 corners whose outline is as many ways, in no order, every third the other way round.
TEST(Osm, OutlinesOfManyWaysAreJoined) {
  constexpr int corners = 20'000;
  constexpr double radius_deg = 0.0005;
  std::string nodes, relation = "<relation id=\"9\">";
  std::vector<std::string> ways;
  for (int i = 0; i < corners; ++i) {
    const double turn = 6.283185307 * i / corners;
    nodes += fmt::format("<node id=\"{}\" lat=\"{:.9f}\" lon=\"{:.9f}\"/>", 1000 + i,
                         52.16 + radius_deg * std::sin(turn), 4.4905 + radius_deg * std::cos(turn));
    const int from = 1000 + i, to = 1000 + (i + 1) % corners;
    ways.push_back(
        way(50'000 + i, i % 3 == 0 ? fmt::format("{} {}", to, from) : fmt::format("{} {}", from, to), {}));
    relation += fmt::format("<member type=\"way\" ref=\"{}\" role=\"outer\"/>", 50'000 + i * 7919 % corners);
  }
  relation += R"(<tag k="type" v="multipolygon"/><tag k="natural" v="water"/></relation>)";
  std::string all = nodes;
  for (const std::string& each : ways) all += each;
  const Read pond = read(osm(all + relation));
  ASSERT_TRUE(pond.model) << to_string(pond.model.errors());
  EXPECT_EQ(pond.warnings, "");
  const double radius_m2 = radius_deg * radius_deg * 111'250.0 * 68'400.0;
  EXPECT_NEAR(area_m2(*pond.model, "WaterBody"), 3.14159265 * radius_m2, 0.01 * 3.14159265 * radius_m2);
}

TEST(Osm, PartsStandInPlaceOfTheirOutline) {
  const Read house = read(osm(way(100, "1 2 3 4 1", {{"building", "yes"}, {"height", "30"}}) +
                              way(101, "5 6 7 8 5", {{"building:part", "yes"}, {"height", "8"}})));
  ASSERT_TRUE(house.model);
  EXPECT_NEAR(bounds_of(*house.model, "RoofSurface").max.z, 8.0f, 1e-4f);
}

TEST(Osm, WallsAreNamedAfterTheKindOfTheirBuilding) {
  const Read city = read(osm(way(1, "1 2 3 4 1", {{"building", "office"}, {"start_date", "1955"}}) +
                             way(2, "5 6 7 8 5", {{"building:part", "yes"}, {"building:levels", "5"}})));
  ASSERT_TRUE(city.model);
  for (const Part& part : city.model->parts)
    if (city.model->materials[std::size_t(part.material)].name == "WallSurface") {
      EXPECT_EQ(part.object, "WallSurface office 1946-1974 5-storeys");
    }
  EXPECT_EQ(matching_parts(*city.model, "WallSurface office*").size(), 1u);
}

TEST(Osm, MissingNodesAreReportedAndTheRestIsRead) {
  const Read house = read(osm(way(100, "1 2 77 3 4 1", {{"building", "yes"}}) +
                              way(101, "11 12 78 13", {{"highway", "residential"}})));
  ASSERT_TRUE(house.model) << to_string(house.model.errors());
  EXPECT_NE(house.warnings.find("way 100: its node 77"), std::string::npos) << house.warnings;
  EXPECT_NE(house.warnings.find("way 101: its node 78"), std::string::npos) << house.warnings;
  EXPECT_NEAR(area_m2(*house.model, "RoofSurface"), double(wide_m * deep_m), 0.3);
  ASSERT_EQ(house.model->roads.size(), 1u);
  EXPECT_EQ(house.model->roads[0].path.size(), 3u);
}

TEST(Osm, TwoWayStreetsHaveTheLanesOfEachDirection) {
  using Tags = std::vector<std::pair<std::string, std::string>>;
  const auto lanes = [](Tags tags) {
    tags.emplace_back("highway", "secondary");
    const Read town = read(osm(way(100, "11 12 13", tags)));
    EXPECT_TRUE(town.model) << to_string(town.model.errors());
    const Road road = town.model ? town.model->roads.at(0) : Road{};
    const Result<RoadGraph> graph = build_road_graph(std::vector<Road>{road});
    EXPECT_TRUE(graph) << to_string(graph.errors());
    return std::pair(road.lanes_each_way, road.lanes_against());
  };
  EXPECT_EQ(lanes({{"lanes", "3"}}), std::pair(2, 1));
  EXPECT_EQ(lanes({{"lanes", "3"}, {"lanes:backward", "2"}}), std::pair(1, 2));
  EXPECT_EQ(lanes({{"lanes:forward", "3"}, {"lanes:backward", "1"}}), std::pair(3, 1));
  EXPECT_EQ(lanes({{"lanes:forward", "2"}}), std::pair(2, 1));
  EXPECT_EQ(
      lanes({{"lanes", "5"}, {"lanes:both_ways", "1"}, {"lanes:forward", "2"}, {"lanes:backward", "2"}}),
      std::pair(3, 2));
  EXPECT_EQ(lanes({{"lanes", "1"}}), std::pair(1, 1)) << "one that both directions share";
  EXPECT_EQ(lanes({}), std::pair(1, 1));
  EXPECT_EQ(lanes({{"oneway", "-1"}, {"lanes:backward", "2"}}), std::pair(2, 0));
}

TEST(Osm, RoadsHaveLanesDirectionsAndLimits) {
  const Read town =
      read(osm(way(100, "11 12 13", {{"highway", "secondary"}, {"lanes", "4"}, {"maxspeed", "30 mph"}}) +
               way(101, "12 14", {{"highway", "residential"}, {"oneway", "-1"}}) +
               way(102, "1 2 3", {{"highway", "footway"}})));
  ASSERT_TRUE(town.model) << to_string(town.model.errors());
  const std::vector<Road>& roads = town.model->roads;
  ASSERT_EQ(roads.size(), 2u);
  EXPECT_EQ(roads[0].lanes_each_way, 2);
  EXPECT_NEAR(roads[0].speed_limit, 13.41f, 0.01f);
  EXPECT_FALSE(roads[0].is_one_way);
  EXPECT_TRUE(roads[1].is_one_way);
  EXPECT_GT(roads[1].path.front().y, roads[1].path.back().y) << "against the way's own direction";
  const Result<RoadGraph> graph = build_road_graph(roads);
  ASSERT_TRUE(graph) << to_string(graph.errors());
  EXPECT_TRUE(std::ranges::any_of(graph->lanes, [](const Lane& lane) { return lane.crossing >= 0; }));
}

/// A bridge from south to north over the street 11-12-13, and its ramp to the north, 111 m long.
std::string street_and_bridge(const std::vector<std::pair<std::string, std::string>>& tags) {
  return R"(<node id="21" lat="52.1593" lon="4.4902"/><node id="22" lat="52.1597" lon="4.4902"/>
<node id="23" lat="52.1607" lon="4.4902"/>)" +
         way(100, "11 12 13", {{"highway", "primary"}}) + way(101, "21 22", tags) +
         way(102, "22 23", {{"highway", "primary"}});
}

float highest_m(const Road& road) {
  float highest = 0.0f;
  for (const glm::vec3& point : road.path) highest = std::max(highest, point.z);
  return highest;
}

TEST(Osm, BridgesLeaveClearanceAndRampsLeadUpToThem) {
  const Read town = read(osm(street_and_bridge({{"highway", "primary"}, {"bridge", "yes"}, {"layer", "1"}})));
  ASSERT_TRUE(town.model) << to_string(town.model.errors());
  const std::vector<Road>& roads = town.model->roads;
  ASSERT_EQ(roads.size(), 3u);
  EXPECT_EQ(highest_m(roads[0]), 0.0f) << "the street below stays on the ground";
  ASSERT_EQ(roads[1].path.size(), 3u) << "the map ends south of it, but the street goes on to the ground";
  EXPECT_NEAR(roads[1].path[0].z, 0.0f, 1e-3f);
  EXPECT_NEAR(glm::distance(glm::vec2(roads[1].path[0]), glm::vec2(roads[1].path[1])), 90.0f, 0.1f);
  for (const std::size_t i : {1u, 2u}) EXPECT_NEAR(roads[1].path[i].z, 5.4f, 1e-3f);
  ASSERT_EQ(roads[2].path.size(), 3u) << "the ramp ends between the nodes";
  EXPECT_NEAR(roads[2].path[0].z, 5.4f, 1e-3f);
  EXPECT_NEAR(roads[2].path[1].z, 0.0f, 1e-3f);
  EXPECT_NEAR(glm::distance(glm::vec2(roads[2].path[0]), glm::vec2(roads[2].path[1])), 90.0f, 0.1f)
      << "at 6 %";
  const Bounds bridge = bounds_of(*town.model, "Bridge");
  EXPECT_NEAR(bridge.max.z, 6.4f, 0.05f) << "parapets";
  // What hangs over the street below: the deck, not a curtain down to it.
  for (const Part& part : town.model->parts)
    for (std::size_t i = 0; part.object == "Bridge" && i < part.mesh.positions.size(); ++i) {
      const glm::vec3 p = part.mesh.positions[i];
      if (std::abs(p.y - roads[0].path[1].y) < 5.0f && std::abs(p.x - roads[1].path[0].x) < 9.0f) {
        EXPECT_GT(p.z, 4.4f);
      }
    }
}

/// The same with a junction on its ramp, from which a service road leads east, and another beside the ramp,
/// 14 m from its middle.
std::string bridge_with_service_roads() {
  return R"(<node id="21" lat="52.1593" lon="4.4902"/><node id="22" lat="52.1597" lon="4.4902"/>
<node id="23" lat="52.1607" lon="4.4902"/><node id="24" lat="52.15995" lon="4.4902"/>
<node id="25" lat="52.15995" lon="4.4912"/><node id="26" lat="52.16" lon="4.4904"/>
<node id="27" lat="52.1602" lon="4.4904"/>)" +
         way(100, "11 12 13", {{"highway", "primary"}}) +
         way(101, "21 22", {{"highway", "primary"}, {"bridge", "yes"}, {"layer", "1"}}) +
         way(102, "22 24 23", {{"highway", "primary"}}) + way(103, "24 25", {{"highway", "service"}}) +
         way(104, "26 27", {{"highway", "service"}});
}

TEST(Osm, LesserWaysFallFasterFromRamps) {
  const Read town = read(osm(bridge_with_service_roads()));
  ASSERT_TRUE(town.model) << to_string(town.model.errors());
  const std::vector<glm::vec3>& service = town.model->roads.at(3).path;
  ASSERT_GE(service.size(), 3u);
  EXPECT_NEAR(service[0].z, 5.4f - 0.09f * 27.8f, 0.05f) << "9 % to the junction, 27.8 m from the bridge";
  EXPECT_NEAR(glm::distance(glm::vec2(service[0]), glm::vec2(service[1])), service[0].z / 0.15f, 0.5f)
      << "15 % from there";
  EXPECT_EQ(service[1].z, 0.0f);
}

TEST(Osm, TheGroundRisesToRampsAndCoversNoWayBesideThem) {
  const Read town = read(osm(bridge_with_service_roads()));
  ASSERT_TRUE(town.model) << to_string(town.model.errors());
  const std::vector<glm::vec3>&ramp = town.model->roads.at(2).path, &beside = town.model->roads.at(4).path;
  const glm::vec2 low(beside.front()), high(beside.back());
  float highest_m = 0.0f, highest_beside_m = 0.0f, below_bridge_m = 0.0f;
  for (const Part& part : town.model->parts)
    for (std::size_t i = 0; part.object == "LandUse" && i < part.mesh.positions.size(); ++i) {
      const glm::vec3 p = part.mesh.positions[i];
      highest_m = std::max(highest_m, p.z);
      if (p.y > low.y && p.y < high.y && std::abs(p.x - low.x) < 2.5f)
        highest_beside_m = std::max(highest_beside_m, p.z);
      if (std::abs(p.y - town.model->roads.at(0).path[1].y) < 3.0f)
        below_bridge_m = std::max(below_bridge_m, p.z);
    }
  EXPECT_NEAR(highest_m, ramp.front().z, 0.2f);
  EXPECT_LT(highest_beside_m, 0.5f);
  EXPECT_LT(below_bridge_m, 0.3f);
}

TEST(Osm, NoTreeGrowsThroughABridge) {
  const auto trees_of = [](const std::string& tags) {
    const std::string map =
        osm(street_and_bridge({{"highway", "primary"}, {"bridge", tags}, {"layer", "1"}}) +
            R"(<node id="31" lat="52.1595" lon="4.49025"><tag k="natural" v="tree"/></node>
<node id="32" lat="52.1595" lon="4.4910"><tag k="natural" v="tree"/></node>)");
    const Read town = read(map);
    EXPECT_TRUE(town.model) << to_string(town.model.errors());
    EXPECT_EQ(town.warnings.find("1 trees would grow through bridges") != std::string::npos, tags == "yes")
        << town.warnings;
    std::size_t triangles = 0;
    for (const Part& part : town.model->parts)
      if (part.object.starts_with("SolitaryVegetationObject")) triangles += part.mesh.triangle_count();
    return triangles / 12;
  };
  EXPECT_EQ(trees_of("yes"), 1u);
  EXPECT_EQ(trees_of("no"), 2u);
}

TEST(Osm, AStreetThatLeadsHighIntoABuildingOrEndsOnAPierStaysAsItIs) {
  const std::string tags_of_house = way(104, "21 1 2 21", {{"building", "yes"}, {"height", "9"}});
  const Read garage = read(
      osm(street_and_bridge({{"highway", "primary"}, {"bridge", "yes"}, {"layer", "1"}}) + tags_of_house));
  ASSERT_TRUE(garage.model) << to_string(garage.model.errors());
  EXPECT_EQ(garage.model->roads[1].path.size(), 2u);
  const Read pier =
      read(osm(R"(<node id="21" lat="52.1693" lon="4.4902"/><node id="22" lat="52.1697" lon="4.4902"/>)" +
               way(101, "21 22", {{"highway", "primary"}, {"bridge", "yes"}})));
  ASSERT_TRUE(pier.model) << to_string(pier.model.errors());
  EXPECT_EQ(pier.model->roads[0].path.size(), 2u);
}

TEST(Osm, RailwaysAndPathsHaveBridgesOfTheirOwn) {
  const auto bridge_of = [](const std::vector<std::pair<std::string, std::string>>& tags) {
    const Read town = read(osm(street_and_bridge(tags)));
    EXPECT_TRUE(town.model) << to_string(town.model.errors());
    return bounds_of(*town.model, "Bridge");
  };
  for (const char* railway : {"rail", "tram"}) {
    const Bounds bridge = bridge_of({{"railway", railway}, {"bridge", "yes"}, {"layer", "1"}});
    EXPECT_NEAR(bridge.max.z, 6.4f, 0.05f) << railway;
  }
  const Bounds path = bridge_of({{"highway", "footway"}, {"bridge", "yes"}, {"layer", "1"}, {"width", "2"}});
  EXPECT_NEAR(path.max.z, 6.4f, 0.05f);
}

TEST(Osm, WhatGoesAlongOnAStreetsBridgeHasNoParapetsOfItsOwn) {
  const auto highest_between_parapets = [](const std::string& beside) {
    const Read town =
        read(osm(street_and_bridge({{"highway", "primary"}, {"bridge", "yes"}, {"layer", "1"}}) + beside));
    EXPECT_TRUE(town.model) << to_string(town.model.errors());
    const float middle = town.model->roads[1].path[1].x;  // where the bridge begins
    float highest = -1.0f;
    for (const Part& part : town.model->parts)
      for (std::size_t i = 0; part.object == "Bridge" && i < part.mesh.positions.size(); ++i)
        if (const glm::vec3 p = part.mesh.positions[i]; std::abs(p.x - middle) < 4.0f)
          highest = std::max(highest, p.z);
    return highest;
  };
  const float alone = highest_between_parapets("");
  EXPECT_LT(alone, 5.5f);
  for (const char* key : {"railway", "highway"}) {
    const std::string value = std::string(key) == "railway" ? "tram" : "cycleway";
    EXPECT_LT(highest_between_parapets(
                  way(103, "21 22", {{key, value}, {"bridge", "yes"}, {"layer", "1"}, {"width", "2"}})),
              5.5f)
        << value;
  }
}

TEST(Osm, BridgesOverNothingAreLow) {
  const Read town = read(osm(way(100, "11 12 13", {{"highway", "primary"}, {"bridge", "yes"}})));
  ASSERT_TRUE(town.model);
  EXPECT_NEAR(highest_m(town.model->roads[0]), 1.0f, 1e-3f);
}

TEST(Osm, GarageTunnelsAndUndergroundRailwaysAreLeftOutAndPassagesStay) {
  const Read town =
      read(osm(way(100, "11 12 13", {{"highway", "service"}, {"tunnel", "yes"}, {"layer", "-1"}}) +
               way(101, "12 14", {{"highway", "service"}, {"tunnel", "building_passage"}}) +
               way(102, "1 2 3", {{"railway", "subway"}, {"tunnel", "yes"}})));
  ASSERT_TRUE(town.model) << to_string(town.model.errors());
  ASSERT_EQ(town.model->roads.size(), 1u);
  EXPECT_EQ(town.model->roads[0].name, "way 101");
  EXPECT_EQ(bounds_of(*town.model, "Railway").min.x, Bounds().min.x);
}

/// A tunnel from south to north, 44 m long, under the street 11-12-13, which an open way leads on from.
std::string street_and_tunnel(const std::vector<std::pair<std::string, std::string>>& tags) {
  return R"(<node id="21" lat="52.1593" lon="4.4902"/><node id="22" lat="52.1597" lon="4.4902"/>
<node id="23" lat="52.1609" lon="4.4902"/>)" +
         way(100, "11 12 13", {{"highway", "primary"}}) + way(101, "21 22", tags) +
         way(102, "22 23", {{"highway", "primary"}}) + way(103, "1 2 3 4 1", {{"leisure", "park"}});
}

TEST(Osm, TunnelsAreDugAndTrenchesLeadDownToThem) {
  const Read town =
      read(osm(street_and_tunnel({{"highway", "primary"}, {"tunnel", "yes"}, {"layer", "-1"}})));
  ASSERT_TRUE(town.model) << to_string(town.model.errors());
  EXPECT_EQ(town.warnings, "");
  const std::vector<Road>& roads = town.model->roads;
  ASSERT_EQ(roads.size(), 3u);
  EXPECT_EQ(highest_m(roads[0]), 0.0f);
  EXPECT_NEAR(roads[0].path[1].z, 0.0f, 1e-3f) << "the street above stays on the ground";
  for (const glm::vec3& point : roads[1].path) EXPECT_NEAR(point.z, -5.1f, 1e-3f);
  ASSERT_EQ(roads[2].path.size(), 3u) << "the ramp ends between the nodes";
  EXPECT_NEAR(roads[2].path[0].z, -5.1f, 1e-3f);
  EXPECT_NEAR(glm::distance(glm::vec2(roads[2].path[0]), glm::vec2(roads[2].path[1])), 85.0f, 0.1f)
      << "at 6 %";
  const Bounds concrete = bounds_of(*town.model, "Tunnel");
  EXPECT_NEAR(concrete.max.z, 0.9f, 1e-3f) << "parapets";
  EXPECT_NEAR(concrete.min.z, -5.12f, 1e-3f);
}

TEST(Osm, TheGroundIsOpenOverTrenchesAndWholeOverTunnels) {
  const auto read_town = [](const char* tunnel) {
    return read(osm(street_and_tunnel({{"highway", "primary"}, {"tunnel", tunnel}})));
  };
  const Read dug = read_town("yes"), level = read_town("no");
  ASSERT_TRUE(dug.model && level.model);
  const double trench_m2 = 85.0 * (6.5 + 2.0 * 3.6);
  EXPECT_NEAR(area_m2(*level.model, "LandUse") - area_m2(*dug.model, "LandUse"), trench_m2, 5.0);
  EXPECT_LT(area_m2(*dug.model, "PlantCover"), area_m2(*level.model, "PlantCover") - 10.0)
      << "a park beside the ramp loses what the trench takes";
  EXPECT_NEAR(area_m2(*dug.model, "Road ramp"), trench_m2, 5.0);
}

TEST(Osm, RampsToPortalsAreSteeperWhereAJunctionIsNear) {
  const Read town = read(
      osm(R"(<node id="21" lat="52.1593" lon="4.4902"/><node id="22" lat="52.1597" lon="4.4902"/>
<node id="23" lat="52.16015" lon="4.4902"/><node id="24" lat="52.1609" lon="4.4902"/>
<node id="25" lat="52.16015" lon="4.4912"/>)" +
          way(101, "21 22", {{"highway", "primary"}, {"tunnel", "yes"}}) +
          way(102, "22 23 24", {{"highway", "primary"}}) + way(103, "23 25", {{"highway", "residential"}})));
  ASSERT_TRUE(town.model) << to_string(town.model.errors());
  EXPECT_NEAR(town.model->roads[2].path[0].z, 0.0f, 1e-2f) << "the junction, 50 m from the portal";
}

TEST(Osm, ManyTrenchesInOneAreaLeaveItWhole) {
  std::string ways = "<node id=\"21\" lat=\"52.1600\" lon=\"4.4905\"/>";
  for (int i = 0; i < 400; ++i) {
    const double angle = 0.0157 * double(i);
    ways += fmt::format("<node id=\"{}\" lat=\"{}\" lon=\"{}\"/>", 1000 + i, 52.16 + 0.0003 * std::sin(angle),
                        4.4905 + 0.0005 * std::cos(angle)) +
            fmt::format("<node id=\"{}\" lat=\"{}\" lon=\"{}\"/>", 2000 + i,
                        52.16 + 0.0009 * std::sin(angle + 1.5), 4.4905 + 0.0015 * std::cos(angle + 1.5)) +
            way(3000 + i, fmt::format("21 {}", 1000 + i), {{"railway", "rail"}, {"tunnel", "yes"}}) +
            way(4000 + i, fmt::format("{} {}", 1000 + i, 2000 + i), {{"railway", "rail"}});
  }
  const Read town = read(osm(ways));
  ASSERT_TRUE(town.model) << to_string(town.model.errors());
  EXPECT_NEAR(area_m2(*town.model, "LandUse"), 205.0 * 222.0, 3000.0);
  EXPECT_NE(town.warnings.find("lead through one area"), std::string::npos) << town.warnings;
}

TEST(Osm, AislesAndDrivewaysAreSlowAndNarrow) {
  const Read town = read(
      osm(way(100, "11 12 13", {{"highway", "service"}, {"service", "parking_aisle"}, {"maxspeed", "50"}}) +
          way(101, "12 14", {{"highway", "service"}, {"service", "driveway"}})));
  ASSERT_TRUE(town.model);
  for (const Road& road : town.model->roads)
    EXPECT_LT(road.speed_limit, 25.0f / 3.6f) << "no pavements, no dashes";
  EXPECT_LT(town.model->roads[1].lane_width_m, 2.0f);
}

TEST(Osm, WidthsAreThoseOfTheTags) {
  const Read town = read(osm(way(100, "11 12 13", {{"highway", "residential"}, {"width", "5.0"}})));
  ASSERT_TRUE(town.model);
  EXPECT_NEAR(town.model->roads[0].lane_width_m, 2.5f, 1e-4f);
}

TEST(Osm, ParksWaterAndPathsLieOnTheGround) {
  const Read town =
      read(osm(way(100, "1 2 3 4 1", {{"leisure", "park"}}) + way(101, "5 6 7 8 5", {{"natural", "water"}}) +
               way(102, "11 12 13", {{"highway", "footway"}}) +
               way(103, "11 14", {{"highway", "footway"}, {"footway", "sidewalk"}})));
  ASSERT_TRUE(town.model) << to_string(town.model.errors());
  EXPECT_EQ(town.warnings, "");
  const double park_m2 = double(wide_m * deep_m);
  EXPECT_NEAR(area_m2(*town.model, "PlantCover"), park_m2, 0.3);
  EXPECT_NEAR(area_m2(*town.model, "WaterBody"), 0.5 * 0.4 * park_m2, 0.3);
  EXPECT_GT(bounds_of(*town.model, "WaterBody").min.z, bounds_of(*town.model, "PlantCover").max.z);
  EXPECT_NEAR(area_m2(*town.model, "Road footway"), 2.0 * 2.0 * 68.4, 4.0)
      << "without the pavement of a street";
  EXPECT_LT(bounds_of(*town.model, "Road footway").max.z, 0.03f) << "below what paving lays";
}

TEST(Osm, TreesTakeFewTriangles) {
  const Read town = read(osm(R"(<node id="31" lat="52.1600" lon="4.4910"><tag k="natural" v="tree"/>
<tag k="height" v="12"/></node>)" +
                             way(100, "11 13", {{"natural", "tree_row"}})));
  ASSERT_TRUE(town.model) << to_string(town.model.errors());
  std::size_t triangles = 0;
  for (const Part& part : town.model->parts)
    if (part.object == "SolitaryVegetationObject") triangles += part.mesh.triangle_count();
  EXPECT_EQ(triangles, 12u * (1 + 18)) << "one tree, and a row of 137 m";
  EXPECT_NEAR(bounds_of(*town.model, "SolitaryVegetationObject").max.z, 12.0f, 1e-3f);
  // `greenery` takes what is lower than 1.2 m for ground: a crown that began there would stay as a mound.
  for (const Part& part : town.model->parts)
    for (const glm::vec3& p : part.mesh.positions)
      EXPECT_TRUE(part.object != "SolitaryVegetationObject" || p.z < 0.01f || p.z > 1.25f) << p.z;
}

/// A square of 137 m by 111 m with a street through its middle and the house 1-2-3-4 beside it.
std::string wood(const std::vector<std::pair<std::string, std::string>>& tags) {
  return R"(<node id="41" lat="52.1595" lon="4.4895"/><node id="42" lat="52.1595" lon="4.4915"/>
<node id="43" lat="52.1605" lon="4.4915"/><node id="44" lat="52.1605" lon="4.4895"/>)" +
         way(200, "41 42 43 44 41", tags) + way(201, "12 14", {{"highway", "residential"}}) +
         way(202, "1 2 3 4 1", {{"building", "yes"}});
}

TEST(Osm, WoodsHaveTreesBesideTheirWaysAndHouses) {
  const Read town = read(osm(wood({{"natural", "wood"}})));
  ASSERT_TRUE(town.model) << to_string(town.model.errors());
  EXPECT_EQ(town.warnings, "");
  std::size_t triangles = 0;
  const Bounds house = bounds_of(*town.model, "WallSurface");
  const std::vector<glm::vec3>& street = town.model->roads.at(0).path;
  for (const Part& part : town.model->parts) {
    if (part.object != "SolitaryVegetationObject wood") continue;
    triangles += part.mesh.triangle_count();
    for (const glm::vec3& p : part.mesh.positions) {
      if (p.z > 0.01f) continue;  // the trunk's foot
      const glm::vec2 along = glm::normalize(glm::vec2(street.back() - street.front())),
                      away = glm::vec2(p - street.front());
      EXPECT_GT(std::abs(along.x * away.y - along.y * away.x), 5.0f) << "on the street";
      EXPECT_FALSE(p.x > house.min.x && p.x < house.max.x && p.y > house.min.y && p.y < house.max.y);
    }
  }
  const std::size_t trees = triangles / 12, room = std::size_t(137 * 111 / 49);
  EXPECT_LT(trees, room);
  EXPECT_GT(trees, room * 7 / 10);
}

std::size_t count(const Read& town, const std::string& name) {
  std::size_t triangles = 0;
  for (const Part& part : town.model->parts)
    triangles += part.object == name ? part.mesh.triangle_count() : 0;
  return triangles;
}

TEST(Osm, PondsInWoodsHaveNoTreesAndMissingNodesAreNamedOnce) {
  const Read dry = read(osm(wood({{"natural", "wood"}})));
  const Read wet = read(osm(wood({{"natural", "wood"}}) + way(203, "43 42 14 43", {{"natural", "water"}})));
  ASSERT_TRUE(dry.model && wet.model);
  EXPECT_LT(count(wet, "SolitaryVegetationObject wood"), count(dry, "SolitaryVegetationObject wood"));
  const Read cut = read(osm(way(200, "1 2 3 99 4 1", {{"natural", "wood"}})));
  ASSERT_TRUE(cut.model);
  const std::size_t first = cut.warnings.find("its node 99 is not in the file");
  ASSERT_NE(first, std::string::npos) << cut.warnings;
  EXPECT_EQ(cut.warnings.find("its node 99", first + 1), std::string::npos) << cut.warnings;
}

TEST(Osm, WoodsHaveTheLeavesOfTheirTags) {
  const std::string leaves = "SolitaryVegetationObject wood", needles = leaves + " needleleaved";
  const Read spruces = read(osm(wood({{"landuse", "forest"}, {"leaf_type", "needleleaved"}})));
  EXPECT_EQ(count(spruces, leaves), 0u);
  EXPECT_GT(count(spruces, needles), 0u);
  const Read mixed = read(osm(wood({{"landuse", "forest"}, {"leaf_type", "mixed"}})));
  EXPECT_GT(count(mixed, leaves), count(mixed, needles) / 2);
  EXPECT_GT(count(mixed, needles), count(mixed, leaves) / 2);
}

TEST(Osm, StreetsThatCannotBeMadeAreLeftOutTogether) {
  std::string equal, star, ends;
  for (int i = 0; i < 500; ++i) {
    equal += way(1000 + i, "11 13", {{"highway", "residential"}});
    const double angle = 0.01256 * i;
    ends += fmt::format("<node id=\"{}\" lat=\"{:.7f}\" lon=\"{:.7f}\"/>", 100 + i,
                        52.16 + 0.0009 * std::sin(angle), 4.4905 + 0.0014 * std::cos(angle));
    star += way(1000 + i, fmt::format("14 {}", 100 + i), {{"highway", "residential"}});
  }
  const Read one = read(osm(equal));
  ASSERT_TRUE(one.model) << to_string(one.model.errors());
  ASSERT_EQ(one.model->roads.size(), 1u);
  EXPECT_EQ(one.model->roads[0].name, "way 1000");
  EXPECT_NE(one.warnings.find("lies along"), std::string::npos) << one.warnings;
  const Read crowded = read(osm(ends + star));
  ASSERT_TRUE(crowded.model) << to_string(crowded.model.errors());
  EXPECT_GT(crowded.model->roads.size(), 10u);
  EXPECT_LE(crowded.model->roads.size(), 64u);
  EXPECT_TRUE(build_road_graph(crowded.model->roads));
}

TEST(Osm, StreetsBeyondEveryNetworkAreLeftOutTogether) {
  std::string nodes, streets;
  for (int i = 0; i < 200; ++i) {
    nodes += fmt::format(R"(<node id="{}" lat="{:.3f}" lon="4.4"/><node id="{}" lat="{:.3f}" lon="5.4"/>)",
                         100 + 2 * i, 50.0 + 0.002 * i, 101 + 2 * i, 50.0 + 0.002 * i);
    streets += way(1000 + i, fmt::format("{} {}", 100 + 2 * i, 101 + 2 * i), {{"highway", "residential"}});
  }
  const Read wide = read("<osm version=\"0.6\">" + nodes + streets + "</osm>");
  ASSERT_TRUE(wide.model) << to_string(wide.model.errors());
  EXPECT_TRUE(wide.model->roads.empty());
  EXPECT_NE(wide.warnings.find("km of lanes; expected 20000 km at most; its streets are left out"),
            std::string::npos)
      << wide.warnings.substr(0, 2000);
}

TEST(Osm, LargeWoodsAreThinnedWithAWarning) {
  // The second outline crosses itself: its areas cancel each other.
  for (const char* outline : {"1 2 3 4 1", "1 3 2 4 1"}) {
    const Read wide =
        read(R"(<osm version="0.6"><node id="1" lat="52.10" lon="4.40"/><node id="2" lat="52.10" lon="4.50"/>
<node id="3" lat="52.20" lon="4.50"/><node id="4" lat="52.20" lon="4.40"/>)" +
             way(100, outline, {{"natural", "wood"}}) + "</osm>");
    ASSERT_TRUE(wide.model) << to_string(wide.model.errors());
    EXPECT_NE(wide.warnings.find("ha: their trees stand"), std::string::npos) << wide.warnings;
    const std::size_t trees = count(wide, "SolitaryVegetationObject wood") / 12;
    EXPECT_LE(trees, max_wood_trees * 11 / 10) << outline;
    EXPECT_GT(trees, max_wood_trees * 9 / 10) << outline;
  }
}

TEST(Osm, LongRowsOfTreesAreThinnedWithAWarning) {
  std::string there_and_back;
  for (int i = 0; i < 5; ++i) there_and_back += "31 32 ";
  const Read rows = read(osm(R"(<node id="31" lat="52.1" lon="4.4"/><node id="32" lat="52.1" lon="5.4"/>)" +
                             way(100, there_and_back, {{"natural", "tree_row"}})));
  ASSERT_TRUE(rows.model) << to_string(rows.model.errors());
  EXPECT_NE(rows.warnings.find("km long: their trees stand"), std::string::npos) << rows.warnings;
  EXPECT_NEAR(double(count(rows, "SolitaryVegetationObject")) / 12.0, double(max_row_trees), 2.0);
}

TEST(Osm, TreesWithNeedlesSaySoAndAreSlim) {
  const auto tree = [](const std::string& tags) {
    return read(osm(
        R"(<node id="31" lat="52.1600" lon="4.4910"><tag k="natural" v="tree"/><tag k="height" v="12"/>)" +
        tags + "</node>"));
  };
  const Read larch = tree(R"(<tag k="genus" v="Larix"/><tag k="leaf_type" v="needleleaved"/>)"),
             lime = tree("");
  const Bounds slim = bounds_of(*larch.model, "SolitaryVegetationObject Larix needleleaved"),
               wide = bounds_of(*lime.model, "SolitaryVegetationObject");
  EXPECT_LT(slim.size().x, 0.8f * wide.size().x);
  EXPECT_NEAR(slim.max.z, 12.0f, 1e-3f);
}

TEST(Osm, HedgesAndWallsStandAndRailsLie) {
  const Read town =
      read(osm(way(100, "1 2", {{"barrier", "hedge"}, {"height", "2"}}) +
               way(101, "11 12 13", {{"railway", "tram"}}) + way(102, "3 4", {{"railway", "rail"}})));
  ASSERT_TRUE(town.model) << to_string(town.model.errors());
  EXPECT_NEAR(bounds_of(*town.model, "CityFurniture").max.z, 2.0f, 1e-3f);
  EXPECT_NEAR(area_m2(*town.model, "Railway"), 3.4 * double(wide_m), 1.0) << "ballast of the railway alone";
}

TEST(Osm, ZebrasCrossTheRoadThatTheyLieOn) {
  const Read town = read(osm(R"(<node id="12" lat="52.1595" lon="4.4905"><tag k="highway" v="crossing"/>
<tag k="crossing" v="zebra"/></node>)" +
                             way(100, "11 12 13", {{"highway", "residential"}})));
  ASSERT_TRUE(town.model) << to_string(town.model.errors());
  EXPECT_NEAR(area_m2(*town.model, "CityFurniture"), 6 * 0.5 * 3.0, 1.6) << "stripes over 6 m";
}

TEST(Osm, CrossingsArePaintedAsTheirTagsSay) {
  const auto paint_m2 = [](const std::string& key, const std::string& value) {
    const Read town = read(osm(
        fmt::format(
            R"(<node id="12" lat="52.1595" lon="4.4905"><tag k="highway" v="crossing"/><tag k="{}" v="{}"/></node>)",
            key, value) +
        way(100, "11 12 13", {{"highway", "residential"}})));
    return town.model ? area_m2(*town.model, "CityFurniture") : -1.0;
  };
  const double stripes_m2 = paint_m2("crossing", "zebra");
  EXPECT_EQ(paint_m2("crossing", "uncontrolled"), stripes_m2);
  EXPECT_EQ(paint_m2("crossing_ref", "zebra"), stripes_m2);
  EXPECT_EQ(paint_m2("crossing:markings", "zebra:double"), stripes_m2);
  EXPECT_NEAR(paint_m2("crossing:markings", "lines"), 2 * 6.0 * 0.15, 0.01) << "from kerb to kerb";
  for (const char* broken : {"dashes", "dots"}) {
    EXPECT_GT(paint_m2("crossing:markings", broken), 0.2) << broken;
    EXPECT_LT(paint_m2("crossing:markings", broken), 1.2) << broken;
  }
  for (const char* bare : {"unmarked", "no"}) EXPECT_EQ(paint_m2("crossing", bare), 0.0) << bare;
}

TEST(Osm, TrafficLightsOnStreetsAreNodesOfTheModel) {
  const auto lights = [](const std::string& tags, double lat) {
    const Read town = read(osm(fmt::format(R"(<node id="12" lat="{}" lon="4.4905">{}</node>)", lat, tags) +
                               way(100, "11 12 13", {{"highway", "residential"}})));
    Object object;
    object.model = std::make_shared<const Model>(*town.model);
    return places_on_map(object, map_signal_node);
  };
  const std::vector<glm::vec3> found = lights(R"(<tag k="highway" v="traffic_signals"/>)", 52.1595);
  ASSERT_EQ(found.size(), 1u);
  const std::string crossing = R"(<tag k="highway" v="crossing"/>)";
  EXPECT_EQ(lights(crossing + R"(<tag k="crossing" v="traffic_signals"/>)", 52.1595).size(), 1u);
  EXPECT_EQ(lights(crossing + R"(<tag k="crossing:signals" v="yes"/>)", 52.1595).size(), 1u);
  EXPECT_EQ(lights(crossing + R"(<tag k="crossing" v="zebra"/>)", 52.1595).size(), 0u);
  const Read town = read(osm(way(100, "11 12 13", {{"highway", "residential"}})));
  const std::vector<glm::vec3>& path = town.model->roads.front().path;
  EXPECT_TRUE(std::ranges::any_of(path, [&](glm::vec3 p) { return glm::distance(p, found.front()) < 0.01f; }))
      << "on the street, in the model's frame";
  const Read beside =
      read(osm(R"(<node id="77" lat="52.1595" lon="4.4907"><tag k="highway" v="traffic_signals"/></node>)" +
               way(100, "11 12 13", {{"highway", "residential"}})));
  Object object;
  object.model = std::make_shared<const Model>(*beside.model);
  EXPECT_TRUE(places_on_map(object, map_signal_node).empty()) << "on no street";
  const Read stop = read(osm(
      R"(<node id="77" lat="52.15953" lon="4.4907"><tag k="highway" v="bus_stop"/></node>
<node id="78" lat="52.15947" lon="4.4907"><tag k="public_transport" v="platform"/><tag k="bus" v="yes"/></node>
<node id="79" lat="52.15940" lon="4.4907"><tag k="public_transport" v="platform"/><tag k="tram" v="yes"/></node>)" +
      way(100, "11 12 13", {{"highway", "residential"}})));
  object.model = std::make_shared<const Model>(*stop.model);
  EXPECT_EQ(places_on_map(object, map_bus_stop_node).size(), 2u) << "of buses";
}

/// The same content as a file of the other format, by libosmium.
std::filesystem::path as_pbf(const std::filesystem::path& xml) {
  osmium::io::Reader reader(osmium::io::File(xml.string()));
  const std::filesystem::path pbf = xml.parent_path() / "quarter.osm.pbf";
  osmium::io::Writer writer(osmium::io::File(pbf.string()), reader.header(), osmium::io::overwrite::allow);
  while (osmium::memory::Buffer buffer = reader.read()) writer(std::move(buffer));
  writer.close();
  return pbf;
}

TEST(Osm, PbfSaysTheSameAsXml) {
  const TestFolder folder;
  const auto xml =
      folder.write("quarter.osm", osm(way(100, "1 2 3 4 1", {{"building", "yes"}, {"height", "9"}}) +
                                      way(101, "11 12 13", {{"highway", "residential"}})));
  Errors warnings;
  const Result<Model> from_xml = read_osm(xml, warnings), from_pbf = read_osm(as_pbf(xml), warnings);
  ASSERT_TRUE(from_xml && from_pbf);
  EXPECT_EQ(to_string(warnings), "");
  EXPECT_EQ(from_pbf->triangle_count(), from_xml->triangle_count());
  EXPECT_EQ(from_pbf->origin, from_xml->origin);
  ASSERT_EQ(from_pbf->roads.size(), 1u);
  EXPECT_EQ(from_pbf->roads[0].path, from_xml->roads[0].path);
  std::filesystem::rename(folder.path() / "quarter.osm.pbf", folder.path() / "QUARTER.OSM.PBF");
  EXPECT_TRUE(read_osm(folder.path() / "QUARTER.OSM.PBF", warnings)) << "extensions count in any case";
}

/// script/fuzz_seeds has written them.
TEST(Osm, TheFuzzersPbfSeedsSayTheSameAsTheirMaps) {
  const std::filesystem::path corpus(source_folder() / "src/formats/city_models/fuzz/corpus");
  int seeds = 0;
  for (const auto& seed : std::filesystem::directory_iterator(corpus / "osm_pbf")) {
    const std::string file = seed.path().filename().string(), name = file.substr(0, file.find_first_of("_."));
    Errors warnings;
    const Result<Model> from_pbf = read_osm(seed.path(), warnings),
                        from_xml = read_osm(corpus / "osm" / (name + ".osm"), warnings);
    ASSERT_TRUE(from_xml && from_pbf) << file << to_string(warnings);
    EXPECT_EQ(from_pbf->triangle_count(), from_xml->triangle_count()) << file;
    EXPECT_EQ(from_pbf->origin, from_xml->origin) << file;
    ++seeds;
  }
  EXPECT_GE(seeds, 5);
}

TEST(Osm, PackedMapsAreReadAsTheyAre) {
  const TestFolder folder;
  const std::string text = osm(way(100, "1 2 3 4 1", {{"building", "yes"}, {"height", "9"}}));
  Errors warnings;
  std::optional<glm::dvec2> place_deg;
  for (const auto& [name, bytes] : {std::pair("quarter.osm.gz", formats::gzipped(text)),
                                    std::pair("quarter.OSM.BZ2", formats::bzipped(text))}) {
    const Result<Model> map = read_osm(folder.write(name, bytes), warnings, {}, &place_deg);
    ASSERT_TRUE(map) << to_string(map.errors());
    EXPECT_EQ(map->triangle_count(), read(text).model->triangle_count());
    ASSERT_TRUE(place_deg);
    EXPECT_NEAR(place_deg->y, 52.16, 0.01);
  }
}

TEST(Osm, DamagedPbfNeverCrashes) {
  const TestFolder folder;
  const auto pbf = as_pbf(folder.write("quarter.osm", osm(way(100, "1 2 3 4 1", {{"building", "yes"}}))));
  const std::string good = *read_file(pbf);
  Random random(5);
  for (int round = 0; round < 100; ++round) {
    std::string bytes = good.substr(0, round % 3 ? good.size() : std::size_t(random.index(int(good.size()))));
    for (int change = 0; change <= round % 4 && !bytes.empty(); ++change)
      bytes[std::size_t(random.index(int(bytes.size())))] = char(random.index(256));
    Errors warnings;
    (void)read_osm(folder.write("damaged.pbf", bytes), warnings);
  }
}

TEST(Osm, ARoadAlongAnotherIsLeftOutByItsName) {
  const Read town = read(
      osm(way(100, "11 12 13", {{"highway", "primary"}}) + way(101, "11 12 13", {{"highway", "primary"}})));
  ASSERT_TRUE(town.model) << to_string(town.model.errors());
  EXPECT_EQ(town.model->roads.size(), 1u);
  EXPECT_NE(town.warnings.find("way 101"), std::string::npos) << town.warnings;
}

TEST(Osm, TheOriginIsOnTheMap) {
  const Read house = read(osm(way(100, "1 2 3 4 1", {{"building", "yes"}})));
  ASSERT_TRUE(house.model);
  const MapProjection utm = MapProjection::utm({4.4905, 52.16});
  EXPECT_EQ(utm.system(), "EPSG:32631");
  EXPECT_EQ(house.model->map, utm.system());
  const glm::dvec2 corner = utm({4.49, 52.16}) - glm::dvec2(house.model->origin);
  const Bounds walls = bounds_of(*house.model, "WallSurface");
  EXPECT_NEAR(walls.min.x, float(corner.x), 0.3f);
  EXPECT_NEAR(walls.min.y, float(corner.y), 0.3f);
}

TEST(MapProjection, KnowsTheMapOfTheWorld) {
  // on a central meridian easting is 500 km; the equator's northing is 0, or 10,000 km for the south
  EXPECT_NEAR(MapProjection::utm({3.0, 0.0})({3.0, 0.0}).x, 500'000.0, 1e-6);
  EXPECT_NEAR(MapProjection::utm({3.0, 0.0})({3.0, 0.0}).y, 0.0, 1e-6);
  EXPECT_NEAR(MapProjection::utm({3.0, -1e-9})({3.0, -1e-9}).y, 10'000'000.0, 1e-3);
  // the Eiffel tower: 31N 448252 5411933
  const glm::dvec2 eiffel = MapProjection::utm({2.2945, 48.8582})({2.2945, 48.8582});
  EXPECT_NEAR(eiffel.x, 448'252.0, 10.0);
  EXPECT_NEAR(eiffel.y, 5'411'933.0, 30.0);
}

void expect_refused(const std::string& text, const std::string& expected) {
  const Read bad = read(text);
  ASSERT_FALSE(bad.model) << expected;
  EXPECT_NE(to_string(bad.model.errors()).find(expected), std::string::npos) << to_string(bad.model.errors());
}

TEST(Osm, HostileFilesAreRefusedByName) {
  expect_refused("", "no well-formed XML");
  expect_refused("<osm version='0.6'><node id='1' lat='1' lon='1'></osm>", "no well-formed XML");
  expect_refused("<osm><node id='1' lat='1' lon='1'/></osm>", "version");
  expect_refused("<!DOCTYPE osm [<!ENTITY a SYSTEM 'file:///etc/passwd'>]><osm>&a;</osm>", "DOCTYPE");
  expect_refused("<gpx/>", "<gpx>; expected <osm>");
  expect_refused("<osm version='0.6'/>", "has no nodes, and so no place to show; export an area");
  expect_refused("<osm version='0.6'><node id='1' lat='91' lon='0'/></osm>", "has no nodes");
  expect_refused("<osm version='0.6'><node id='1' lat='0' lon='0'/><node id='2' lat='40' lon='5'/></osm>",
                 "cut out");
}

TEST(Osm, AFileThatShowsNothingSaysWhatItHasAndWhatToDo) {
  const TestFolder folder;
  const auto file =
      folder.write("line.osm",
                   "<osm version='0.6'><node id='1' lat='52' lon='4'/><node id='2' lat='52.001' "
                   "lon='4'/>" +
                       way(100, "1 2", {{"power", "line"}}) + "</osm>");
  const auto said = [&](const GroundOnMap& ground) {
    Errors warnings;
    const Result<Model> model = read_osm(file, warnings, ground);
    EXPECT_FALSE(model);
    return model ? "" : to_string(model.errors());
  };
  for (const char* words : {"2 nodes and 1 ways", "its bounds enclose no ground", "export an area"})
    EXPECT_NE(said({}).find(words), std::string::npos) << said({});
  const std::string over_terrain = said([](glm::dvec2) { return 5.0; });
  EXPECT_EQ(over_terrain.find("bounds"), std::string::npos) << over_terrain;
  EXPECT_NE(over_terrain.find("export an area"), std::string::npos) << over_terrain;
}

TEST(Osm, DamagedFilesNeverCrash) {
  const std::string good = osm(way(100, "1 2 3 4 1", {{"building", "yes"}, {"roof:shape", "hipped"}}) +
                               way(101, "11 12 13", {{"highway", "primary"}, {"lanes", "2"}}));
  Random random(11);
  for (int round = 0; round < 300; ++round) {
    std::string bytes = good;
    for (int change = 0; change <= round % 4; ++change)
      bytes[std::size_t(random.index(int(bytes.size())))] = "0123456789.-<>\"/ax"[random.index(18)];
    (void)read(bytes);
  }
}

}  // namespace
}  // namespace parvis::scene

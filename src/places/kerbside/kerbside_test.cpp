// Trees, cars and furniture along the streets of scripts.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "life/vegetation/scene_plant.h"
#include "places/kerbside/map_trees.h"
#include "rooms/rooms.h"
#include "scene/script/live_scene.h"
#include "scene/script/test_script.h"

namespace parvis::kerbside {
namespace {

/// A ground, and two streets that cross on it.
constexpr const char* streets =
    "terrain_plane()\n"
    "road(path=\"-100 0, 0 0, 100 0\")\n"
    "road(path=\"0 -100, 0 0, 0 100\")\n"
    "paving()\n"
    "camera(name=\"eye\", position=\"0 -9 2\", target=\"0 0 1\")\n";

class Kerbside : public scene::ScriptTest<> {
 protected:
  Kerbside() : ScriptTest(rooms::all_registries()) {}
  scene::Scene load(const std::string& text) const { return scene_of(streets + text); }
  std::string errors_of(const std::string& text) const { return ScriptTest::errors_of(streets + text); }
  static std::vector<scene::Object> called(const scene::Scene& scene, const std::string& name) {
    std::vector<scene::Object> found;
    for (const scene::Object& object : scene.objects)
      if (object.name.starts_with(name)) found.push_back(object);
    return found;
  }
};

glm::vec2 place_of(const scene::Object& object) { return glm::vec2(object.world_from_model[3]); }

float distance_to_lanes(const scene::Scene& scene, glm::vec2 p) {
  float nearest = 1e9f;
  for (const scene::Lane& lane : scene.roads.lanes)
    for (std::size_t i = 0; i + 1 < lane.points.size(); ++i) {
      const glm::vec2 a(lane.points[i]), b(lane.points[i + 1]);
      const float t = glm::clamp(glm::dot(p - a, b - a) / glm::dot(b - a, b - a), 0.0f, 1.0f);
      nearest = std::min(nearest, glm::distance(p, glm::mix(a, b, t)) - 0.5f * lane.width_m);
    }
  return nearest;
}

TEST_F(Kerbside, GrownPlantsStandWhereTreesWould) {
  const scene::Scene trees = load("streetTrees(spacing=10, height=7)\n"),
                     plants = load("streetTrees(spacing=10, height=7, kind=\"plane\")\n");
  const std::vector<scene::Object> objects = called(trees, "street tree");
  const std::vector<vegetation::ScenePlant>& grown = vegetation::scene_plants(plants);
  ASSERT_GT(grown.size(), 10u);
  ASSERT_EQ(grown.size(), objects.size());
  EXPECT_TRUE(called(plants, "street tree").empty());
  for (std::size_t i = 0; i < grown.size(); ++i) {
    EXPECT_EQ(glm::vec2(grown[i].world_from_plant[3]), place_of(objects[i]));
    EXPECT_EQ(grown[i].shape->recipe.height_m, 7.0f);
  }
  EXPECT_NE(errors_of("streetTrees(kind=\"palm\")\n").find("plane"), std::string::npos);
  EXPECT_NE(errors_of("streetTrees(kind=\"orange\", height=20)\n").find("between 1 and 8 m"),
            std::string::npos);
}

TEST_F(Kerbside, ANameAndAKindContradictEachOther) {
  folder_.write("post.obj", "v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n");
  const std::string post = "model(name=\"post\", file=\"post.obj\", visible=0)\n";
  const std::string errors = errors_of(post + "streetTrees(of=\"post\", kind=\"plane\")\n");
  EXPECT_NE(errors.find("scene.xp:7"), std::string::npos) << errors;
  EXPECT_NE(errors.find("one of the two"), std::string::npos) << errors;
  load(post + "streetTrees(of=\"post\")\n");
}

TEST_F(Kerbside, NothingStandsInGrownPlants) {
  const std::string planted =
      "plant(kind=\"oak\", position=\"40 4.6 0\")\nplant(kind=\"hedge\", length=30, height=1, position=\"-60 "
      "4.4 0\")\n";
  const auto close = [&](const scene::Scene& scene) {
    return std::ranges::count_if(called(scene, "parked car"), [](const scene::Object& car) {
      const glm::vec2 p = place_of(car);
      return glm::distance(p, {40, 4.6f}) < 1.5f || (p.x > -74 && p.x < -46 && p.y > 3 && p.y < 6);
    });
  };
  EXPECT_GT(close(load("parkedCars(share=1)\n")), 3);
  EXPECT_EQ(close(load(planted + "parkedCars(share=1)\n")), 0);
  EXPECT_EQ(close(load("parkedCars(share=1)\n" + planted)), 0) << "whatever the order";
}

TEST_F(Kerbside, NothingStandsAlongMotorways) {
  const auto count = [&](int speed_km_h) {
    const auto loaded = ScriptTest::load(
        fmt::format("terrain_plane()\nroad(path=\"-100 0, 100 0\", speed_km_h={})\npaving()\n"
                    "camera(name=\"eye\", position=\"0 -9 2\", target=\"0 0 1\")\n"
                    "streetTrees()\nparkedCars()\nstreetFurniture(kind=\"lamps\")\n",
                    speed_km_h));
    EXPECT_TRUE(loaded) << to_string(loaded.errors());
    if (!loaded) return std::size_t(0);
    std::size_t found = 0;
    for (const char* name : {"street tree", "street lamp", "parked car"})
      found += called(loaded->scene, name).size();
    return found;
  };
  EXPECT_GT(count(80), 40u);
  EXPECT_EQ(count(100), 0u);
}

TEST_F(Kerbside, NothingStandsInTunnels) {
  const auto lamps = [&](const char* tunnel) {
    std::string map =
        R"(<osm version="0.6"><bounds minlat="48" minlon="11" maxlat="48.004" maxlon="11.001"/>)";
    const double places[] = {48.0001, 48.0015, 48.0025, 48.0039};
    for (int i = 0; i < 4; ++i)
      map += fmt::format("<node id=\"{}\" version=\"1\" lat=\"{}\" lon=\"11.0005\"/>", i + 1, places[i]);
    for (int i = 1; i < 4; ++i)
      map += fmt::format(
          "<way id=\"{}\" version=\"1\"><nd ref=\"{}\"/><nd ref=\"{}\"/><tag k=\"highway\" v=\"secondary\"/>"
          "<tag k=\"tunnel\" v=\"{}\"/></way>",
          i, i, i + 1, i == 2 ? tunnel : "no");
    folder_.write("map.osm", map + "</osm>");
    const auto loaded = ScriptTest::load(
        "model(name=\"map\", file=\"map.osm\")\nstreets(of=\"map\")\n"
        "streetFurniture(kind=\"lamps\", spacing=6)\n"
        "camera(name=\"eye\", position=\"0 -9 2\", target=\"0 0 1\")\n");
    EXPECT_TRUE(loaded) << to_string(loaded.errors());
    return loaded ? called(loaded->scene, "street lamp") : std::vector<scene::Object>();
  };
  const auto in_the_middle = [](const std::vector<scene::Object>& objects) {
    return std::ranges::count_if(
        objects, [](const scene::Object& object) { return std::abs(place_of(object).y) < 50.0f; });
  };
  const std::vector<scene::Object> dug = lamps("yes"), level = lamps("no");
  EXPECT_GT(in_the_middle(level), 20);
  EXPECT_EQ(in_the_middle(dug), 0);
  EXPECT_TRUE(std::ranges::any_of(dug, [](const scene::Object& lamp) {
    return lamp.world_from_model[3].z < -1.0f;
  })) << "in the trenches they do";
}

TEST_F(Kerbside, NothingStandsOnBridgesNorGrowsThroughThem) {
  const auto near_the_bridge = [&](const char* bridge) {
    std::string map =
        R"(<osm version="0.6"><bounds minlat="48" minlon="11" maxlat="48.003" maxlon="11.003"/>)";
    const auto add_node = [&](int id, double lat, double lon) {
      map += fmt::format("<node id=\"{}\" version=\"1\" lat=\"{}\" lon=\"{}\"/>", id, lat, lon);
    };
    const auto add_way = [&](int id, int from, int to, const std::string& tags) {
      map += fmt::format("<way id=\"{}\" version=\"1\"><nd ref=\"{}\"/><nd ref=\"{}\"/>{}</way>", id, from,
                         to, "<tag k=\"highway\" v=\"secondary\"/>" + tags);
    };
    add_node(1, 48.0001, 11.0015), add_node(2, 48.0012, 11.0015), add_node(3, 48.0018, 11.0015);
    add_node(4, 48.0029, 11.0015), add_node(5, 48.0015, 11.0001), add_node(6, 48.0015, 11.0029);
    add_way(1, 1, 2, ""), add_way(3, 3, 4, ""), add_way(4, 5, 6, "");
    add_way(2, 2, 3, fmt::format("<tag k=\"bridge\" v=\"{}\"/><tag k=\"layer\" v=\"1\"/>", bridge));
    folder_.write("map.osm", map + "</osm>");
    const auto loaded = ScriptTest::load(
        "model(name=\"map\", file=\"map.osm\")\nstreets(of=\"map\")\nstreetTrees(height=9)\n"
        "parkedCars(share=1)\nstreetFurniture(kind=\"lamps\")\n"
        "camera(name=\"eye\", position=\"0 -9 2\", target=\"0 0 1\")\n");
    EXPECT_TRUE(loaded) << to_string(loaded.errors());
    std::array<std::ptrdiff_t, 2> counts{};  // where the bridge is; along the street below, away from it
    for (const char* name : {"street tree", "parked car", "street lamp"})
      for (const scene::Object& object : called(loaded->scene, name)) {
        const glm::vec2 p = place_of(object);
        counts[0] += std::abs(p.x) < 6.5f && std::abs(p.y) < 30.0f;
        counts[1] += std::abs(p.x) > 25.0f && std::abs(p.y) < 30.0f;
      }
    return counts;
  };
  EXPECT_EQ(near_the_bridge("yes")[0], 0);
  EXPECT_GT(near_the_bridge("yes")[1], 10);
  EXPECT_GT(near_the_bridge("no")[0], 0);
}

TEST_F(Kerbside, TreesOfAMapGrow) {
  folder_.write("map.osm",
                R"(<osm version="0.6"><bounds minlat="48" minlon="11" maxlat="48.001" maxlon="11.002"/>
    <node id="1" version="1" lat="48.0004" lon="11.0006"><tag k="natural" v="tree"/><tag k="species" v="Quercus robur"/>
      <tag k="height" v="9"/></node>
    <node id="2" version="1" lat="48.0006" lon="11.0006"><tag k="natural" v="tree"/></node></osm>)");
  const std::string map = "model(name=\"map\", file=\"map.osm\")\n";
  const scene::Scene scene = load(map + "grownTrees(of=\"map\")\n");
  const std::vector<vegetation::ScenePlant>& grown = vegetation::scene_plants(scene);
  ASSERT_EQ(grown.size(), 2u);
  int oaks = 0;
  for (const vegetation::ScenePlant& plant : grown) {
    const bool is_oak = plant.shape->kind().name == "oak";
    oaks += is_oak;
    EXPECT_EQ(plant.shape->kind().name, is_oak ? "oak" : "plane");
    if (is_oak) {
      const float scale = glm::length(glm::vec3(plant.world_from_plant[2]));
      EXPECT_NEAR(scale * plant.shape->recipe.height_m, 9.0f, 0.01f);
    }
  }
  EXPECT_EQ(oaks, 1);
  for (const scene::Object& object : called(scene, "map"))
    for (const scene::Part& part : object.model->parts)
      EXPECT_FALSE(part.object.starts_with("SolitaryVegetationObject")) << "none stands there twice";
  EXPECT_NE(errors_of(map + "grownTrees(of=\"town\")\n").find("no object is called \"town\""),
            std::string::npos);
}

/// How many parts of the object are trees of a map.
std::ptrdiff_t map_trees_in(const scene::Object& object) {
  return std::ranges::count_if(object.model->parts, [](const scene::Part& part) {
    return part.object.starts_with("SolitaryVegetationObject");
  });
}

constexpr const char* map_of_a_tree =
    R"(<osm version="0.6"><bounds minlat="48" minlon="11" maxlat="48.001" maxlon="11.002"/>
    <node id="1" version="1" lat="48.0004" lon="11.0006"><tag k="natural" v="tree"/></node></osm>)";

TEST_F(Kerbside, TreesOfAMapStayTakenWhenTheMapIsRebuilt) {
  folder_.write("map.osm", map_of_a_tree);
  auto loaded = ScriptTest::load(std::string(streets) +
                                 "model(name=\"map\", file=\"map.osm\", positions=\"0 0 0, 300 0 0\")\n"
                                 "model(name=\"as it was\", file=\"map.osm\")\n"
                                 "grownTrees(of=\"map*\")\n");
  ASSERT_TRUE(loaded) << to_string(loaded.errors());
  scene::Scene scene = std::move(loaded->scene);
  scene::LiveScene live(std::move(loaded->script));
  const std::vector<scene::Object> before = scene.objects;
  ASSERT_EQ(called(scene, "map").size(), 2u);
  EXPECT_EQ(called(scene, "map")[0].model, called(scene, "map")[1].model) << "one copy for both";
  for (const char* name : {"map", "as it was"})
    for (const bool is_visible : {false, true}) {
      live.set(*live.find(name), "visible", is_visible);
      ASSERT_TRUE(live.refresh(scene).empty());
      ASSERT_EQ(scene.objects.size(), before.size());
      for (const scene::Object& object : called(scene, name)) EXPECT_EQ(object.is_visible, is_visible);
    }
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_EQ(scene.objects[i].model, before[i].model) << before[i].name;
    EXPECT_EQ(scene.objects[i].is_visible, before[i].is_visible) << before[i].name;
  }
  for (const scene::Object& object : called(scene, "map")) EXPECT_EQ(map_trees_in(object), 0);
  EXPECT_GT(map_trees_in(called(scene, "as it was").at(0)), 0) << "grownTrees does not name it";
  EXPECT_EQ(vegetation::scene_plants(scene).size(), 2u);
}

TEST_F(Kerbside, TreesOfAMapStayTakenWhereAScenarioPaintsTheMap) {
  folder_.write("map.osm", map_of_a_tree);
  auto loaded = ScriptTest::load(std::string(streets) +
                                 "model(name=\"map\", file=\"map.osm\") { material(name=\"paint\", "
                                 "roughness=0.5) }\n"
                                 "grownTrees(of=\"map\")\n"
                                 "scenario(name=\"wet\") { override(of=\"paint\", roughness=0.1) }\n");
  ASSERT_TRUE(loaded) << to_string(loaded.errors());
  scene::Scene scene = std::move(loaded->scene);
  scene::LiveScene live(std::move(loaded->script));
  ASSERT_TRUE(live.prepare_scenarios(scene));
  ASSERT_TRUE(live.choose(scene, "wet"));
  for (const scene::Object& object : called(scene, "map")) {
    EXPECT_EQ(map_trees_in(object), 0);
    if (object.is_visible) {
      EXPECT_EQ(object.model->materials.back().roughness, 0.1f);
    }
  }
  EXPECT_EQ(vegetation::scene_plants(scene).size(), 1u);
}

/// Where its visible plants stand.
std::vector<glm::vec2> seen_plants(const scene::Scene& scene) {
  std::vector<glm::vec2> places;
  for (const vegetation::ScenePlant& plant : vegetation::scene_plants(scene))
    if (plant.is_visible) places.emplace_back(plant.world_from_plant[3]);
  return places;
}

TEST_F(Kerbside, TreesOfAMapFollowTheMap) {
  folder_.write("map.osm", map_of_a_tree);
  folder_.write("other.osm",
                R"(<osm version="0.6"><bounds minlat="48" minlon="11" maxlat="48.001" maxlon="11.002"/>
    <node id="1" version="1" lat="48.0005" lon="11.0007"><tag k="natural" v="tree"/></node>
    <node id="2" version="1" lat="48.0003" lon="11.0016"><tag k="natural" v="tree"/></node></osm>)");
  auto loaded =
      ScriptTest::load(std::string(streets) +
                       "model(name=\"map\", file=\"map.osm\", visible=0)\n"
                       "group(name=\"trees\") { grownTrees(of=\"map*\") }\n"
                       "scenario(name=\"other\") { override(of=\"map\", file=\"other.osm\", visible=1) }\n"
                       "scenario(name=\"more\") { model(name=\"map of it\", file=\"other.osm\") }\n");
  ASSERT_TRUE(loaded) << to_string(loaded.errors());
  scene::Scene scene = std::move(loaded->scene);
  scene::LiveScene live(std::move(loaded->script));
  ASSERT_TRUE(live.prepare_scenarios(scene));
  const auto set = [&](const char* node, const char* attribute, scene::AttributeValue value) {
    live.set(*live.find(node), attribute, std::move(value));
    EXPECT_TRUE(live.refresh(scene).empty());
    for (const scene::Object& object : called(scene, "map")) EXPECT_EQ(map_trees_in(object), 0);
    return seen_plants(scene);
  };
  const auto choose = [&](const char* scenario) {
    EXPECT_TRUE(live.choose(scene, scenario));
    for (const scene::Object& object : called(scene, "map")) EXPECT_EQ(map_trees_in(object), 0);
    return seen_plants(scene).size();
  };
  EXPECT_TRUE(seen_plants(scene).empty()) << "hidden with the map";
  EXPECT_TRUE(set("trees", "visible", false).empty());
  const std::vector<glm::vec2> shown = set("map", "visible", true);
  ASSERT_EQ(shown.size(), 1u);
  const std::vector<glm::vec2> moved = set("map", "position", glm::vec3(5, 7, 0));
  ASSERT_EQ(moved.size(), 1u);
  EXPECT_NEAR(glm::distance(moved[0], shown[0] + glm::vec2(5, 7)), 0.0f, 1e-3f);
  EXPECT_TRUE(set("map", "visible", false).empty());
  EXPECT_EQ(set("map", "position", glm::vec3(0)).size(), 0u);
  EXPECT_EQ(choose("other"), 2u) << "of the other file, and none of the first";
  EXPECT_EQ(choose("more"), 2u);
  EXPECT_EQ(choose("base"), 0u);
  const std::size_t objects = scene.objects.size();
  EXPECT_EQ(choose("other"), 2u);
  EXPECT_EQ(scene.objects.size(), objects) << "objects find their places again";
}

TEST_F(Kerbside, FlatTreesOfAMapGrowToTheLeastHeight) {
  folder_.write("flat.obj", "o tree\nv 20 0 20\nv 21 0 20\nv 20 0 21\nf 1 2 3\n");
  const scene::Scene scene =
      load("model(name=\"map\", file=\"flat.obj\")\ngrownTrees(of=\"map\", target=\"*\")\n");
  ASSERT_EQ(vegetation::scene_plants(scene).size(), 1u);
  const vegetation::ScenePlant& plant = vegetation::scene_plants(scene).front();
  EXPECT_NEAR(plant.world_from_plant[2].z * plant.shape->recipe.height_m, 3.0f, 1e-4f);
}

/// Triangles with these lowest and highest corners, which stand about a place; y is up.
std::string spindle(glm::vec2 at, float radius, float low, float high, int& points) {
  const std::string text =
      fmt::format("v {} {} {}\nv {} {} {}\nv {} {} {}\nv {} {} {}\n", at.x - radius, low, at.y, at.x + radius,
                  low, at.y, at.x, high, at.y - radius, at.x, high, at.y + radius);
  points += 4;
  return text + fmt::format("f {0} {1} {2}\nf {0} {1} {3}\n", points - 3, points - 2, points - 1, points);
}

TEST_F(Kerbside, PiecesOfATreeOfAMapAreOneTree) {
  int points = 0;
  std::string map = "o tree\n";
  for (const float x :
       {20.0f, 28.0f}) {  // two whose crowns overlap, each a trunk and a crown that hangs apart
    map += spindle({x, 20}, 0.2f, 0.0f, 2.9f, points);
    map += spindle({x + 0.3f, 20}, 5.0f, 3.0f, 10.0f, points);
  }
  map += spindle({48.5f, 20}, 0.5f, 0.0f, 5.0f, points);  // a crown in two halves
  for (const float x : {46.5f, 50.5f}) map += spindle({x, 20}, 2.0f, 4.0f, 9.0f, points);
  folder_.write("map.obj", map);
  const scene::Scene scene =
      load("model(name=\"map\", file=\"map.obj\")\ngrownTrees(of=\"map\", target=\"*\")\n");
  std::vector<float> heights;
  for (const vegetation::ScenePlant& plant : vegetation::scene_plants(scene)) {
    EXPECT_NEAR(plant.world_from_plant[3].z, 0.0f, 1e-4f);
    heights.push_back(plant.world_from_plant[2].z * plant.shape->recipe.height_m);
  }
  ASSERT_EQ(heights.size(), 3u);
  EXPECT_EQ(std::ranges::count_if(heights, [](float height_m) { return std::abs(height_m - 10) < 0.01f; }),
            2);
}

TEST_F(Kerbside, TreesOnATerraceDoNotHangAboveThoseBelow) {
  int points = 0;
  std::string map = "o tree\n" + spindle({20, 20}, 2.0f, 0.0f, 6.0f, points);
  map += spindle({22.5f, 20}, 2.5f, 4.0f, 12.0f, points);
  folder_.write("terrace.obj", map);
  const scene::Scene scene =
      load("model(name=\"map\", file=\"terrace.obj\")\ngrownTrees(of=\"map\", target=\"*\")\n");
  EXPECT_EQ(vegetation::scene_plants(scene).size(), 2u);
}

/// The faces of tetrahedra whose feet stand about these places.
scene::Model needles(const std::vector<glm::vec2>& places, float radius) {
  scene::Model model;
  model.materials.emplace_back();
  Mesh& mesh = model.parts.emplace_back().mesh;
  for (const glm::vec2 at : places) {
    const std::uint32_t first = std::uint32_t(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), {{at.x - radius, at.y - radius, 0},
                                                 {at.x + radius, at.y - radius, 0},
                                                 {at.x, at.y + radius, 0},
                                                 {at, 5.0f}});
    for (const std::uint32_t k : {0, 1, 3, 1, 2, 3, 2, 0, 3}) mesh.indices.push_back(first + k);
  }
  return model;
}

TEST_F(Kerbside, TreesOfAForestAreCountedAndMoreThanCanBeComparedAreRefused) {
  std::vector<glm::vec2> column, heap;
  for (int i = 0; i < 60000; ++i) column.emplace_back(0.0f, 2.0f * float(i));
  for (int i = 0; i < 20000; ++i) heap.emplace_back(0.1f * float(i % 100), 0.1f * float(i / 100));
  scene::Model forest = needles(column, 0.9f), bush = needles(heap, 50.0f);
  const Result<std::vector<MapTree>> trees = take_trees(forest, "*");
  ASSERT_TRUE(trees) << to_string(trees.errors());
  EXPECT_EQ(trees->size(), column.size());
  const Result<std::vector<MapTree>> none = take_trees(bush, "*");
  ASSERT_FALSE(none);
  EXPECT_NE(to_string(none.errors()).find("20000 pieces"), std::string::npos) << to_string(none.errors());
  EXPECT_EQ(to_string(none.errors()).find("50000"), std::string::npos) << to_string(none.errors());
}

TEST_F(Kerbside, TreesThatStandCloseAreTreesOfTheirOwn) {
  const auto planted = [&](const std::string& nodes) {
    folder_.write("close.osm",
                  "<osm version=\"0.6\"><bounds minlat=\"48\" minlon=\"11\" maxlat=\"48.001\" "
                  "maxlon=\"11.002\"/>" +
                      nodes + "</osm>");
    return vegetation::scene_plants(load("model(name=\"map\", file=\"close.osm\")\ngrownTrees(of=\"map\")\n"))
        .size();
  };
  const auto tree = [](int id, double east_m, double height_m) {
    return fmt::format(
        "<node id=\"{}\" version=\"1\" lat=\"48.0005\" lon=\"{:.8f}\"><tag k=\"natural\" v=\"tree\"/>"
        "<tag k=\"height\" v=\"{}\"/></node>",
        id, 11.0003 + east_m / 74'600.0, height_m);
  };
  std::string dense;
  for (int i = 0; i < 100; ++i) dense += tree(i + 1, i, 7 + i % 5);
  EXPECT_EQ(planted(dense), 100u) << "1 m apart";
  EXPECT_EQ(planted(tree(1, 0, 60) + tree(2, 7, 5)), 2u) << "a small tree beside a large one";
}

TEST_F(Kerbside, TreesStandOnPavementsAtBothKerbsAndKeepTheirDistance) {
  const scene::Scene scene = load("streetTrees(spacing=10)\n");
  const std::vector<scene::Object> trees = called(scene, "street tree");
  EXPECT_GT(trees.size(), 50u);  // four arms of some 80 m, two kerbs
  EXPECT_LT(trees.size(), 80u);
  for (const scene::Object& tree : trees) {
    EXPECT_GT(distance_to_lanes(scene, place_of(tree)), 0.5f) << tree.name;
    EXPECT_NEAR(tree.world_from_model[3].z, 0.03f, 0.01f) << tree.name;  // on the slabs
    for (const scene::Object& other : trees) {
      const float apart = glm::distance(place_of(tree), place_of(other));
      EXPECT_TRUE(tree.name == other.name || apart > 5.0f) << tree.name << ", " << other.name;
    }
  }
  const auto is_north = [](const scene::Object& tree) {
    return std::abs(place_of(tree).x) > 10 && place_of(tree).y > 0;
  };
  const auto is_south = [](const scene::Object& tree) {
    return std::abs(place_of(tree).x) > 10 && place_of(tree).y < 0;
  };
  EXPECT_EQ(std::ranges::count_if(trees, is_north), std::ranges::count_if(trees, is_south));
}

TEST_F(Kerbside, NothingStandsOnCarriagewaysWhereverTheyLie) {
  for (const char* road : {"-80 -60.13, 90 51.7", "-80 -60.31, -20 -61.2, 90 -20", "-33.3 -90, -30.1 90"}) {
    const auto loaded = ScriptTest::load(std::string("terrain_plane()\nroad(path=\"") + road +
                                         "\")\npaving()\nstreetFurniture(kind=\"bollards\")\n");
    ASSERT_TRUE(loaded) << to_string(loaded.errors());
    const std::vector<scene::Object> bollards = called(loaded->scene, "bollard");
    EXPECT_GT(bollards.size(), 100u) << road;
    for (const scene::Object& bollard : bollards)
      EXPECT_GT(distance_to_lanes(loaded->scene, place_of(bollard)), 0.2f) << road;
  }
}

TEST_F(Kerbside, NothingStandsInWalls) {
  folder_.write("house.obj", "v 20 0 -5\nv 60 0 -5\nv 60 9 -5\nv 20 9 -5\nf 1 2 3\nf 1 3 4\n");  // y is up
  const auto in_wall = [](const scene::Object& tree) {
    return place_of(tree).x > 20 && place_of(tree).x < 60 && place_of(tree).y > 0 && place_of(tree).y < 8;
  };
  EXPECT_GT(std::ranges::count_if(called(load("streetTrees()\n"), "street tree"), in_wall), 2);
  const scene::Scene walled = load("model(file=\"house.obj\")\nstreetTrees()\n");
  EXPECT_EQ(std::ranges::count_if(called(walled, "street tree"), in_wall), 0);
}

TEST_F(Kerbside, LargeTrianglesLeaveNoHoles) {
  const std::string trees = "streetTrees(spacing=2, clear=0.3)\n";
  const auto north = [](const scene::Object& tree) {
    return std::abs(place_of(tree).x) > 10.0f && place_of(tree).y > 0.0f && place_of(tree).y < 8.0f;
  };
  const std::vector<scene::Object> free = called(load(trees), "street tree");
  ASSERT_GT(std::ranges::count_if(free, north), 20);
  const float y = place_of(*std::ranges::find_if(free, north)).y;
  folder_.write("wall.obj",
                fmt::format("v -4000 0 {0}\nv 4000 0 {0}\nv 0 4000 {0}\nf 1 2 3\n", -y));  // y is up
  const scene::Scene walled = load("model(file=\"wall.obj\")\n" + trees);
  EXPECT_EQ(std::ranges::count_if(called(walled, "street tree"), north), 0);
}

TEST_F(Kerbside, PlantsOfAnySizeTakeNoMoreThanThePlan) {
  const auto cars = [&](const std::string& text) {
    return called(load(text + "parkedCars(share=1)\n"), "parked car").size();
  };
  const std::size_t alone = cars("");
  EXPECT_EQ(cars("plant(kind=\"hedge\", scale=1e6)\n"), 0u);
  EXPECT_EQ(cars("plant(kind=\"oak\", scale=1e6)\n"), 0u);
  EXPECT_EQ(cars("plant(kind=\"hedge\", scale=1e6, position=\"9e8 9e8 0\")\n"), alone);
  EXPECT_EQ(cars("plant(kind=\"oak\", position=\"9e8 9e8 0\")\n"), alone);
}

TEST_F(Kerbside, CarsLookAlongTheirLanesAndTakeTheirShareOfPlaces) {
  const scene::Scene all = load("parkedCars(share=1)\n");
  const std::vector<scene::Object> cars = called(all, "parked car");
  EXPECT_GT(cars.size(), 60u);
  for (const scene::Object& car : cars) {
    EXPECT_TRUE(car.takes_reflection && car.is_dynamic);
    EXPECT_GT(distance_to_lanes(all, place_of(car)), 0.9f) << car.name;
    // Vehicles drive on the right: along the street that runs east, cars on its north look west.
    const glm::vec2 ahead(car.world_from_model[0]);
    if (std::abs(place_of(car).y) < 6.0f) {
      EXPECT_LT(ahead.x * place_of(car).y, 0.0f) << car.name;
    }
  }
  const std::size_t half = called(load("parkedCars(share=0.5)\n"), "parked car").size();
  EXPECT_NEAR(double(half), 0.5 * double(cars.size()), 0.2 * double(cars.size()));
  EXPECT_TRUE(called(load("parkedCars(share=0)\n"), "parked car").empty());
}

TEST_F(Kerbside, CarsStandOnTheSlopeOfAHillAndLampsUpright) {
  constexpr float rise = 0.2f;  // eastward
  folder_.write("hill.obj", "v -120 -40 -24\nv 120 -40 24\nv 120 40 24\nv -120 40 -24\nf 1 2 3 4\n");
  const auto loaded = ScriptTest::load(
      "model(file=\"hill.obj\", up=\"z\")\nroad(path=\"-100 0 -20, 100 0 20\")\npaving()\n"
      "streetFurniture(kind=\"lamps\")\nparkedCars(share=1)\n"
      "camera(name=\"eye\", position=\"0 -9 2\", target=\"0 0 1\")\n");
  ASSERT_TRUE(loaded) << to_string(loaded.errors());
  const std::vector<scene::Object> cars = called(loaded->scene, "parked car"),
                                   lamps = called(loaded->scene, "street lamp");
  ASSERT_GT(cars.size(), 10u);
  ASSERT_GT(lamps.size(), 3u);
  for (const scene::Object& car : cars) {
    const glm::vec3 ahead(car.world_from_model[0]), left(car.world_from_model[1]);
    EXPECT_NEAR(ahead.z / ahead.x, rise, 0.02f) << "whichever way it looks";
    EXPECT_NEAR(left.z, 0.0f, 1e-4f);
    EXPECT_NEAR(car.world_from_model[3].z, rise * place_of(car).x, 0.15f);
  }
  for (const scene::Object& lamp : lamps) EXPECT_NEAR(lamp.world_from_model[2].z, 1.0f, 1e-4f);
}

TEST_F(Kerbside, CarsOfABodyShareItsModelInAllTheirPaints) {
  const auto count = [&](const std::string& share) {
    std::set<const scene::Model*> bodies;
    std::set<std::pair<const scene::Model*, const void*>> looks;
    std::size_t cars = 0;
    for (const scene::Object& car : called(load("parkedCars(share=" + share + ")\n"), "parked car")) {
      ++cars, bodies.insert(car.model.get()), looks.insert({car.model.get(), car.paint.get()});
      EXPECT_EQ(car.materials().size(), car.model->materials.size());
    }
    return std::array{cars, bodies.size(), looks.size()};
  };
  const auto [cars, bodies, looks] = count("1");
  EXPECT_GT(cars, 60u);
  EXPECT_EQ(bodies, 3u);
  EXPECT_EQ(looks, 10u);
  const auto [few_cars, few_bodies, few_looks] = count("0.08");
  ASSERT_GT(few_cars, 2u);
  ASSERT_LE(few_cars, 12u);
  EXPECT_EQ(few_bodies, 1u) << "a short street has one body";
  EXPECT_GT(few_looks, 1u) << "in several paints";
}

TEST(MapTrees, ConifersAreKnownByTheirGenusOrTheirNeedles) {
  EXPECT_EQ(plant_kind_of("SolitaryVegetationObject Pinus sylvestris needleleaved", "plane"), "pine");
  EXPECT_EQ(plant_kind_of("SolitaryVegetationObject Picea abies", "plane"), "spruce");
  EXPECT_EQ(plant_kind_of("SolitaryVegetationObject wood needleleaved", "plane"), "spruce");
  EXPECT_EQ(plant_kind_of("SolitaryVegetationObject Ginkgo biloba", "plane"), "plane");
}

TEST_F(Kerbside, WhatComesFirstTakesItsPlacesFirst) {
  const std::size_t alone = called(load("streetTrees()\n"), "street tree").size();
  const std::size_t beside_few = called(load("parkedCars(share=0.2)\nstreetTrees()\n"), "street tree").size();
  const scene::Scene both = load("parkedCars(share=1)\nstreetTrees()\n");
  EXPECT_LT(called(both, "street tree").size(), beside_few);
  EXPECT_LT(beside_few, alone);
  EXPECT_LT(called(both, "street tree").size(), alone);
  for (const scene::Object& tree : called(both, "street tree"))
    for (const scene::Object& car : called(both, "parked car"))
      EXPECT_GT(glm::distance(place_of(tree), place_of(car)), 1.5f) << tree.name << ", " << car.name;
}

TEST_F(Kerbside, BenchesTurnTheirBacksToTheHouses) {
  const scene::Scene scene = load("streetFurniture(kind=\"benches\", spacing=10)\n");
  const std::vector<scene::Object> benches = called(scene, "bench");
  EXPECT_GT(benches.size(), 30u);
  for (const scene::Object& bench : benches)
    if (std::abs(place_of(bench).y) < 6.0f) {
      EXPECT_GT(bench.world_from_model[1].y * place_of(bench).y, 0.0f) << bench.name;
    }
}

TEST_F(Kerbside, ACircleKeepsWhatStandsInIt) {
  for (const char* node :
       {"parkedCars(share=0.5", "streetTrees(spacing=9", "streetFurniture(kind=\"lamps\""}) {
    const scene::Scene all = load(std::string(node) + ")\n"),
                       some = load(std::string(node) + ", around=\"60 0 0\", within=30)\n");
    std::set<std::pair<float, float>> expected, found;
    for (const scene::Object& object : all.objects)
      if (object.name.starts_with("parked") || object.name.starts_with("street "))
        if (const glm::vec2 p = place_of(object); glm::distance(p, {60, 0}) <= 30.0f)
          expected.insert({p.x, p.y});
    for (const scene::Object& object : some.objects)
      if (object.name.starts_with("parked") || object.name.starts_with("street "))
        found.insert({place_of(object).x, place_of(object).y});
    EXPECT_GT(expected.size(), 1u) << node;
    EXPECT_EQ(found, expected) << node;
  }
  const std::string far = "parkedCars(around=\"9000 0 0\", within=30)\n";
  EXPECT_TRUE(called(load(far), "parked car").empty());
  EXPECT_NE(errors_of("parkedCars(within=30)\n").find("scene.xp:6"), std::string::npos);
  EXPECT_NE(errors_of("parkedCars(around=\"0 0 0\")\n").find("give both"), std::string::npos);
}

TEST_F(Kerbside, AHiddenGroupHidesWhatIsLaidOutInItUntilItIsShown) {
  auto loaded = ScriptTest::load(std::string(streets) +
                                 "group(name=\"trees\", visible=0) {\nstreetTrees(spacing=12)\n"
                                 "parkedCars(share=0.3)\nstreetTrees(spacing=30, kind=\"plane\", height=7)\n"
                                 "streetFurniture(kind=\"lamps\", visible=0)\n}\n");
  ASSERT_TRUE(loaded) << to_string(loaded.errors());
  scene::Scene& scene = loaded->scene;
  scene::LiveScene live(std::move(loaded->script));
  const auto shown = [&](const char* name) {
    const std::vector<scene::Object> objects = called(scene, name);
    EXPECT_GE(objects.size(), 4u) << name;
    return std::ranges::count_if(objects, &scene::Object::is_visible);
  };
  const auto plants = [&] {
    EXPECT_GT(vegetation::scene_plants(scene).size(), 4u);
    return std::ranges::count_if(vegetation::scene_plants(scene), &vegetation::ScenePlant::is_visible);
  };
  const auto expect_none = [&] {
    for (const char* name : {"street tree", "parked car", "street lamp"}) EXPECT_EQ(shown(name), 0) << name;
    EXPECT_EQ(plants(), 0);
  };
  expect_none();
  live.set(*live.find("trees"), "visible", true);
  ASSERT_TRUE(live.refresh(scene).empty());
  EXPECT_EQ(shown("street tree"), std::ptrdiff_t(called(scene, "street tree").size()));
  EXPECT_EQ(shown("parked car"), std::ptrdiff_t(called(scene, "parked car").size()));
  EXPECT_EQ(shown("street lamp"), 0) << "hidden itself";
  EXPECT_EQ(plants(), std::ptrdiff_t(vegetation::scene_plants(scene).size()));
  live.set(*live.find("trees"), "visible", false);
  ASSERT_TRUE(live.refresh(scene).empty());
  expect_none();
}

TEST_F(Kerbside, RepeatsWhatTheScriptNames) {
  folder_.write("post.obj", "v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n");
  const std::string post = "model(name=\"post\", file=\"post.obj\", scale=2, visible=0)\n";
  const scene::Scene scene = load(post + "streetFurniture(kind=\"bollards\", of=\"post\", spacing=20)\n");
  const std::vector<scene::Object> posts = called(scene, "bollard");
  ASSERT_FALSE(posts.empty());
  EXPECT_NEAR(glm::length(glm::vec3(posts.front().world_from_model[0])), 2.0f, 1e-4f);
  EXPECT_EQ(posts.front().model, called(scene, "post").front().model);
  const std::string errors = errors_of("streetTrees(of=\"oak *\")\n");
  EXPECT_NE(errors.find("no object is called \"oak *\""), std::string::npos) << errors;
  EXPECT_NE(errors.find("scene.xp:6"), std::string::npos) << errors;
}

TEST_F(Kerbside, ManyThingsAreRefusedWithTheNumberThatIsAllowed) {
  const std::string errors =
      errors_of("road(path=\"0 500, 40000 500\")\nstreetFurniture(kind=\"bollards\", spacing=1)\n");
  EXPECT_NE(errors.find("50000"), std::string::npos) << errors;
  EXPECT_NE(errors.find("wider spacing"), std::string::npos) << errors;
}

TEST_F(Kerbside, ASceneWithoutStreetsHasNone) {
  const auto loaded = ScriptTest::load(
      "terrain_plane()\nstreetTrees()\ncamera(name=\"eye\", position=\"0 -9 2\", target=\"0 0 1\")\n");
  ASSERT_TRUE(loaded) << to_string(loaded.errors());
  EXPECT_TRUE(called(loaded->scene, "street tree").empty());
  EXPECT_NE(to_string(loaded->warnings).find("no streets"), std::string::npos);
}

}  // namespace
}  // namespace parvis::kerbside

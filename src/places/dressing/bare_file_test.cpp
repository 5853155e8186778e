#include "places/dressing/bare_file.h"

#include <gtest/gtest.h>

#include "base/files.h"
#include "base/test_data.h"
#include "base/test_folder.h"
#include "graphics/render/fixed_parts.h"
#include "places/dressing/street_view.h"
#include "rooms/rooms.h"
#include "scene/data/surroundings.h"
#include "scene/data/test_scene.h"
#include "scene/script/scene_loader.h"

namespace parvis::dressing {
namespace {

using scene::Model;

const formats::Readers& readers() { return rooms::all_registries().get<formats::Readers>(); }

void add_part(Model& model, const std::string& name, Mesh mesh, glm::vec3 colour = glm::vec3(0.5f)) {
  scene::Material material = scene::matt(colour);
  material.name = name;
  scene::Part part;
  part.object = name, part.mesh = std::move(mesh), part.material = int(model.materials.size());
  model.materials.push_back(material);
  model.parts.push_back(std::move(part));
}

/// Two rows of houses along a street from west to east.
Model street_of_houses() {
  Model model;
  for (float x = 0.0f; x < 120.0f; x += 12.0f)
    for (const float y : {6.0f, -16.0f}) {
      add_part(model, "WallSurface", scene::box({x, y, 0}, {x + 12, y + 10, 9}));
      add_part(model, "RoofSurface", scene::box({x, y, 9}, {x + 12, y + 10, 10}));
    }
  return model;
}

TEST(BareFile, ScriptsAreNotBare) {
  EXPECT_FALSE(is_bare_file("place.xp"));
  EXPECT_FALSE(is_bare_file("place"));
  EXPECT_TRUE(is_bare_file("place.city.json"));
  EXPECT_TRUE(is_bare_file("place.OSM"));
}

TEST(BareFile, BareVolumesAreDressed) {
  const std::string script = bare_scene(street_of_houses(), "quarter.city.json");
  for (const char* node :
       {"facades(target=\"WallSurface\")", "roofs(target=\"RoofSurface\")", "terrain_plane()", "dayLight(",
        "shadowMap()", "camera(name=\"street\"", "camera(name=\"overview\""})
    EXPECT_NE(script.find(node), std::string::npos) << node << "\n" << script;
  EXPECT_EQ(script.find("streets("), std::string::npos) << "it has none";
  EXPECT_NE(script.find("// The file has no roads"), std::string::npos) << script;
  EXPECT_EQ(script.find("TINRelief"), std::string::npos) << "nothing that would match nothing";
}

TEST(BareFile, HousesInGardensStandOnLawns) {
  Model village, house, car;
  for (float x = 0.0f; x < 240.0f; x += 40.0f) {
    add_part(village, "WallSurface", scene::box({x, 0, 0}, {x + 10, 10, 6}));
    add_part(village, "RoofSurface", scene::box({x, 0, 6}, {x + 10, 10, 7}));
  }
  Mesh land;
  land.positions = {{-40, -40, 0}, {300, -40, 0}, {300, 80, 0}, {-40, 80, 0}};
  land.indices = {0, 1, 2, 0, 2, 3};
  add_part(village, "LandUse", std::move(land));
  add_part(house, "house", scene::box({0, 0, 0}, {9, 11, 7}));
  add_part(car, "car", scene::box({0, 0, 0}, {4.3f, 1.8f, 1.5f}));
  const std::string script = bare_scene(village, "village.osm");
  EXPECT_NE(script.find("ground(target=\"LandUse\", surface=\"by_density\")"), std::string::npos) << script;
  EXPECT_NE(script.find("terrain_plane(surface=\"lawn\")"), std::string::npos) << script;
  EXPECT_NE(bare_scene(house, "house.glb").find("terrain_plane(surface=\"lawn\")"), std::string::npos);
  EXPECT_NE(bare_scene(car, "car.glb").find("terrain_plane()"), std::string::npos);
}

/// A ridge from west to east, 400 m by 300 m and 80 m high, about a local origin in its middle.
Model ridge() {
  Mesh mesh;
  constexpr int columns = 41, rows = 31;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const float x = 10.0f * float(column) - 200.0f, y = 10.0f * float(row) - 150.0f;
      mesh.positions.emplace_back(x, y, 80.0f * std::max(0.0f, 1.0f - std::abs(y) / 90.0f));
      mesh.normals.emplace_back(0, 0, 1), mesh.uvs.emplace_back(x, y);
      if (row + 1 == rows || column + 1 == columns) continue;
      const auto at = [&](int c, int r) { return std::uint32_t((row + r) * columns + column + c); };
      for (const std::uint32_t corner : {at(0, 0), at(1, 0), at(1, 1), at(0, 0), at(1, 1), at(0, 1)})
        mesh.indices.push_back(corner);
    }
  Model model;
  add_part(model, "TINRelief", std::move(mesh));
  return model;
}

TEST(BareFile, BareLandIsSeenFromAboveTheGround) {
  const std::string script = bare_scene(ridge(), "ridge.tif", glm::dvec2(20.0, -40.0));
  EXPECT_LT(script.find("camera(name=\"overview\""), script.find("camera(name=\"hill\"")) << script;
  EXPECT_NE(script.find("latitude=-40, longitude=20"), std::string::npos) << script;
  scene::Scene scene;
  scene.objects.emplace_back();
  scene.objects.back().model = std::make_shared<const Model>(ridge());
  const View above = land_view(scene);
  EXPECT_GT(above.eye.z, 100.0f) << "over the crest";
  EXPECT_LT(glm::length(glm::vec2(above.target)), 1.0f);
  const scene::PlaceHeights place(scene, {}, 60.0f);
  const View on_land = view_on_land(scene, place);
  EXPECT_LT(std::abs(on_land.eye.x), 200.0f);
  EXPECT_LT(std::abs(on_land.eye.y), 150.0f);
  EXPECT_NEAR(on_land.eye.z, 80.0f * (1.0f - std::abs(on_land.eye.y) / 90.0f) + 1.6f, 3.0f)
      << "at eye height";
}

TEST(BareFile, TheSunIsThatOfThePlace) {
  const Model model = street_of_houses();
  const std::string unknown = "dayLight(latitude=48, longitude=10, standardMeridian=2, julianDay=172, ";
  EXPECT_NE(bare_scene(model, "a.gml").find(unknown), std::string::npos);
  const std::string tokyo = bare_scene(model, "a.gml", glm::dvec2(139.767, 35.681));
  EXPECT_NE(tokyo.find("dayLight(latitude=35.68, longitude=139.77, standardMeridian=9, julianDay=172, "),
            std::string::npos)
      << tokyo;
  const std::string sydney = bare_scene(model, "a.gml", glm::dvec2(151.2, -33.87));
  EXPECT_NE(sydney.find("latitude=-33.87, longitude=151.2, standardMeridian=11, julianDay=355, "),
            std::string::npos)
      << sydney;
}

TEST(BareFile, WallsThatAreNoHousesHaveNoWindows) {
  Model model = street_of_houses();
  EXPECT_EQ(bare_scene(model, "a.city.json").find("openings"), std::string::npos);
  add_part(model, "GenericCityObject", scene::ground(5));
  EXPECT_EQ(bare_scene(model, "a.city.json").find("openings"), std::string::npos) << "it has no walls";
  add_part(model, "GenericCityObject", scene::box({0, 0, 0}, {5, 0.3f, 2}));
  EXPECT_NE(bare_scene(model, "a.city.json").find("facades(target=\"GenericCityObject\", openings=0)"),
            std::string::npos);
}

TEST(BareFile, WindowsOfAModelAreNotPaintedOver) {
  const Mesh window = scene::quad({3, 6, 3}, {4, 6, 3}, {4, 6, 4}, {3, 6, 4});
  Model house;
  add_part(house, "WallSurface", scene::box({0, 6, 0}, {12, 16, 9})), add_part(house, "Window", window);
  EXPECT_EQ(bare_scene(house, "lod3.gml").find("facades("), std::string::npos);
  Model town = street_of_houses();
  add_part(town, "Window", window);
  EXPECT_NE(bare_scene(town, "town.gml").find("facades("), std::string::npos) << "the others have none";
  Model pictured = street_of_houses();
  pictured.textures.emplace_back();
  pictured.materials.front().base_colour_texture = 0;
  EXPECT_EQ(bare_scene(pictured, "textured.gml").find("facades("), std::string::npos);
}

TEST(BareFile, TheStreetIsSeenAlong) {
  const Model model = street_of_houses();
  scene::Scene scene;
  scene.objects.emplace_back();
  scene.objects.back().model = std::make_shared<const Model>(model);
  const scene::PlaceHeights place(scene, {}, 60.0f);
  const View view = street_view(scene, place, {});
  EXPECT_LT(std::abs(view.eye.y + 0.0f), 6.0f) << "between the houses, which stand at 6 and -6";
  EXPECT_NEAR(view.eye.z, 1.7f, 0.3f);
  const glm::vec3 ahead = glm::normalize(view.target - view.eye);
  EXPECT_GT(std::abs(ahead.x), 0.9f) << "along them, not at them";
}

/// A street of houses in a plain of 12 km, where a barn stands in each corner.
Model street_in_a_large_place() {
  Model model = street_of_houses();
  for (const glm::vec2 corner : {glm::vec2(-6000, -6000), {6000, -6000}, {-6000, 6000}, {6000, 6000}}) {
    const glm::vec3 at(corner, 0.0f);
    add_part(model, "WallSurface", scene::box(at, at + glm::vec3(20, 15, 6)));
    add_part(model, "RoofSurface", scene::box(at + glm::vec3(0, 0, 6), at + glm::vec3(20, 15, 7)));
  }
  return model;
}

/// A street from `west_m` to as far in the east, through the street of houses.
std::vector<scene::Road> street_from(float west_m) {
  std::vector<scene::Road> roads(1);
  roads.front().path = {{west_m, 0, 0}, {-west_m, 0, 0}};
  return roads;
}

TEST(BareFile, TheStreetOfALargePlaceIsLookedForWhereItsHousesAre) {
  Model model = street_in_a_large_place();
  scene::Scene scene;
  scene.objects.emplace_back();
  scene.objects.back().model = std::make_shared<const Model>(model);
  const std::vector<scene::Road> roads = street_from(-6000);
  const scene::PlaceHeights place(scene, roads, 60.0f);
  const View view = street_view(scene, place, roads);
  EXPECT_LT(std::abs(view.eye.x - 60.0f), 70.0f) << "at the houses, which stand from 0 to 120";
  EXPECT_GT(glm::dot(view.target - view.eye, glm::vec3(60, 0, 0) - view.eye), 0.0f) << "toward them";
  EXPECT_GT(std::abs(glm::normalize(view.target - view.eye).x), 0.9f);
}

TEST(BareFile, OfALargePlaceTheStreetsAboutTheCameraAreFurnished) {
  Model model = street_in_a_large_place();
  model.roads = street_from(-2000);
  EXPECT_NE(bare_scene(model, "town.osm").find("parkedCars(share=0.4)"), std::string::npos) << "all of 4 km";
  model.roads = street_from(-6000);
  const std::string script = bare_scene(model, "town.osm");
  for (const char* node : {"streetFurniture(kind=\"lamps\", around=\"", "parkedCars(share=0.4, around=\"",
                           "streetTrees(kind=\"plane\", spacing=12, clear=2.5, around=\""})
    EXPECT_NE(script.find(node), std::string::npos) << node << "\n" << script;
}

TEST(BareFile, ATowerIsSeenWholeFromAbove) {
  Model model;
  add_part(model, "WallSurface", scene::box({0, 0, 0}, {12, 10, 30}));
  scene::Scene scene;
  scene.objects.emplace_back();
  scene.objects.back().model = std::make_shared<const Model>(model);
  const scene::PlaceHeights place(scene, {}, 60.0f);
  const View view = overview(scene, place, outside_view(scene, place));
  const glm::vec3 ahead = glm::normalize(view.target - view.eye);
  for (const glm::vec3 corner :
       {glm::vec3(0, 0, 30), glm::vec3(12, 10, 30), glm::vec3(0, 0, 0), glm::vec3(12, 0, 0)}) {
    const float angle = std::acos(glm::dot(ahead, glm::normalize(corner - view.eye)));
    EXPECT_LT(angle, 0.5f) << "of half a picture's width of 0.57";
  }
  EXPECT_LT(glm::distance(view.eye, view.target), 120.0f) << "and no farther than that takes";
}

TEST(BareFile, LoadsWithoutAWarningAndHasGroundToTheHorizon) {
  const TestFolder folder;
  std::filesystem::copy(source_folder() / "scenes" / "crossroads.osm", folder.path());
  const Result<WrittenScene> written =
      write_bare_scene(folder.path() / "crossroads.osm", readers(), folder.path());
  ASSERT_TRUE(written) << to_string(written.errors());
  EXPECT_EQ(written->script.filename(), "crossroads.xp");
  const Result<std::string> script = read_file(written->script);
  ASSERT_TRUE(script);
  EXPECT_EQ(script->find("latitude=48, longitude=10,"), std::string::npos) << "the map lies elsewhere";
  const Result<scene::LoadedScene> loaded = scene::load_scene(written->script, rooms::node_registry());
  ASSERT_TRUE(loaded) << to_string(loaded.errors());
  EXPECT_EQ(to_string(loaded->warnings), "");
  const scene::Scene& scene = loaded->scene;
  ASSERT_EQ(scene.items<scene::Surroundings>().size(), 1u);
  Bounds land, fixed;
  for (const scene::Object& object : scene.objects)
    if (scene::surrounds_place(scene, object)) land.add(scene::bounds(*object.model));
  EXPECT_GT(std::min({-land.min.x, -land.min.y, land.max.x, land.max.y}), 4000.0f);
  render::for_each_fixed_opaque_part(scene,
                                     [&](const render::FixedPart& part) { fixed.add(part.mesh.bounds()); });
  EXPECT_LT(fixed.size().x, 1500.0f) << "what is fitted to the place ends with the place";
  ASSERT_EQ(scene.cameras.size(), 2u);
  EXPECT_FALSE(scene.roads.empty());
  EXPECT_NE(script->find("trafficLights(of=\"place\")"), std::string::npos) << "the map has some";
  EXPECT_EQ(std::ranges::count(scene.objects, std::string("traffic lights masts"), &scene::Object::name), 1);
}

TEST(BareFile, LightsOfTheMapBetweenJunctionsAreNamed) {
  const TestFolder folder;
  folder.write("street.osm", R"(<osm version="0.6">
      <bounds minlat="52.158" minlon="4.488" maxlat="52.161" maxlon="4.494"/>
      <node id="1" lat="52.1595" lon="4.4890"/>
      <node id="2" lat="52.1595" lon="4.4907"><tag k="highway" v="traffic_signals"/></node>
      <node id="3" lat="52.1595" lon="4.4924"/>
      <way id="9"><nd ref="1"/><nd ref="2"/><nd ref="3"/><tag k="highway" v="residential"/></way></osm>)");
  const auto script = folder.write("a.xp",
                                   "model(name=\"town\", file=\"street.osm\") trafficLights(of=\"town\")\n"
                                   "camera(name=\"c\", position=\"0 -9 2\", target=\"0 0 1\")\n");
  const Result<scene::LoadedScene> loaded = scene::load_scene(script, rooms::node_registry());
  ASSERT_TRUE(loaded) << to_string(loaded.errors());
  EXPECT_NE(to_string(loaded->warnings).find("1 of the map are left out, which stand at no junction"),
            std::string::npos)
      << to_string(loaded->warnings);
}

/// The map of crossroads as the model "town", followed by more of a script.
scene::Scene crossroads_with(const std::string& rest) {
  const TestFolder folder;
  std::filesystem::copy(source_folder() / "scenes" / "crossroads.osm", folder.path());
  const auto script =
      folder.write("a.xp", "model(name=\"town\", file=\"crossroads.osm\") " + rest +
                               "\ncamera(name=\"c\", position=\"0 -9 2\", target=\"0 0 1\")\n");
  Result<scene::LoadedScene> loaded = scene::load_scene(script, rooms::node_registry());
  EXPECT_TRUE(loaded) << to_string(loaded.errors());
  return loaded ? std::move(loaded->scene) : scene::Scene();
}

TEST(Dressing, StreetsOfCentreLinesAreShown) {
  const auto is_paved = [](const std::string& streets) {
    const scene::Scene scene = crossroads_with("\n" + streets);
    EXPECT_EQ(scene.roads.empty(), streets.empty());
    return std::ranges::count(scene.objects, std::string("paving"), &scene::Object::name) == 1;
  };
  EXPECT_TRUE(is_paved("streets(of=\"town\")"));
  EXPECT_FALSE(is_paved("streets(of=\"town\", paving=0)"));
  EXPECT_FALSE(is_paved(""));
}

TEST(Dressing, WithoutATargetWallsAndRoofsAreTheModelsOwn) {
  const auto triangles_under_tiles = [&](const std::string& nodes) {
    std::size_t count = 0;
    for (const scene::Object& object : crossroads_with("{ " + nodes + " }").objects)
      for (const scene::Part& part : object.model->parts)
        if (part.material >= 0 && object.model->materials[std::size_t(part.material)].name == "roof tiles")
          count += part.mesh.triangle_count();
    return count;
  };
  const std::size_t of_roofs =
      triangles_under_tiles("facades(target=\"WallSurface\") roofs(target=\"RoofSurface\")");
  EXPECT_GT(of_roofs, 0u);
  EXPECT_EQ(triangles_under_tiles("facades() roofs()"), of_roofs);
  EXPECT_GT(triangles_under_tiles("facades() roofs(target=\"*\")"), of_roofs) << "walls, too, when asked";
}

TEST(BareFile, NothingIsOverwritten) {
  const TestFolder folder;
  std::filesystem::copy(source_folder() / "scenes" / "crossroads.osm", folder.path());
  const auto file = folder.path() / "crossroads.osm";
  folder.write("crossroads.xp", "// mine\n");
  const Result<WrittenScene> first = write_bare_scene(file, readers(), folder.path());
  ASSERT_TRUE(first) << to_string(first.errors());
  EXPECT_EQ(first->script.filename(), "crossroads-2.xp");
  EXPECT_TRUE(first->is_new);
  EXPECT_EQ(*read_file(folder.path() / "crossroads.xp"), "// mine\n");
  const Result<WrittenScene> second = write_bare_scene(file, readers(), folder.path());
  ASSERT_TRUE(second);
  EXPECT_EQ(second->script.filename(), "crossroads-2.xp") << "the same again";
  EXPECT_FALSE(second->is_new);
}

TEST(BareFile, AFileThatCannotBeReadLeavesNothing) {
  const TestFolder folder;
  const auto file = folder.write("bad.osm", "<osm>");
  EXPECT_FALSE(write_bare_scene(file, readers(), folder.path()));
  EXPECT_FALSE(write_bare_scene(folder.path() / "none.gml", readers(), folder.path()));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "bad.xp"));
}

}  // namespace
}  // namespace parvis::dressing

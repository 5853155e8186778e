// Noise maps of small scenes: levels by hand, symmetry, screening, kept transfers, what scripts get wrong.
#include <gtest/gtest.h>

#include <chrono>

#include "base/test_folder.h"
#include "life/propagation/noise_source.h"
#include "life/traffic/demand.h"
#include "life/tram/tram_line.h"
#include "planning/noise/noise_map.h"
#include "room_list.h"
#include "scene/script/test_script.h"

namespace parvis::noise {
namespace {

scene::Scene with_road() {
  scene::Scene scene;
  scene::Lane lane;
  lane.points = {{-500, 0, 0}, {500, 0, 0}};
  scene.roads.lanes.push_back(lane);
  scene.data<traffic::TrafficDemand>().vehicles = 20;
  return scene;
}

scene::Object box(glm::vec3 low, glm::vec3 high) {
  scene::Model model;
  model.materials.emplace_back();
  model.nodes.emplace_back();
  scene::Part part;
  part.material = 0, part.node = 0;
  for (int i = 0; i < 8; ++i)
    part.mesh.positions.emplace_back(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
  part.mesh.indices = {0, 1, 5, 0, 5, 4, 3, 2, 6, 3, 6, 7, 2, 0, 4,
                       2, 4, 6, 1, 3, 7, 1, 7, 5, 4, 5, 7, 4, 7, 6};
  part.mesh.normals.assign(8, {0, 0, 1});
  part.mesh.uvs.assign(8, {0, 0});
  model.parts.push_back(std::move(part));
  scene::Object object;
  object.name = "box";
  object.model = std::make_shared<const scene::Model>(std::move(model));
  return object;
}

NoiseOptions small_area() {
  NoiseOptions options;
  options.area = glm::dvec4(-10, 20, 10, 40);
  options.cell_m = 10;
  return options;
}

TEST(Lden, IsThatOfTheDirective) {
  EXPECT_NEAR(lden_of(60, 60, 60), 66.4, 0.05);
  EXPECT_NEAR(lden_of(60, 55, 50), 60.0, 1e-9);
}

TEST(Map, OfALongRoadHasTheLevelOfALineSource) {
  NoiseOptions options = small_area();
  options.favourable_fraction = 0.0;
  const auto map = compute_noise(with_road(), options);
  ASSERT_TRUE(map);
  ASSERT_EQ(map->receivers.size(), 4u);
  // Hard level ground: a line source in half space, and -3 dB of ground. 20 vehicles over 1 km at 50 km/h.
  propagation::RoadTraffic traffic;
  traffic.speed_km_h.fill(3.6 * double(13.9f)), traffic.flow_per_h[0] = 0.02 * 3600.0 * 13.9,
                                                traffic.celsius = 15.0;
  const auto per_metre = propagation::road_power_db(propagation::road_coefficients_2020, {}, traffic);
  const double distance = std::hypot(25.0, 4.0);
  propagation::Octaves expected;
  for (std::size_t i = 0; i < propagation::octaves; ++i)
    expected[i] = per_metre[i] - 10.0 * std::log10(distance) - 11.0 + 10.0 * std::log10(3.05) + 3.0;
  // Without air absorption, which takes a little off.
  EXPECT_NEAR(map->levels.front().lday, propagation::a_weighted(expected), 0.6);
  EXPECT_LT(map->levels.front().lday, propagation::a_weighted(expected));
  EXPECT_NEAR(map->levels[0].lden, map->levels[0].lday + 6.4, 0.05) << "the same at all hours";
}

TEST(Map, ABuildingScreensAndIsMarked) {
  scene::Scene open = with_road(), built = with_road();
  built.objects.push_back(box({-60, 10, 0}, {60, 16, 12}));
  built.objects.push_back(box({-4, 22, 0}, {4, 28, 6}));
  NoiseOptions options = small_area();
  const auto before = compute_noise(open, options), after = compute_noise(built, options);
  ASSERT_TRUE(before && after);
  EXPECT_LT(after->levels.front().lden, before->levels.front().lden - 8.0);
  options.cell_m = 2;
  const auto fine = compute_noise(built, options);
  ASSERT_TRUE(fine);
  EXPECT_FALSE(levels_at(*fine, 5, 2)) << "in the second building";
  EXPECT_TRUE(levels_at(*fine, 0, 0));
  int facades = 0, floors = 0;
  for (const Receiver& it : fine->receivers) facades += it.wall >= 0, floors = std::max(floors, it.floor);
  EXPECT_GT(facades, 4);
  EXPECT_EQ(floors, 1) << "6 m are two floors";
}

TEST(Map, TrafficAloneIsSummedAgain) {
  const scene::Scene scene = with_road();
  const auto map = compute_noise(scene, small_area());
  ASSERT_TRUE(map);
  const auto levels = sum_levels(map->transfers, multiplied(map->sources, 2.0));
  for (std::size_t i = 0; i < levels.size(); ++i)
    EXPECT_NEAR(levels[i].lday, map->levels[i].lday + 3.01, 0.01);
}

TEST(Map, WhatCannotBeComputedIsAnError) {
  scene::Scene none;
  EXPECT_FALSE(compute_noise(none, {})) << "no roads";
  scene::Scene silent = with_road();
  silent.data<traffic::TrafficDemand>().vehicles = 0;
  const auto result = compute_noise(silent, {});
  ASSERT_FALSE(result);
  EXPECT_NE(to_string(result.errors()).find("trafficCount"), std::string::npos);
  NoiseOptions options = small_area();
  options.area = glm::dvec4(0, 0, 1e6, 1e6), options.cell_m = 1;
  EXPECT_FALSE(compute_noise(with_road(), options)) << "too many cells";
  options.area = glm::dvec4(5, 5, 5, 9);
  EXPECT_FALSE(compute_noise(with_road(), options)) << "empty";
}

TEST(Map, ANoiseSourceCountsWhileItSoundsAndWithoutRoads) {
  scene::Scene scene;
  propagation::NoiseSource fan;
  fan.line = {{0, 0, 3}}, fan.power_db.fill(80.0), fan.hours_share = {1.0, 0.5, 0.0};
  scene.data<scene::ItemsOf<propagation::NoiseSource>>().add(fan, 0);
  NoiseOptions options = small_area();
  options.favourable_fraction = 0.0;
  const auto map = compute_noise(scene, options);
  ASSERT_TRUE(map) << to_string(map.errors());
  const NoiseLevels& near = map->levels.front();  // at -5, 25, 4
  EXPECT_NEAR(near.lday - near.levening, 3.01, 0.01);
  EXPECT_EQ(near.lnight, 0.0);
  // A point source over hard ground.
  propagation::Octaves expected = propagation::absorption_db_per_m(options.air);
  const double distance_m = std::hypot(5.0, 25.0, 1.0);
  for (double& level : expected)
    level = 80.0 - 20.0 * std::log10(distance_m) - 11.0 + 3.0 - level * distance_m;
  EXPECT_NEAR(near.lday, propagation::a_weighted(expected), 0.01);
  // As a line of ten metres it has the same power.
  fan.line = {{-5, 0, 3}, {5, 0, 3}};
  scene::Scene other;
  other.data<scene::ItemsOf<propagation::NoiseSource>>().add(fan, 0);
  const auto line = compute_noise(other, options);
  ASSERT_TRUE(line);
  EXPECT_NEAR(line->levels.front().lday, near.lday, 0.3);
  EXPECT_EQ(multiplied(line->sources, 2.0), line->sources.power) << "a factor of the roads' traffic";
  // Its pieces have their lengths, by which near ones are divided.
  const auto pieces = road_sources(other, 4.0);
  ASSERT_TRUE(pieces && pieces->patches.size() == 3u);
  for (const SourcePatch& patch : pieces->patches) EXPECT_NEAR(patch.length_m(), 10.0 / 3.0, 1e-5);
}

TEST(Map, ANoiseSourceHidesNoTrafficThatCountsNowhere) {
  scene::Scene scene = with_road();
  propagation::NoiseSource fan;
  fan.line = {{0, 0, 3}}, fan.power_db.fill(80.0), fan.hours_share = {1.0, 1.0, 1.0};
  scene.data<scene::ItemsOf<propagation::NoiseSource>>().add(fan, 0);
  TrafficCount count;
  count.road = "misspelt";
  scene.data<scene::ItemsOf<TrafficCount>>().add(count, 0);
  const auto sources = road_sources(scene, 10.0);
  ASSERT_FALSE(sources);
  EXPECT_NE(to_string(sources.errors()).find("no road"), std::string::npos);
}

TEST(Map, TramsAreSourcesOfTheirOwn) {
  scene::Scene scene;
  tram::TramLine line;
  line.track = scene::MeasuredPath({{-200, 0, 0}, {200, 0, 0}});
  line.timetable = std::make_shared<const tram::Timetable>(
      line.track, 40.0f, 400.0f, std::vector<tram::Stop>{{40.0f}, {220.0f}, {400.0f}}, 11.0f, 32.0f);
  line.headway_s = 300.0;
  scene.data<scene::ItemsOf<tram::TramLine>>().add(line, 0);
  const auto sources = road_sources(scene, 10.0);
  ASSERT_TRUE(sources) << "no roads are needed";
  EXPECT_TRUE(sources->has_trams);
  EXPECT_EQ(multiplied(*sources, 2.0), sources->power) << "a factor of the roads' traffic";
  const auto map = compute_noise(scene, small_area());
  ASSERT_TRUE(map);
  EXPECT_GT(map->levels.front().lday, 35.0);
  EXPECT_LT(map->levels.front().lday, 65.0);
  scene::Scene both = with_road();
  both.data<scene::ItemsOf<tram::TramLine>>().add(line, 0);
  const auto louder = compute_noise(both, small_area()), alone = compute_noise(with_road(), small_area());
  ASSERT_TRUE(louder && alone);
  EXPECT_GT(louder->levels.front().lday, alone->levels.front().lday);
}

TEST(Map, ItsModelHasTheColoursOfLevels) {
  scene::Scene scene = with_road();
  scene.objects.push_back(box({-60, 10, 0}, {60, 16, 12}));
  const auto map = compute_noise(scene, small_area());
  ASSERT_TRUE(map);
  const scene::Model model = noise_model(*map, 4.0);
  ASSERT_FALSE(model.parts.empty());
  std::size_t rectangles = 0;
  for (const scene::Part& part : model.parts) rectangles += part.mesh.indices.size() / 6;
  EXPECT_EQ(rectangles, map->receivers.size());
  for (const glm::vec3& at : model.parts[0].mesh.positions) EXPECT_NEAR(at.z, 0.1f, 1e-4f);
}

class NoiseMapNode : public scene::ScriptTest<> {
 protected:
  NoiseMapNode()
      : ScriptTest([] {
          Registries registries;
          script::register_room(registries), noise::register_room(registries);
          return registries;
        }()) {}
};

TEST_F(NoiseMapNode, NeedsRoadsAndTwoCorners) {
  EXPECT_TRUE(holds(errors_of("noiseMap()\n"), "no roads"));
  EXPECT_TRUE(holds(errors_of("noiseMap(area=\"0 0 0, 1 1 0, 2 2 0\")\n"), "two corners"));
}

TEST_F(NoiseMapNode, NoiseSourcesHaveOneLevelOrEight) {
  const scene::Scene scene = scene_of(
      "noiseSource(path=\"1 2 3\", power_db=80)\nnoiseSource(path=\"1 2 3, 4 5 6\", power_db=\"1 2 3 4 5 6 7 "
      "8\", hours=\"1 0 0\")\n");
  ASSERT_EQ(scene.items<propagation::NoiseSource>().size(), 2u);
  EXPECT_NEAR(propagation::a_weighted(scene.items<propagation::NoiseSource>()[0].power_db), 80.0, 1e-6);
  EXPECT_EQ(scene.items<propagation::NoiseSource>()[1].power_db[7], 8.0);
  EXPECT_TRUE(holds(errors_of("noiseSource(path=\"1 2 3\", power_db=\"1 2\")\n"), "one level or eight"));
  for (const char* far : {"1e5", "1e12", "1e30"})
    EXPECT_TRUE(holds(errors_of(fmt::format("noiseSource(path=\"0 0 0, {} 0 0\", power_db=80)\n", far)),
                      "at most 10000"));
  const scene::Scene upright = scene_of("noiseSource(path=\"12 4 0, 12 4 0, 12 4 8\", power_db=80)\n");
  const auto& pipe = upright.items<propagation::NoiseSource>()[0];
  EXPECT_EQ(pipe.line.size(), 2u);
  EXPECT_EQ(pipe.pieces(4.0).size(), 2u);
  EXPECT_TRUE(holds(errors_of("noiseSource(path=\"1 2 3\", power_db=900)\n"), "-50 to 160"));
  EXPECT_TRUE(holds(errors_of("noiseSource(path=\"1 2 3\", power_db=80, hours=\"2 0 0\")\n"), "fractions"));
}

TEST(Files, AreWrittenTogether) {
  const TestFolder folder;
  const scene::Scene scene = with_road();
  const auto map = compute_noise(scene, small_area());
  ASSERT_TRUE(map);
  ASSERT_TRUE(write_noise(folder.path() / "noise", *map, scene, 4.0));
  for (const char* end : {"noise.png", "noise.csv", "noise.tif", "noise.glb"})
    EXPECT_GT(std::filesystem::file_size(folder.path() / end), 100u) << end;
  ASSERT_TRUE(write_difference(folder.path() / "noise", *map, *map));
  NoiseMap other = *map;
  other.columns = 1;
  EXPECT_FALSE(write_difference(folder.path() / "noise", *map, other));
}

}  // namespace
}  // namespace parvis::noise

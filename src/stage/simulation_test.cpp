// What a simulation's time does: the same from the same script, at any frame rate. No OpenGL.
#include <gtest/gtest.h>

#include "base/test_folder.h"
#include "rooms/rooms.h"
#include "stage/stage.h"

namespace parvis::stage {
namespace {

/// A box 4.4 m long as a car, x forward.
constexpr const char* box_car =
    "v -2.2 -0.9 0\nv 2.2 -0.9 0\nv 2.2 0.9 0\nv -2.2 0.9 0\nv -2.2 -0.9 1.4\nv 2.2 -0.9 1.4\nv 2.2 0.9 1.4\n"
    "v -2.2 0.9 1.4\nf 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 3 4 8 7\nf 2 3 7 6\nf 4 1 5 8\n";

std::string script(int seed) {
  return fmt::format(
      "road(path=\"0 0, 200 0\")\nroad(path=\"100 -100, 100 100\")\n"
      "traffic(vehicles=6, seed={}) {{ model(file=\"car.obj\", up=z, dynamic=1) }}\n"
      "model(name=\"tram\", file=\"car.obj\", up=z, dynamic=1)\n"
      "path(of=\"tram\", along=1) {{ key(time_s=0, position=\"-40 9 0\") key(time_s=8, position=\"40 9 0\") "
      "}}\n"
      "camera(name=\"still\", position=\"0 -9 2\")\ncamera(name=\"rider\", follows=\"vehicle 1\")\n",
      seed);
}

class PlayTest : public testing::Test {
 protected:
  void SetUp() override { folder_.write("car.obj", box_car); }

  /// The scene of that seed after `frames` of `frame_s`.
  Simulation played(int seed, int frames, double frame_s) {
    Result<Simulation> simulation =
        open_simulation(rooms::all_registries(), folder_.write("scene.xp", script(seed)), {});
    EXPECT_TRUE(simulation) << to_string(simulation.errors());
    for (int i = 0; i < frames; ++i) simulation->advance(frame_s);
    return *std::move(simulation);
  }

  TestFolder folder_;
};

/// The farthest that an object stands from where it stands in another play.
float farthest(const Simulation& a, const Simulation& b) {
  float result = 0.0f;
  EXPECT_EQ(a.scene.objects.size(), b.scene.objects.size());
  for (std::size_t i = 0; i < a.scene.objects.size(); ++i)
    result = std::max(result, glm::distance(glm::vec3(a.scene.objects[i].world_from_model[3]),
                                            glm::vec3(b.scene.objects[i].world_from_model[3])));
  return result;
}

TEST_F(PlayTest, IsTheSameWhenItIsPlayedAgain) {
  const Simulation first = played(3, 96, 1.0 / 24.0), second = played(3, 96, 1.0 / 24.0);
  ASSERT_EQ(first.scene.objects.size(), 7u);  // the tram and six vehicles
  EXPECT_EQ(farthest(first, second), 0.0f);
  EXPECT_GT(farthest(first, played(3, 95, 1.0 / 24.0)), 0.1f) << "a frame more is another moment";
  EXPECT_GT(farthest(first, played(4, 96, 1.0 / 24.0)), 1.0f) << "another seed is another traffic";
}

std::vector<scene::Object> vehicles_of(const Simulation& simulation) {
  std::vector<scene::Object> vehicles;
  for (const scene::Object& object : simulation.scene.objects)
    if (object.name.starts_with("vehicle ")) vehicles.push_back(object);
  return vehicles;
}

/// Ground that rises to the north east, in waves, as a terrain model has it; roads lie across it.
std::string hill() {
  std::string points, faces;
  constexpr int side = 41;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const double e = 10.0 * x - 100.0, n = 10.0 * y - 200.0;
      points += fmt::format("v {} {} {:.3f}\n", e, n, 0.03 * e + 0.02 * n + 0.8 * std::sin(0.05 * e));
      const int i = y * side + x + 1;
      if (x + 1 < side && y + 1 < side)
        faces += fmt::format("f {} {} {} {}\n", i, i + 1, i + side + 1, i + side);
    }
  return points + "o TINRelief\n" + faces;
}

TEST_F(PlayTest, PavingLeavesEveryVehicleInItsPlace) {
  folder_.write("hill.obj", hill());
  for (const std::string ground : {"", "terrain_plane()\n", "model(file=\"hill.obj\", up=z)\n"})
    for (const double seconds : {0.5, 20.0}) {
      const auto played = [&](const std::string& paving) {
        Result<Simulation> simulation = open_simulation(
            rooms::all_registries(), folder_.write("scene.xp", ground + script(3) + paving), {});
        EXPECT_TRUE(simulation) << to_string(simulation.errors());
        simulation->advance(seconds);
        return *std::move(simulation);
      };
      const Simulation bare = played(""), paved = played("paving()\n");
      const std::vector<scene::Object> before = vehicles_of(bare), after = vehicles_of(paved);
      ASSERT_EQ(before.size(), 6u);
      ASSERT_EQ(after.size(), before.size());
      for (std::size_t i = 0; i < before.size(); ++i) {
        EXPECT_EQ(after[i].name, before[i].name);
        EXPECT_EQ(after[i].model->name, before[i].model->name);
        const glm::vec3 from(before[i].world_from_model[3]), to(after[i].world_from_model[3]);
        // Terrain is shaped for paved roads; a body that leans with it moves its origin by a hair.
        const bool is_shaped = ground.find("hill") != std::string::npos;
        EXPECT_LE(glm::distance(glm::vec2(to), glm::vec2(from)), is_shaped ? 0.002f : 0.0f)
            << ground << seconds << " s: " << before[i].name;
        if (is_shaped) continue;
        EXPECT_NEAR(to.z - from.z, 0.06f, 1e-4f) << "on the asphalt";
      }
    }
}

TEST_F(PlayTest, IsTheSameAtAnyFrameRate) {
  const Simulation slow = played(3, 40, 0.1);
  for (const int frames_per_second : {24, 25, 60, 90}) {
    const Simulation other = played(3, 4 * frames_per_second, 1.0 / frames_per_second);
    // The simulation's steps are the same; a frame shows a place between two of them, in float.
    EXPECT_LT(farthest(slow, other), 2e-3f) << frames_per_second << " frames per second";
  }
}

TEST_F(PlayTest, MovesWhatAPathMoves) {
  const Simulation simulation = played(3, 48, 1.0 / 24.0);
  EXPECT_NEAR(simulation.scene.objects[0].world_from_model[3].y, 9.0f, 0.1f);
  EXPECT_NEAR(simulation.scene.objects[0].world_from_model[3].x, -20.0f, 0.5f);  // a quarter of its way
}

TEST_F(PlayTest, CamerasStandOrFollow) {
  const Simulation early = played(3, 1, 0.1), late = played(3, 40, 0.1);
  const auto eye = [](const Simulation& simulation, const std::string& name) {
    const Result<Camera> camera = simulation.camera(name);
    EXPECT_TRUE(camera) << to_string(camera.errors());
    return camera->position_in_world();
  };
  EXPECT_EQ(eye(early, "still"), glm::vec3(0, -9, 2));
  EXPECT_EQ(eye(late, "still"), eye(early, "still"));
  EXPECT_EQ(eye(late, ""), eye(late, "still")) << "unnamed: the first";
  EXPECT_GT(glm::distance(eye(early, "rider"), eye(late, "rider")), 1.0f);
  const Result<Camera> absent = late.camera("roof");
  ASSERT_FALSE(absent);
  EXPECT_NE(to_string(absent.errors()).find("rider"), std::string::npos) << "lists which there are";
}

// What `--reflection` does (apps/parvis/scene_arguments.h).
TEST_F(PlayTest, TheMethodOfTheCommandLineHoldsInAScenarioThatNamesAnother) {
  for (const char* own : {"reflection(method=none)\n", ""}) {
    const std::string names_another =
        *own ? "override(of=\"%reflection\", method=box_projected_probe)" : "group() { camera(name=inside) }";
    Result<Simulation> simulation = open_simulation(
        rooms::all_registries(),
        folder_.write("scene.xp",
                      own + ("camera(name=eye)\nscenario(name=other) { " + names_another + " }\n")),
        {});
    ASSERT_TRUE(simulation) << to_string(simulation.errors());
    scene::LiveScene& live = simulation->live();
    const scene::Node& reflection = live.unique_node("reflection");
    const Status unknown = live.hold(reflection, "method", "mirrors");
    ASSERT_FALSE(unknown);
    EXPECT_NE(to_string(unknown.errors()).find("shared_cube_map"), std::string::npos) << "names the methods";
    ASSERT_TRUE(live.hold(reflection, "method", "shared_cube_map"));
    ASSERT_TRUE(live.choose(simulation->scene, "other"));
    EXPECT_EQ(reflection.text("method"), "shared_cube_map");
    EXPECT_EQ(methods::settings(simulation->scene).method, "shared_cube_map");
  }
}

}  // namespace
}  // namespace parvis::stage

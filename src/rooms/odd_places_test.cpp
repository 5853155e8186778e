// Places that reflection maps were not made for: every method of maps shows light in the mirror, the same
// each time.
#include <gtest/gtest.h>

#include <algorithm>

#include "base/test_folder.h"
#include "graphics/gl/test_context.h"
#include "rooms/rooms.h"
#include "stage/stage.h"

namespace parvis::rooms {
namespace {

class OddPlacesTest : public gl::ContextTest {};

/// An OBJ file of one square; its corners are in world coordinates, z up.
std::string obj_of(const std::array<glm::vec3, 4>& corners) {
  std::string text;
  for (const glm::vec3 corner : corners) text += fmt::format("v {} {} {}\n", corner.x, corner.z, -corner.y);
  return text + "f 1 2 3 4\n";
}

/// A mirror before a wall, looked at from the wall's side, and further nodes.
class Place {
 public:
  explicit Place(const std::string& nodes, glm::vec3 at = {0, 0, 0}, bool has_surroundings = true) {
    add("mirror", {{{-2, 0, 0}, {2, 0, 0}, {2, 0, 3}, {-2, 0, 3}}});
    add("ground", {{{-16, -16, 0}, {16, -16, 0}, {16, 16, 0}, {-16, 16, 0}}});
    add("wall", {{{16, -9, 0}, {-16, -9, 0}, {-16, -9, 9}, {16, -9, 9}}});
    if (has_surroundings) script_ += "model(file=\"ground.obj\")\nmodel(file=\"wall.obj\")\n";
    script_ += fmt::format(
        "model(file=\"mirror.obj\", position=\"{0} {1} 0\", dynamic=1, reflective=1) {{ "
        "material(preset=\"chrome\") }}\n"
        "sun()\ncamera(name=\"eye\", position=\"{2} {3} 1.6\", target=\"{0} {1} 1.5\")\n{4}",
        at.x, at.y, at.x + 1, at.y - 5, nodes);
  }

  void add(const std::string& name, const std::array<glm::vec3, 4>& corners) {
    folder_.write(name + ".obj", obj_of(corners));
  }

  std::unique_ptr<stage::Stage> stage() const {
    Result<stage::Simulation> simulation =
        stage::open_simulation(all_registries(), folder_.write("scene.xp", script_), {});
    EXPECT_TRUE(simulation) << to_string(simulation.errors());
    Result<std::unique_ptr<stage::Stage>> stage = stage::Stage::create(*std::move(simulation));
    EXPECT_TRUE(stage) << to_string(stage.errors());
    return *std::move(stage);
  }

 private:
  TestFolder folder_;
  std::string script_;
};

/// The pixels in the middle of the mirror, by a method that begins with this frame.
std::vector<glm::ivec3> mirrored(stage::Stage& stage, const std::string& method) {
  methods::Settings settings = methods::settings(stage.scene());
  settings.method = method;
  const Status status = stage.set_reflection(settings);
  EXPECT_TRUE(status) << to_string(status.errors());
  stage.simulation().settle();
  stage.draw(*stage.camera("eye"), 64, 48);
  const Image8 picture = stage.picture();
  std::vector<glm::ivec3> pixels;
  for (int y = 16; y < 32; ++y)
    for (int x = 24; x < 40; ++x) {
      const auto pixel = picture.at(x, y);
      pixels.emplace_back(pixel[0], pixel[1], pixel[2]);
    }
  return pixels;
}

void expect_light(const Place& place) {
  const std::unique_ptr<stage::Stage> stage = place.stage();
  const std::array methods{"multiple_environment_maps", "local_environment_maps", "simple_blend"};
  std::vector<std::vector<glm::ivec3>> first;
  for (const char* method : methods) {
    first.push_back(mirrored(*stage, method));
    for (const glm::ivec3 pixel : first.back())
      EXPECT_GT(pixel.x + pixel.y + pixel.z, 30) << method << ": black";
  }
  for (std::size_t i = 0; i < methods.size(); ++i)
    EXPECT_EQ(mirrored(*stage, methods[i]), first[i]) << methods[i] << " blinks";
}

TEST_F(OddPlacesTest, APlaceWithoutRoads) { expect_light(Place("")); }

TEST_F(OddPlacesTest, APlaceWithoutGeometryMirrorsTheSky) { expect_light(Place("", {0, 0, 0}, false)); }

TEST_F(OddPlacesTest, ACarThatNoMapReaches) {
  const std::string maps = "referenceMaps(position=\"0 -3 1.2\")\n";
  expect_light(Place(maps, {900, 700, 0}));
  expect_light(Place(maps, {0, -13, 0}));  // behind the wall, which hides it from the map
}

TEST_F(OddPlacesTest, CarsWithoutArea) {
  Place place(
      "model(file=\"thread.obj\", position=\"0 -1 0\", dynamic=1, reflective=1)\n"
      "model(file=\"dot.obj\", position=\"0 -1 0\", dynamic=1, reflective=1)\n");
  place.add("thread", {{{0, 0, 0}, {0, 0, 3}, {0, 0, 3}, {0, 0, 0}}});
  place.add("dot", {{{1, 0, 1}, {1, 0, 1}, {1, 0, 1}, {1, 0, 1}}});
  expect_light(place);
}

}  // namespace
}  // namespace parvis::rooms

#include <gtest/gtest.h>

#include "base/registries.h"
#include "graphics/gl/test_context.h"
#include "graphics/light/sun_and_sky.h"
#include "graphics/render/test_room.h"
#include "reflections/methods/frame.h"
#include "reflections/methods/lobe_levels.h"
#include "reflections/methods/registry.h"
#include "reflections/methods/settings.h"
#include "reflections/probes/methods.h"
#include "room_list.h"

namespace parvis::probes {
namespace {

using namespace render;  // the room with its walls

const methods::Registry& registry() {
  static Registries registries = [] {
    Registries made;
    register_room(made);
    return made;
  }();
  return registries.get<methods::Registry>();
}

constexpr int width = 160, height = 120;

/// A scene drawn with its method, frame after frame.
class Show {
 public:
  Show(scene::Scene scene, glm::vec3 eye, glm::vec3 target) : scene_(std::move(scene)) {
    camera_.world_from_camera = look_at(eye, target);
    Result<std::unique_ptr<render::Renderer>> renderer =
        render::Renderer::create(scene_, {}, light::sun_and_sky);
    EXPECT_TRUE(renderer) << to_string(renderer.errors());
    renderer_ = *std::move(renderer);
    Result<std::unique_ptr<methods::Reflections>> made = registry().make(scene_, *renderer_);
    EXPECT_TRUE(made) << to_string(made.errors());
    reflections_ = *std::move(made);
    const Status set = renderer_->set_reflection(reflections_.get());
    EXPECT_TRUE(set) << to_string(set.errors());
  }

  /// Draws a frame and returns the faces that were drawn for it.
  int draw() {
    EXPECT_TRUE(methods::draw_frame(*renderer_, scene_, reflections_.get(), {camera_, width, height}));
    return reflections_->faces_drawn();
  }
  ImageF radiance() const { return renderer_->read_radiance(); }
  scene::Scene& scene() { return scene_; }
  Camera& camera() { return camera_; }

 private:
  scene::Scene scene_;
  Camera camera_;
  std::unique_ptr<render::Renderer> renderer_;
  std::unique_ptr<methods::Reflections> reflections_;
};

class ReflectionsTest : public gl::ContextTest {};

constexpr float room_half_m = 8.0f, mirror_half_m = 1.0f;

scene::Scene room_with_mirror(const std::string& method) {
  scene::Scene scene = room_scene(room_half_m);
  add_mirror(scene, glm::vec3(0.0f), mirror_half_m);
  methods::settings(scene) = {method, 128, false};
  return scene;
}

/// Where a ray hits the mirror box about the origin, and the outward normal there; false: it passes by.
bool meets_mirror(glm::vec3 from, glm::vec3 direction, glm::vec3& point, glm::vec3& normal) {
  for (int axis = 0; axis < 3; ++axis) {
    const float side = from[axis] > 0.0f ? mirror_half_m : -mirror_half_m;
    const float distance = (side - from[axis]) / direction[axis];
    const glm::vec3 at = from + distance * direction;
    glm::vec3 reach = glm::abs(at);
    reach[axis] = 0.0f;
    if (std::abs(from[axis]) <= mirror_half_m || distance <= 0.0f ||
        std::max(reach.x, std::max(reach.y, reach.z)) > 0.97f * mirror_half_m)  // not at its edges
      continue;
    normal = glm::vec3(0.0f), normal[axis] = glm::sign(side), point = at;
    return true;
  }
  return false;
}

/// Unit direction from an eye through the middle of a pixel.
glm::vec3 direction_of_pixel(const glm::mat4& world_from_clip, glm::vec3 eye, int x, int y) {
  const glm::vec2 clip{2.0f * (float(x) + 0.5f) / width - 1.0f, 1.0f - 2.0f * (float(y) + 0.5f) / height};
  const glm::vec4 ahead = world_from_clip * glm::vec4(clip, 0.5f, 1.0f);
  return glm::normalize(glm::vec3(ahead) / ahead.w - eye);
}

/// The share of the mirror's pixels that show the wall which a mirror shows there.
float share_right(const std::string& method, glm::vec3 eye) {
  Show show(room_with_mirror(method), eye, glm::vec3(0.0f));
  show.camera().vertical_fov = 0.4f;
  show.draw();
  const ImageF radiance = show.radiance();
  const glm::mat4 world_from_clip = glm::inverse(
      show.camera().clip_from_camera(float(width) / float(height)) * show.camera().camera_from_world());
  int mirrored = 0, right = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const glm::vec3 direction = direction_of_pixel(world_from_clip, eye, x, y);
      glm::vec3 point, normal;
      if (!meets_mirror(eye, direction, point, normal)) continue;
      const int wall = wall_met(room_half_m, point, glm::reflect(direction, normal)).wall;
      const float* pixel = radiance.at(x, y);
      const glm::vec3 shown(pixel[0], pixel[1], pixel[2]);
      ++mirrored;
      right += glm::distance(shown, wall_colours[std::size_t(wall)]) < 0.3f;
    }
  EXPECT_GT(mirrored, 1000) << "the mirror is in the picture";
  return float(right) / float(mirrored);
}

constexpr glm::vec3 from_above{4.5f, -5.5f, 3.0f}, from_the_side{4.5f, -5.5f, 0.1f};

/// One map seen as infinitely far is wrong where two walls meet.
TEST_F(ReflectionsTest, MapsDrawnAboutTheMirrorShowTheRoom) {
  for (const char* method : {"rerendered_cube_map", "time_sliced_cube_map", "shared_cube_map"}) {
    EXPECT_GT(share_right(method, from_above), 0.85f) << method;
    EXPECT_LT(share_right(method, from_the_side), 0.92f) << method;
  }
}

/// The box that is fitted stands for a street: open above, with the road for its floor. Walls are where they
/// are.
TEST_F(ReflectionsTest, AProbesBoxPutsTheWallsWhereTheyAre) {
  EXPECT_GT(share_right("box_projected_probe", from_the_side), 0.94f);
  EXPECT_GT(share_right("box_projected_probe", from_above), 0.7f);
}

TEST_F(ReflectionsTest, WithoutReflectionTheMirrorShowsTheSky) {
  EXPECT_EQ(share_right("none", from_above), 0.0f);
  scene::Scene scene = room_with_mirror("none");
  scene.sky.picture = ImageF(64, 32, 3, 0.5f);
  Show show(std::move(scene), from_above, glm::vec3(0.0f));
  show.draw();
  const ImageF radiance = show.radiance();
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(radiance.at(width / 2, height / 2)[c], 0.5f, 0.01f);
}

/// A row of mirrors across the view of a camera at the origin that looks north, nearest first.
Show row_of_mirrors(methods::Settings reflection, std::initializer_list<float> distances_m) {
  scene::Scene scene = room_scene(30.0f);
  float across = -0.3f;
  for (const float distance_m : distances_m) {
    add_mirror(scene, {across * distance_m, distance_m, 0}, 0.5f);
    across += 0.6f / float(distances_m.size());
  }
  methods::settings(scene) = reflection;
  return Show(std::move(scene), glm::vec3(0.0f), {0, 1, 0});
}

TEST_F(ReflectionsTest, EveryReflectorHasAMapOfItsOwn) {
  Show show = row_of_mirrors({"rerendered_cube_map", 32, false}, {6, 8, 12, 16, 20});
  EXPECT_EQ(show.draw(), 5 * 6);
  EXPECT_EQ(show.draw(), 5 * 6);
}

TEST_F(ReflectionsTest, WithLevelOfDetailFarReflectorsShareAMap) {
  Show show = row_of_mirrors({"rerendered_cube_map", 32, true}, {3, 4, 12, 16, 20});
  EXPECT_EQ(show.draw(), (2 + 1) * 6);
  EXPECT_EQ(show.draw(), (2 + 1) * 6);
}

TEST_F(ReflectionsTest, TimeSlicingDrawsAFaceAFrameOnceMapsAreWhole) {
  Show show = row_of_mirrors({"time_sliced_cube_map", 32, false}, {6, 8, 10});
  EXPECT_EQ(show.draw(), 3 * 6);
  for (int frame = 0; frame < 8; ++frame) EXPECT_EQ(show.draw(), 3) << "frame " << frame;
}

TEST_F(ReflectionsTest, TimeSlicingDrawsNoMoreFacesThanItIsAllowed) {
  methods::Settings reflection{"time_sliced_cube_map", 32, false};
  for (const int faces : {1, 2, 5, 12}) {
    reflection.own.get<TimeSlicing>().faces_per_frame = faces;
    Show show = row_of_mirrors(reflection, {6, 8, 10});
    EXPECT_EQ(show.draw(), 3 * 6) << "maps are whole when they are first seen";
    for (int frame = 0; frame < 4; ++frame) EXPECT_EQ(show.draw(), faces);
  }
  reflection.own.get<TimeSlicing>().faces_per_frame = 100;
  Show show = row_of_mirrors(reflection, {6, 8});
  show.draw();
  EXPECT_EQ(show.draw(), 2 * 6) << "no face twice";
}

TEST_F(ReflectionsTest, ASharedMapIsDrawnOnceForAll) {
  Show show = row_of_mirrors({"shared_cube_map", 32, false}, {6, 8, 10});
  EXPECT_EQ(show.draw(), 6);
  EXPECT_EQ(show.draw(), 6);
}

TEST_F(ReflectionsTest, ProbesAreDrawnOnceUntilTheFixedSurroundingsChange) {
  Show show = row_of_mirrors({"box_projected_probe", 32, false}, {6, 8, 10});
  EXPECT_EQ(show.draw(), 6);  // no roads: one probe, where the first reflector stands
  EXPECT_EQ(show.draw(), 0);
  show.scene().objects.front().world_from_model[3].x = 1.0f;
  EXPECT_EQ(show.draw(), 6);
  EXPECT_EQ(show.draw(), 0);
}

/// A mirror in a room with a lamp, and a lane along which probes stand.
Show mirror_on_lane(float west_m, float east_m) {
  constexpr float middle_m = -0.5f;
  scene::Scene scene = room_scene(30.0f);
  add_mirror(scene, {middle_m, 0, 0}, 2.0f);
  scene::Material lamp = scene::matt(glm::vec3(0.0f));
  lamp.emission = glm::vec3(1.0f);
  scene::add(scene, scene::model_of(scene::box({-10, -23, -6}, {-4, -17, 0}), lamp));
  scene::Lane lane;
  lane.points = {{west_m, -3, -1.5f}, {east_m, -3, -1.5f}};
  scene.roads.lanes.push_back(lane);
  methods::settings(scene) = {"box_projected_probe", 64, false};
  Show show(std::move(scene), {4.5f, -14, 2}, {middle_m, 0, 0});
  show.camera().vertical_fov = 0.4f;
  return show;
}

/// How many pixels of two pictures differ in blue, which the lamp has and the wall behind it lacks, by more
/// than `apart`.
int pixels_apart(const ImageF& a, const ImageF& b, float apart) {
  int count = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) count += std::abs(a.at(x, y)[2] - b.at(x, y)[2]) > apart;
  return count;
}

TEST_F(ReflectionsTest, MidwayBetweenTwoProbesBothAreShownByHalf) {
  Show west = mirror_on_lane(-15.5f, -14.5f), east = mirror_on_lane(14.5f, 15.5f),
       both = mirror_on_lane(-15.5f, 15.5f);
  EXPECT_EQ(west.draw(), 6);
  EXPECT_EQ(east.draw(), 6);
  EXPECT_EQ(both.draw(), 12);
  EXPECT_EQ(both.draw(), 0) << "they are kept";
  ImageF half = west.radiance();
  const ImageF other = east.radiance();
  const int between_probes = pixels_apart(half, other, 0.2f);
  EXPECT_GT(between_probes, 50) << "the lamp stands nearer than the walls";
  for (std::size_t i = 0; i < half.pixels.size(); ++i)
    half.pixels[i] = 0.5f * (half.pixels[i] + other.pixels[i]);
  EXPECT_LT(pixels_apart(both.radiance(), half, 0.1f), between_probes / 4) << "outlines alone differ";
}

/// The reflection in a rough mirror is as wide as its lobe, not as a texel.
TEST_F(ReflectionsTest, RoughMirrorsShowTheMeanOverTheirLobe) {
  constexpr float roughness = 0.5f;
  scene::Scene scene = room_with_mirror("rerendered_cube_map");
  auto rough = std::make_shared<scene::Model>(*scene.objects.back().model);
  rough->materials.front().roughness = roughness;
  scene.objects.back().model = rough;
  Show show(std::move(scene), from_above, glm::vec3(0.0f));
  show.camera().vertical_fov = 0.4f;
  show.draw();
  const ImageF radiance = show.radiance();
  const glm::mat4 world_from_clip = glm::inverse(
      show.camera().clip_from_camera(float(width) / float(height)) * show.camera().camera_from_world());
  const auto hue = [](glm::vec3 colour) { return colour / (colour.x + colour.y + colour.z); };
  float error = 0.0f, error_of_smooth = 0.0f;
  for (int y = 0; y < height; y += 4)
    for (int x = 0; x < width; x += 4) {
      glm::vec3 point, normal;
      const glm::vec3 direction = direction_of_pixel(world_from_clip, from_above, x, y);
      if (!meets_mirror(from_above, direction, point, normal)) continue;
      const glm::vec3 mirrored = glm::reflect(direction, normal);
      const auto wall = [&](glm::vec3 way) {
        return wall_colours[std::size_t(wall_met(room_half_m, glm::vec3(0.0f), way).wall)];
      };
      glm::vec3 sum(0.0f);
      constexpr int directions = 512;
      for (int i = 0; i < directions; ++i) {
        const glm::vec3 way(methods::lobe_sample(mirrored, roughness, i, directions));
        if (glm::dot(way, mirrored) > 0.0f) sum += wall(way);
      }
      const float* pixel = radiance.at(x, y);
      error += glm::distance(hue({pixel[0], pixel[1], pixel[2]}), hue(sum));
      error_of_smooth += glm::distance(hue(wall(mirrored)), hue(sum));
    }
  EXPECT_GT(error_of_smooth, 0.0f) << "the mirror is in the picture";
  EXPECT_LT(error, 0.5f * error_of_smooth);
}

TEST_F(ReflectionsTest, WhatIsNotSeenCostsNoFace) {
  for (const std::string& method : registry().names()) {
    Show show = row_of_mirrors({method, 32, false}, {6, 8});
    show.camera().world_from_camera = look_at(glm::vec3(0.0f), {0, -1, 0});
    EXPECT_EQ(show.draw(), 0) << method;
  }
}

/// The room turns over. Before each side of the mirror one face of the map is seen: after one frame one has
/// followed, after six all.
TEST_F(ReflectionsTest, ATimeSlicedMapIsUpToDateAfterSixFrames) {
  const glm::mat4 turned = glm::rotate(glm::mat4(1.0f), glm::radians(120.0f), {1, 1, 1});
  int late = 0;
  for (int side = 0; side < 6; ++side) {
    glm::vec3 eye(0.5f, 0.4f, 0.3f);
    eye[side / 2] = side % 2 == 0 ? 6.5f : -6.5f;
    scene::Scene turned_scene = room_with_mirror("time_sliced_cube_map");
    turned_scene.objects.front().world_from_model = turned;
    Show fresh(std::move(turned_scene), eye, glm::vec3(0.0f));
    fresh.draw();
    const ImageF expected = fresh.radiance();

    Show show(room_with_mirror("time_sliced_cube_map"), eye, glm::vec3(0.0f));
    show.draw();
    show.scene().objects.front().world_from_model = turned;
    show.draw();
    late += show.radiance().pixels != expected.pixels;
    for (int frame = 1; frame < 6; ++frame) show.draw();
    EXPECT_EQ(show.radiance().pixels, expected.pixels) << "side " << side;
  }
  EXPECT_EQ(late, 5);
}

}  // namespace
}  // namespace parvis::probes

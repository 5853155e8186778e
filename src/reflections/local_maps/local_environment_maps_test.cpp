#include "reflections/local_maps/local_environment_maps.h"

#include <gtest/gtest.h>

#include <limits>

#include "graphics/gl/test_context.h"
#include "graphics/light/sun_and_sky.h"
#include "reflections/local_maps/local_map_faces.h"
#include "reflections/local_maps/local_map_settings.h"
#include "reflections/methods/frame.h"
#include "reflections/reference_maps/settings.h"
#include "reflections/reference_maps/simple_blend.h"
#include "reflections/reference_maps/test_square.h"

namespace parvis::local_maps {
using namespace reference_maps;
namespace {

constexpr float wall_at_m = 8.0f, wall_height_m = 6.0f;
constexpr glm::vec3 ground_colour{0.3f, 0.3f, 0.3f}, other_colour{1.0f, 0.5f, 1.0f};
constexpr glm::vec3 mirror_at{0.7f, 1.1f, 1.2f};

/// A court of four walls, each of a colour of its own, with a mirror; the object's index is 5.
scene::Scene court() {
  scene::Scene scene;
  scene.sun.irradiance = glm::vec3(0.0f);
  scene::add(scene, scene::model_of(scene::ground(30.0f), lamp(ground_colour)));
  for (int wall = 0; wall < 4; ++wall) {
    glm::vec3 low(-12, -12, 0), high(12, 12, wall_height_m);
    (wall % 2 == 0 ? low : high)[wall / 2] = wall % 2 == 0 ? wall_at_m : -wall_at_m;
    scene::add(scene, scene::model_of(scene::box(low, high), lamp(render::wall_colours[std::size_t(wall)])));
  }
  render::add_mirror(scene, mirror_at, 0.5f);
  scene.roads.lanes = {{{{-5, 0, 0}, {5, 0, 0}}, {}}};
  methods::settings(scene) = {"local_environment_maps", 128, false};
  methods::own_settings<MapSettings>(scene).max_maps = 2;
  return scene;
}
constexpr int mirror = 5;

class Court {
 public:
  explicit Court(scene::Scene made) : scene(std::move(made)) {
    camera.world_from_camera = look_at({-4, -5, 2.5f}, mirror_at);
    Result<std::unique_ptr<render::Renderer>> created =
        render::Renderer::create(scene, {}, light::sun_and_sky);
    EXPECT_TRUE(created) << to_string(created.errors());
    renderer = *std::move(created);
    Result<std::unique_ptr<LocalEnvironmentMaps>> method = LocalEnvironmentMaps::create(scene, *renderer);
    EXPECT_TRUE(method) << to_string(method.errors());
    reflections = *std::move(method);
    EXPECT_TRUE(renderer->set_reflection(reflections.get()));
  }

  /// Draws a frame; returns how many faces were made for it.
  int draw() {
    EXPECT_TRUE(methods::draw_frame(*renderer, scene, reflections.get(), {camera, 160, 120}));
    return reflections->faces_drawn();
  }

  /// The picture of all maps, row 0 at the bottom.
  ImageF maps(int level = 0) const {
    const glm::ivec2 size = reflections->picture().size() >> level;
    ImageF picture(size.x, size.y, 3);
    glGetTextureImage(reflections->picture().texture(), level, GL_RGB, GL_FLOAT,
                      GLsizei(picture.pixels.size() * sizeof(float)), picture.pixels.data());
    return picture;
  }

  /// The colour of the mirror's map in a direction.
  glm::vec3 shown(glm::vec3 direction, int level = 0) const {
    const LocalMapPlace place = reflections->place_of(mirror).value();
    const glm::vec2 texel = reflections->picture().corner(place.slot) +
                            texel_on_tiles(direction, float(place.tile), float(local_map_border));
    const ImageF picture = maps(level);
    const float* colour = picture.at(int(texel.x) >> level, int(texel.y) >> level);
    return {colour[0], colour[1], colour[2]};
  }

  scene::Scene scene;
  Camera camera;
  std::unique_ptr<render::Renderer> renderer;
  std::unique_ptr<LocalEnvironmentMaps> reflections;
};

/// The part of the court seen from within: a wall (0 to 3), the ground (4) or the sky (5), and how clearly:
/// the least angle, as a share of the distance, by which anything else is missed.
struct Seen {
  int what;
  float lead;
};
Seen seen_in_court(glm::vec3 from, glm::vec3 direction) {
  float wall_m = std::numeric_limits<float>::max(), second_m = wall_m;
  int wall = 0;
  for (int axis = 0; axis < 2; ++axis) {
    const float side = direction[axis] > 0.0f ? wall_at_m : -wall_at_m;
    const float distance_m = (side - from[axis]) / direction[axis];
    second_m = std::min(second_m, std::max(distance_m, wall_m));
    if (distance_m < wall_m) wall_m = distance_m, wall = 2 * axis + (direction[axis] > 0.0f ? 0 : 1);
  }
  const float z = from.z + wall_m * direction.z;
  const float lead = std::min({std::abs(z), std::abs(z - wall_height_m), second_m - wall_m}) / wall_m;
  return {z < 0.0f ? 4 : z > wall_height_m ? 5 : wall, lead};
}

class LocalMapsTest : public gl::ContextTest {};

TEST_F(LocalMapsTest, AMapShowsWhatItsCentreSees) {
  Court court_of_maps(court());
  court_of_maps.draw();
  const ImageF picture = court_of_maps.maps();
  const LocalMapPlace place = court_of_maps.reflections->place_of(mirror).value();
  ASSERT_EQ(place.tile, 128);
  int right = 0, judged = 0;
  for (int face = 0; face < 6; ++face)
    for (int y = 0; y < place.tile; ++y)
      for (int x = 0; x < place.tile; ++x) {
        const glm::vec2 in_tile(float(x) + 0.5f, float(y) + 0.5f);
        const glm::vec2 texel = court_of_maps.reflections->picture().corner(place.slot) +
                                tile_corner(face, float(place.tile)) + in_tile;
        const glm::vec3 direction =
            glm::normalize(direction_on_face(place_of_texel(in_tile, 128, local_map_border), face));
        const Seen seen = seen_in_court(mirror_at, direction);
        // Near an edge a texel of a reference map shows both sides, and a quad may not be split there.
        if (seen.what == 5 || seen.lead < 0.1f) continue;
        const float* pixel = picture.at(int(texel.x), int(texel.y));
        const glm::vec3 expected =
            seen.what == 4 ? ground_colour : render::wall_colours[std::size_t(seen.what)];
        ++judged;
        right += glm::distance(glm::vec3(pixel[0], pixel[1], pixel[2]), expected) < 0.05f;
      }
  EXPECT_GT(judged, 50000);
  EXPECT_GT(float(right) / float(judged), 0.99f);
}

/// Six bits of mantissa are what R11F_G11F_B10F has.
TEST_F(LocalMapsTest, CoarserLevelsAreTheMeansOfFinerOnes) {
  Court court_of_maps(court());
  court_of_maps.draw();
  for (int level = 1; level < local_map_levels; ++level) {
    const ImageF finer = court_of_maps.maps(level - 1), coarser = court_of_maps.maps(level);
    for (int y = 0; y < coarser.height; y += 3)
      for (int x = 0; x < coarser.width; x += 3)
        for (int c = 0; c < 3; ++c) {
          const float mean = 0.25f * (finer.at(2 * x, 2 * y)[c] + finer.at(2 * x + 1, 2 * y)[c] +
                                      finer.at(2 * x, 2 * y + 1)[c] + finer.at(2 * x + 1, 2 * y + 1)[c]);
          ASSERT_NEAR(coarser.at(x, y)[c], mean, 0.04f * mean + 0.01f) << level;
        }
  }
}

TEST_F(LocalMapsTest, AMirrorShowsTheSquareBetterThanSimplyBlendedMaps) {
  scene::Scene scene = tower_square();
  const glm::vec3 eye(6.0f, -2.0f, 2.4f);
  const double local = flip_of(scene, make_local_environment_maps, eye);
  const double blended = flip_of(scene, make_simple_blend, eye);
  // One centre stands for the whole box, whose sides are 1.2 m away from it.
  EXPECT_LT(local, 0.18);
  EXPECT_LT(local, 0.7 * blended) << local << " and " << blended;
  scene.objects.clear();
  render::add_mirror(scene, {1.5f, 0.5f, 1.6f}, 1.2f);
  EXPECT_LT(flip_of(scene, make_local_environment_maps, eye), 0.1) << "nothing but sky";
  EXPECT_LT(flip_of(scene, make_simple_blend, eye), 0.1) << "nothing but sky";
}

TEST_F(LocalMapsTest, ADynamicThingStandsInTheMapWhereNothingHidesIt) {
  scene::Scene with_others = court();
  const auto add_other = [&](glm::vec3 at) {
    scene::add(with_others,
               scene::model_of(scene::box(glm::vec3(-0.8f), glm::vec3(0.8f)), lamp(other_colour)), true,
               glm::translate(glm::mat4(1.0f), at));
  };
  add_other({5, 1, 1.5f});
  add_other({0, -11, 3});  // within a wall
  Court court_of_maps(std::move(with_others));
  EXPECT_EQ(court_of_maps.draw(), 6);
  EXPECT_LT(glm::distance(court_of_maps.shown(glm::vec3(5, 1, 1.5f) - mirror_at), other_colour), 0.05f);
  EXPECT_LT(glm::distance(court_of_maps.shown(glm::vec3(0, -11, 3) - mirror_at), render::wall_colours[3]),
            0.05f);
  EXPECT_EQ(court_of_maps.draw(), 6) << "others may move: the map is recomputed";
  court_of_maps.scene.objects[mirror + 1].is_visible = false;
  court_of_maps.scene.objects[mirror + 2].is_visible = false;
  EXPECT_EQ(court_of_maps.draw(), 6) << "the others are gone";
  EXPECT_LT(glm::distance(court_of_maps.shown(glm::vec3(5, 1, 1.5f) - mirror_at), render::wall_colours[0]),
            0.05f);
  EXPECT_EQ(court_of_maps.draw(), 0);
}

TEST_F(LocalMapsTest, AMapServesUntilItsBodyHasMovedByHalfATexel) {
  Court court_of_maps(court());
  EXPECT_EQ(court_of_maps.draw(), 6);
  EXPECT_EQ(court_of_maps.draw(), 0);
  glm::mat4& at = court_of_maps.scene.objects[mirror].world_from_model;
  at[3].x += 0.002f;  // of 1.2 m to the ground: 0.13 texels of 76 a radian
  EXPECT_EQ(court_of_maps.draw(), 0);
  at[3].x += 0.1f;
  EXPECT_EQ(court_of_maps.draw(), 6);
}

TEST_F(LocalMapsTest, BodiesInOnePlaceShareAMap) {
  scene::Scene scene = court();
  render::add_mirror(scene, mirror_at + glm::vec3(0.001f, 0, 0), 0.4f);
  scene.objects.back().is_dynamic = false;
  scene.objects[mirror].is_dynamic = false;
  Court court_of_maps(std::move(scene));
  EXPECT_EQ(court_of_maps.draw(), 6);
}

TEST_F(LocalMapsTest, FarBodiesAreSimplyBlended) {
  scene::Scene scene = court();
  methods::settings(scene).uses_level_of_detail = true;
  Court court_of_maps(std::move(scene));
  court_of_maps.camera.world_from_camera = look_at({-6, -6, 2.5f}, mirror_at);
  court_of_maps.camera.vertical_fov = 1.8f;
  EXPECT_EQ(court_of_maps.draw(), 0);
  EXPECT_FALSE(court_of_maps.reflections->place_of(mirror));
}

TEST_F(LocalMapsTest, ABudgetTakesTexelsAwayButNeverTheReflection) {
  int last_tile = 0;
  for (const float budget_ms : {0.001f, 0.3f, 1.0f, 10.0f}) {
    scene::Scene scene = court();
    methods::settings(scene).budget_ms = budget_ms;
    Court court_of_maps(std::move(scene));
    court_of_maps.draw();
    const std::optional<LocalMapPlace> place = court_of_maps.reflections->place_of(mirror);
    const int tile = place ? place->tile : 0;
    EXPECT_EQ(tile == 0, last_tile == 0 && budget_ms < 0.1f);
    EXPECT_GE(tile, last_tile);
    last_tile = tile;
  }
  EXPECT_EQ(last_tile, 128);
}

TEST_F(LocalMapsTest, TheMeshAndTheWeightsCanBeLookedAt) {
  scene::Scene scene = court();
  methods::own_settings<LocalMapSettings>(scene).shown = LocalMapView::mesh;
  Court meshes(scene);
  meshes.draw();
  int red = 0;
  const ImageF drawn = meshes.maps();
  for (int y = 0; y < drawn.height; ++y)
    for (int x = 0; x < drawn.width; ++x) {
      const float* p = drawn.at(x, y);
      red += p[0] == 1.0f && p[1] == 0.0f && p[2] == 0.0f;
    }
  EXPECT_GT(red, 5000);
  methods::own_settings<LocalMapSettings>(scene).shown = LocalMapView::weights;
  Court weights(scene);
  weights.draw();
  const ImageF shares = weights.maps();
  for (int y = 0; y < 256; ++y)
    for (int x = 0; x < 384; ++x) {
      const float* p = shares.at(x, y);
      ASSERT_NEAR(p[0] + p[1] + p[2], 1.0f, 0.03f) << "at " << x << ", " << y;  // six bits of mantissa
    }
}

TEST_F(LocalMapsTest, ABodyWithoutAreaIsNoError) {
  scene::Scene scene = court();
  const int flat = render::add_mirror(scene, mirror_at + glm::vec3(1, 0, 0), 0.0f);
  scene.objects[std::size_t(flat)].is_dynamic = false;
  Court court_of_maps(std::move(scene));
  EXPECT_GE(court_of_maps.draw(), 6);
  for (const float value : court_of_maps.renderer->read_radiance().pixels)
    ASSERT_TRUE(std::isfinite(value) && value >= 0.0f);
}

TEST(LocalMapLevel, FollowsTheSizeOnTheScreen) {
  EXPECT_EQ(level_for(1000.0f, 0.0f, 128), full_level(128));
  EXPECT_EQ(level_for(20.0f, 0.0f, 128).tile, 0) << "simply blended";
  EXPECT_EQ(level_for(300.0f, 0.0f, 256).tile, 256);
  EXPECT_EQ(level_for(100.0f, 0.0f, 256).tile, 64);
  EXPECT_GE(level_for(50.0f, 0.0f, 128).smallest_texels, 1.0f);
  const LocalMapLevel still = level_for(200.0f, 0.0f, 128), fast = level_for(200.0f, 40.0f, 128);
  EXPECT_LT(fast.tile, still.tile) << "motion blur";
  EXPECT_GT(fast.smallest_texels, still.smallest_texels);
}

TEST(LocalMapSlots, GiveTheIdlestSlotAndNoneThatIsUsed) {
  LocalMapSlots slots;
  slots.begin_frame(2, true);
  const LocalMapWish a{{0, 0, 0}, 1.0f, 128, 1.0f, false}, b{{9, 0, 0}, 1.0f, 128, 1.0f, false},
      c{{0, 9, 0}, 1.0f, 128, 1.0f, false};
  EXPECT_FALSE(slots.find(a));
  const std::optional<int> of_a = slots.take(a), of_b = slots.take(b);
  ASSERT_TRUE(of_a && of_b);
  EXPECT_NE(*of_a, *of_b);
  EXPECT_FALSE(slots.take(c)) << "both are used";
  EXPECT_EQ(slots.find(a), of_a);
  slots.begin_frame(2, false);
  EXPECT_EQ(slots.find(b), of_b);
  EXPECT_EQ(slots.take(c), of_a);
  slots.forget();
  EXPECT_FALSE(slots.find(b));
}

}  // namespace
}  // namespace parvis::local_maps

#include "reflections/environment_rays/multiple_environment_maps.h"

#include <gtest/gtest.h>

#include <array>

#include "base/random.h"
#include "base/registries.h"
#include "graphics/bounced_light/bounced_over.h"
#include "graphics/gl/test_context.h"
#include "graphics/light/sun_and_sky.h"
#include "reflections/methods/frame.h"
#include "reflections/methods/registry.h"
#include "reflections/reference_maps/map_levels.h"
#include "reflections/reference_maps/placement.h"
#include "reflections/reference_maps/settings.h"
#include "reflections/reference_maps/test_square.h"
#include "room_list.h"

namespace parvis::environment_rays {
using namespace reference_maps;
namespace {

constexpr float room_half_m = 8.0f;

class EnvironmentMapsTest : public gl::ContextTest {};

TEST_F(EnvironmentMapsTest, ALayerHoldsColourAndDistanceOfEveryDirection) {
  scene::Scene scene = render::room_scene(room_half_m);
  Result<std::unique_ptr<render::Renderer>> renderer =
      render::Renderer::create(scene, {}, light::sun_and_sky);
  ASSERT_TRUE(renderer) << to_string(renderer.errors());
  (*renderer)->begin_frame(scene, Camera{});
  const std::vector<glm::vec3> places{{4, 2.5f, -3.5f}, {-3.5f, -4.5f, 2}};
  const Result<ReferenceMaps> maps = ReferenceMaps::bake(**renderer, places, 32);
  ASSERT_TRUE(maps) << to_string(maps.errors());
  const std::size_t side = std::size_t(maps->resolution());
  std::vector<glm::vec3> colours(2 * side * side);
  std::vector<float> distances(2 * side * side);
  glGetTextureImage(maps->colours(), 0, GL_RGB, GL_FLOAT, GLsizei(colours.size() * sizeof(glm::vec3)),
                    colours.data());
  glGetTextureImage(maps->distances(), 0, GL_RED, GL_FLOAT, GLsizei(distances.size() * sizeof(float)),
                    distances.data());
  for (std::size_t i = 0; i < colours.size(); ++i) {
    const glm::vec2 uv = (glm::vec2(i % side, i / side % side) + 0.5f) / float(side);
    const glm::vec3 place = places[i / (side * side)];
    const glm::vec3 direction = layer_direction(uv, float(side), float(ReferenceMaps::border));
    const render::WallHit hit = render::wall_met(room_half_m, place, direction);
    if (hit.lead_m < 3.0f) continue;  // a texel near an edge shows two walls
    ASSERT_LT(glm::distance(colours[i], render::wall_colours[std::size_t(hit.wall)]), 0.02f);
    const float side_m = hit.wall % 2 == 0 ? room_half_m : -room_half_m;
    const float expected_m = (side_m - place[hit.wall / 2]) / direction[hit.wall / 2];
    ASSERT_NEAR(distances[i], expected_m, 0.05f * expected_m);
  }
}

TEST_F(EnvironmentMapsTest, ScenesWithStreetsAndMirrorsHaveThisMethodUnlessTheyNameAnother) {
  Registries registries;
  register_room(registries);
  const methods::Registry& registry = registries.get<methods::Registry>();
  scene::Scene scene = render::room_scene(room_half_m);
  render::add_mirror(scene, glm::vec3(0.0f), 1.0f);
  EXPECT_EQ(registry.name_of(scene), "") << "no street";
  scene.roads.lanes.emplace_back().points = {{0, 0, 0}, {5, 0, 0}};
  EXPECT_EQ(registry.name_of(scene), "multiple_environment_maps");
  methods::settings(scene).method = "none";
  EXPECT_EQ(registry.name_of(scene), "none");
  methods::settings(scene).method = methods::automatic;
  for (scene::Object& object : scene.objects) object.takes_reflection = false;
  EXPECT_EQ(registry.name_of(scene), "") << "nothing mirrors";
}

TEST_F(EnvironmentMapsTest, AGlossyTileIsTheMeanOverTheLobe) {
  const scene::Scene scene = render::room_scene(room_half_m);
  Result<std::unique_ptr<render::Renderer>> renderer =
      render::Renderer::create(scene, {}, light::sun_and_sky);
  ASSERT_TRUE(renderer) << to_string(renderer.errors());
  (*renderer)->begin_frame(scene, Camera{});
  const glm::vec3 place(4, 2.5f, -3.5f);
  const Result<ReferenceMaps> maps = ReferenceMaps::bake(**renderer, {place}, 32);
  ASSERT_TRUE(maps) << to_string(maps.errors());
  const int row = int(gloss_tile_count * gloss_side);
  std::vector<glm::vec3> radiances(std::size_t(row) * std::size_t(gloss_side));
  glGetTextureImage(maps->glosses(), 0, GL_RGB, GL_FLOAT, GLsizei(radiances.size() * sizeof(glm::vec3)),
                    radiances.data());
  Random random(3);
  for (int trial = 0; trial < 60; ++trial) {
    const int tile = random.index(int(gloss_tile_count)), x = random.index(int(gloss_side)),
              y = random.index(int(gloss_side));
    const glm::vec3 normal = layer_direction((glm::vec2(x, y) + 0.5f) / gloss_side, gloss_side, gloss_border);
    const float alpha = gloss_of_tile(float(tile)) * gloss_of_tile(float(tile));
    const glm::vec3 across = glm::normalize(
        glm::cross(std::abs(normal.z) < 0.9f ? glm::vec3(0, 0, 1) : glm::vec3(1, 0, 0), normal));
    glm::vec3 mean(0.0f);
    int counted = 0;
    for (int i = 0; i < 4000; ++i) {
      const float u = random.uniform(), phi = 6.2831853f * random.uniform();
      const float cosine = std::sqrt((1.0f - u) / (1.0f + (alpha * alpha - 1.0f) * u));
      const float sine = std::sqrt(1.0f - cosine * cosine);
      const glm::vec3 half =
          sine * std::cos(phi) * across + sine * std::sin(phi) * glm::cross(normal, across) + cosine * normal;
      const glm::vec3 direction = glm::reflect(-normal, half);
      if (glm::dot(direction, normal) <= 0.0f) continue;
      mean += render::wall_colours[std::size_t(render::wall_met(room_half_m, place, direction).wall)];
      ++counted;
    }
    mean /= float(counted);
    const glm::vec3 baked =
        radiances[std::size_t(y) * std::size_t(row) + std::size_t(tile * int(gloss_side) + x)];
    EXPECT_LT(glm::distance(baked, mean), 0.05f) << "tile " << tile << ", texel " << x << ' ' << y;
  }
}

TEST(MapLevels, RoughnessRunsThroughTheTilesWithoutAGap) {
  for (float roughness = min_gloss; roughness <= 1.0f; roughness += 0.01f) {
    const glm::vec3 tiles = gloss_tiles(roughness);
    EXPECT_NEAR(glm::mix(gloss_of_tile(tiles.x), gloss_of_tile(tiles.y), tiles.z), roughness, 1e-4f);
    EXPECT_LT(tiles.y, gloss_tile_count);
  }
}

TEST_F(EnvironmentMapsTest, AMirrorShowsTheSquareThatTheRayTracerShows) {
  const scene::Scene scene = tower_square();
  for (const glm::vec3 eye : {glm::vec3(-2.5f, -3.5f, 2.2f), glm::vec3(6.0f, -2.0f, 2.4f)}) {
    EXPECT_LT(flip_of(scene, make_multiple_environment_maps, eye), 0.08);
    EXPECT_GT(flip_of(scene, nullptr, eye), 0.25) << "the sky alone";
  }
}

// No map shows dynamic objects; a mirror that passes over it stands at 0.112.
TEST_F(EnvironmentMapsTest, AMirrorShowsDynamicThingsBesideIt) {
  scene::Scene scene = tower_square();
  const Mesh van = scene::box({-2.6f, 0.2f, 0.2f}, {-1.2f, 2.2f, 1.8f});
  scene::add(scene, scene::model_of(van, scene::matt({0.85f, 0.1f, 0.05f})), true);
  EXPECT_LT(flip_of(scene, make_multiple_environment_maps, {-2.5f, -3.5f, 2.2f}), 0.08);
}

/// A red van beside a mirror between high black walls, under a dark sky that glows along the horizon alone.
scene::Scene van_between_walls() {
  scene::Scene scene;
  scene.sun.irradiance = glm::vec3(0.0f);
  scene.sky.picture = ImageF(64, 32, 3, 0.02f);
  for (int y = 13; y < 16; ++y)  // up to 17 degrees
    for (int x = 0; x < 64; ++x)
      for (int c = 0; c < 3; ++c) scene.sky.picture.at(x, y)[c] = 4.0f;
  const scene::Material black = lamp(glm::vec3(0.0f));
  const auto add = [&](const Mesh& mesh) { scene::add(scene, scene::model_of(mesh, black)); };
  add(scene::ground(10)), add(scene::box({-10, -10, 0}, {-8, 10, 14}));
  add(scene::box({8, -10, 0}, {10, 10, 14})), add(scene::box({-8, -10, 0}, {8, -8, 14}));
  add(scene::box({-8, 8, 0}, {8, 10, 14}));
  scene::add(scene,
             scene::model_of(scene::box({-2.6f, 0.2f, 0.2f}, {-1.2f, 2.2f, 1.8f}),
                             scene::matt({0.85f, 0.1f, 0.05f})),
             true);
  render::add_mirror(scene, {1.5f, 0.5f, 1.6f}, 1.2f);
  methods::settings(scene) = {"multiple_environment_maps", 32, false};
  methods::own_settings<MapSettings>(scene).max_maps = 4;
  scene.data<scene::BouncedSettings>() = {true, 3.0f, 128};
  return scene;
}

TEST_F(EnvironmentMapsTest, DynamicThingsHaveTheLightOfThatPartOfTheSkyWhichTheySee) {
  const scene::Scene scene = van_between_walls();
  Result<std::unique_ptr<render::Renderer>> renderer =
      render::Renderer::create(scene, {}, bounced_light::with_bounced_light(light::sun_and_sky));
  ASSERT_TRUE(renderer) << to_string(renderer.errors());
  const auto reflections = make_multiple_environment_maps(scene, **renderer);
  ASSERT_TRUE(reflections) << to_string(reflections.errors());
  ASSERT_TRUE((*renderer)->set_reflection(reflections->get()));
  Camera camera;
  camera.world_from_camera = look_at({-2.5f, -3.5f, 2.2f}, {1.5f, 0.5f, 1.6f});
  const render::EyeView eye{camera, test_width, test_height};
  ASSERT_TRUE(methods::draw_frame(**renderer, scene, reflections->get(), eye));
  const ImageF drawn = (*renderer)->read_radiance();
  const reference::TracedPicture truth = methods::trace_frame(**renderer, scene, eye);
  // What is red in the mirror is diffuse light of the van: all else is grey.
  const auto redness = [&](const ImageF& picture) {
    double sum = 0.0;
    for (int y = 0; y < test_height; ++y)
      for (int x = 0; x < test_width; ++x)
        if (*truth.mirror_mask.at(x, y) == 255) sum += double(picture.at(x, y)[0] - picture.at(x, y)[2]);
    return sum;
  };
  ASSERT_GT(redness(truth.radiance), 0.0);
  // The body's field is coarse at its edges. By the whole sky it would be lit many times as brightly.
  EXPECT_NEAR(redness(drawn) / redness(truth.radiance), 1.0, 0.5);
}

// Heights have no air under what spans the ground.
TEST_F(EnvironmentMapsTest, AMirrorShowsWhatStandsBeyondABridge) {
  scene::Scene scene = tower_square();
  const Mesh bridge = scene::box({-11, -40, 3.5f}, {-8, 40, 4.5f});
  scene::add(scene, scene::model_of(bridge, lamp({0.9f, 0.5f, 0.2f})));
  const Mesh arcade = scene::box({-30, -12, 4.0f}, {30, -9, 5.0f});
  scene::add(scene, scene::model_of(arcade, lamp({0.2f, 0.5f, 0.4f})));
  EXPECT_LT(flip_of(scene, make_multiple_environment_maps, {-2.5f, -3.5f, 2.2f}), 0.08);
}

// What has holes, crowns of trees say, is not among the heights: only the maps know it. A mirror that takes
// it for what lies behind it stands at 0.268, and one that meets edges between crown and sky at 0.105.
TEST_F(EnvironmentMapsTest, AMirrorShowsACrownWhereItStands) {
  scene::Scene scene = tower_square();
  scene::Material leaves = lamp({0.3f, 0.7f, 0.2f});
  leaves.alpha_mode = scene::Alpha::cutout;
  scene::add(scene, scene::model_of(scene::sphere({-5.0f, 5.5f, 2.5f}, 1.6f), leaves));
  scene::add(scene, scene::model_of(scene::sphere({6.0f, -5.0f, 2.5f}, 1.8f), leaves));
  EXPECT_LT(flip_of(scene, make_multiple_environment_maps, {-2.5f, -3.5f, 2.2f}), 0.095);
}

// All maps stand under a roof, which hides from them the sky that the mirror beside it shows.
TEST_F(EnvironmentMapsTest, AMirrorShowsTheSkyThatNoMapSees) {
  scene::Scene scene = tower_square();
  scene::add(scene, scene::model_of(scene::box({3.5f, -9, 3.0f}, {14, 3, 3.5f}), lamp({0.9f, 0.5f, 0.2f})));
  map_plan(scene).places = {{6, -5, 1.5f}, {10, -5, 1.5f}, {6, -1, 1.5f}, {10, -1, 1.5f}};
  EXPECT_LT(flip_of(scene, make_multiple_environment_maps, {0.5f, -1.0f, 7.0f}), 0.3)
      << "a mirror that shows the roof's lower side in place of the sky stands at 0.66";
}

// Light is computed before the first view is drawn; maps that were kept have drawn nothing either.
TEST_F(EnvironmentMapsTest, TheFirstFrameIsLikeTheSecond) {
  scene::Scene scene = tower_square();
  const Mesh van = scene::box({-2.6f, 0.2f, 0.2f}, {-1.2f, 2.2f, 1.8f});
  scene::add(scene, scene::model_of(van, scene::matt({0.85f, 0.1f, 0.05f})), true);
  Result<std::unique_ptr<render::Renderer>> renderer =
      render::Renderer::create(scene, {}, light::sun_and_sky);
  ASSERT_TRUE(renderer) << to_string(renderer.errors());
  const auto reflections = make_multiple_environment_maps(scene, **renderer);
  ASSERT_TRUE(reflections) << to_string(reflections.errors());
  ASSERT_TRUE((*renderer)->set_reflection(reflections->get()));
  for (GLuint unit = 0; unit < 32; ++unit) glBindTextureUnit(unit, 0);
  Camera camera;
  camera.world_from_camera = look_at({-2.5f, -3.5f, 2.2f}, {1.5f, 0.5f, 1.6f});
  ImageF frames[2];
  for (ImageF& frame : frames) {
    EXPECT_TRUE(
        methods::draw_frame(**renderer, scene, reflections->get(), {camera, test_width, test_height}));
    frame = (*renderer)->read_radiance();
  }
  EXPECT_EQ(frames[0].pixels, frames[1].pixels);
}

// Of two eyes that see a mirror each, the second must not displace what the first found missing.
TEST_F(EnvironmentMapsTest, EachEyeOfAFrameGetsTheMapsThatItLooksInto) {
  scene::Scene scene = tower_square();
  render::add_mirror(scene, {30.0f, -30.0f, 1.6f}, 1.2f);
  const auto facing = [](glm::vec3 mirror) {
    Camera camera;
    camera.world_from_camera = look_at(mirror + glm::vec3(-4, -4, 0.6f), mirror);
    camera.vertical_fov = 0.6f;
    return render::EyeView{camera, 160, 120};
  };
  const render::EyeView first = facing({1.5f, 0.5f, 1.6f}), second = facing({30.0f, -30.0f, 1.6f});
  const auto seen_first = [&](std::span<const render::EyeView> eyes) {
    Result<std::unique_ptr<render::Renderer>> renderer =
        render::Renderer::create(scene, {}, light::sun_and_sky);
    EXPECT_TRUE(renderer) << to_string(renderer.errors());
    const auto reflections = make_multiple_environment_maps(scene, **renderer);
    EXPECT_TRUE(reflections) << to_string(reflections.errors());
    EXPECT_TRUE((*renderer)->set_reflection(reflections->get()));
    EXPECT_TRUE(methods::draw_frame(**renderer, scene, reflections->get(), eyes));
    (*renderer)->select_eye(0);
    return (*renderer)->read_radiance().pixels;
  };
  EXPECT_EQ(seen_first(std::array{first, second}), seen_first(std::array{first}));
}

TEST_F(EnvironmentMapsTest, TheLightOfAFrameComesBackAfterMapsThatAreDrawnBehindIt) {
  scene::Scene scene = tower_square();
  Result<std::unique_ptr<render::Renderer>> renderer =
      render::Renderer::create(scene, {}, light::sun_and_sky);
  ASSERT_TRUE(renderer) << to_string(renderer.errors());
  const auto reflections = make_multiple_environment_maps(scene, **renderer);
  ASSERT_TRUE(reflections) << to_string(reflections.errors());
  (*reflections)->prefer_rate();
  ASSERT_TRUE((*renderer)->set_reflection(reflections->get()));
  Camera camera;
  camera.world_from_camera = look_at({-2.5f, -3.5f, 2.2f}, {1.5f, 0.5f, 1.6f});
  const auto shade = [&] {
    const shading::BodyShade& bodies = *(*renderer)->drawn_light().body_shade;
    return std::string(reinterpret_cast<const char*>(&bodies), sizeof(bodies));
  };
  ASSERT_TRUE(methods::draw_frame(**renderer, scene, reflections->get(), {camera, test_width, test_height}));
  EXPECT_GT((*renderer)->frames_begun(), 1) << "a map is drawn behind the frame";
  const std::string elsewhere = shade();
  (*renderer)->relight_main_view(scene, camera);
  const std::string own = shade();
  EXPECT_NE(own, elsewhere);
  (*renderer)->begin_frame(scene, camera);
  EXPECT_EQ(shade(), own);
}

TEST_F(EnvironmentMapsTest, ABudgetTakesDetailAwayButNeverTheReflection) {
  scene::Scene scene = tower_square();
  const int mirror = int(scene.objects.size()) - 1;
  Result<std::unique_ptr<render::Renderer>> renderer =
      render::Renderer::create(scene, {}, light::sun_and_sky);
  ASSERT_TRUE(renderer) << to_string(renderer.errors());
  Camera camera;
  camera.world_from_camera = look_at({-2.5f, -3.5f, 2.2f}, {1.5f, 0.5f, 1.6f});
  int last_detail = 0;
  for (const float budget_ms : {0.001f, 12.0f, 1000.0f, 0.0f}) {  // the last: none
    methods::settings(scene).budget_ms = budget_ms;
    const auto made = MultipleEnvironmentMaps::create(scene, **renderer);
    ASSERT_TRUE(made) << to_string(made.errors());
    ASSERT_TRUE((*renderer)->set_reflection(made->get()));
    (*renderer)->begin_frame(scene, camera);
    (*renderer)->prepare_main_view(camera, test_width, test_height);
    (*made)->update(**renderer, scene, camera);
    const int detail = (*made)->detail_of(mirror);
    EXPECT_EQ(detail == nearest_map, budget_ms == 0.001f);
    EXPECT_GE(detail, last_detail);
    last_detail = detail;
    if (budget_ms > 0.0f) continue;
    const auto held_to = [&](double held_ms) {  // by a window, while it runs
      (*made)->hold(held_ms);
      (*made)->update(**renderer, scene, camera);
      return (*made)->detail_of(mirror);
    };
    EXPECT_EQ(held_to(0.001), nearest_map);
    EXPECT_EQ(held_to(0.0), all_detail);
  }
  EXPECT_EQ(last_detail, all_detail);
}

TEST_F(EnvironmentMapsTest, ASceneWithoutAnythingFixedStillReflectsItsSky) {
  scene::Scene scene;
  render::add_mirror(scene, glm::vec3(0.0f, 0.0f, 1.5f), 1.0f);
  methods::settings(scene) = {"multiple_environment_maps", 32, false};
  methods::own_settings<MapSettings>(scene).max_maps = 4;
  EXPECT_LT(flip_of(scene, make_multiple_environment_maps, {-3.0f, -2.0f, 3.5f}), 0.1);
}

TEST_F(EnvironmentMapsTest, PlacesAreApartAndOnTheStreets) {
  scene::Scene scene;
  scene.roads.lanes = {{{{0, 0, 0}, {200, 0, 0}}, {}}, {{{100, 2, 0}, {100, 150, 0}}, {}}};
  const HeightPyramid nothing{shading::Heightfield(Bounds{})};
  const std::vector<glm::vec3> few = spread_places(scene, nothing, 9);
  ASSERT_EQ(few.size(), 9u);
  for (std::size_t i = 0; i < few.size(); ++i) {
    EXPECT_TRUE(std::abs(few[i].y) < 0.01f || std::abs(few[i].x - 100.0f) < 0.01f);
    for (std::size_t j = 0; j < i; ++j) EXPECT_GT(glm::distance(few[i], few[j]), 25.0f);
  }
  EXPECT_LT(spread_places(scene, nothing, 1000).size(), 60u) << "near-duplicates are dropped";
}

}  // namespace
}  // namespace parvis::environment_rays

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "graphics/gl/test_context.h"
#include "graphics/light/shadow_settings.h"
#include "graphics/reference/camera_ray.h"
#include "graphics/reference/test_wrong_pixels.h"
#include "graphics/reference/tracer.h"
#include "graphics/render/frame_views.h"
#include "graphics/render/test_renderer.h"
#include "graphics/shadows/chosen_light.h"
#include "graphics/shadows/near_map_fit.h"
#include "room_list.h"
#include "scene/data/test_scene.h"
#include "scene/script/live_scene.h"
#include "scene/script/scene_builder.h"
#include "scene/script/test_script.h"

namespace parvis::shadows {
namespace {

using light::ShadowTechnique;

/// A street with walls, a roof on posts and a box.
scene::Scene street() {
  scene::Scene scene;
  const scene::Material grey = scene::matt(glm::vec3(0.5f));
  add(scene, scene::model_of(scene::ground(60), grey));
  add(scene, scene::model_of(scene::box({-12, -10, 0}, {-9, 50, 9}), grey));
  add(scene, scene::model_of(scene::box({9, 5, 0}, {12, 30, 7}), grey));
  add(scene, scene::model_of(scene::box({-3, 12, 3}, {3, 16, 3.2f}), grey));
  add(scene, scene::model_of(scene::box({3, 4, 0}, {4, 5, 1.2f}), grey));
  scene.sun.direction_to_sun = glm::normalize(glm::vec3(0.75f, -0.3f, 0.4f));
  return scene;
}

Camera street_camera() {
  Camera camera;
  camera.world_from_camera = look_at({0.3f, -12, 1.7f}, {0, 20, 1.0f});
  camera.vertical_fov = 0.9f;
  return camera;
}

Bounds bounds_of(const scene::Scene& scene) {
  Bounds bounds;
  for (const scene::Object& object : scene.objects) bounds.add(scene::bounds(*object.model));
  return bounds;
}

glm::vec3 projected(const light::NearMap& map, glm::vec3 p) {
  const glm::vec4 h = map.clip_from_world * glm::vec4(p, 1.0f);
  EXPECT_GT(h.w, 0.0f);
  return glm::vec3(h) / h.w;
}

TEST(NearMapFit, DepthGrowsAwayFromTheSunAlongLinesThatKeepTheirTexel) {
  const scene::Scene scene = street();
  const reference::RayScene rays(scene);
  const Bounds casters = bounds_of(scene);
  for (const glm::vec3 sun : {glm::vec3(0.5f, -0.45f, 0.6f), glm::vec3(-0.3f, 0.8f, 0.5f),
                              glm::vec3(0.0f, -0.9f, 0.4f), glm::vec3(0.02f, 0.0f, 1.0f)})
    for (const auto method : {light::ShadowMethod::cascades, light::ShadowMethod::perspective,
                              light::ShadowMethod::light_space_perspective}) {
      const glm::vec3 to_sun = glm::normalize(sun);
      const light::SeenSurfaces seen = seen_surfaces(rays, street_camera(), true);
      const light::NearMap map = fit_near_map(method, street_camera(), to_sun, seen, casters);
      ASSERT_GT(seen.positions.size(), 1000u);
      for (std::size_t i = 0; i < seen.positions.size(); i += 7) {
        const glm::vec3 p = seen.positions[i], here = projected(map, p),
                        above = projected(map, p + 4.0f * to_sun);
        EXPECT_LT(std::abs(here.x), 1.001f);
        EXPECT_LT(std::abs(here.y), 1.001f);
        EXPECT_NEAR(here.x, above.x, 2e-3f);
        EXPECT_NEAR(here.y, above.y, 2e-3f);
        EXPECT_LT(above.z, here.z) << light::shadow_method_names[std::size_t(method)];
        EXPECT_LE(here.z, 1.0f);
        EXPECT_GE(above.z, -1.001f);
      }
    }
}

TEST(NearMapFit, TilesAreQuartersThatHoldWhatTheyServe) {
  const scene::Scene scene = street();
  const reference::RayScene rays(scene);
  const light::SeenSurfaces seen = seen_surfaces(rays, street_camera(), true);
  const light::NearMap map = fit_near_map(light::ShadowMethod::cascades, street_camera(),
                                          scene.sun.direction_to_sun, seen, bounds_of(scene));
  ASSERT_EQ(map.tile_count, 4);
  EXPECT_GT(map.tiles[3].x, 3.0f * map.tiles[0].x) << "the finest is last";
  std::set<int> serving;
  for (const glm::vec3 p : seen.positions) {
    const glm::vec2 uv = 0.5f + 0.5f * glm::vec2(projected(map, p));
    int finest = -1;
    for (int i = 0; i < 4; ++i) {
      const glm::vec4 tile = map.tiles[std::size_t(i)];
      const glm::vec2 at =
          uv * glm::vec2(tile) + glm::vec2(tile.z, tile.w) - 0.5f * glm::vec2(float(i % 2), float(i / 2));
      if (std::min(at.x, at.y) > 0.0f && std::max(at.x, at.y) < 0.5f) finest = i;
    }
    ASSERT_GE(finest, 0);
    serving.insert(finest);
  }
  EXPECT_EQ(serving.size(), 4u);
}

TEST(TracedSun, AStillViewConvergesToTheDiscAndAJumpIsAStillOfItsOwn) {
  scene::Scene scene;
  add(scene, scene::model_of(scene::ground(60), scene::matt(glm::vec3(0.5f))));
  add(scene, scene::model_of(scene::box({-40, 5, 30}, {40, 45, 31}), scene::matt(glm::vec3(0.5f))));
  scene.sun.direction_to_sun = {0, 0, 1};
  const reference::RayScene rays(scene, reference::Precision::fine);
  Camera camera;
  camera.world_from_camera = look_at({0, 5, 8}, {0, 5, 0}, {0, 1, 0});
  camera.vertical_fov = 0.1f;
  TracedSun traced;
  const auto shares = [&] {
    std::set<float> all;
    for (const glm::vec2 pixel : traced.pixels()) all.insert(pixel.x);
    return all.size();
  };
  traced.trace(rays, 1, {}, scene::sun_light(scene), camera, 64, 64, 32);
  EXPECT_EQ(traced.samples(), 32) << "the first picture is a still";
  EXPECT_GT(shares(), 8u) << "half a degree, 30 m up: a penumbra of 28 cm";
  camera.world_from_camera[3].y += 0.01f;
  traced.trace(rays, 1, {}, scene::sun_light(scene), camera, 64, 64, 32);
  EXPECT_EQ(traced.samples(), 0);
  EXPECT_EQ(shares(), 2u) << "a moving view sees the middle of the disc";
  traced.trace(rays, 1, {}, scene::sun_light(scene), camera, 64, 64, 32);
  EXPECT_EQ(traced.samples(), 1);
  EXPECT_EQ(shares(), 2u) << "one direction of the disc would be noise";
  traced.trace(rays, 2, {}, scene::sun_light(scene), camera, 64, 64, 32);
  EXPECT_EQ(traced.samples(), 0) << "another scene";
  camera.world_from_camera[3].y += 10.0f;
  traced.trace(rays, 2, {}, scene::sun_light(scene), camera, 64, 64, 32);
  EXPECT_EQ(traced.samples(), 32);
}

TEST(TracedSun, AMovedThingIsTracedAgainAndTheRestStaysSoft) {
  scene::Scene scene;
  add(scene, scene::model_of(scene::ground(60), scene::matt(glm::vec3(0.5f))));
  add(scene, scene::model_of(scene::box({-8, 4, 6}, {-2, 12, 7}), scene::matt(glm::vec3(0.5f))));
  add(scene, scene::model_of(scene::box({2, 0, 1}, {4, 2, 3}), scene::matt(glm::vec3(0.5f))));
  scene.objects[2].is_dynamic = true;
  scene.sun.direction_to_sun = glm::normalize(glm::vec3(0.3f, -0.2f, 1.0f));
  reference::RayScene rays(scene, reference::Precision::fine);
  Camera camera;
  camera.world_from_camera = look_at({0, -22, 12}, {0, 12, 0}, {0, 0, 1});
  camera.vertical_fov = 0.9f;
  const auto trace = [&](TracedSun& traced, std::span<const Bounds> moved) {
    traced.trace(rays, 1, moved, scene::sun_light(scene), camera, 160, 120, 32);
  };
  TracedSun traced, blind;
  trace(traced, {}), trace(blind, {});
  scene.objects[2].world_from_model[3].x = -3.0f;
  ASSERT_TRUE(rays.update(scene));
  EXPECT_EQ(rays.moved().size(), 2u) << "the box where it stood, and where it stands";
  trace(traced, rays.moved()), trace(blind, {});
  EXPECT_EQ(traced.samples(), 0);
  TracedSun fresh;
  trace(fresh, {});
  std::size_t other = 0, hard = 0, wrong_blind = 0, soft = 0;
  for (std::size_t i = 0; i < fresh.pixels().size(); ++i) {
    const glm::vec2 truth = fresh.pixels()[i], is = traced.pixels()[i];
    EXPECT_EQ(is.y, truth.y);
    hard += is.x != truth.x ? 1 : 0;
    other += std::abs(is.x - truth.x) > 0.75f ? 1 : 0;
    wrong_blind += blind.pixels()[i] != truth ? 1 : 0;
    soft += is.x > 0.0f && is.x < 1.0f ? 1 : 0;
  }
  EXPECT_EQ(other, 0u);
  EXPECT_GT(soft, 20u) << "the penumbra of the roof that stands still";
  EXPECT_LT(hard, 200u) << "the penumbra of what moved";
  EXPECT_GT(wrong_blind, 300u) << "control: as if nothing had moved";
  ASSERT_FALSE(rays.update(scene));
  EXPECT_TRUE(rays.moved().empty());
  for (int i = 0; i < 32; ++i) trace(traced, {});
  EXPECT_EQ(traced.pixels(), fresh.pixels());
}

class ChosenLightTest : public gl::ContextTest {
 protected:
  std::unique_ptr<render::Renderer> renderer_of(const scene::Scene& scene) {
    return render::renderer_of(scene, ChosenLight::create);
  }
  static ImageF drawn(render::Renderer& renderer, const scene::Scene& scene, int size) {
    EXPECT_TRUE(render::draw_frame(renderer, scene, {street_camera(), size, size}));
    return renderer.read_radiance();
  }
  /// Percent of a picture's pixels whose light is off by more than a tenth from exact rays.
  static double wrong_percent(render::Renderer& renderer, const scene::Scene& scene) {
    return wrong_percent(renderer, scene, scene);
  }
  /// The same of the picture of `shown` beside the rays through `scene`.
  static double wrong_percent(render::Renderer& renderer, const scene::Scene& shown,
                              const scene::Scene& scene) {
    constexpr int size = 200;
    const ImageF picture = drawn(renderer, shown, size);
    shading::DrawnLight exact = renderer.drawn_light();
    exact.has_exact_shadows = true;
    const reference::RayScene rays(scene);
    reference::TraceOptions options;
    options.samples_per_pixel = 16;
    options.drawn_light = &exact;
    const ImageF truth =
        reference::trace_picture(rays, scene, renderer.sky(), street_camera(), size, size, options).radiance;
    return reference::wrong_percent(picture, truth);
  }
};

TEST_F(ChosenLightTest, EveryMethodDrawsTheShadowsThatRaysFind) {
  scene::Scene scene = street();
  const auto renderer = renderer_of(scene);
  std::vector<double> wrong;
  for (std::size_t i = 0; i < light::shadow_technique_names.size(); ++i) {
    scene.data<light::ShadowSettings>().technique = ShadowTechnique(i);
    scene.data<light::ShadowSettings>().sun_samples = 1;
    wrong.push_back(wrong_percent(*renderer, scene));
    std::printf("%s: %.2f %% of the pixels are off\n", light::shadow_technique_names[i], wrong.back());
    // Edges: blurred over a few texels by the filter, over a pixel by the samples.
    EXPECT_LT(wrong.back(), 1.5) << light::shadow_technique_names[i];
  }
  scene.data<light::ShadowSettings>().technique = ShadowTechnique::cached_cascades;
  const scene::Scene with_roof = scene;
  scene.data<scene::SunShadows>().casts_none = {false, true, true};
  const auto without = renderer_of(scene);
  EXPECT_GT(wrong_percent(*without, scene, with_roof), 3.0 * wrong[0])
      << "the comparison sees a missing shadow";
}

TEST_F(ChosenLightTest, SpotLightsAndReceiversAgreeWithTheRayTracer) {
  scene::Scene scene = street();
  scene.data<scene::SunShadows>() = {scene::Spot{{0, 0, 8}, 0.7f}, {}, {false, false, false, false, true}};
  scene.sun.direction_to_sun = glm::normalize(glm::vec3(0, -1, 1));
  const auto renderer = renderer_of(scene);
  EXPECT_LT(wrong_percent(*renderer, scene), 4.0);
  scene.data<light::ShadowSettings>().technique = ShadowTechnique::rays;
  EXPECT_LT(wrong_percent(*renderer, scene), 3.0);
}

class ShadowMapNode : public scene::ScriptTest<> {
 protected:
  ShadowMapNode() {
    script::register_room(registries_);
    light::register_room(registries_);
  }
};

TEST_F(ShadowMapNode, HasTheSpellingsOfTheThesis) {
  for (const char* type : {"shadowMap", "xpShadowMap", "%xpShadowMap", "%shadowMap"}) {
    const auto loaded =
        load(std::string(type) + "(method=\"perspective\", lightposition=\"1 2 3\", spot=1)\n");
    ASSERT_TRUE(loaded) << to_string(loaded.errors());
    EXPECT_EQ(loaded->scene.data<light::ShadowSettings>().technique, ShadowTechnique::perspective);
    EXPECT_EQ(scene::sun_light(loaded->scene).spot->position, glm::vec3(1, 2, 3));
  }
  EXPECT_FALSE(load("shadowMap()\n%xpShadowMap()\n")) << "a scene has one";
}

TEST_F(ShadowMapNode, TakesTheMessagesOfTheThesisAndGivesTheSunBack) {
  auto loaded = load("sun(direction=\"0 1 1\")\n%xpShadowMap()\n");
  ASSERT_TRUE(loaded) << to_string(loaded.errors());
  scene::Scene& scene = loaded->scene;
  scene::LiveScene live(std::move(loaded->script));
  const auto tell = [&](const char* text) {
    const scene::Node* node = live.find("%xpShadowMap");
    ASSERT_NE(node, nullptr);
    const auto message = scene::parse_message(*node->schema, text, {});
    ASSERT_TRUE(message) << text;
    EXPECT_TRUE(live.receive(*node, *message)) << text;
    EXPECT_TRUE(live.refresh(scene).empty()) << text;
  };
  tell("lightposition 0 0 -200");
  tell("lightDirection 0 0 1");
  tell("lightAngle 45.0");
  EXPECT_FALSE(scene::sun_light(scene).spot) << "the angle is ignored if it is no spot light";
  EXPECT_EQ(scene.sun.direction_to_sun, glm::vec3(0, 0, -1));
  tell("spot on");
  EXPECT_EQ(scene::sun_light(scene).spot->position, glm::vec3(0, 0, -200));
  EXPECT_NEAR(scene::sun_light(scene).spot->half_angle, glm::radians(22.5f), 1e-6f);
  tell("spot off");
  EXPECT_FALSE(scene::sun_light(scene).spot);
}

TEST_F(ShadowMapNode, ChoosesCastersAndReceiversByTheirGroups) {
  scene::NodeSchema stone{.type = "object", .attributes = {{.name = "name"}}};
  registries_.get<scene::NodeRegistry>().add(stone, [](const scene::Node&, scene::SceneBuilder& builder) {
    scene::Object object;
    object.model = scene::model_of(scene::ground(1), scene::matt(glm::vec3(0.5f)));
    builder.add(object);
  });
  const auto loaded = load(
      "object()\ngroup(name=a) { object() group(name=b) { object() } }\nobject(name=c)\n"
      "shadowMap(casters=a, receivers=b, receivers=c)\n");
  ASSERT_TRUE(loaded) << to_string(loaded.errors());
  std::string casters, receivers;
  const auto& shadows = loaded->scene.data<scene::SunShadows>();
  for (std::size_t i = 0; i < 4; ++i) {
    casters += shadows.casts(i) ? '1' : '0';
    receivers += shadows.receives(i) ? '1' : '0';
  }
  EXPECT_EQ(casters, "0110");
  EXPECT_EQ(receivers, "0011");
  // What is no object is known by its node: the group a is the second, the object c the fifth.
  std::string by_node;
  for (int node = 0; node < 6; ++node) by_node += shadows.casts_item_of(node) ? '1' : '0';
  EXPECT_EQ(by_node, "011110") << "the group, what it holds, and no other";
}

TEST_F(ShadowMapNode, IsThereForMessagesAndScenariosThatNameIt) {
  const auto loaded = load("scenario(name=\"lamp\") { override(of=\"%xpShadowMap\", spot=1) }\n");
  ASSERT_TRUE(loaded) << to_string(loaded.errors());
  EXPECT_TRUE(scene::find_node(loaded->script.nodes, "%shadowMap"));
  auto other = load("scenario(name=\"exact\") { override(of=\"%shadowMap\", method=\"rays\") }\n");
  ASSERT_TRUE(other) << to_string(other.errors());
  scene::LiveScene live(std::move(other->script));
  ASSERT_TRUE(live.choose(other->scene, "exact"));
  EXPECT_EQ(other->scene.data<light::ShadowSettings>().technique, ShadowTechnique::rays);
  const auto none = load("sun(direction=\"0 1 1\")\n");
  ASSERT_TRUE(none) << to_string(none.errors());
  EXPECT_FALSE(scene::find_node(none->script.nodes, "%shadowMap")) << "nobody speaks of it";
}

TEST_F(ShadowMapNode, SaysWhatIsWrong) {
  EXPECT_NE(errors_of("shadowMap(casters=\"trees\")").find("no node of the scene has this name"),
            std::string::npos);
  EXPECT_NE(errors_of("group(name=\"trees\") { }\nshadowMap(casters=\"trees\")").find("holds nothing that"),
            std::string::npos);
  EXPECT_NE(errors_of("group(name=\"a\") { sun() }\nshadowMap()\nscenario(name=\"s\") { "
                      "override(of=\"%shadowMap\", casters=\"a\") }")
                .find("keeps, once the scene is loaded, its \"casters\""),
            std::string::npos);
  EXPECT_NE(errors_of("shadowMap(lightDirection=\"0 0 0\")").find("no length"), std::string::npos);
  EXPECT_NE(errors_of("shadowMap(lightAngle=180)").find("lightAngle"), std::string::npos);
  EXPECT_NE(errors_of("shadowMap(method=\"raytraced\")").find("method"), std::string::npos);
}

}  // namespace
}  // namespace parvis::shadows

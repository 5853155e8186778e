#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "base/random.h"
#include "graphics/gl/test_context.h"
#include "graphics/lamps/lamp_light.h"
#include "graphics/lamps/lamp_process.h"
#include "graphics/lamps/nodes_lamp.h"
#include "graphics/light/sun_and_sky.h"
#include "graphics/reference/photograph.h"
#include "graphics/reference/scene_lamps.h"
#include "graphics/reference/test_wrong_pixels.h"
#include "graphics/reference/tracer.h"
#include "graphics/render/fixed_parts.h"
#include "graphics/render/frame_views.h"
#include "graphics/render/test_renderer.h"
#include "room_list.h"
#include "scene/action/scene_clock.h"
#include "scene/data/test_scene.h"
#include "scene/script/scene_builder.h"
#include "scene/script/test_script.h"

namespace parvis::lamps {
namespace {

using glm::vec3;

scene::Lamp lamp_at(vec3 position, float watts_per_sr = 20.0f, float reach_m = 30.0f) {
  scene::Lamp lamp;
  lamp.position = position, lamp.intensity = vec3(1.0f, 0.8f, 0.5f) * watts_per_sr, lamp.reach_m = reach_m;
  lamp.radius_m = 0.2f, lamp.burns = scene::LampSwitch::always;
  return lamp;
}

void add_lamp(scene::Scene& scene, const scene::Lamp& lamp) {
  scene.data<scene::ItemsOf<scene::Lamp>>().add(lamp, 0);
}

/// A street by night: ground, two walls, a box that casts shadows, three lamps.
scene::Scene night_street() {
  scene::Scene scene;
  const scene::Material grey = scene::matt(vec3(0.5f));
  add(scene, scene::model_of(scene::ground(60), grey));
  add(scene, scene::model_of(scene::box({-12, -10, 0}, {-9, 50, 9}), grey));
  add(scene, scene::model_of(scene::box({9, 5, 0}, {12, 30, 7}), grey));
  add(scene, scene::model_of(scene::box({-5, 8, 0}, {4, 12, 3}), grey));
  scene.sun.irradiance = vec3(0.0f);
  scene.sky.intensity = 0.02f;
  add_lamp(scene, lamp_at({-5, 14, 4.5f}));
  add_lamp(scene, lamp_at({-1, 16, 2.5f}, 60.0f, 50.0f));
  scene::Lamp spot = lamp_at({0, 26, 6}, 40.0f);
  spot.axis = glm::normalize(vec3(0, -1, -0.7f)), spot.half_angle = 0.6f;
  add_lamp(scene, spot);
  return scene;
}

Camera street_camera() {
  Camera camera;
  camera.world_from_camera = look_at({0.3f, -12, 1.7f}, {0, 20, 1.0f});
  camera.vertical_fov = 0.9f;
  return camera;
}

TEST(LampTable, FindsTheLampsThatReachAPoint) {
  scene::Scene scene;
  Random random(3);
  for (int i = 0; i < 200; ++i)
    add_lamp(scene, lamp_at({random.uniform(-200, 200), random.uniform(-200, 200), random.uniform(2, 6)},
                            random.uniform(1, 9), random.uniform(4, 16)));
  const std::vector<shading::Lamp> lamps = reference::lit_lamps(scene);
  ASSERT_EQ(lamps.size(), 200u);
  const shading::LampTable table = shading::make_lamp_table(lamps);
  const auto all_visible = [](const shading::Lamp&, vec3, vec3) { return 1.0f; };
  shading::LampLookup lookup{table, all_visible};
  double found = 0.0, expected = 0.0;
  for (int i = 0; i < 4000; ++i) {
    const vec3 at(random.uniform(-220, 220), random.uniform(-220, 220), 0.0f), up(0, 0, 1);
    vec3 sum(0.0f);
    for (const shading::Lamp& lamp : lamps) {
      const vec3 away = vec3(lamp.place) - at;
      sum += std::max(glm::normalize(away).z, 0.0f) *
             shading::lamp_irradiance(lamp, glm::normalize(away), glm::length(away));
    }
    const vec3 looked_up = lookup.irradiance_of_lamps(at, up);
    EXPECT_NEAR(looked_up.x, sum.x, 1e-5f + 1e-4f * sum.x);
    found += double(looked_up.x), expected += double(sum.x);
  }
  EXPECT_GT(expected, 1.0);
}

TEST(LampTable, EightStrongestOfMoreShineInACell) {
  std::vector<shading::Lamp> lamps;
  scene::Scene scene;
  for (int i = 0; i < 20; ++i) add_lamp(scene, lamp_at({0, 0, 4}, float(i + 1)));
  const shading::LampTable table = shading::make_lamp_table(reference::lit_lamps(scene));
  const glm::uvec4 cell = table.cell({0, 0, 0});
  EXPECT_EQ(cell.x & 65535u, 20u);
  EXPECT_EQ(cell.w >> 16, 13u);
  EXPECT_EQ(table.cell({1000, 0, 0}), glm::uvec4(0u));
}

TEST(SceneLamps, StandOnObjectsAndOnBothOfAPairOfParts) {
  scene::Scene scene;
  auto car = std::make_shared<scene::Model>();
  car->materials.push_back(scene::matt(vec3(0.5f)));
  for (const float y : {-0.7f, 0.7f}) {
    Mesh glass = scene::box({2.0f, y - 0.1f, 0.6f}, {2.1f, y + 0.1f, 0.8f});
    if (car->parts.empty())
      car->parts.push_back({"lamp", std::move(glass), 0, 0, true});
    else
      append(car->parts[0].mesh, glass, glm::mat4(1.0f));
  }
  const int object =
      add(scene, car, true,
          glm::rotate(glm::translate(glm::mat4(1.0f), vec3(10, 0, 0)), 1.5707963f, vec3(0, 0, 1)));
  scene.objects[std::size_t(object)].name = "vehicle 1";
  scene::Lamp lamp = lamp_at({0, 0, 0});
  lamp.of = "vehicle *", lamp.part = "lamp", lamp.axis = {1, 0, 0}, lamp.half_angle = 0.5f;
  add_lamp(scene, lamp);
  const std::vector<shading::Lamp> lamps = reference::lit_lamps(scene, reference::LampKind::moving);
  ASSERT_EQ(lamps.size(), 2u);
  EXPECT_TRUE(reference::lit_lamps(scene, reference::LampKind::still).empty());
  EXPECT_NEAR(lamps[0].place.x, 9.3f, 1e-4f) << "the left one";
  EXPECT_NEAR(lamps[0].place.y, 2.05f, 1e-4f);
  EXPECT_NEAR(lamps[1].place.x, 10.7f, 1e-4f);
  EXPECT_NEAR(lamps[0].axis.y, 1.0f, 1e-5f) << "turned with the car";
}

TEST(SceneLamps, BurnAtDuskAndShowWhatIsSeenByTheirLight) {
  scene::Scene scene;
  const int windows = add(scene, scene::model_of(scene::ground(1), scene::matt(vec3(0.5f))));
  scene.objects[std::size_t(windows)].name = "lit windows";
  scene::Lamp lamp = lamp_at({0, 0, 4});
  lamp.burns = scene::LampSwitch::dusk, lamp.shows = "lit *";
  add_lamp(scene, lamp);
  LampProcess process;
  for (const bool is_dark : {false, true}) {
    scene.data<scene::Darkness>().is_dark = is_dark;
    process.present(scene, 0.0);
    EXPECT_EQ(scene.objects[std::size_t(windows)].is_visible, is_dark);
    EXPECT_EQ(reference::lit_lamps(scene).size(), is_dark ? 1u : 0u);
  }
}

TEST(SceneLamps, TheLastOfThoseThatShowAnObjectDecides) {
  const auto is_shown = [](const std::string& first, const std::string& last, bool last_burns) {
    scene::Scene scene;
    const int windows = add(scene, scene::model_of(scene::ground(1), scene::matt(vec3(0.5f))));
    scene.objects[std::size_t(windows)].name = "lit windows";
    for (const bool is_last : {false, true}) {
      scene::Lamp lamp = lamp_at({0, 0, 4});
      lamp.shows = is_last ? last : first;
      lamp.burns = is_last == last_burns ? scene::LampSwitch::always : scene::LampSwitch::never;
      add_lamp(scene, lamp);
    }
    scene::show_what_lamps_show(scene);
    return scene.objects[std::size_t(windows)].is_visible;
  };
  for (const char* first : {"lit windows", "lit *", "*s"})
    for (const char* last : {"lit windows", "lit *", "lit window?"}) {
      EXPECT_TRUE(is_shown(first, last, true)) << first << ", " << last;
      EXPECT_FALSE(is_shown(first, last, false)) << first << ", " << last;
    }
}

TEST(PathTracer, SeesTheGroundUnderALampAsBrightAsTheLawSays) {
  scene::Scene scene;
  add(scene, scene::model_of(scene::ground(60), scene::matt(vec3(0.5f))));
  scene.sun.irradiance = vec3(0.0f);
  scene.sky.intensity = 0.0f;
  add_lamp(scene, lamp_at({0, 0, 5}, 20.0f, 50.0f));
  Camera camera;
  camera.world_from_camera = look_at({4, 0, 3}, {0, 0, 0});
  camera.vertical_fov = 0.01f;
  const reference::RayScene rays(scene);
  const shading::SkyLight sky = shading::make_sky_light(scene.sky.picture, scene.sky.intensity, 0.0f);
  const auto photograph = reference::take_photograph(rays, scene, sky, camera, 4, 4, {});
  ASSERT_TRUE(photograph) << to_string(photograph.errors());
  // Nearly Lambert's: a rough surface keeps a few percent for its highlight.
  const float window = float(std::pow(1.0 - std::pow(5.0 / 50.0, 4.0), 2.0));
  const float expected = 0.5f / 3.1415927f * 20.0f / 25.0f * window;
  EXPECT_NEAR(photograph->radiance.at(2, 2)[0], expected, 0.08f * expected);
}

class LampPicture : public gl::ContextTest {
 protected:
  static std::unique_ptr<render::Renderer> renderer_of(const scene::Scene& scene) {
    return render::renderer_of(scene, with_lamps(light::sun_and_sky));
  }
  static constexpr int size = 160;
  static ImageF drawn(render::Renderer& renderer, const scene::Scene& scene) {
    EXPECT_TRUE(render::draw_frame(renderer, scene, {street_camera(), size, size}));
    return renderer.read_radiance();
  }
  /// Percent of the pixels that are off by more than a tenth.
  static double wrong_percent(const ImageF& picture, const scene::Scene& scene,
                              const shading::DrawnLight& light, const shading::SkyLight& sky) {
    const reference::RayScene rays(scene);
    reference::TraceOptions options;
    options.samples_per_pixel = 16;
    options.drawn_light = &light;
    const ImageF truth =
        reference::trace_picture(rays, scene, sky, street_camera(), size, size, options).radiance;
    return reference::wrong_percent(picture, truth, 0.0003f);
  }
};

TEST_F(LampPicture, AgreesWithTheRayTracerThatReadsItsMapsAndWithExactRays) {
  const scene::Scene scene = night_street();
  const auto renderer = renderer_of(scene);
  const ImageF picture = drawn(*renderer, scene);
  shading::DrawnLight light = renderer->drawn_light();
  ASSERT_NE(light.lamps, nullptr);
  ASSERT_EQ(light.lamps->lamps.size(), 3u);
  EXPECT_LT(wrong_percent(picture, scene, light, renderer->sky()), 1.0) << "the same light, the same maps";
  light.has_exact_shadows = true;
  const double off = wrong_percent(picture, scene, light, renderer->sky());
  std::printf("%.2f %% of the pixels are off from exact rays\n", off);
  EXPECT_LT(off, 6.0) << "edges of shadows are as coarse as a texel of the lamps' maps";
  for (auto depth = light.lamps->depths.begin(); depth != light.lamps->depths.end(); ++depth)
    const_cast<std::uint16_t&>(*depth) = 65535;
  light.has_exact_shadows = false;
  EXPECT_GT(wrong_percent(picture, scene, light, renderer->sky()), 10.0)
      << "the comparison sees lamps that shine through walls";
}

/// The other lamps that burn keep their depth maps.
TEST_F(LampPicture, ALampThatIsSwitchedHasItsMapAloneTraced) {
  scene::Scene scene = night_street();
  auto& hung = scene.data<scene::ItemsOf<scene::Lamp>>().items;
  const auto make = [&] {
    auto below = light::sun_and_sky(scene, render::bounds_of_fixed_parts(scene, false));
    EXPECT_TRUE(below) << to_string(below.errors());
    return LampLight(*std::move(below));
  };
  const auto depths_of = [&](LampLight& light) {
    light.update(scene);
    light.draw_shadows(street_camera(), {}, [](const render::View&) {});
    const std::span<const std::uint16_t> depths = light.lamps()->depths;
    return std::vector<std::uint16_t>(depths.begin(), depths.end());
  };
  const auto depths_then = [&] {
    LampLight fresh = make();
    return depths_of(fresh);
  };
  LampLight light = make();
  const std::vector<std::uint16_t> all = depths_of(light);
  EXPECT_EQ(light.maps_traced(), 3u);
  hung[0].burns = scene::LampSwitch::never;
  EXPECT_EQ(depths_of(light), depths_then());
  EXPECT_EQ(light.maps_traced(), 3u) << "the others have moved to other layers";
  hung[0].burns = scene::LampSwitch::always;
  EXPECT_EQ(depths_of(light), all);
  EXPECT_EQ(light.maps_traced(), 4u);
  hung[2].position.z += 0.5f;
  EXPECT_EQ(depths_of(light), depths_then());
  EXPECT_EQ(light.maps_traced(), 5u);
}

TEST_F(LampPicture, LampsOfMovingObjectsFollowThemAndArePartOfNoStillPicture) {
  scene::Scene scene = night_street();
  scene.data<scene::ItemsOf<scene::Lamp>>() = {};
  const int cart =
      add(scene, scene::model_of(scene::box({-0.5f, -0.5f, 0}, {0.5f, 0.5f, 0.4f}), scene::matt(vec3(0.2f))),
          true);
  scene.objects[std::size_t(cart)].name = "cart";
  scene::Lamp lamp = lamp_at({0, 0, 1.5f});
  lamp.of = "cart";
  add_lamp(scene, lamp);
  const auto renderer = renderer_of(scene);
  const auto brightness = [&] {
    double sum = 0.0;
    for (const float value : drawn(*renderer, scene).pixels) sum += double(std::min(value, 10.0f));
    return sum;
  };
  const double here = brightness();
  scene.objects[std::size_t(cart)].world_from_model = glm::translate(glm::mat4(1.0f), vec3(0, -58, 0));
  const double behind = brightness();
  EXPECT_GT(here, 1.05 * behind);
  scene.objects[std::size_t(cart)].world_from_model = glm::mat4(1.0f);
  EXPECT_NEAR(brightness(), here, 1e-3 * here);
  renderer->begin_still_frame(scene, street_camera());
  EXPECT_EQ(renderer->drawn_light().lamps, nullptr);
}

class LampNode : public scene::ScriptTest<> {
 protected:
  LampNode() {
    script::register_room(registries_);
    light::register_room(registries_);
    add_lamp_node(registries_.get<scene::NodeRegistry>());
  }
};

TEST_F(LampNode, HasTheFluxThatItIsGiven) {
  const auto loaded = load("lamp(flux_lm=683, colour=\"1 0.5 0.25\", burns=always)\n");
  ASSERT_TRUE(loaded) << to_string(loaded.errors());
  const vec3 intensity = loaded->scene.items<scene::Lamp>().front().intensity;
  const float watts = 4.0f * 3.1415927f * glm::dot(intensity, vec3(0.2126f, 0.7152f, 0.0722f));
  EXPECT_NEAR(watts, 1.0f, 1e-3f);
  EXPECT_NEAR(intensity.y / intensity.x, 0.5f, 1e-5f);
}

TEST_F(LampNode, StandsInTheFrameOfItsGroup) {
  const auto loaded = load("group(position=\"10 0 0\", heading_deg=90) { lamp(position=\"0 5 3\") }\n");
  ASSERT_TRUE(loaded) << to_string(loaded.errors());
  const vec3 place = loaded->scene.items<scene::Lamp>().front().position;
  EXPECT_NEAR(place.x, 15.0f, 1e-4f);
  EXPECT_NEAR(place.y, 0.0f, 1e-4f);
  EXPECT_TRUE(load("group(visible=0) { lamp() }\n")->scene.items<scene::Lamp>().empty());
}

TEST_F(LampNode, IsLitAtDuskAndTheEyeAdaptsToIt) {
  const auto lit = [&](const char* hour, const char* lamps) {
    auto loaded = load(std::string("dayLight(standardMeridian=2, timeOfDay=") + hour + ")\n" + lamps);
    EXPECT_TRUE(loaded) << to_string(loaded.errors());
    return std::pair{reference::lit_lamps(loaded->scene).size(), loaded->scene.exposure};
  };
  EXPECT_EQ(lit("13", "lamp()\n").first, 0u);
  EXPECT_EQ(lit("21.9", "lamp()\n").first, 1u);
  EXPECT_EQ(lit("21.9", "lamp(burns=never)\n").first, 0u);
  EXPECT_LT(lit("23.5", "lamp()\n").second, 0.2f * lit("23.5", "").second);
  EXPECT_EQ(lit("13", "lamp()\n").second, lit("13", "").second);
}

TEST_F(LampNode, WarnsOfNamesThatNothingHas) {
  const auto warnings = [&](const std::string& lamp) {
    auto loaded = load(lamp);
    EXPECT_TRUE(loaded) << to_string(loaded.errors());
    add(loaded->scene, scene::model_of(scene::box({0, 0, 0}, {1, 1, 1}), scene::matt(vec3(0.5f))));
    loaded->scene.objects.back().name = "post 1";
    action::Processes processes;
    processes.add([] { return std::make_unique<LampProcess>(); });
    action::SceneClock clock(processes, scene::LiveScene(std::move(loaded->script)), loaded->scene);
    return to_string(clock.take_warnings());
  };
  EXPECT_EQ(warnings("lamp(of=\"post *\")"), "");
  EXPECT_EQ(warnings("lamp(position=\"0 0 4\")"), "");
  EXPECT_EQ(warnings("group(visible=0) { lamp(of=\"pots *\") }"), "");
  const std::string of = warnings("lamp(of=\"pots *\")");
  EXPECT_NE(of.find("\"pots *\"; did you mean \"post 1\"?"), std::string::npos) << of;
  EXPECT_NE(warnings("lamp(shows=\"lit windows\")").find("lit windows"), std::string::npos);
  const std::string part = warnings("lamp(of=\"post *\", part=\"bulb\")");
  EXPECT_NE(part.find("no part of \"post *\" is called \"bulb\""), std::string::npos) << part;
}

/// A group that is hidden at first: its lamps are looked at when a scenario shows it, and once.
TEST_F(LampNode, WarnsOfNamesThatNothingHasWhenAScenarioShowsTheLamp) {
  auto loaded = load(
      "group(name=\"stalls\", visible=0) { lamp(of=\"pots *\", burns=always) lamp(position=\"0 0 4\", "
      "burns=always) }\n"
      "scenario(name=\"market\") { override(of=\"stalls\", visible=1) }\n");
  ASSERT_TRUE(loaded) << to_string(loaded.errors());
  action::Processes processes;
  processes.add([] { return std::make_unique<LampProcess>(); });
  action::SceneClock clock(processes, scene::LiveScene(std::move(loaded->script)), loaded->scene);
  EXPECT_EQ(to_string(clock.take_warnings()), "");
  EXPECT_TRUE(reference::lit_lamps(loaded->scene).empty());
  ASSERT_TRUE(clock.live().choose(loaded->scene, "market"));
  clock.follow(loaded->scene);
  EXPECT_NE(to_string(clock.take_warnings()).find("\"pots *\""), std::string::npos);
  EXPECT_EQ(reference::lit_lamps(loaded->scene).size(), 1u) << "the one that stands by itself";
  ASSERT_TRUE(clock.live().choose(loaded->scene, ""));
  clock.follow(loaded->scene);
  EXPECT_TRUE(reference::lit_lamps(loaded->scene).empty());
  ASSERT_TRUE(clock.live().choose(loaded->scene, "market"));
  clock.follow(loaded->scene);
  EXPECT_EQ(to_string(clock.take_warnings()), "") << "once";
}

TEST_F(LampNode, SaysWhatIsWrong) {
  EXPECT_NE(errors_of("lamp(part=\"lamp\")").find("give of="), std::string::npos);
  EXPECT_NE(errors_of("lamp(direction=\"0 0 0\")").find("no length"), std::string::npos);
  EXPECT_NE(errors_of("lamp(colour=\"0 0 0\")").find("black"), std::string::npos);
  EXPECT_NE(errors_of("lamp(flux_lm=-1)").find("flux_lm"), std::string::npos);
  EXPECT_NE(errors_of("lamp(burns=noon)").find("burns"), std::string::npos);
  EXPECT_NE(errors_of("lamp(angle_deg=400)").find("angle_deg"), std::string::npos);
}

}  // namespace
}  // namespace parvis::lamps

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "base/random.h"
#include "formats/gltf/gltf_writer.h"
#include "formats/gltf/test_mesh_file.h"
#include "graphics/gl/test_context.h"
#include "graphics/light/sun_and_sky.h"
#include "graphics/lit_objects/lighting_process.h"
#include "graphics/reference/frame.h"
#include "graphics/reference/test_wrong_pixels.h"
#include "graphics/reference/tracer.h"
#include "graphics/render/frame_views.h"
#include "graphics/render/light_source.h"
#include "graphics/render/renderer.h"
#include "room_list.h"
#include "scene/action/scene_clock.h"
#include "scene/data/test_scene.h"
#include "scene/script/test_script.h"

namespace parvis::lit_objects {
namespace {

using glm::vec3;

/// A scene that runs.
struct Running {
  scene::Scene scene;
  std::unique_ptr<action::SceneClock> clock;
  Errors warnings;

  scene::Object& object(const std::string& name) {
    for (scene::Object& each : scene.objects)
      if (each.name == name) return each;
    ADD_FAILURE() << name;
    return scene.objects.front();
  }
  std::size_t index(const std::string& name) { return std::size_t(&object(name) - scene.objects.data()); }
  const scene::LitVertices* light(const std::string& name) {
    return scene.data<scene::VertexIrradiance>().of(index(name));
  }
  /// Mean over the vertices of the first part.
  vec3 mean(const std::string& name) {
    vec3 sum(0.0f);
    for (const vec3 each : light(name)->parts[0].front) sum += each;
    return sum / float(light(name)->parts[0].front.size());
  }
  int rays() { return clock->find<LightingProcess>()->rays(); }
};

class LitObjects : public scene::ScriptTest<gl::ContextTest> {
 protected:
  LitObjects() {
    for (const auto register_room : {script::register_room, gltf::register_room, meshes::register_room,
                                     light::register_room, action::register_room, lit_objects::register_room})
      register_room(registries_);
    save("ground.glb", scene::ground(40));
    save("wall.glb", scene::box({-8, 2, 0}, {8, 3, 9}));
    save("ball.glb", scene::sphere({0, 0, 1}, 0.8f, 24));
  }

  void save(const std::string& name, const Mesh& mesh, bool is_double_sided = false) const {
    scene::write_grey(folder_.path() / name, mesh, is_double_sided);
  }

  Running run(const std::string& script) {
    Running running;
    auto loaded = load(script);
    EXPECT_TRUE(loaded) << to_string(loaded.errors());
    if (!loaded) return running;
    running.scene = std::move(loaded->scene);
    running.clock = std::make_unique<action::SceneClock>(
        registries_.get<action::Processes>(), scene::LiveScene(std::move(loaded->script)), running.scene);
    running.warnings = running.clock->take_warnings();
    return running;
  }

  static std::string street(const std::string& lit) {
    return "dayLight(julianDay=172, timeOfDay=15, standardMeridian=2)\n"
           "model(file=\"ground.glb\")\nmodel(file=\"wall.glb\")\nlitVirtualObject(" +
           lit + ") { object(file=\"ball.glb\", grab=1) }\n";
  }
};

/// Irradiance by independent random rays over the sphere about a point, with one bounce as documented: the
/// sun by a ray, and half of the sky's irradiance, on what blocks a ray.
vec3 brute_force(const scene::Scene& scene, const reference::RayScene& rays, vec3 at, vec3 normal,
                 int count) {
  const light::SkyTable sky(scene);
  const vec3 to_sun = glm::normalize(scene.sun.direction_to_sun), from = at + 1e-3f * normal;
  Random random(11);
  vec3 sum(0.0f);
  for (int i = 0; i < count; ++i) {
    const float z = random.uniform(-1.0f, 1.0f), turn = random.uniform(0.0f, 6.2831853f);
    const vec3 d(std::sqrt(1.0f - z * z) * std::cos(turn), std::sqrt(1.0f - z * z) * std::sin(turn), z);
    const float facing = glm::dot(d, normal);
    if (facing <= 0.0f) continue;
    reference::Passage passage{Random(7)};
    const auto hit = rays.nearest_hit({from, d}, passage);
    if (!hit) {
      sum += facing * sky.radiance(d);
      continue;
    }
    const Mesh& mesh = *hit->place->mesh;
    const std::uint32_t* corner = mesh.indices.data() + 3 * std::size_t(hit->triangle);
    vec3 n = glm::normalize(hit->place->world_from_normal *
                            ((1.0f - hit->u - hit->v) * mesh.normals[corner[0]] +
                             hit->u * mesh.normals[corner[1]] + hit->v * mesh.normals[corner[2]]));
    if (glm::dot(n, d) > 0.0f) n = -n;
    vec3 irradiance = 0.5f * sky.irradiance(n);
    const vec3 point = from + hit->distance_m * d + 1e-3f * n;
    reference::Passage to_light{Random(7)};
    if (glm::dot(n, to_sun) > 0.0f && !rays.is_blocked({point, to_sun}, to_light))
      irradiance += glm::dot(n, to_sun) * scene.sun.irradiance;
    sum += facing * 0.5f / 3.14159265f * irradiance;
  }
  vec3 result = 12.566371f / float(count) * sum;
  reference::Passage passage{Random(7)};
  if (glm::dot(normal, to_sun) > 0.0f && !rays.is_blocked({from, to_sun}, passage))
    result += glm::dot(normal, to_sun) * scene.sun.irradiance;
  return result;
}

/// Mean over all vertices of how far two lights are apart.
double mean_difference(const std::vector<vec3>& light, const std::vector<vec3>& wanted) {
  double sum = 0.0;
  for (std::size_t v = 0; v < wanted.size(); ++v) sum += std::abs(double(light[v].y - wanted[v].y));
  return sum / double(wanted.size());
}

TEST_F(LitObjects, HaveTheLightThatRandomRaysFind) {
  Running street_scene = run(street("rays=256"));
  const scene::LitVertices* light = street_scene.light("ball");
  ASSERT_NE(light, nullptr);
  EXPECT_EQ(street_scene.light("wall"), nullptr);
  EXPECT_GE(street_scene.rays(), 256);
  const reference::RayScene rays(street_scene.scene);
  const Mesh& mesh = street_scene.object("ball").mesh(0);
  double off = 0.0, dark_off = 0.0, mean = 0.0;
  int count = 0;
  for (std::size_t v = 5; v < mesh.positions.size(); v += 37, ++count) {
    const vec3 truth = brute_force(street_scene.scene, rays, mesh.positions[v], mesh.normals[v], 40'000);
    const vec3 found = light->parts[0].front[v];
    off += double((found.y - truth.y) * (found.y - truth.y)), mean += double(truth.y);
    dark_off += double(truth.y) * double(truth.y);
  }
  off = 100.0 * std::sqrt(off * count) / mean;
  std::printf("%.2f %% of the mean off, %d vertices\n", off, count);
  EXPECT_LT(off, 3.0) << "256 rays, and 40,000 at random that err by a percent";
  EXPECT_GT(100.0 * std::sqrt(dark_off * count) / mean, 50.0);
}

TEST_F(LitObjects, AMovedThingIsLitAgainFirstQuicklyThenBetter) {
  Running scene = run(street("rays=128, budget_ms=2"));
  const vec3 open = scene.mean("ball");
  scene.object("ball").world_from_model =
      glm::translate(glm::mat4(1.0f), vec3(0, 4.3f, 0));  // behind the wall
  scene.clock->advance(scene.scene, 0.02);
  EXPECT_LT(scene.rays(), 128) << "no time for all";
  const vec3 quick = scene.mean("ball");
  EXPECT_GT(glm::distance(quick, open), 0.05f * open.y);
  for (int frame = 0; frame < 400 && scene.rays() < 128; ++frame) scene.clock->advance(scene.scene, 0.02);
  EXPECT_GE(scene.rays(), 128);
  const vec3 converged = scene.mean("ball");
  Running there = run("group() { " + street("rays=128, budget_ms=0") + " }");
  there.object("ball").world_from_model = glm::translate(glm::mat4(1.0f), vec3(0, 4.3f, 0));
  there.clock->advance(there.scene, 0.02);
  EXPECT_GE(there.rays(), 128) << "without a budget all rays are traced at once";
  const vec3 truth = there.mean("ball");
  EXPECT_NEAR(converged.y, truth.y, 0.02f * truth.y);
  EXPECT_LT(std::abs(converged.y - truth.y), std::abs(quick.y - truth.y) + 1e-4f);
  const float jump = std::abs(open.y - truth.y);
  EXPECT_LT(std::abs(quick.y - truth.y), 0.5f * jump) << "even the quick light is nearer than the old one";
}

/// A picture that stands by itself does not show how many frames were drawn before it.
TEST_F(LitObjects, HaveAllTheirRaysInAPictureWhateverTheBudget) {
  const glm::mat4 behind_the_wall = glm::translate(glm::mat4(1.0f), vec3(0, 4.3f, 0));
  const auto moved = [&](const std::string& budget) {
    Running scene = run(street("rays=128, budget_ms=" + budget));
    scene.object("ball").world_from_model = behind_the_wall;
    scene.clock->advance(scene.scene, 0.02);
    return scene;
  };
  Running hurried = moved("2"), unhurried = moved("0");
  EXPECT_LT(hurried.rays(), 128);
  hurried.clock->settle(hurried.scene);
  EXPECT_GE(hurried.rays(), 128);
  const std::vector<vec3>&found = hurried.light("ball")->parts[0].front,
        &wanted = unhurried.light("ball")->parts[0].front;
  ASSERT_EQ(found.size(), wanted.size());
  // Sums of other lengths are rounded otherwise.
  for (std::size_t v = 0; v < found.size(); ++v) EXPECT_NEAR(found[v].y, wanted[v].y, 1e-5f * wanted[v].y);
}

/// A budget that holds one round of rays: while a thing is dragged each of its sides has its turn.
TEST_F(LitObjects, AreLitInTurnsWhileTheyAreDraggedAndThereIsNoTimeForAll) {
  save("shell.glb", scene::sphere({0, 0, 1}, 0.8f, 8), true);
  Running scene =
      run("dayLight(julianDay=172, timeOfDay=15, standardMeridian=2)\nmodel(file=\"ground.glb\")\n"
          "model(file=\"wall.glb\")\nlitVirtualObject(rays=256, budget_ms=0.01) { object(file=\"shell.glb\", "
          "grab=1) }\n");
  const auto sides_changed_by_a_move_to = [&](float north) {
    const scene::LitVertices::PartLight before = scene.light("shell")->parts[0];
    scene.object("shell").world_from_model = glm::translate(glm::mat4(1.0f), vec3(0, north, 0));
    scene.clock->advance(scene.scene, 0.02);
    const scene::LitVertices::PartLight& now = scene.light("shell")->parts[0];
    return std::array{now.front != before.front, now.behind != before.behind};
  };
  const auto first = sides_changed_by_a_move_to(4.3f), second = sides_changed_by_a_move_to(4.4f);
  EXPECT_NE(first[0], first[1]) << "one of the two";
  EXPECT_EQ(second, (std::array{!first[0], !first[1]})) << "then the other";
  for (int frame = 0; frame < 100 && scene.rays() < 256; ++frame) scene.clock->advance(scene.scene, 0.02);
  EXPECT_GE(scene.rays(), 256);
}

/// A wall that stood in the east of its floor stands in the west.
TEST_F(LitObjects, HaveTheirOwnShadeOfNowWhereTheyAreTurnedOrStretched) {
  Mesh corner = scene::box({-1, -1, 0}, {1, 1, 0.2f});
  append(corner, scene::box({0.9f, -1, 0.2f}, {1, 1, 3}));
  save("corner.glb", corner);
  const auto lit = [&](const std::string& placed) {
    return run(
        "dayLight(julianDay=172, timeOfDay=15, standardMeridian=2)\nmodel(file=\"ground.glb\")\n"
        "litVirtualObject(rays=64, budget_ms=0) { object(file=\"corner.glb\", grab=1" +
        placed + ") }\n");
  };
  for (const char* const placed : {", heading_deg=180", ", scale=2"}) {
    Running fresh = lit(placed), changed = lit("");
    const std::vector<vec3> before = changed.light("corner")->parts[0].front;
    changed.object("corner").world_from_model = fresh.object("corner").world_from_model;
    changed.clock->advance(changed.scene, 0.02);
    const std::vector<vec3>&truth = fresh.light("corner")->parts[0].front,
          &found = changed.light("corner")->parts[0].front;
    const double mean = mean_difference(truth, std::vector<vec3>(truth.size(), vec3(0.0f)));
    EXPECT_LT(mean_difference(found, truth), 1e-3 * mean) << placed;
    // The control: stretched alike in all directions it shades itself as before, turned it does not.
    if (std::string_view(placed).find("heading") != std::string_view::npos) {
      EXPECT_GT(mean_difference(before, truth), 0.01 * mean) << placed;
    }
  }
}

/// A surface texture has metallic in blue, by which the factor, 1 by default in glTF, is multiplied.
TEST_F(LitObjects, HaveTheLightThatGroundWithASurfaceTextureGivesBack) {
  const auto light_above = [&](std::uint8_t metallic) {
    const auto ground = scene::model_of(scene::ground(40), scene::matt(vec3(0.5f)));
    Image8 texel(1, 1, 4);
    texel.pixels = {255, 255, metallic, 255};
    ground->textures.push_back({"surface", std::move(texel), false});
    ground->materials[0].surface_texture = 0, ground->materials[0].metallic = 1.0f;
    EXPECT_TRUE(scene::write_gltf(folder_.path() / "paving.glb", *ground));
    Running scene =
        run("dayLight(julianDay=172, timeOfDay=15, standardMeridian=2)\nmodel(file=\"paving.glb\")\n"
            "litVirtualObject(rays=256) { object(file=\"ball.glb\") }");
    return scene.mean("ball").y;
  };
  Running plain =
      run("dayLight(julianDay=172, timeOfDay=15, standardMeridian=2)\nmodel(file=\"ground.glb\")\n"
          "litVirtualObject(rays=256) { object(file=\"ball.glb\") }");
  const float matt = plain.mean("ball").y;
  EXPECT_FLOAT_EQ(light_above(0), matt);
  EXPECT_LT(light_above(255), 0.9f * matt) << "metal gives nothing back matt";
}

TEST_F(LitObjects, NodesHaveTheirOwnRaysAndNoneHurriesOneThatHasTime) {
  Running scene = run(street("rays=16") +
                      "litVirtualObject(rays=64, budget_ms=0) { object(name=\"other\", "
                      "file=\"ball.glb\", position=\"5 0 0\", grab=1) }\n");
  EXPECT_EQ(scene.rays(), 16) << "the fewest";
  scene.object("other").world_from_model = glm::translate(glm::mat4(1.0f), vec3(4, 0, 0));
  scene.clock->advance(scene.scene, 0.02);
  const vec3 at_once = scene.mean("other");
  scene.clock->settle(scene.scene);
  EXPECT_EQ(scene.mean("other"), at_once) << "it had all its rays in the frame of its move";
}

TEST_F(LitObjects, FollowTheSkyAndAreLeftAloneWhileNothingChanges) {
  Running scene = run(street("rays=64, budget_ms=0"));
  const auto noon = scene.scene.data<scene::VertexIrradiance>().objects;
  scene.clock->advance(scene.scene, 0.1);
  EXPECT_EQ(scene.scene.data<scene::VertexIrradiance>().objects, noon) << "nothing to upload";
  const vec3 before = scene.mean("ball");
  ASSERT_TRUE(scene.clock->send("%dayLight", "timeOfDay 20.5"));
  scene.clock->advance(scene.scene, 0.1);
  EXPECT_LT(scene.mean("ball").y, 0.4f * before.y);
  EXPECT_GE(scene.rays(), 64);
}

TEST_F(LitObjects, FollowTheSkyWhileTheyAreHidden) {
  Running scene = run(street("rays=64, budget_ms=0"));
  const vec3 before = scene.mean("ball");
  scene.object("ball").is_visible = false;
  ASSERT_TRUE(scene.clock->send("%dayLight", "timeOfDay 20.5"));
  scene.clock->advance(scene.scene, 0.1);
  scene.object("ball").is_visible = true;
  scene.clock->advance(scene.scene, 0.1);
  EXPECT_LT(scene.mean("ball").y, 0.4f * before.y);
}

/// There is no time for all rays, but what earlier ones found of the sky holds for the new one.
TEST_F(LitObjects, AreLitByANewSkyInItsFirstFrame) {
  Running scene = run(street("rays=256, budget_ms=3"));
  const std::vector<vec3> old = scene.light("ball")->parts[0].front;
  ASSERT_TRUE(scene.clock->send("%dayLight", "timeOfDay 9"));
  scene.clock->advance(scene.scene, 0.1);
  ASSERT_LT(scene.rays(), 64);
  const std::vector<vec3> quick = scene.light("ball")->parts[0].front;
  scene.clock->settle(scene.scene);
  EXPECT_GE(scene.rays(), 256);
  const std::vector<vec3>& truth = scene.light("ball")->parts[0].front;
  const double mean = mean_difference(truth, std::vector<vec3>(truth.size(), vec3(0.0f)));
  std::printf("%.3f of the mean off, old light %.3f\n", mean_difference(quick, truth) / mean,
              mean_difference(old, truth) / mean);
  EXPECT_LT(mean_difference(quick, truth), 0.05 * mean)
      << "few rays to the edges of shadows and to surfaces in the sun";
  EXPECT_GT(mean_difference(old, truth), 0.2 * mean);
}

TEST_F(LitObjects, AreLitInTheFrameInWhichTheyComeBack) {
  Running scene = run(street("rays=256, budget_ms=2"));
  const vec3 before = scene.mean("ball");
  scene.object("ball").is_visible = false;
  ASSERT_TRUE(scene.clock->send("%dayLight", "timeOfDay 20.5"));
  scene.clock->advance(scene.scene, 0.1);
  EXPECT_EQ(scene.mean("ball"), before) << "nobody sees it";
  scene.object("ball").is_visible = true;
  scene.clock->advance(scene.scene, 0.02);
  ASSERT_LT(scene.rays(), 64) << "there was time for rays";
  EXPECT_LT(scene.mean("ball").y, 0.4f * before.y);
}

TEST_F(LitObjects, AreLitAgainWhereWhatShadedThemHasGone) {
  save("roof.glb", scene::box({-3, -3, 3}, {3, 3, 3.2f}));
  const std::string under_a_roof =
      street("rays=64, budget_ms=0") + "litVirtualObject() { object(file=\"roof.glb\", grab=1) }\n";
  const auto brighter_after = [&](const auto& change) {
    Running scene = run(under_a_roof);
    const float before = scene.mean("ball").y;
    change(scene.object("roof"));
    scene.clock->advance(scene.scene, 0.02);
    return scene.mean("ball").y / before;
  };
  EXPECT_GT(brighter_after([](scene::Object& roof) {
              roof.world_from_model = glm::translate(glm::mat4(1.0f), vec3(0, -18, 0));
            }),
            1.5f);
  EXPECT_GT(brighter_after([](scene::Object& roof) { roof.is_visible = false; }), 1.5f);
  EXPECT_EQ(brighter_after([](scene::Object&) {}), 1.0f);
}

TEST_F(LitObjects, HaveOnlyTheSkyWhileTheSunIsBelowTheHorizon) {
  Running scene =
      run("sun(azimuth_deg=180, elevation_deg=-10, irradiance=\"0 0 0\")\nmodel(file=\"ground.glb\")\n"
          "litVirtualObject(rays=64) { object(file=\"ball.glb\") }");
  const scene::LitVertices& light = *scene.light("ball");
  for (const vec3 each : light.parts[0].front) {
    EXPECT_GE(each.y, 0.0f);
    EXPECT_TRUE(std::isfinite(each.x + each.y + each.z));
  }
  EXPECT_GT(scene.mean("ball").y, 0.0f);
  Running night =
      run("dayLight(timeOfDay=0.5, standardMeridian=1)\nlitVirtualObject() { object(file=\"ball.glb\") }");
  EXPECT_LT(night.mean("ball").y, 1e-3f);
}

TEST_F(LitObjects, InsideOutMeshesAndThoseWithoutNormalsAreNamedAndLit) {
  Mesh inward = scene::sphere({0, 0, 1}, 0.8f, 8);
  for (std::size_t i = 0; i < inward.indices.size(); i += 3)
    std::swap(inward.indices[i], inward.indices[i + 1]);
  for (vec3& normal : inward.normals) normal = -normal;
  save("inward.glb", inward);
  save("inward_both.glb", inward, true);
  Running scene = run(
      "dayLight()\nlitVirtualObject(rays=64) { object(file=\"inward.glb\") object(file=\"inward_both.glb\", "
      "position=\"9 0 0\") }");
  EXPECT_NE(to_string(scene.warnings).find("is inside out"), std::string::npos) << to_string(scene.warnings);
  const auto& both = scene.light("inward_both")->parts[0];
  vec3 outside(0.0f), inside(0.0f);
  for (std::size_t v = 0; v < both.front.size(); ++v) outside += both.behind[v], inside += both.front[v];
  EXPECT_GT(outside.y, 3.0f * inside.y) << "seen from outside it is lit as from outside";

  Mesh bare = scene::sphere({0, 0, 1}, 0.8f, 8);
  scene::Scene by_hand;
  for (vec3& normal : bare.normals) normal = vec3(0.0f);
  scene::add(by_hand, scene::model_of(bare, scene::matt(vec3(0.5f))));
  std::vector<std::string> odd;
  const LitObject lit(by_hand, 0, odd);
  ASSERT_EQ(odd.size(), 1u);
  EXPECT_NE(odd[0].find("without normals"), std::string::npos);
  for (const light::LitVertex& vertex : lit.blocks()[0].light.vertices())
    EXPECT_NEAR(glm::length(vertex.normal), 1.0f, 1e-4f);
}

TEST_F(LitObjects, SayWhatIsWrong) {
  EXPECT_NE(to_string(run("litVirtualObject() { }").warnings).find("holds no object"), std::string::npos);
  EXPECT_NE(errors_of("litVirtualObject() { sun() }").find("sun"), std::string::npos);
  EXPECT_NE(errors_of("litVirtualObject(rays=3)").find("rays=\"3\""), std::string::npos);
  EXPECT_NE(errors_of("object()").find("object needs file="), std::string::npos);
  EXPECT_NE(errors_of("object(file=duck.pfb)").find("no .glb, .gltf, .iv or .wrl of that name"),
            std::string::npos);
}

/// A group may hold what is not lit so: that is said, not ignored.
TEST_F(LitObjects, WhatOtherRoomsDrawIsNamed) {
  registries_.get<scene::NodeRegistry>().add({.type = "plant"},
                                             [](const scene::Node&, scene::SceneBuilder&) {});
  const auto warnings_of = [&](const std::string& script) {
    const auto loaded = load(script);
    EXPECT_TRUE(loaded) << to_string(loaded.errors());
    return loaded ? to_string(loaded->warnings) : "";
  };
  const std::string told =
      warnings_of("litVirtualObject() {\n  object(file=\"ball.glb\")\n  group() { plant()\n plant() }\n}\n");
  for (const char* words :
       {"scene.xp:3:", "this plant, with 1 more of the kind,", "put it outside of litVirtualObject"})
    EXPECT_NE(told.find(words), std::string::npos) << told;
  EXPECT_EQ(warnings_of("litVirtualObject() { object(file=\"ball.glb\") }\ngroup() { plant() }\n"), "");
  EXPECT_NE(errors_of("litVirtualObject() { plant() }").find("plant does not stand in litVirtualObject"),
            std::string::npos);
}

/// Appendix A.2.2, as printed, with models that can be read beside the names of those that cannot.
TEST_F(LitObjects, TheExampleOfTheThesisRuns) {
  save("duck.glb", scene::sphere({0, 0, 1}, 0.8f, 8));
  save("duck2.glb", scene::sphere({3, 0, 1}, 0.8f, 8));
  const std::string example =
      "litVirtualObject() {\n object (file=duck.pfb, grab=1, wall=0)\n"
      " object (file=duck2.pfb, grab=1, wall=0)\n}\n";
  Running scene = run("dayLight()\n" + example);
  ASSERT_EQ(scene.scene.objects.size(), 2u);
  for (const char* name : {"duck", "duck2"}) {
    ASSERT_NE(scene.light(name), nullptr) << name;
    EXPECT_TRUE(scene.object(name).is_dynamic);
    EXPECT_GT(scene.mean(name).y, 1.0f);
  }
  const auto loaded = load("dayLight()\n" + example);
  EXPECT_NE(to_string(loaded->warnings).find("\"duck.glb\" is used"), std::string::npos)
      << to_string(loaded->warnings);
}

TEST_F(LitObjects, AreDrawnAndTracedAlike) {
  Running scene =
      run("sun(azimuth_deg=140, elevation_deg=50)\nmodel(file=\"ground.glb\")\nmodel(file=\"wall.glb\")\n"
          "litVirtualObject(rays=64) { object(file=\"ball.glb\") }");
  Camera camera;
  camera.world_from_camera = look_at({1, -4, 1.7f}, {0, 0, 1});
  camera.vertical_fov = 0.6f;
  constexpr int size = 128;
  auto renderer = render::Renderer::create(scene.scene, {}, light::sun_and_sky);
  ASSERT_TRUE(renderer) << to_string(renderer.errors());
  const auto drawn = [&] {
    EXPECT_TRUE(render::draw_frame(**renderer, scene.scene, {camera, size, size}));
    return (*renderer)->read_radiance();
  };
  const auto traced = [&](const scene::Scene& of) {
    const reference::RayScene rays(of);
    reference::TraceOptions options;
    const shading::DrawnLight light = (*renderer)->drawn_light();
    options.drawn_light = &light;
    return reference::trace_picture(rays, of, (*renderer)->sky(), camera, size, size, options).radiance;
  };
  // The ball without its silhouette, where the two count samples of other places.
  const reference::ObjectPicture objects =
      reference::trace_objects(reference::RayScene(scene.scene), camera, size, size);
  const auto is_inside = [&](int x, int y) {
    if (x < 1 || y < 1 || x + 1 >= size || y + 1 >= size) return false;
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx)
        if (*objects.at(x + dx, y + dy) != scene.index("ball") + 1) return false;
    return true;
  };
  const auto wrong_percent = [&](const ImageF& a, const ImageF& b) {
    const reference::WrongPixels pixels = reference::wrong_pixels(a, b, 0.02f, 1e-3f, is_inside);
    EXPECT_GT(pixels.count, 1000);
    return pixels.percent();
  };
  const ImageF picture = drawn();
  EXPECT_LT(wrong_percent(picture, traced(scene.scene)), 1.0);
  scene::Scene unlit = scene.scene;
  unlit.data<scene::VertexIrradiance>() = {};
  EXPECT_GT(wrong_percent(picture, traced(unlit)), 30.0) << "the comparison sees where the light comes from";
  // What is put into the scene is on the GPU with the next frame.
  auto dark = std::make_shared<scene::LitVertices>(*scene.light("ball"));
  for (vec3& each : dark->parts[0].front) each = vec3(0.0f);
  scene.scene.data<scene::VertexIrradiance>().objects[scene.index("ball")] = dark;
  EXPECT_LT(wrong_percent(drawn(), traced(scene.scene)), 1.0);
}

}  // namespace
}  // namespace parvis::lit_objects

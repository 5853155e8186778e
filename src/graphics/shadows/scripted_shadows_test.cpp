// What the node shadowMap says in a script, as it is drawn by every method and as the ray tracer has it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "formats/gltf/test_mesh_file.h"
#include "graphics/gl/test_context.h"
#include "graphics/light/shadow_settings.h"
#include "graphics/reference/test_wrong_pixels.h"
#include "graphics/reference/tracer.h"
#include "graphics/render/frame_views.h"
#include "graphics/render/light_source.h"
#include "graphics/render/test_renderer.h"
#include "room_list.h"
#include "scene/script/live_scene.h"
#include "scene/script/test_script.h"

namespace parvis::shadows {
namespace {

using light::ShadowTechnique;

constexpr int width = 256, height = 144;

/// High above a table on the ground there is a roof, beside it an awning; the sun stands above all of them.
class ScriptedShadows : public scene::ScriptTest<gl::ContextTest> {
 protected:
  ScriptedShadows() {
    for (const auto register_room : {script::register_room, gltf::register_room, meshes::register_room,
                                     light::register_room, shadows::register_room})
      register_room(registries_);
    scene::write_grey(folder_.path() / "ground.glb", scene::ground(40));
    scene::write_grey(folder_.path() / "table.glb", scene::box({-2, -2, 0}, {2, 2, 1}));
    scene::write_grey(folder_.path() / "roof.glb", scene::box({-4, -4, 12}, {4, 4, 12.2f}));
    scene::write_grey(folder_.path() / "awning.glb", scene::box({10, -2, 6}, {14, 2, 6.2f}));
    camera_.world_from_camera = look_at({0, -25, 8}, {4, 0, 0});
    camera_.vertical_fov = 0.6f;
  }
  static std::string place(const std::string& shadow_map) {
    return "sun(direction=\"0.02 0 1\", irradiance=\"20 20 20\")\nmodel(name=\"floor\", "
           "file=\"ground.glb\")\n"
           "model(name=\"table\", file=\"table.glb\")\nmodel(name=\"roof\", file=\"roof.glb\")\n"
           "group(name=\"awnings\") { model(file=\"awning.glb\") }\nshadowMap(" +
           shadow_map + ")\n";
  }
  std::unique_ptr<render::Renderer> renderer_of(const scene::Scene& scene) const {
    return render::renderer_of(scene, registries_.get<render::Lights>().make);
  }
  ImageF drawn(render::Renderer& renderer, const scene::Scene& scene) const {
    EXPECT_TRUE(render::draw_frame(renderer, scene, {camera_, width, height}));
    return renderer.read_radiance();
  }
  /// The picture with the exact shadows of the ray tracer, or the renderer's, and the renderer's light of the
  /// sky.
  ImageF traced(const render::Renderer& renderer, const scene::Scene& scene, bool is_exact = true) const {
    const reference::RayScene rays(scene);
    shading::DrawnLight exact = renderer.drawn_light();
    exact.has_exact_shadows = is_exact;
    reference::TraceOptions options;
    options.samples_per_pixel = 16;
    options.drawn_light = &exact;
    return reference::trace_picture(rays, scene, renderer.sky(), camera_, width, height, options).radiance;
  }
  /// The shade in the order table, ground under the roof, ground under the awning: S in shadow, L in the
  /// light.
  std::string shade_in(const ImageF& picture) const {
    const auto radiance_at = [&](glm::vec3 point) {
      const glm::vec4 clip = camera_.clip_from_camera(float(width) / float(height)) *
                             camera_.camera_from_world() * glm::vec4(point, 1.0f);
      const glm::vec2 at = 0.5f + 0.5f * glm::vec2(clip) / clip.w;
      return picture.at(int(at.x * float(width)), int((1.0f - at.y) * float(height)))[1];
    };
    const float open = radiance_at({-6, 0, 0});
    std::string shade;
    for (const glm::vec3 point : {glm::vec3(0, 0, 1), glm::vec3(3, -2, 0), glm::vec3(12, 0, 0)}) {
      const float share = radiance_at(point) / open;
      shade += share < 0.5f ? 'S' : share > 0.8f ? 'L' : '?';
    }
    return shade;
  }

  Camera camera_;
};

TEST_F(ScriptedShadows, NamedThingsAloneCastAndNamedThingsAloneReceive) {
  for (const auto& [shadow_map, expected] : {std::pair{"", "SSS"},
                                             {"casters=roof", "SSL"},
                                             {"casters=awnings", "LLS"},
                                             {"casters=roof, casters=awnings", "SSS"},
                                             {"receivers=table", "SLL"},
                                             {"receivers=floor", "LSS"},
                                             {"casters=awnings, receivers=table", "LLL"}}) {
    auto loaded = load(place(shadow_map));
    ASSERT_TRUE(loaded) << to_string(loaded.errors());
    scene::Scene& scene = loaded->scene;
    const auto renderer = renderer_of(scene);
    for (std::size_t i = 0; i < light::shadow_technique_names.size(); ++i) {
      scene.data<light::ShadowSettings>().technique = ShadowTechnique(i);
      EXPECT_EQ(shade_in(drawn(*renderer, scene)), expected)
          << shadow_map << ", " << light::shadow_technique_names[i];
    }
    EXPECT_EQ(shade_in(traced(*renderer, scene)), expected) << shadow_map << ", traced";
  }
}

TEST_F(ScriptedShadows, WithoutShadowsTheSunShinesThroughEverythingUntilItHasThemAgain) {
  auto loaded = load(place("method=none"));
  ASSERT_TRUE(loaded) << to_string(loaded.errors());
  scene::Scene& scene = loaded->scene;
  const auto renderer = renderer_of(scene);
  EXPECT_EQ(shade_in(drawn(*renderer, scene)), "LLL");
  EXPECT_EQ(shade_in(traced(*renderer, scene, false)), "LLL");
  scene.data<light::ShadowSettings>().technique = ShadowTechnique::cached_cascades;
  EXPECT_EQ(shade_in(drawn(*renderer, scene)), "SSS");
}

TEST_F(ScriptedShadows, NamesThatThereAreNotAreReportedWithOnesThatThereAre) {
  for (const char* role : {"casters", "receivers"}) {
    const auto errors = [&](const char* name) { return errors_of(place(fmt::format("{}={}", role, name))); };
    EXPECT_TRUE(
        holds(errors("awning"), fmt::format("{}=\"awning\": no node of the scene has this name; did you "
                                            "mean \"awnings\"?",
                                            role)));
    EXPECT_TRUE(holds(errors("tabel"), "did you mean \"table\"?"));
    EXPECT_TRUE(holds(errors_of(fmt::format("scenario(name=\"dusk\") {{ }}\nshadowMap({}=dusk)\n", role)),
                      "this is a scenario"));
  }
}

/// A perspective map that begins at the camera's near plane has its texels where nothing is seen.
TEST_F(ScriptedShadows, UpdateNearKeepsThePerspectiveMapAtWhatIsSeen) {
  auto loaded = load(place("method=perspective"));
  ASSERT_TRUE(loaded) << to_string(loaded.errors());
  scene::Scene& scene = loaded->scene;
  scene::LiveScene live(std::move(loaded->script));
  const auto renderer = renderer_of(scene);
  camera_.world_from_camera = look_at({0, -25, 8}, {3.5f, -2, 0});  // at a corner of the roof's shadow
  camera_.vertical_fov = 0.1f;
  const auto tell = [&](const char* text) {
    const scene::Node* const node = live.find("%xpShadowMap");
    ASSERT_NE(node, nullptr);
    const auto message = scene::parse_message(*node->schema, text, {});
    ASSERT_TRUE(message) << text;
    EXPECT_TRUE(live.receive(*node, *message)) << text;
    EXPECT_TRUE(live.refresh(scene).empty()) << text;
  };
  const ImageF with = drawn(*renderer, scene), truth = traced(*renderer, scene);
  tell("updateNear off");
  EXPECT_FALSE(scene.data<light::ShadowSettings>().updates_near);
  EXPECT_EQ(scene.data<light::ShadowSettings>().technique, ShadowTechnique::perspective);
  const double without_percent = reference::wrong_percent(drawn(*renderer, scene), truth),
               with_percent = reference::wrong_percent(with, truth);
  std::printf("%.2f %% of the pixels are off with updateNear, %.2f %% without\n", with_percent,
              without_percent);
  EXPECT_GT(without_percent, 2.0 * with_percent);
  tell("updatenear on");
  EXPECT_TRUE(scene.data<light::ShadowSettings>().updates_near);
  EXPECT_EQ(drawn(*renderer, scene).pixels, with.pixels);
}

}  // namespace
}  // namespace parvis::shadows

// A room that nobody knows brings a method, an overlay and their attributes; scripts name them and they are
// drawn.
#include "reflections/methods/registry.h"

#include <gtest/gtest.h>

#include "base/registries.h"
#include "graphics/gl/test_context.h"
#include "graphics/light/sun_and_sky.h"
#include "graphics/render/test_room.h"
#include "reflections/methods/frame.h"
#include "scene/script/attribute.h"
#include "scene/script/test_script.h"

namespace parvis::methods {
namespace {

using namespace scene::attribute;

/// The room's data in a scene.
struct Paint {
  static constexpr std::string_view name = "test.paint";
  static constexpr scene::DataRole role = scene::DataRole::settings;
  float green = 0.25f, red = 0.0f;
  bool is_prepared = false;
  void hash(ContentHash& hash) const {
    for (const float value : {green, red}) hash.add(value);
  }
};

/// Mirrors that shine green.
class Green final : public Reflections {
 public:
  explicit Green(float radiance) : radiance_(radiance) {}
  render::SurfaceSource source() const override {
    return {.reflection = fmt::format("vec3(0.0f, {:.6f}f, 0.0f)", radiance_)};
  }
  void bind(const gl::Program&, int) override {}

 private:
  void update_maps(render::Renderer&, const scene::Scene&, const std::vector<VisibleReflector>&) override {}
  float radiance_;
};

/// Adds red to whatever they show.
class Red final : public Overlay {
 public:
  Red(float radiance, std::unique_ptr<Reflections> below) : Overlay(std::move(below)), radiance_(radiance) {}
  render::SurfaceSource source() const override {
    render::SurfaceSource surface = Overlay::source();
    surface.reflection += fmt::format(" + vec3({:.6f}f, 0.0f, 0.0f)", radiance_);
    return surface;
  }

 private:
  void update_maps(render::Renderer& renderer, const scene::Scene& scene,
                   const std::vector<VisibleReflector>& reflectors) override {
    update_below(renderer, scene, reflectors);
  }
  float radiance_;
};

scene::AttributeSchema radiance(const char* name, const char* fallback) {
  return number(name, "radiance").by_default(fallback);
}

void register_room(Registries& registries) {
  Registry& registry = registries.get<Registry>();
  registry.add(
      {.name = "green",
       .help = "mirrors shine green",
       .make = [](const scene::Scene& scene, render::Renderer&,
                  std::unique_ptr<Reflections>) -> Result<std::unique_ptr<Reflections>> {
         return std::unique_ptr<Reflections>(std::make_unique<Green>(own_settings<Paint>(scene).green));
       },
       .is_default = true,
       .attributes = {radiance("green", "0.25")},
       .read = [](const scene::Node& node,
                  Settings& settings) { settings.own.get<Paint>().green = float(node.number("green")); },
       .prepare = [](scene::Scene& scene) { own_settings<Paint>(scene).is_prepared = true; }});
  registry.add({.name = "green twice",
                .help = "the same, and half as much over it",
                .make = [](const scene::Scene&, render::Renderer&,
                           std::unique_ptr<Reflections> below) -> Result<std::unique_ptr<Reflections>> {
                  if (!below) return error("lies over nothing");
                  return below;
                },
                .suits = [](const scene::Scene& scene) { return own_settings<Paint>(scene).red > 0.9f; },
                .suits_where = "where it is red",
                .lies_over = "green",
                .attributes = {radiance("green", "0.25")}});
  registry.add(
      {.name = "red shine",
       .help = "red over any method",
       .make = [](const scene::Scene& scene, render::Renderer&,
                  std::unique_ptr<Reflections> below) -> Result<std::unique_ptr<Reflections>> {
         return std::unique_ptr<Reflections>(
             std::make_unique<Red>(own_settings<Paint>(scene).red, std::move(below)));
       },
       .is_overlay = true,
       .is_wanted = [](const scene::Scene& scene) { return own_settings<Paint>(scene).red > 0.0f; },
       .attributes = {radiance("red", "0")},
       .read = [](const scene::Node& node,
                  Settings& settings) { settings.own.get<Paint>().red = float(node.number("red")); }});
  add_reflection_node(registries.get<scene::NodeRegistry>(), registry);
}

class RegistryTest : public scene::ScriptTest<gl::ContextTest> {
 protected:
  RegistryTest() { register_room(registries_); }
  const Registry& registry() const { return registries_.get<Registry>(); }

  /// The settings of a script.
  Result<Settings> settings_of(const std::string& script) {
    const Result<scene::LoadedScene> loaded = load(script);
    if (!loaded) return loaded.errors();
    return settings(loaded->scene);
  }

  /// The middle of a picture of a mirror in a room.
  glm::vec3 mirror_with(const Settings& wanted) {
    scene::Scene scene = render::room_scene(8.0f);
    render::add_mirror(scene, glm::vec3(0.0f), 1.0f);
    settings(scene) = wanted;
    EXPECT_TRUE(registry().prepare(scene));
    Result<std::unique_ptr<render::Renderer>> renderer =
        render::Renderer::create(scene, {}, light::sun_and_sky);
    EXPECT_TRUE(renderer) << to_string(renderer.errors());
    Result<std::unique_ptr<Reflections>> made = registry().make(scene, **renderer);
    EXPECT_TRUE(made) << to_string(made.errors());
    EXPECT_TRUE((*renderer)->set_reflection(made->get()));
    Camera camera;
    camera.world_from_camera = look_at({0, -5, 0}, glm::vec3(0.0f));
    EXPECT_TRUE(draw_frame(**renderer, scene, made->get(), {camera, 32, 32}));
    const ImageF radiance = (*renderer)->read_radiance();
    const float* pixel = radiance.at(16, 16);
    return {pixel[0], pixel[1], pixel[2]};
  }
};

TEST_F(RegistryTest, AMethodOfATestRoomIsNamedByAScriptAndDrawn) {
  const Result<Settings> wanted = settings_of("reflection(method=\"green\", green=0.5)");
  ASSERT_TRUE(wanted) << to_string(wanted.errors());
  EXPECT_LT(glm::distance(mirror_with(*wanted), glm::vec3(0, 0.5f, 0)), 0.01f);
}

TEST_F(RegistryTest, TheDefaultMethodIsDrawnWithItsDefaults) {
  EXPECT_LT(glm::distance(mirror_with({}), glm::vec3(0, 0.25f, 0)), 0.01f);
}

TEST_F(RegistryTest, AnOverlayLiesOverAnyMethodThatWantsIt) {
  for (const char* method : {"green", "green twice"}) {
    const Result<Settings> wanted =
        settings_of(fmt::format("reflection(method=\"{}\", green=0.5, red=0.75)", method));
    ASSERT_TRUE(wanted) << to_string(wanted.errors());
    EXPECT_LT(glm::distance(mirror_with(*wanted), glm::vec3(0.75f, 0.5f, 0)), 0.01f) << method;
  }
}

TEST_F(RegistryTest, AnUnknownMethodIsAnErrorThatNamesThoseThereAre) {
  const Result<Settings> in_script = settings_of("reflection(method=\"geren\")");
  ASSERT_FALSE(in_script);
  EXPECT_NE(to_string(in_script.errors()).find("did you mean \"green\"?"), std::string::npos);
  EXPECT_FALSE(settings_of("reflection(method=\"red shine\")")) << "an overlay is no method";
  scene::Scene scene;
  settings(scene).method = "geren";
  const Status status = registry().prepare(scene);
  ASSERT_FALSE(status);
  EXPECT_NE(to_string(status.errors()).find("expected one of green, green twice"), std::string::npos)
      << to_string(status.errors());
}

TEST_F(RegistryTest, AMethodThatSuitsTheSceneStandsInForTheDefault) {
  for (const char* left_open : {"", automatic}) {
    scene::Scene scene;
    settings(scene).method = left_open;
    EXPECT_EQ(registry().name_of(scene), "green");
    own_settings<Paint>(scene).red = 1.0f;
    EXPECT_EQ(registry().name_of(scene), "green twice");
    settings(scene).method = "green";
    EXPECT_EQ(registry().name_of(scene), "green") << "the script names it";
  }
  const Result<Settings> by_script = settings_of("reflection(green=0.5)");
  ASSERT_TRUE(by_script) << to_string(by_script.errors());
  EXPECT_EQ(by_script->method, automatic);
}

TEST_F(RegistryTest, AttributesThatMethodsShareStandOnceInTheNode) {
  const std::vector<scene::AttributeSchema> attributes = registry().attributes();
  ASSERT_EQ(attributes.size(), 2u);
  EXPECT_EQ(attributes[0].name, "green");
  EXPECT_EQ(attributes[1].name, "red");
}

TEST_F(RegistryTest, TheSceneIsPreparedByItsMethodAlone) {
  scene::Scene scene;
  ASSERT_TRUE(registry().prepare(scene));
  EXPECT_TRUE(own_settings<Paint>(scene).is_prepared);
  scene::Scene other;
  settings(other).method = "green twice";
  ASSERT_TRUE(registry().prepare(other));
  EXPECT_FALSE(own_settings<Paint>(other).is_prepared);
}

TEST(Settings, AreEqualByTheirContent) {
  Settings a, b;
  EXPECT_EQ(a, b);
  a.own.get<Paint>();
  EXPECT_EQ(a, b) << "read, not set";
  a.own.get<Paint>().green = 0.5f;
  EXPECT_FALSE(a == b);
  b = a;
  EXPECT_EQ(a, b);
  b.bounces = 2;
  EXPECT_FALSE(a == b);
}

}  // namespace
}  // namespace parvis::methods

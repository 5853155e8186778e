// What rooms draw by themselves, as rays see it: surfaces given by functions.
#include <gtest/gtest.h>

#include "graphics/reference/path_tracer.h"
#include "graphics/reference/tracer.h"
#include "scene/data/test_scene.h"

namespace parvis::reference {
namespace {

/// Shines with the direction toward the viewer as its colour; alpha by which half of the texture.
class Shining final : public scene::TracedSurface {
 public:
  explicit Shining(scene::Alpha alpha_mode = scene::Alpha::opaque, bool is_double_sided = true)
      : alpha_mode_(alpha_mode), is_double_sided_(is_double_sided) {}
  scene::TracedPoint point(const scene::TracedHit& hit) const override {
    scene::TracedPoint point;
    point.normal = hit.normal;
    point.base_colour = glm::vec3(0.0f);
    point.metallic = 1.0f;
    point.emission = 0.5f * hit.to_viewer + 0.5f;
    return point;
  }
  float alpha(const scene::TracedHit& hit) const override {
    if (alpha_mode_ == scene::Alpha::blend) return 0.25f;
    return hit.uv.x < 0.5f ? 1.0f : 0.0f;
  }
  scene::Alpha alpha_mode() const override { return alpha_mode_; }
  bool is_double_sided() const override { return is_double_sided_; }

 private:
  scene::Alpha alpha_mode_;
  bool is_double_sided_;
};

/// Faces south, 4 m wide and high about the origin; u runs east.
std::shared_ptr<const Mesh> facing_south() {
  return std::make_shared<const Mesh>(scene::quad({-2, 0, -2}, {2, 0, -2}, {2, 0, 2}, {-2, 0, 2}));
}

using Things = std::function<void(scene::TracedScene&)>;

scene::TracedKind kind_of(std::string name, int count, Things things) {
  return {std::move(name), [count](const scene::Scene&) { return count; },
          [things](const scene::Scene&, scene::TracedScene& traced) { things(traced); }};
}

scene::Scene scene_with(const Things& things, int count = 1) {
  scene::Scene scene;
  scene.sun.irradiance = glm::vec3(0.0f);
  scene.traced_kinds = {kind_of("shining", count, things)};
  return scene;
}

constexpr int traced_side = 33;

TracedPicture trace(const scene::Scene& scene, glm::vec3 eye = {0, -10, 0}) {
  Camera camera;
  camera.world_from_camera = look_at(eye, {0, 0, 0});
  camera.vertical_fov = glm::radians(60.0f);
  const RayScene rays(scene);
  return trace_picture(rays, scene, shading::make_sky_light(ImageF(32, 16, 3, 0.0f), 1.0f, 0.0f), camera,
                       traced_side, traced_side, {});
}

glm::vec3 at(const TracedPicture& picture, int x, int y) {
  const float* pixel = picture.radiance.at(x, y);
  return {pixel[0], pixel[1], pixel[2]};
}

TEST(TracedThings, RadianceMayDependOnTheDirection) {
  const scene::Scene scene = scene_with([](scene::TracedScene& traced) {
    traced.add(facing_south(), std::make_shared<const Shining>(), glm::mat4(1.0f), {});
  });
  for (const glm::vec3 eye : {glm::vec3(0, -10, 0), glm::vec3(5, -8, 3), glm::vec3(-6, -8, 0)}) {
    const glm::vec3 expected = 0.5f * glm::normalize(eye) + 0.5f;
    EXPECT_LT(glm::distance(at(trace(scene, eye), traced_side / 2, traced_side / 2), expected), 0.02f);
  }
}

TEST(TracedThings, TransformsTurnPointsAndNormals) {
  const glm::mat4 stretched = glm::scale(glm::rotate(glm::mat4(1.0f), 0.4f, {0, 0, 1}), {2.0f, 1.0f, 0.5f});
  const scene::Scene scene = scene_with([&](scene::TracedScene& traced) {
    traced.add(facing_south(), std::make_shared<const Shining>(), stretched, {});
  });
  const RayScene rays(scene);
  const std::optional<Hit> hit = rays.nearest_hit({{0.3f, -5, 0.1f}, {0, 1, 0}});
  ASSERT_TRUE(hit);
  const ShadingPoint point = shading_point(*hit, {0, 1, 0}, 0.01f);
  EXPECT_LT(glm::distance(point.position, glm::vec3(0.3f, 0.3f * std::tan(0.4f), 0.1f)), 1e-5f);
  EXPECT_LT(glm::distance(point.surface.normal, glm::vec3(std::sin(0.4f), -std::cos(0.4f), 0)), 1e-5f);
  EXPECT_FALSE(point.is_back);
}

TEST(TracedThings, HolesAreSeenAndShoneThrough) {
  const scene::Scene scene = scene_with([](scene::TracedScene& traced) {
    traced.add(facing_south(), std::make_shared<const Shining>(scene::Alpha::cutout), glm::mat4(1.0f), {});
  });
  const TracedPicture picture = trace(scene);
  EXPECT_GT(at(picture, traced_side / 2 - 3, traced_side / 2).z, 0.4f);
  EXPECT_EQ(at(picture, traced_side / 2 + 3, traced_side / 2), glm::vec3(0.0f));
  const RayScene rays(scene);
  EXPECT_TRUE(rays.is_blocked({{-1, -5, 0}, {0, 1, 0}}));
  EXPECT_FALSE(rays.is_blocked({{1, -5, 0}, {0, 1, 0}}));
  Passage passage{Random(1), false};
  EXPECT_TRUE(rays.is_blocked({{-1, -5, 0}, {0, 1, 0}}, passage));
  EXPECT_FALSE(rays.is_blocked({{1, -5, 0}, {0, 1, 0}}, passage));
}

TEST(TracedThings, BlendingCoversItsShare) {
  const scene::Scene scene = scene_with([](scene::TracedScene& traced) {
    traced.add(facing_south(), std::make_shared<const Shining>(scene::Alpha::blend), glm::mat4(1.0f), {});
    traced.add(facing_south(), std::make_shared<const Shining>(), glm::translate(glm::mat4(1.0f), {0, 3, 0}),
               {});
  });
  const glm::vec3 seen = at(trace(scene), traced_side / 2, traced_side / 2);
  EXPECT_LT(glm::distance(seen, glm::vec3(0.5f, 0.0f, 0.5f)), 0.02f) << "both shine alike";
  const RayScene rays(scene);
  const Ray through{{0.5f, -5, 0.2f}, {0, 1, 0}, 1e-4f, 6.0f};  // beside the edge that two triangles share
  EXPECT_FALSE(rays.is_blocked(through)) << "it casts no shadow";
  int stopped = 0;
  Passage passage{Random(7), true};
  for (int i = 0; i < 4000; ++i) stopped += rays.is_blocked(through, passage) ? 1 : 0;
  EXPECT_NEAR(stopped, 1000, 130) << "in photographs at random: 4.7 standard deviations";
}

TEST(TracedThings, OneMeshMayHaveSeveralSurfaces) {
  const std::shared_ptr<const Mesh> mesh = facing_south();
  const scene::Scene scene = scene_with([&](scene::TracedScene& traced) {
    traced.add(mesh, std::make_shared<const Shining>(scene::Alpha::cutout), glm::mat4(1.0f), {});
    traced.add(mesh, std::make_shared<const Shining>(), glm::translate(glm::mat4(1.0f), {5, 0, 0}), {});
  });
  const RayScene rays(scene);
  EXPECT_FALSE(rays.nearest_hit({{1, -5, 0}, {0, 1, 0}}));
  EXPECT_TRUE(rays.nearest_hit({{6, -5, 0}, {0, 1, 0}}));
}

TEST(TracedThings, BacksAndWhatIsHiddenArePassed) {
  scene::TracedPlacing hidden, without_shadow;
  hidden.is_visible = false;
  without_shadow.casts_shadow = false;
  const auto surface = std::make_shared<const Shining>(scene::Alpha::opaque, false);
  const scene::Scene scene = scene_with([&](scene::TracedScene& traced) {
    traced.add(facing_south(), surface, glm::mat4(1.0f), {});
    traced.add(facing_south(), surface, glm::translate(glm::mat4(1.0f), {10, 0, 0}), hidden);
    traced.add(facing_south(), surface, glm::translate(glm::mat4(1.0f), {20, 0, 0}), without_shadow);
  });
  const RayScene rays(scene);
  EXPECT_TRUE(rays.nearest_hit({{0, -5, 0}, {0, 1, 0}}));
  EXPECT_FALSE(rays.nearest_hit({{0, 5, 0}, {0, -1, 0}}));
  EXPECT_TRUE(rays.is_blocked({{0, 5, 0}, {0, -1, 0}})) << "the sun sees its front";
  EXPECT_FALSE(rays.nearest_hit({{10, -5, 0}, {0, 1, 0}}));
  EXPECT_TRUE(rays.nearest_hit({{20, -5, 0}, {0, 1, 0}}));
  EXPECT_FALSE(rays.is_blocked({{20, 5, 0}, {0, -1, 0}}));
}

TEST(TracedThings, AreNumberedBehindTheObjectsByKind) {
  scene::Scene scene;
  scene::add(scene, scene::model_of(scene::quad({-2, 0, -2}, {2, 0, -2}, {2, 0, 2}, {-2, 0, 2}),
                                    scene::matt(glm::vec3(0.5f))));
  const auto at_x = [](float x, int thing) {
    return [x, thing](scene::TracedScene& traced) {
      scene::TracedPlacing placing;
      placing.thing = thing;
      traced.add(facing_south(), std::make_shared<const Shining>(),
                 glm::translate(glm::mat4(1.0f), {x, 0, 0}), placing);
    };
  };
  const auto model_at_30 = [](scene::TracedScene& traced) {
    traced.add(scene::model_of(scene::quad({28, 0, -2}, {32, 0, -2}, {32, 0, 2}, {28, 0, 2}),
                               scene::matt(glm::vec3(0.5f))),
               glm::mat4(1.0f), {});
  };
  scene.traced_kinds = {kind_of("first", 3, at_x(10, 2)), kind_of("none", 0, at_x(0, 0)),
                        kind_of("second", 1, at_x(20, 0)), kind_of("third", 1, model_at_30)};
  const RayScene rays(scene);
  const auto number_at = [&](float x) {
    const std::optional<Hit> hit = rays.nearest_hit({{x, -5, 0}, {0, 1, 0}});
    return hit ? hit->place->object : -1;
  };
  EXPECT_EQ(number_at(0), 0);
  EXPECT_EQ(number_at(10), 3);
  EXPECT_EQ(number_at(20), 4);
  EXPECT_EQ(number_at(30), 5);
}

/// A photograph's paths see the same light.
TEST(TracedThings, PathsSeeThem) {
  const scene::Scene scene = scene_with([](scene::TracedScene& traced) {
    traced.add(facing_south(), std::make_shared<const Shining>(scene::Alpha::cutout), glm::mat4(1.0f), {});
  });
  const RayScene rays(scene);
  const shading::SkyLight sky = shading::make_sky_light(ImageF(32, 16, 3, 0.0f), 1.0f, 0.0f);
  const PathTracer paths(rays, scene, sky, {});
  SampleSequence numbers(1, 0, 0);
  const PathTracer::Sample seen = paths.sample({{-1, -5, 0}, {0, 1, 0}}, 1e-3f, numbers, 1);
  EXPECT_LT(glm::distance(seen.radiance, glm::vec3(0.5f, 0.0f, 0.5f)), 1e-3f);
  EXPECT_FALSE(paths.sample({{1, -5, 0}, {0, 1, 0}}, 1e-3f, numbers, 1).meets_scene);
}

/// A backdrop, the photograph of all that is far away, is seen, and lets sun and sky through.
TEST(TracedThings, LightPassesABackdrop) {
  for (const scene::Alpha alpha : {scene::Alpha::opaque, scene::Alpha::cutout}) {
    const auto is_dark_behind = [&](const scene::TracedPlacing& placing) {
      scene::Scene scene = scene_with([&](scene::TracedScene& traced) {
        traced.add(facing_south(), std::make_shared<const Shining>(alpha), glm::mat4(1.0f), placing);
      });
      scene.traced_kinds.front().is_recorded = true;
      const RayScene rays(scene);
      Passage passage, to_light{.passes_backdrops = true};
      const Ray ray{{-1, -5, 0.2f}, {0, 1, 0}};
      EXPECT_TRUE(rays.nearest_hit(ray, passage));
      const bool is_blocked = rays.is_blocked(ray, passage);
      EXPECT_EQ(rays.nearest_hit(ray, to_light).has_value(), is_blocked);
      EXPECT_EQ(rays.are_blocked(std::span(&ray, 1), std::span(&passage, 1)) != 0, is_blocked);
      EXPECT_EQ(rays.fixed_bounds(scene).empty(), !is_blocked) << "nor does it belong to the place";
      return is_blocked;
    };
    EXPECT_FALSE(is_dark_behind({.casts_shadow = false, .is_backdrop = true}));
    EXPECT_TRUE(is_dark_behind({}));
    EXPECT_TRUE(is_dark_behind({.casts_shadow = false})) << "a wish about pictures of the renderer";
  }
}

/// Models that a room places may be backdrops, and so may parts of models.
TEST(TracedThings, ModelsAreBackdropsAndCastersAsTheySay) {
  auto model = scene::model_of(scene::quad({-2, 0, -2}, {2, 0, -2}, {2, 0, 2}, {-2, 0, 2}),
                               scene::matt(glm::vec3(0.5f)));
  const auto blocks = [&](const scene::TracedPlacing& placing) {
    const scene::Scene scene =
        scene_with([&](scene::TracedScene& traced) { traced.add(model, glm::mat4(1.0f), placing); });
    const RayScene rays(scene);
    Passage passage;
    const Ray ray{{-1, 5, 0.2f}, {0, -1, 0}};
    return std::pair(rays.is_blocked(ray), rays.is_blocked(ray, passage));
  };
  EXPECT_EQ(blocks({}), std::pair(true, true));
  EXPECT_EQ(blocks({.casts_shadow = false}), std::pair(false, true));
  EXPECT_EQ(blocks({.is_backdrop = true}), std::pair(false, false)) << "the room says so";
  auto far_away = std::make_shared<scene::Model>(*model);
  far_away->parts[0].is_backdrop = true;
  model = far_away;
  EXPECT_EQ(blocks({}), std::pair(false, false)) << "its part says so";
}

/// A backdrop of a scene's own model is seen, and rays to the light pass it as they pass it in the renderer's
/// maps, whatever its part says of shadows. A blended one is no painted shadow.
TEST(TracedThings, ABackdropOfAnObjectIsSeenAndCastsNoShadow) {
  for (const scene::Alpha alpha : {scene::Alpha::opaque, scene::Alpha::blend})
    for (const bool casts_shadow : {false, true}) {
      scene::Material material = scene::matt(glm::vec3(0.5f));
      material.alpha_mode = alpha, material.is_double_sided = true;
      auto model = scene::model_of(*facing_south(), material);
      model->parts[0].is_backdrop = true, model->parts[0].casts_shadow = casts_shadow;
      scene::Scene scene;
      scene::add(scene, model);
      const RayScene rays(scene);
      Passage passage;
      const Ray ray{{-1, -5, 0.2f}, {0, 1, 0}};
      EXPECT_TRUE(rays.nearest_hit(ray));
      EXPECT_TRUE(rays.nearest_hit(ray, passage));
      EXPECT_FALSE(rays.is_blocked(ray));
      EXPECT_FALSE(rays.is_blocked(ray, passage));
    }
}

/// Photographs hold the shadows of what they show, of models, too.
TEST(TracedThings, RecordedModelsCastNoInsertedShadow) {
  const std::shared_ptr<const scene::Model> model = scene::model_of(
      scene::quad({-2, 0, -2}, {2, 0, -2}, {2, 0, 2}, {-2, 0, 2}), scene::matt(glm::vec3(0.5f)));
  for (const bool is_recorded : {false, true}) {
    scene::Scene scene =
        scene_with([&](scene::TracedScene& traced) { traced.add(model, glm::mat4(1.0f), {}); });
    scene.traced_kinds.front().is_recorded = is_recorded;
    const RayScene rays(scene);
    const Ray ray{{-1, 5, 0.2f}, {0, -1, 0}};
    EXPECT_TRUE(rays.is_blocked(ray));
    EXPECT_EQ(rays.is_blocked_by_inserted(ray), !is_recorded);
  }
}

}  // namespace
}  // namespace parvis::reference

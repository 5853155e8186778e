#include "graphics/reference/tracer.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scene/data/test_scene.h"

namespace parvis::reference {
namespace {

using scene::quad;

scene::Material glowing(glm::vec3 light) {
  scene::Material material;
  material.base_colour = glm::vec3(0.0f);
  material.roughness = 1.0f;
  material.emission = light;
  return material;
}

/// One object of a part and a material; no sun.
scene::Scene scene_of(Mesh mesh, const scene::Material& material, bool takes_reflection = false) {
  scene::Scene scene;
  scene.sun.irradiance = glm::vec3(0.0f);
  scene.objects.push_back({"object",
                           scene::model_of(std::move(mesh), material),
                           glm::mat4(1.0f),
                           {},
                           takes_reflection,
                           takes_reflection});
  return scene;
}

/// A sky without light, so that only what the test lights is seen.
shading::SkyLight dark_sky() { return shading::make_sky_light(ImageF(32, 16, 3, 0.0f), 1.0f, 0.0f); }

TracedPicture trace(const scene::Scene& scene, const Camera& camera, int width = 33, int height = 33) {
  const RayScene rays(scene);
  return trace_picture(rays, scene, dark_sky(), camera, width, height, {});
}

Camera looking_north() {
  Camera camera;
  camera.world_from_camera = look_at({0, -10, 0}, {0, 0, 0});
  camera.vertical_fov = glm::radians(60.0f);
  return camera;
}

TEST(Tracer, ASceneWithoutGeometryShowsTheSky) {
  scene::Scene scene;
  const RayScene rays(scene);
  const shading::SkyLight sky = shading::make_sky_light(ImageF(32, 16, 3, 0.5f), 1.0f, 0.0f);
  const TracedPicture picture = trace_picture(rays, scene, sky, looking_north(), 8, 8, {});
  for (const float value : picture.radiance.pixels) EXPECT_NEAR(value, 0.5f, 1e-3f);
}

TEST(Tracer, AQuadFillsThePixelsThatTrigonometrySays) {
  // 4 m high at 10 m in a picture of 60 degrees: 4 / (2 * 10 * tan 30) of its height
  const scene::Scene scene =
      scene_of(quad({-50, 0, -2}, {50, 0, -2}, {50, 0, 2}, {-50, 0, 2}), glowing(glm::vec3(1)));
  const TracedPicture picture = trace(scene, looking_north(), 3, 300);
  double rows = 0.0;
  for (int y = 0; y < 300; ++y) rows += double(picture.radiance.at(1, y)[0] > 0.5f);
  EXPECT_NEAR(rows / 300.0, 4.0 / (20.0 * std::tan(glm::radians(30.0))), 0.01);
}

TEST(Tracer, AMirrorShowsWhatStandsInItsDirection) {
  scene::Material chrome;
  chrome.base_colour = glm::vec3(1.0f);
  chrome.metallic = 1.0f;
  chrome.roughness = 0.0f;
  chrome.is_mirror_like = true;
  // a mirror that looks half to the viewer, half to the east: a ray to the north leaves to the east
  scene::Scene scene = scene_of(quad({-1, -1, -1}, {1, 1, -1}, {1, 1, 1}, {-1, -1, 1}), chrome, true);
  const scene::Scene wall =
      scene_of(quad({20, 5, -3}, {20, -5, -3}, {20, -5, 3}, {20, 5, 3}), glowing({0, 1, 0}));
  scene.objects.push_back(wall.objects[0]);
  const TracedPicture picture = trace(scene, looking_north());
  const float* middle = picture.radiance.at(16, 16);
  EXPECT_LT(middle[0], 0.05f);
  EXPECT_GT(middle[1], 0.8f);
  EXPECT_GT(*picture.mirror_mask.at(16, 16), 250);
  EXPECT_EQ(*picture.mirror_mask.at(0, 0), 0);
}

/// A coated mirror in the ground among a wall, a pane and the sky.
scene::Scene mirror_among_things() {
  scene::Material coated;
  coated.base_colour = glm::vec3(0.6f, 0.4f, 0.3f);
  coated.metallic = 0.7f, coated.roughness = 0.4f;
  coated.clear_coat = 1.0f, coated.clear_coat_roughness = 0.0f;
  coated.is_mirror_like = true;
  scene::Scene scene = scene_of(quad({-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}), coated, true);
  scene::Material white, pane;
  white.base_colour = glm::vec3(0.8f);
  pane.base_colour = {0.2f, 0.8f, 0.3f};
  pane.alpha = 0.4f, pane.alpha_mode = scene::Alpha::blend;
  const scene::Scene wall = scene_of(quad({-2, 2.5f, 0}, {1, 2.5f, 0}, {1, 2.5f, 2}, {-2, 2.5f, 2}), white),
                     front = scene_of(quad({-1, 2.2f, 0}, {2, 2.2f, 0}, {2, 2.2f, 1}, {-1, 2.2f, 1}), pane);
  scene.objects.push_back(wall.objects[0]);
  scene.objects.push_back(front.objects[0]);
  scene.sun.direction_to_sun = glm::normalize(glm::vec3(0.4f, -1.0f, 0.8f));
  scene.sun.irradiance = glm::vec3(3.0f);
  return scene;
}

TEST(Tracer, MirrorsInPacketsShowWhatSingleOnesShow) {
  const scene::Scene scene = mirror_among_things();
  const RayScene rays(scene);
  const shading::SkyLight sky = shading::make_sky_light(ImageF(32, 16, 3, 0.5f), 1.0f, 0.0f);
  const glm::vec3 eye(0, -6, 2);
  constexpr float spread = 0.002f;
  std::vector<MirrorPixel> pixels;
  for (int i = 0; i < 55; ++i)  // some beside the mirror
    pixels.push_back(
        {i % 11, i / 11, 0, {-2.2f + 0.44f * float(i % 11), -1.5f + 0.7f * float(i / 11), 0.0f}});
  pixels[3].base_rays = 1, pixels[4].base_rays = 0;
  std::vector<std::optional<MirrorLight>> together(pixels.size()), alone(pixels.size());
  trace_mirrors(rays, scene, sky, eye, spread, pixels, {}, together);
  int found = 0;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    trace_mirrors(rays, scene, sky, eye, spread, std::span(&pixels[i], 1), {}, std::span(&alone[i], 1));
    ASSERT_EQ(together[i].has_value(), alone[i].has_value());
    if (!alone[i]) continue;
    ++found;
    for (int c = 0; c < 3; ++c) {  // Embree's packets round otherwise than its single rays
      EXPECT_NEAR(together[i]->base[c], alone[i]->base[c], 1e-3f) << i;
      EXPECT_NEAR(together[i]->coat[c], alone[i]->coat[c], 1e-3f) << i;
    }
  }
  EXPECT_GT(found, 30);
  EXPECT_LT(found, 55);
}

TEST(Tracer, NoRayAsksForASunThatASurfaceTurnsAwayFrom) {
  scene::Material white;
  white.base_colour = glm::vec3(0.8f);
  scene::Scene scene = scene_of(quad({-50, 0, -50}, {50, 0, -50}, {50, 0, 50}, {-50, 0, 50}), white);
  scene.sun.irradiance = glm::vec3(3.0f);
  const auto rays_of = [&](glm::vec3 to_sun) {
    scene.sun.direction_to_sun = to_sun;
    return trace(scene, looking_north(), 8, 8).rays;
  };
  EXPECT_EQ(rays_of({0, 1, 0}), 8u * 8u * 16u);
  EXPECT_EQ(rays_of({0, -1, 0}), 2u * 8u * 8u * 16u);
}

TEST(Tracer, TheShadowOfAWallEndsWhereTrigonometrySays) {
  scene::Material white;
  white.base_colour = glm::vec3(0.8f);
  scene::Scene scene = scene_of(quad({-50, -50, 0}, {50, -50, 0}, {50, 50, 0}, {-50, 50, 0}), white);
  const scene::Scene wall = scene_of(quad({-50, 0, 0}, {50, 0, 0}, {50, 0, 3}, {-50, 0, 3}), white);
  scene.objects.push_back(wall.objects[0]);
  scene.sun.direction_to_sun =
      glm::normalize(glm::vec3(0, -1, 1));  // 45 degrees: 3 m of wall cast 3 m of shadow
  scene.sun.irradiance = glm::vec3(3.0f);
  const RayScene rays(scene);
  EXPECT_TRUE(rays.is_blocked({{0, 2.9f, 0.001f}, scene.sun.direction_to_sun}));
  EXPECT_FALSE(rays.is_blocked({{0, 3.1f, 0.001f}, scene.sun.direction_to_sun}));
}

TEST(Tracer, HolesOfCutoutPartsLetThrough) {
  scene::Material leaf = glowing(glm::vec3(1));
  leaf.alpha_mode = scene::Alpha::cutout;
  leaf.base_colour_texture = 0;
  scene::Scene scene = scene_of(quad({-5, 0, -5}, {5, 0, -5}, {5, 0, 5}, {-5, 0, 5}), leaf);
  auto model = std::make_shared<scene::Model>(*scene.objects[0].model);
  Image8 half(2, 2, 4, 255);
  half.at(0, 0)[3] = half.at(0, 1)[3] = 0;  // the west half
  model->textures.push_back({"half", half, true, scene::Wrap::clamp, scene::Wrap::clamp});
  scene.objects[0].model = model;
  const RayScene rays(scene);
  EXPECT_FALSE(rays.nearest_hit({{-4, -10, 0}, {0, 1, 0}}));
  EXPECT_TRUE(rays.nearest_hit({{4, -10, 0}, {0, 1, 0}}));
}

TEST(Tracer, PosedObjectsStandWhereTheirPoseSays) {
  scene::Scene scene = scene_of(quad({-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}), glowing(glm::vec3(1)));
  scene.objects[0].pose = {glm::translate(glm::mat4(1.0f), {30, 0, 0})};
  const RayScene rays(scene);
  EXPECT_FALSE(rays.nearest_hit({{0, -10, 0}, {0, 1, 0}}));
  const auto hit = rays.nearest_hit({{30, -10, 0}, {0, 1, 0}});
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->distance_m, 10.0f, 1e-4f);
}

TEST(Tracer, HiddenObjectsAreNotThere) {
  scene::Scene scene = scene_of(quad({-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}), glowing(glm::vec3(1)));
  EXPECT_GT(*trace(scene, looking_north()).radiance.at(16, 16), 0.5f);
  scene.objects[0].is_visible = false;
  EXPECT_EQ(*trace(scene, looking_north()).radiance.at(16, 16), 0.0f);
}

TEST(Tracer, TheSameSeedGivesTheSamePicture) {
  const scene::Scene scene =
      scene_of(quad({-2, 0, -2}, {2, 1, -2}, {2, 0, 2}, {-2, 0, 2}), glowing(glm::vec3(1)));
  EXPECT_EQ(trace(scene, looking_north()).radiance.pixels, trace(scene, looking_north()).radiance.pixels);
}

TEST(Tracer, ZeroAreaTrianglesDoNoHarm) {
  const scene::Scene scene =
      scene_of(quad({0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {1, 0, 0}), glowing(glm::vec3(1)));
  for (const float value : trace(scene, looking_north()).radiance.pixels) EXPECT_TRUE(std::isfinite(value));
}

}  // namespace
}  // namespace parvis::reference

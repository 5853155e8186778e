// The path tracer against closed forms, by z-test: the mean of independent samples lies within 4 standard
// errors of what calculus says.
#include "graphics/reference/path_tracer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "graphics/shading/lighting.h"
#include "scene/data/test_scene.h"

namespace parvis::reference {
namespace {

using glm::vec3;
using shading::Surface;

constexpr double pi_d = 3.14159265358979;

struct Estimate {
  double mean = 0.0, error = 0.0;  // standard error of the mean
};

Estimate estimate(int count, const std::function<double(int)>& value) {
  double sum = 0.0, squares = 0.0;
  for (int i = 0; i < count; ++i) {
    const double v = value(i);
    sum += v, squares += v * v;
  }
  const double mean = sum / count;
  return {mean, std::sqrt(std::max(squares / count - mean * mean, 0.0) / count)};
}

/// Radiance (red) along one ray, over samples of which each has its own numbers.
Estimate radiance(const scene::Scene& scene, const shading::SkyLight& sky, const Ray& ray, int samples,
                  const PathOptions& options = {}) {
  const RayScene rays(scene);
  const PathTracer tracer(rays, scene, sky, options);
  return estimate(samples, [&](int i) {
    SampleSequence numbers(7, std::uint32_t(i), 0);
    return double(tracer.sample(ray, 0.0f, numbers, std::uint64_t(i)).radiance.x);
  });
}

/// Four standard errors, and what the closed form leaves out.
void expect_agrees(const Estimate& found, double expected, double model_error) {
  EXPECT_NEAR(found.mean, expected, 4.0 * found.error + model_error * expected) << "error " << found.error;
  EXPECT_LT(found.error, 0.03 * expected) << "too few samples to say anything";
}

shading::SkyLight constant_sky(float radiance) {
  return shading::make_sky_light(ImageF(32, 16, 3, radiance), 1.0f, 0.0f);
}

scene::Scene without_sun() {
  scene::Scene scene;
  scene.sun.irradiance = vec3(0.0f);
  return scene;
}

scene::Scene of(Mesh mesh, const scene::Material& material) {
  scene::Scene scene = without_sun();
  scene::add(scene, scene::model_of(std::move(mesh), material));
  return scene;
}

Surface surface_of(const scene::Material& m) {
  Surface s{};
  s.normal = vec3(0, 0, 1);
  s.base_colour = m.base_colour;
  s.metallic = m.metallic, s.roughness = m.roughness;
  s.clear_coat = m.clear_coat, s.clear_coat_roughness = m.clear_coat_roughness;
  return s;
}

vec3 about_z(double cosine, double turn) {
  const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
  return {float(sine * std::cos(turn)), float(sine * std::sin(turn)), float(cosine)};
}

/// Light that leaves at `cosine_out` where light(cosine) comes in: the BRDF integrated by the midpoint rule.
double reflected(const Surface& s, double cosine_out, const std::function<double(double)>& light,
                 int steps = 200) {
  double sum = 0.0;
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < steps; ++j) {
      const double cosine = (i + 0.5) / steps, turn = pi_d * (j + 0.5) / steps;  // half a turn, twice
      sum +=
          double(shading::scattered_share(s, about_z(cosine_out, 0.0), about_z(cosine, turn), 1.0f, 1.0f).x) *
          light(cosine);
    }
  return sum * 2.0 * pi_d / (double(steps) * steps);
}

scene::Material gloss(float metallic, float roughness, float coat) {
  scene::Material material = scene::matt(vec3(0.7f));
  material.metallic = metallic;
  material.roughness = roughness;
  material.clear_coat = coat;
  material.clear_coat_roughness = 0.4f;
  return material;
}

const scene::Material materials[]{gloss(0, 1, 0), gloss(0, 0.4f, 0), gloss(1, 0.5f, 0), gloss(0.5f, 0.8f, 1)};

/// A ray that hits the sphere of radius 1 about the origin at this angle to its normal, which is up.
Ray ray_to_top(double cosine) {
  const vec3 from = about_z(cosine, 0.3);
  return {vec3(0, 0, 1) + 5.0f * from, -from};
}

TEST(PathTracer, ASphereUnderAConstantSkyShowsItsDirectionalAlbedo) {
  for (const scene::Material& material : materials)
    for (const double cosine : {0.9, 0.4}) {
      const scene::Scene scene = of(scene::sphere(vec3(0), 1.0f, 128), material);
      const Estimate found = radiance(scene, constant_sky(2.0f), ray_to_top(cosine), 20000);
      const double expected = 2.0 * reflected(surface_of(material), cosine, [](double) { return 1.0; });
      expect_agrees(found, expected, 2e-3);  // facets, and the midpoint rule
    }
}

TEST(PathTracer, ASphereUnderTheSunAloneHasTheSunsIrradiance) {
  for (const scene::Material& material : materials) {
    scene::Scene scene = of(scene::sphere(vec3(0), 1.0f, 128), material);
    scene.sun.direction_to_sun = about_z(0.6, 2.0);
    scene.sun.irradiance = vec3(3.0f);
    const Estimate found = radiance(scene, constant_sky(0.0f), ray_to_top(0.8), 2000);
    const vec3 expected = shading::direct_radiance(surface_of(material), about_z(0.8, 0.3),
                                                   scene.sun.direction_to_sun, scene.sun.irradiance);
    expect_agrees(found, double(expected.x), 2e-3);  // facets
  }
}

TEST(PathTracer, TheSunsDiscFillsItsSolidAngleWithItsIrradiance) {
  scene::Scene scene = without_sun();
  scene.sun.irradiance = vec3(3.0f);
  const SunDisc sun(scene.sun);
  EXPECT_NEAR(sun.radiance().x / SunDisc::density(), 3.0f, 1e-3f);
  for (const glm::vec2 u : {glm::vec2(0, 0), glm::vec2(0.5f, 0.3f), glm::vec2(0.99f, 0.9f)})
    EXPECT_TRUE(sun.contains(sun.direction(u)));
  EXPECT_FALSE(sun.contains(glm::normalize(sun.to_middle() + vec3(0.01f, -0.01f, 0))));
}

/// A chord inside a glowing sphere hits the wall at one angle at both its ends, so that the light that leaves
/// solves an equation in that angle alone: L(a) = E + integral of the BRDF times L.
std::vector<double> furnace_light(const Surface& s, double emission, int steps) {
  std::vector<double> light(std::size_t(steps), emission);
  const auto at = [&](double cosine) { return light[std::size_t(std::min(cosine * steps, steps - 1.0))]; };
  for (int round = 0; round < 40; ++round) {
    std::vector<double> next;
    for (int i = 0; i < steps; ++i) next.push_back(emission + reflected(s, (i + 0.5) / steps, at, steps));
    light = next;
  }
  return light;
}

TEST(PathTracer, AFurnaceHoldsTheLightOfAllBounces) {
  for (scene::Material material : {gloss(0, 1, 0), gloss(1, 0.6f, 0)}) {
    const int steps = 40;
    const std::vector<double> expected = furnace_light(surface_of(material), 1.0, steps);
    material.emission = vec3(1.0f);
    material.is_double_sided = true;
    const scene::Scene scene = of(scene::sphere(vec3(0), 10.0f, 128), material);
    for (const float offset : {0.0f, 6.0f}) {  // a ray across the sphere's axis meets its wall at this sine
      const Estimate found =
          radiance(scene, constant_sky(100.0f), {vec3(offset, 0, 0), vec3(0, 1, 0)}, 20000);
      const double cosine = std::sqrt(1.0 - 0.01 * double(offset * offset));
      expect_agrees(found, expected[std::size_t(std::min(int(cosine * steps), steps - 1))],
                    6e-3);  // steps of the closed form
    }
  }
}

TEST(PathTracer, NoSurfaceReflectsMoreThanItGets) {
  for (const float metallic : {0.0f, 1.0f})
    for (const float roughness : {0.0f, 0.1f, 0.3f, 0.6f, 1.0f})
      for (const float coat : {0.0f, 1.0f})
        for (const double cosine : {0.99, 0.5, 0.1}) {
          Surface s = surface_of(gloss(metallic, roughness, coat));
          s.base_colour = vec3(1.0f);
          const Scatter scatter(s, about_z(cosine, 0.0));
          const Estimate albedo = estimate(20000, [&](int i) {
            SampleSequence numbers(3, std::uint32_t(i), 0);
            const float choice = numbers.next_1d();
            const auto sample = scatter.sample(choice, numbers.next_2d());
            return sample ? double(sample->weight.x) : 0.0;
          });
          // Karis' polynomial lies up to 0.04 below what the highlight reflects at grazing angles.
          EXPECT_LT(albedo.mean, 1.04 + 4.0 * albedo.error)
              << metallic << " " << roughness << " " << coat << " " << cosine;
          EXPECT_GT(albedo.mean, 0.3);
        }
}

/// A sky with a bright patch, over a glossy floor with a box on it.
TEST(PathTracer, EitherStrategyAloneFindsTheSameLight) {
  ImageF picture(64, 32, 3, 0.3f);
  for (int y = 8; y < 12; ++y)
    for (int x = 30; x < 36; ++x)
      for (int c = 0; c < 3; ++c) picture.at(x, y)[c] = 3.0f;
  const shading::SkyLight sky = shading::make_sky_light(picture, 1.0f, 0.4f);
  scene::Scene scene = of(scene::ground(50.0f), gloss(0.5f, 0.3f, 1));
  scene::add(scene, scene::model_of(scene::box({-1, 2, 0}, {1, 3, 2}), gloss(0, 0.7f, 0)));
  const Ray ray{{0.5f, -4, 2}, glm::normalize(vec3(0, 5, -2))};
  PathOptions options;
  const Estimate both = radiance(scene, sky, ray, 40000, options);
  for (const LightStrategy strategy : {LightStrategy::chosen_lights, LightStrategy::scattered_rays}) {
    options.strategy = strategy;
    const Estimate one = radiance(scene, sky, ray, 40000, options);
    EXPECT_NEAR(one.mean, both.mean, 4.0 * std::hypot(one.error, both.error));
    EXPECT_GT(one.error, both.error);
  }
}

TEST(PathTracer, EitherStrategyAloneFindsTheSameHighlightOfTheSun) {
  scene::Scene scene = of(scene::ground(50.0f), gloss(1, 0.2f, 0));
  scene.sun.direction_to_sun = about_z(0.6, 0.0);
  scene.sun.irradiance = vec3(3.0f);
  const Ray ray{10.0f * about_z(0.6, pi_d), -about_z(0.6, pi_d)};
  PathOptions options;
  const Estimate both = radiance(scene, constant_sky(0.0f), ray, 20000, options);
  options.strategy = LightStrategy::scattered_rays;
  const Estimate rays = radiance(scene, constant_sky(0.0f), ray, 400000, options);
  EXPECT_NEAR(rays.mean, both.mean, 4.0 * std::hypot(rays.error, both.error));
  EXPECT_LT(rays.error, 0.1 * both.mean);
}

TEST(PathTracer, ASmoothMirrorShowsExactlyWhatLiesInItsDirection) {
  scene::Material chrome = gloss(1, 0.0f, 0);
  chrome.base_colour = vec3(1.0f);
  const scene::Scene scene = of(scene::ground(5.0f), chrome);
  const Estimate found =
      radiance(scene, constant_sky(0.5f), {{0, -3, 3}, glm::normalize(vec3(0, 1, -1))}, 2000);
  EXPECT_NEAR(found.mean, 0.5, 4.0 * found.error + 1e-5);
}

TEST(PathTracer, WhatBlendsLetsThroughWhatItsAlphaLeaves) {
  scene::Material glow = scene::matt(vec3(0.0f)), pane = glow;
  glow.roughness = pane.roughness = 1.0f;
  glow.emission = vec3(8.0f);
  pane.emission = vec3(2.0f);
  pane.alpha = 0.25f;
  pane.alpha_mode = scene::Alpha::blend;
  scene::Scene scene = of(scene::quad({-1, 1, -1}, {1, 1, -1}, {1, 1, 1}, {-1, 1, 1}), glow);
  scene::add(scene, scene::model_of(scene::quad({-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}), pane));
  const Ray ray{{0.1f, -3, 0.4f}, {0, 1, 0}};
  expect_agrees(radiance(scene, constant_sky(0.0f), ray, 20000), 0.25 * 2.0 + 0.75 * 8.0, 2e-3);
  // What is to cast no shadow in pictures is there all the same.
  scene.data<scene::SunShadows>().casts_none = {false, true};
  expect_agrees(radiance(scene, constant_sky(0.0f), ray, 20000), 0.25 * 2.0 + 0.75 * 8.0, 2e-3);
  // Painted contact shadows are the renderer's.
  auto painted = std::make_shared<scene::Model>(*scene.objects[1].model);
  painted->parts[0].casts_shadow = false;
  scene.objects[1].model = painted;
  EXPECT_NEAR(radiance(scene, constant_sky(0.0f), ray, 100).mean, 8.0, 0.02);
}

TEST(PathTracer, HazeIsTheRenderers) {
  scene::Material glow = scene::matt(vec3(0.0f));
  glow.emission = vec3(8.0f);
  scene::Scene scene =
      of(scene::quad({-500, 100, -500}, {500, 100, -500}, {500, 100, 500}, {-500, 100, 500}), glow);
  scene.haze_per_m = 0.004f;
  const shading::SkyLight sky = constant_sky(1.0f);
  PathOptions options;
  options.bounces = 0;
  const Estimate found = radiance(scene, sky, {vec3(0), {0, 1, 0}}, 10, options);
  const vec3 expected = shading::through_haze(vec3(8.0f), 100.0f, scene.haze_per_m, sky.haze_radiance);
  EXPECT_NEAR(found.mean, double(expected.x), 1e-4);
}

/// A photograph of all that is far away: it shines by itself, five times as brightly as the sky.
class FarAway final : public scene::TracedSurface {
 public:
  static constexpr float radiance = 5.0f;
  scene::TracedPoint point(const scene::TracedHit& hit) const override {
    return {.normal = hit.to_viewer,
            .base_colour = vec3(0.0f),
            .metallic = 1.0f,
            .roughness = 1.0f,
            .emission = vec3(radiance)};
  }
};

/// Things within a dome that stands for all that is far away are lit as without it, by either strategy.
TEST(PathTracer, ABackdropIsSeenAndLightsNothing) {
  const shading::SkyLight sky = constant_sky(1.0f);
  const auto dome = std::make_shared<const Mesh>(scene::sphere(vec3(0.0f), 50.0f, 32));
  const auto within_dome = [&](scene::Scene scene) {
    scene.traced_kinds = {{.name = "facades",
                           .count = [](const scene::Scene&) { return 1; },
                           .trace =
                               [dome](const scene::Scene&, scene::TracedScene& traced) {
                                 traced.add(dome, std::make_shared<const FarAway>(), glm::mat4(1.0f),
                                            {.casts_shadow = false, .is_backdrop = true});
                               },
                           .is_recorded = true}};
    return scene;
  };
  const Mesh ball = scene::sphere(vec3(0.0f), 1.0f, 128);
  PathOptions options;
  for (const scene::Material& material : materials) {
    const double expected = reflected(surface_of(material), 0.7, [](double) { return 1.0; });
    for (const LightStrategy strategy :
         {LightStrategy::both, LightStrategy::chosen_lights, LightStrategy::scattered_rays}) {
      options.strategy = strategy;
      expect_agrees(radiance(within_dome(of(ball, material)), sky, ray_to_top(0.7), 40000, options), expected,
                    2e-3);  // facets, and the midpoint rule
    }
  }
  options.strategy = LightStrategy::both;
  options.bounces = 0;
  EXPECT_NEAR(radiance(within_dome(without_sun()), sky, ray_to_top(0.7), 10, options).mean, FarAway::radiance,
              1e-3);
  options.bounces = 1;
  scene::Material chrome = gloss(1, 0.0f, 0);
  chrome.base_colour = vec3(1.0f);
  EXPECT_NEAR(radiance(within_dome(of(ball, chrome)), sky, ray_to_top(0.7), 2000, options).mean,
              FarAway::radiance, 0.02 * FarAway::radiance)
      << "what smooth mirrors show";
}

TEST(PathTracer, AnEmptySceneShowsTheSkyAndTheSunsDisc) {
  scene::Scene scene;
  const Estimate sky = radiance(scene, constant_sky(0.5f), {vec3(0), {0, 0, -1}}, 10);
  EXPECT_NEAR(sky.mean, 0.5, 1e-3);
  const vec3 to_sun = glm::normalize(scene.sun.direction_to_sun);
  EXPECT_GT(radiance(scene, constant_sky(0.5f), {vec3(0), to_sun}, 10).mean, 1e4);
}

TEST(PathTracer, SolidGlassKeepsLightAndAbsorbsByBeersLaw) {
  scene::Material glass;
  glass.ior = 1.5f;
  const Mesh ball = scene::sphere(vec3(0.0f), 1.0f, 64);
  expect_agrees(radiance(of(ball, glass), constant_sky(2.0f), {{0.6f, 0.3f, 4}, {0, 0, -1}}, 4000), 2.0,
                0.005);
  // Through the middle: what comes straight through, and what is reflected inside twice, four times, ...
  glass.absorption_per_m = vec3(0.4f);
  const double f = 0.04, left = std::exp(-0.8);
  const double through = (1.0 - f) * (1.0 - f) * left / (1.0 - f * left);
  expect_agrees(radiance(of(ball, glass), constant_sky(2.0f), {{0, 0, 4}, {0, 0, -1}}, 4000),
                2.0 * (f + through), 0.005);
}

}  // namespace
}  // namespace parvis::reference

#include <gtest/gtest.h>

#include <cmath>

#include "graphics/bounced_light/bounced_over.h"
#include "graphics/bounced_light/test_street.h"
#include "graphics/gl/test_context.h"
#include "graphics/lamps/lamp_light.h"
#include "graphics/light/sun_and_sky.h"
#include "graphics/reference/photograph.h"
#include "graphics/reference/scene_lamps.h"
#include "graphics/reference/tracer.h"
#include "graphics/render/frame_views.h"
#include "graphics/render/test_renderer.h"
#include "scene/data/lamp.h"

namespace parvis::bounced_light {
namespace {

using glm::vec3;

vec3 irradiance(const shading::BouncedLight& light, vec3 position, vec3 geometric_normal, vec3 normal) {
  return bounced_irradiance(light.cell(position, geometric_normal), normal);
}

TEST(Transfer, GroundGivesBackItsAlbedoOfTheLight) {
  scene::Scene scene;
  add(scene, scene::model_of(scene::ground(60), scene::matt(vec3(0.5f, 0.4f, 0.3f))));
  scene.sun.direction_to_sun = glm::normalize(vec3(0.3f, 0.2f, 0.8f));
  scene.sky.intensity = 0.0f;
  const reference::RayScene rays(scene);
  const Transfer transfer(scene, rays, {true, 4.0f, 256});
  const shading::BouncedLight light = transfer.light(scene.sun, sky_of(scene));
  const vec3 expected = vec3(0.5f, 0.4f, 0.3f) * scene.sun.irradiance * scene.sun.direction_to_sun.z;
  const vec3 down = irradiance(light, {0, 0, 0.5f}, {0, 0, 1}, {0, 0, -1});
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(down[c], expected[c], 0.05f * expected[c]);
  const vec3 wall = irradiance(light, {0, 0, 0.5f}, {0, 0, 1}, {1, 0, 0});
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(wall[c], 0.5f * expected[c], 0.06f * expected[c]);
  EXPECT_LT(irradiance(light, {0, 0, 0.5f}, {0, 0, 1}, {0, 0, 1}).x, 0.02f * expected.x);
}

TEST(Transfer, AMirrorShowsWhatStandsBeforeIt) {
  scene::Scene scene;
  add(scene, scene::model_of(scene::ground(60), scene::matt(vec3(0.5f, 0.4f, 0.3f))));
  scene.sky.intensity = 0.0f;
  const reference::RayScene rays(scene);
  const shading::BouncedLight light =
      Transfer(scene, rays, {true, 4.0f, 256}).light(scene.sun, sky_of(scene));
  const vec3 ground =
      vec3(0.5f, 0.4f, 0.3f) * scene.sun.irradiance * scene.sun.direction_to_sun.z / glm::pi<float>();
  const shading::BouncedCell cell = light.cell({0, 0, 0.5f}, {1, 0, 0});
  // Two bands tell no horizon from a slope: half of the radiance at the horizon, a quarter too much below.
  EXPECT_NEAR(bounced_radiance(cell, {0, 0, -1}).x / ground.x, 1.25, 0.1);
  EXPECT_NEAR(bounced_radiance(cell, {1, 0, 0}).x / ground.x, 0.5, 0.1);
  EXPECT_LT(bounced_radiance(cell, {0, 0, 1}).x / ground.x, 0.03);
}

/// The picture's middle looks north, its right quarter east.
ImageF glowing_in_the_east() {
  ImageF picture(128, 64, 3, 0.2f);
  for (int y = 24; y < 32; ++y)  // up to 22 degrees above the horizon
    for (int x = 80; x < 112; ++x)
      for (int c = 0; c < 3; ++c) picture.at(x, y)[c] = 8.0f;
  return picture;
}

TEST(Transfer, WallsOfAStreetHideTheGlowOfALowSun) {
  const scene::Scene scene = street();
  const reference::RayScene rays(scene);
  const Transfer transfer(scene, rays, {true, 3.0f, 128});
  const vec3 up(0, 0, 1), on_the_street(0, 0, 0.5f), above_the_roofs(0, 0, 14);
  const auto sky_at = [&](const ImageF& picture, vec3 place) {
    return transfer.light(scene.sun, shading::make_sky_light(picture, 1.0f, 0.0f)).cell(place, up).sky.x;
  };
  const ImageF glow = glowing_in_the_east(), even(128, 64, 3, 0.7f);
  EXPECT_LT(sky_at(glow, on_the_street), 0.5f);
  EXPECT_NEAR(sky_at(glow, above_the_roofs), 1.0f, 0.25f);
  EXPECT_NEAR(sky_at(even, on_the_street), 1.0f, 1e-3f);
  EXPECT_EQ(shading::BouncedLight().cell(on_the_street, up).sky, vec3(1.0f)) << "without any";
}

TEST(Transfer, IsLinearInSunAndSky) {
  scene::Scene scene = street();
  const reference::RayScene rays(scene);
  const Transfer transfer(scene, rays, {true, 6.0f, 64});
  const auto at = [&](float sun, float sky) {
    scene::Scene other = scene;
    other.sun.irradiance *= sun, other.sky.intensity *= sky;
    return irradiance(transfer.light(other.sun, sky_of(other)), {-5.9f, 0, 2}, {1, 0, 0}, {1, 0, 0}).x;
  };
  EXPECT_GT(at(1, 1), 0.1f);
  EXPECT_NEAR(at(3, 3), 3 * at(1, 1), 1e-4f * at(3, 3));
  // Cells have one colour each, so that mixing between cells of several colours is not quite linear.
  EXPECT_NEAR(at(1, 0) + at(0, 1), at(1, 1), 0.015f * at(1, 1));
  EXPECT_NEAR(at(3, 2), 3 * at(1, 0) + 2 * at(0, 1), 0.015f * at(3, 2));
}

/// The scene without sun and sky; a lamp hangs 5 m above the ground.
scene::Scene by_night(scene::Scene scene) {
  scene.sun.irradiance = vec3(0.0f), scene.sky.intensity = 0.0f;
  scene::Lamp lamp;
  lamp.position = {0, 0, 5}, lamp.intensity = vec3(10.0f, 8.0f, 5.0f), lamp.reach_m = 200.0f;
  lamp.burns = scene::LampSwitch::always;
  scene.data<scene::ItemsOf<scene::Lamp>>().add(lamp, 0);
  return scene;
}

std::vector<vec3> irradiance_of(const Transfer& transfer, const scene::Scene& scene) {
  return LampShares().irradiance(transfer, reference::lit_lamps(scene), scene);
}

TEST(Transfer, GroundGivesBackTheLightOfALampAboveIt) {
  scene::Scene scene;
  add(scene, scene::model_of(scene::ground(40), scene::matt(vec3(0.5f))));
  add(scene,
      scene::model_of(scene::box({38, 38, 0}, {39, 39, 20}), scene::matt(vec3(0.0f))));  // there is air
  scene = by_night(scene);
  const reference::RayScene rays(scene);
  const Transfer transfer(scene, rays, {true, 4.0f, 512});
  const shading::BouncedLight light =
      transfer.light(scene.sun, sky_of(scene), irradiance_of(transfer, scene), 1);
  // Irradiance of a ceiling 12 m above the ground, right over the lamp: rings of the ground.
  const double lamp_m = 5.0, ceiling_m = 12.0, step_m = 0.01;
  double expected = 0.0;
  for (int i = 0; i < 4000; ++i) {
    const double r = (i + 0.5) * step_m, to_lamp = r * r + lamp_m * lamp_m,
                 to_ceiling = r * r + ceiling_m * ceiling_m;
    const double on_ground = 10.0 * lamp_m / (to_lamp * std::sqrt(to_lamp));
    expected += 0.5 / glm::pi<double>() * on_ground * ceiling_m * ceiling_m / (to_ceiling * to_ceiling) *
                2.0 * glm::pi<double>() * r * step_m;
  }
  const vec3 found = irradiance(light, {0, 0, ceiling_m}, vec3(0.0f), {0, 0, -1});
  // Patches of 3 m, and two bands, which spread what comes from right below: by up to a quarter.
  EXPECT_NEAR(double(found.x) / expected, 0.9, 0.3);
  EXPECT_NEAR(found.y / found.x, 0.8f, 0.01f);
}

TEST(Transfer, LampsLightNoPatchBehindAWall) {
  scene::Scene scene = by_night(street());
  const reference::RayScene rays(scene);
  const Transfer transfer(scene, rays, {true, 3.0f, 64});
  const std::vector<vec3> irradiance = irradiance_of(transfer, scene);
  int lit = 0, behind = 0;
  for (std::size_t i = 0; i < irradiance.size(); ++i) {
    const Patch& patch = transfer.patches()[i];
    const bool is_on_the_street = std::abs(patch.position.x) < 5.0f && std::abs(patch.position.y) < 15.0f;
    if (is_on_the_street && patch.normal.z > 0.9f) {
      EXPECT_GT(irradiance[i].x, 0.0f);
      ++lit;
    }
    if (std::abs(patch.position.x) > 14.5f && std::abs(patch.position.y) < 28.0f) {
      EXPECT_EQ(irradiance[i], vec3(0.0f));
      ++behind;
    }
  }
  EXPECT_GT(lit, 20);
  EXPECT_GT(behind, 20);
}

shading::Lamp lamp_at(vec3 place, float power = 10.0f) {
  return {glm::vec4(place, 20.0f), glm::vec4(vec3(power), 0.0f), glm::vec4(0, 0, -1, -2), glm::vec4(0.0f)};
}

TEST(LampShares, ALampThatIsSwitchedTracesItsOwnRaysAlone) {
  const scene::Scene scene = street();
  const Transfer transfer(scene, reference::RayScene(scene), {true, 3.0f, 64});
  const shading::Lamp south = lamp_at({0, -12, 5}), north = lamp_at({1, 12, 4});
  const auto traced_for = [&](const std::vector<shading::Lamp>& lamps) {
    LampShares fresh;
    fresh.irradiance(transfer, lamps, scene);
    return fresh.traced();
  };
  LampShares shares;
  const std::vector<vec3> of_one = shares.irradiance(transfer, {south}, scene);
  EXPECT_EQ(shares.traced(), traced_for({south}));
  const std::vector<vec3> of_both = shares.irradiance(transfer, {north, south}, scene);
  EXPECT_EQ(of_both, LampShares().irradiance(transfer, {north, south}, scene));
  const std::size_t all = shares.traced();
  EXPECT_EQ(all, traced_for({south}) + traced_for({north}));

  EXPECT_EQ(shares.irradiance(transfer, {south}, scene), of_one);
  EXPECT_TRUE(shares.irradiance(transfer, {}, scene).empty());
  EXPECT_EQ(shares.irradiance(transfer, {north, south}, scene), of_both);
  shading::Lamp bright = north;
  bright.power *= 3.0f;
  EXPECT_NE(shares.irradiance(transfer, {bright, south}, scene), of_both);
  EXPECT_EQ(shares.traced(), all) << "switched off, on and dimmed";

  for (const auto change :
       {+[](shading::Lamp& lamp) { lamp.place.z += 1.0f; },
        +[](shading::Lamp& lamp) { lamp.place.w = 15.0f; }, +[](shading::Lamp& lamp) { lamp.axis.w = 0.5f; },
        +[](shading::Lamp& lamp) { lamp.body.w = 0.3f; }}) {
    shading::Lamp other = north;
    change(other);
    const std::size_t before = shares.traced();
    EXPECT_EQ(shares.irradiance(transfer, {other, south}, scene),
              LampShares().irradiance(transfer, {other, south}, scene));
    EXPECT_EQ(shares.traced() - before, traced_for({other})) << "it is another lamp";
  }
}

/// The lamps that are brightest now count where a cell has no room for all, whichever burned first.
TEST(LampShares, TheStrongestAreChosenAmongThoseThatBurnNow) {
  const scene::Scene scene = street();
  const Transfer transfer(scene, reference::RayScene(scene), {true, 6.0f, 64});
  std::vector<shading::Lamp> lamps;
  for (int i = 0; i < shading::max_lamps_per_cell + 2; ++i)
    lamps.push_back(lamp_at({0.01f * float(i), 0, 5}, 10.0f - float(i)));
  LampShares shares;
  const std::vector<vec3> at_first = shares.irradiance(transfer, lamps, scene);
  const std::size_t traced = shares.traced();
  lamps.back().power = glm::vec4(50.0f, 50.0f, 50.0f, 0.0f);
  const std::vector<vec3> later = shares.irradiance(transfer, lamps, scene);
  EXPECT_NE(later, at_first);
  EXPECT_EQ(later, LampShares().irradiance(transfer, lamps, scene));
  EXPECT_GT(shares.traced(), traced);
  EXPECT_LT(4 * (shares.traced() - traced), traced) << "one lamp beside the eight";
}

/// The kept data are bounded where a lamp moves on for hours.
TEST(LampShares, ALampOnAPathIsForgottenWhereItHasBeen) {
  const scene::Scene scene = street();
  const Transfer transfer(scene, reference::RayScene(scene), {true, 8.0f, 32});
  LampShares shares;
  for (int i = 0; i < 80; ++i) {
    const std::vector<shading::Lamp> lamps{lamp_at({0.01f * float(i), 0, 5}), lamp_at({1, 3, 5})};
    ASSERT_EQ(shares.irradiance(transfer, lamps, scene), LampShares().irradiance(transfer, lamps, scene))
        << i;
  }
  EXPECT_LT(2 * shares.kept(), shares.traced());
}

TEST(Transfer, PlacesInsideOfThingsAreNone) {
  const scene::Scene scene = street();
  const reference::RayScene rays(scene);
  const Transfer transfer(scene, rays, {true, 3.0f, 64});
  const shading::BouncedLight light = transfer.light(scene.sun, sky_of(scene));
  EXPECT_LT(transfer.place_count(), light.lobes.size());
  for (const glm::vec4 lobe : light.lobes) ASSERT_TRUE(std::isfinite(lobe.x + lobe.y + lobe.z + lobe.w));
  const scene::Scene empty;
  const Transfer nothing(empty, reference::RayScene(empty), {true, 3.0f, 64});
  EXPECT_TRUE(nothing.light(scene.sun, sky_of(scene)).empty());
}

class BouncedPicture : public gl::ContextTest {};

/// Switched on, made brighter and switched off while the scene runs.
TEST_F(BouncedPicture, FollowsTheLampsThatStandStill) {
  scene::Scene scene = by_night(street());
  scene::Lamp& lamp = scene.data<scene::ItemsOf<scene::Lamp>>().items[0];
  const auto renderer =
      render::Renderer::create(scene, {}, with_bounced_light(lamps::with_lamps(light::sun_and_sky)));
  ASSERT_TRUE(renderer) << to_string(renderer.errors());
  const auto on_the_wall = [&] {
    EXPECT_TRUE(render::draw_frame(**renderer, scene, {Camera{}, 16, 16}));
    return irradiance(*(*renderer)->drawn_light().bounced, {-5.9f, 0, 9}, {1, 0, 0}, {1, 0, 0}).x;
  };
  const float once = on_the_wall();
  EXPECT_GT(once, 1e-3f);
  lamp.intensity *= 2.0f;
  EXPECT_NEAR(on_the_wall(), 2.0f * once, 1e-3f * once);
  lamp.burns = scene::LampSwitch::never;
  EXPECT_EQ(on_the_wall(), 0.0f);
  lamp.burns = scene::LampSwitch::always;
  lamp.position.z = 0.5f;
  const float from_below = on_the_wall();
  EXPECT_GT(from_below, 1e-3f);
  EXPECT_GT(std::abs(from_below - 2.0f * once), 0.05f * once) << "it stands somewhere else";
}

/// Where more lamps hang than light one place, those that are switched on or grow bright later bounce, too.
TEST_F(BouncedPicture, IsThatOfTheLampsThatBurnNowWhicheverBurnedFirst) {
  scene::Scene scene = by_night(street());
  auto& hung = scene.data<scene::ItemsOf<scene::Lamp>>();
  const scene::Lamp first = hung.items[0];
  for (int i = 1; i < shading::max_lamps_per_cell + 2; ++i) {
    scene::Lamp lamp = first;
    lamp.position.x = 0.01f * float(i);
    hung.add(lamp, 0);
  }
  hung.items.back().intensity *= 0.1f;
  const auto make = [&] {
    return render::renderer_of(scene, with_bounced_light(lamps::with_lamps(light::sun_and_sky)));
  };
  const auto lobes_of = [&](render::Renderer& renderer) {
    EXPECT_TRUE(render::draw_frame(renderer, scene, {Camera{}, 16, 16}));
    return renderer.drawn_light().bounced->lobes;
  };
  const auto renderer = make();
  const std::vector<glm::vec4> at_first = lobes_of(*renderer);
  hung.items.back().intensity = 5.0f * first.intensity;
  const std::vector<glm::vec4> brighter = lobes_of(*renderer);
  EXPECT_NE(brighter, at_first);
  EXPECT_EQ(brighter, lobes_of(*make()));
  for (std::size_t i = 0; i < 4; ++i) hung.items[i].burns = scene::LampSwitch::never;
  const std::vector<glm::vec4> fewer = lobes_of(*renderer);
  EXPECT_NE(fewer, brighter);
  EXPECT_EQ(fewer, lobes_of(*make()));
}

/// The bounced light that path-traced photographs of the shaded wall show, and sun and sky alone do not.
TEST_F(BouncedPicture, IsNearerToThePhotographThanTheConstant) {
  constexpr int size = 64;
  scene::Scene scene = street();
  Camera camera;
  camera.world_from_camera = look_at({2, -12, 2.5f}, {-5, 4, 3});
  camera.vertical_fov = 0.9f;
  const reference::RayScene rays(scene);
  reference::PhotographOptions options;
  options.samples_per_pixel = 256;
  const auto truth = reference::take_photograph(rays, scene, sky_of(scene), camera, size, size, options);
  ASSERT_TRUE(truth) << to_string(truth.errors());
  const auto error = [&](bool is_bounced) {
    scene.data<scene::BouncedSettings>().is_on = is_bounced;
    auto renderer = render::Renderer::create(scene, {}, with_bounced_light(light::sun_and_sky));
    EXPECT_TRUE(renderer) << to_string(renderer.errors());
    EXPECT_TRUE(render::draw_frame(**renderer, scene, {camera, size, size}));
    const ImageF picture = (*renderer)->read_radiance();
    double off = 0.0, sum = 0.0;
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x)
        for (int c = 0; c < 3; ++c) {
          const double expected = double(truth->radiance.at(x, y)[c]);
          off += std::abs(double(picture.at(x, y)[c]) - expected), sum += expected;
        }
    // The ray tracer reads the same light.
    const shading::DrawnLight light = (*renderer)->drawn_light();
    EXPECT_EQ(light.bounced != nullptr, is_bounced);
    reference::TraceOptions tracing;
    tracing.drawn_light = &light, tracing.samples_per_pixel = 4;
    const ImageF traced =
        reference::trace_picture(rays, scene, (*renderer)->sky(), camera, size, size, tracing).radiance;
    double apart = 0.0;
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x) apart += double(std::abs(picture.at(x, y)[0] - traced.at(x, y)[0]));
    EXPECT_LT(apart / (sum / 3.0), 0.03);
    return off / sum;
  };
  const double with = error(true), without = error(false);
  std::printf("mean difference to the photograph: %.1f %% with, %.1f %% without bounced light\n", 100 * with,
              100 * without);
  EXPECT_LT(with, 0.6 * without);
}

}  // namespace
}  // namespace parvis::bounced_light

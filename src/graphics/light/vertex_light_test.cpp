#include "graphics/light/vertex_light.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/random.h"
#include "graphics/light/test_box.h"

namespace parvis::light {
namespace {

/// A sky of one radiance everywhere, without a sun.
class EvenSky : public SkyModel {
 public:
  explicit EvenSky(glm::vec3 sun = glm::vec3(0.0f))
      : SkyModel(glm::normalize(glm::vec3(0.3f, -0.5f, 0.8f)), sun) {}
  glm::vec3 sky_radiance_xyz(glm::vec3) const override { return xyz_from_rec709(glm::vec3(1.0f)); }
};

std::vector<LitVertex> around_the_box(int count) {
  std::vector<LitVertex> vertices;
  Random random(3);
  for (int i = 0; i < count; ++i)
    vertices.push_back(
        {{random.uniform(-12.0f, 12.0f), random.uniform(6.2f, 12.0f), random.uniform(0.05f, 3.0f)},
         glm::normalize(
             glm::vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-0.3f, 1.0f)))});
  return vertices;
}

double rmse_percent(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& truth) {
  double off = 0.0, mean = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    off += double((a[i].y - truth[i].y) * (a[i].y - truth[i].y)), mean += double(truth[i].y);
  }
  return 100.0 * std::sqrt(off / double(truth.size())) / (mean / double(truth.size()));
}

TEST(VertexLight, AnOpenSkyOfRadianceOneGivesPi) {
  const scene::Scene scene = box_on_a_plain({20, 20, 0}, {21, 21, 1});
  const reference::RayScene rays(scene);
  VertexLight light({{{0, 0, 0.01f}, {0, 0, 1}}, {{0, 0, 0.01f}, {0, -1, 0}}});
  EXPECT_EQ(light.irradiance()[0], glm::vec3(0.0f));
  light.refine(rays, SkyTable(EvenSky()), 1024);
  EXPECT_NEAR(light.irradiance()[0].y, 3.14159f, 1e-2f);
  EXPECT_NEAR(light.irradiance()[1].y, 0.5f * 3.14159f, 0.05f);  // a wall sees half: the plain gives nothing
}

/// The roof is far above, as wide as the sky.
TEST(VertexLight, ABackdropGivesNothingBackAndHidesNoSky) {
  const auto irradiance_below = [](bool is_backdrop) {
    scene::Scene scene = box_on_a_plain({20, 20, 0}, {21, 21, 1});
    Mesh roof;
    for (const glm::vec2 corner : {glm::vec2(-1, -1), glm::vec2(-1, 1), glm::vec2(1, 1), glm::vec2(1, -1)})
      roof.positions.emplace_back(3000.0f * corner, 30.0f);
    roof.normals.assign(4, {0, 0, -1}), roof.uvs.assign(4, {0, 0});
    roof.indices = {0, 1, 2, 0, 2, 3};
    auto model = std::make_shared<scene::Model>(*scene.objects[0].model);
    model->parts.push_back({.object = "roof", .mesh = roof, .is_backdrop = is_backdrop});
    scene.objects[0].model = model;
    const reference::RayScene rays(scene);
    VertexLight light({{{0, 0, 0.01f}, {0, 0, 1}}});
    light.refine(rays, SkyTable(EvenSky()), 1024);
    return light.irradiance()[0].y;
  };
  EXPECT_NEAR(irradiance_below(true), 3.14159f, 1e-2f);
  EXPECT_LT(irradiance_below(false), 2.0f) << "a roof gives back less than it hides";
}

TEST(VertexLight, TheSunComesWithItsDiscAndItsShadow) {
  const scene::Scene scene = box_on_a_plain({-5, -5, 0}, {5, 5, 10});
  const reference::RayScene rays(scene);
  const EvenSky sky(xyz_from_rec709(glm::vec3(10.0f)));
  VertexLight light({{{-20, -20, 0.01f}, {0, 0, 1}}, {{-2, 6.0f, 0.01f}, {0, 0, 1}}});
  light.refine(rays, SkyTable(sky), 256);
  EXPECT_NEAR(light.irradiance()[0].y, 10.0f * sky.to_sun().z + 3.14159f, 0.25f);
  EXPECT_LT(light.irradiance()[1].y, 2.5f);  // behind the box
}

TEST(VertexLight, ConvergesOnManyRays) {
  const scene::Scene scene = box_on_a_plain({-5, -5, 0}, {5, 6, 10});
  const reference::RayScene rays(scene);
  const auto sky = make_sky(SkyKind::preetham, Air{3.0}, {.azimuth_deg = 230.0, .zenith_deg = 50.0}).value();
  const SkyTable table(*sky);
  const std::vector<LitVertex> vertices = around_the_box(200);
  VertexLight quick(vertices), truth(vertices);
  truth.refine(rays, table, 16384);
  quick.refine(rays, table, 16);
  const double at_first = rmse_percent(quick.irradiance(), truth.irradiance());
  quick.refine(rays, table, 240);
  const double later = rmse_percent(quick.irradiance(), truth.irradiance());
  EXPECT_LT(later, 2.0);
  EXPECT_GT(at_first, 2.0);  // a control: sixteen rays alone do not do
  // Progress: divided otherwise, the same rays.
  VertexLight at_once(vertices);
  at_once.refine(rays, table, 256);
  for (std::size_t i = 0; i < vertices.size(); ++i)
    EXPECT_NEAR(at_once.irradiance()[i].y, quick.irradiance()[i].y,
                1e-3f * at_once.irradiance()[i].y + 1e-4f);
}

TEST(VertexLight, MovedObjectsAreLitAgain) {
  const scene::Scene scene = box_on_a_plain({-5, -5, 0}, {5, 5, 10});
  const reference::RayScene rays(scene);
  const SkyTable table{EvenSky()};
  VertexLight light({{{0, 5.5f, 0.01f}, {0, 0, 1}}});
  light.refine(rays, table, 256);
  const float near = light.irradiance()[0].y;
  light.restart({{{0, 25.0f, 0.01f}, {0, 0, 1}}});
  EXPECT_EQ(light.rays(), 0);
  light.refine(rays, table, 256);
  EXPECT_GT(light.irradiance()[0].y, 1.4f * near);
}

std::shared_ptr<const SkyModel> sky_of(double azimuth_deg, double zenith_deg) {
  return make_sky(SkyKind::preetham, Air{3.0}, {.azimuth_deg = azimuth_deg, .zenith_deg = zenith_deg})
      .value();
}

double mean_of(const std::vector<glm::vec3>& light) {
  double sum = 0.0;
  for (const glm::vec3 each : light) sum += double(each.y);
  return sum / double(light.size());
}

TEST(VertexLight, KnowsTheLightOfANewSkyWithoutARay) {
  const scene::Scene scene = box_on_a_plain({-5, -5, 0}, {5, 6, 10});
  const reference::RayScene rays(scene);
  const SkyTable before(*sky_of(230.0, 80.0)), after(*sky_of(120.0, 30.0));
  const std::vector<LitVertex> vertices = around_the_box(200);
  VertexLight followed(vertices), fresh(vertices);
  followed.refine(rays, before, 256);
  followed.follow(after);
  EXPECT_EQ(followed.rays(), 0) << "none has found this sun";
  fresh.refine(rays, after, 256);
  const std::vector<glm::vec3> known = followed.sky_irradiance(), wanted = fresh.sky_irradiance();
  for (std::size_t v = 0; v < vertices.size(); ++v)
    EXPECT_NEAR(known[v].y, wanted[v].y, 1e-3f * wanted[v].y + 1e-4f);  // sums in another order
  EXPECT_EQ(mean_of(followed.sun_irradiance()), 0.0);
  EXPECT_GT(mean_of(fresh.sun_irradiance()), 0.0);
}

TEST(VertexLight, EndsUnderANewSkyWithTheLightOfAllItsRays) {
  const scene::Scene scene = box_on_a_plain({-5, -5, 0}, {5, 6, 10});
  const reference::RayScene rays(scene);
  const SkyTable before(*sky_of(230.0, 80.0)), after(*sky_of(120.0, 30.0));
  const std::vector<LitVertex> vertices = around_the_box(200);
  VertexLight followed(vertices), fresh(vertices);
  followed.refine(rays, before, 256, Blocked::bounces);
  followed.follow(after);
  followed.refine(rays, after, 16, Blocked::bounces);
  fresh.refine(rays, after, 256, Blocked::bounces);
  const std::vector<glm::vec3> wanted = fresh.irradiance();
  followed.refine(rays, after, 240, Blocked::bounces);
  EXPECT_EQ(followed.rays(), 256);
  const std::vector<glm::vec3> found = followed.irradiance();
  for (std::size_t v = 0; v < vertices.size(); ++v)
    EXPECT_NEAR(found[v].y, wanted[v].y, 1e-3f * wanted[v].y + 1e-4f);
  // Rays beyond those of the first sky count on.
  followed.refine(rays, after, 64, Blocked::bounces), fresh.refine(rays, after, 64, Blocked::bounces);
  EXPECT_NEAR(mean_of(followed.irradiance()), mean_of(fresh.irradiance()), 1e-3 * mean_of(wanted));
}

}  // namespace
}  // namespace parvis::light

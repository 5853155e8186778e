#include "graphics/light/vertex_light.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

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

TEST(VisibilityPlaces, InterpolatesWhatWasTraced) {
  const scene::Scene scene = box_on_a_plain({-5, -5, 0}, {5, 6, 10});
  const reference::RayScene rays(scene);
  const auto sky = make_sky(SkyKind::preetham, Air{3.0}, {.azimuth_deg = 230.0, .zenith_deg = 50.0}).value();
  const SkyTable table(*sky);
  const std::vector<LitVertex> vertices = around_the_box(300);
  VertexLight traced(vertices);
  traced.refine(rays, table, 2048);
  Bounds region;
  region.add({-14, 5, 0}), region.add({14, 14, 4});
  const VisibilityPlaces places(rays, region, 0.5f);
  const InterpolatedLight light = interpolated_irradiance(vertices, places, rays, table);
  std::vector<glm::vec3> sum(vertices.size());
  std::ranges::transform(light.sky, light.sun, sum.begin(), std::plus());
  const double interpolated = rmse_percent(sum, traced.irradiance());
  const double open = rmse_percent(open_irradiance(vertices, table), traced.irradiance());
  EXPECT_LT(interpolated, 25.0);
  EXPECT_GT(open, 1.5 * interpolated);
}

TEST(VisibilityPlaces, AreNoMoreThanTheBudgetAllows) {
  const reference::RayScene rays(box_on_a_plain({-5, -5, 0}, {5, 5, 10}));
  Bounds region;
  region.add({-20, -20, 0}), region.add({20, 20, 20});
  EXPECT_GT(VisibilityPlaces(rays, region, 1.0f).size(), 30'000u);
  EXPECT_LE(VisibilityPlaces(rays, region, 1.0f, 1000).size(), 1000u);
}

TEST(RelightingPlan, GoesByTheBudget) {
  EXPECT_EQ(plan_relighting(10'000, 50.0, 20'000.0, true).method, Relighting::traced);
  EXPECT_EQ(plan_relighting(10'000, 50.0, 20'000.0, true).rays, 80);
  EXPECT_EQ(plan_relighting(100'000, 20.0, 20'000.0, true).method, Relighting::interpolated);
  EXPECT_EQ(plan_relighting(100'000, 20.0, 20'000.0, false).method, Relighting::open);
  EXPECT_EQ(plan_relighting(10'000'000, 1.0, 20'000.0, true).method, Relighting::open);
  EXPECT_EQ(plan_relighting(0, 50.0, 20'000.0, true).rays, 256);
}

}  // namespace
}  // namespace parvis::light

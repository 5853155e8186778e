#include "graphics/light/vertex_light.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>

#include "base/random.h"
#include "graphics/light/own_faces.h"
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
  fresh.refine(rays, after, 16, Blocked::bounces);
  followed.refine(rays, after, 16, Blocked::bounces);
  const std::vector<glm::vec3> after_16 = fresh.sky_irradiance(), followed_16 = followed.sky_irradiance();
  fresh.refine(rays, after, 240, Blocked::bounces);
  const std::vector<glm::vec3> wanted = fresh.irradiance(), of_sky = fresh.sky_irradiance();
  EXPECT_LT(rmse_percent(followed_16, of_sky), 0.85 * rmse_percent(after_16, of_sky));
  followed.refine(rays, after, 240, Blocked::bounces);
  EXPECT_EQ(followed.rays(), 256);
  const std::vector<glm::vec3> found = followed.irradiance();
  for (std::size_t v = 0; v < vertices.size(); ++v)
    EXPECT_NEAR(found[v].y, wanted[v].y, 1e-3f * wanted[v].y + 1e-4f);
  // Rays beyond those of the first sky count on.
  followed.refine(rays, after, 64, Blocked::bounces), fresh.refine(rays, after, 64, Blocked::bounces);
  EXPECT_NEAR(mean_of(followed.irradiance()), mean_of(fresh.irradiance()), 1e-3 * mean_of(wanted));
}

/// While rays to the sun are few, surfaces have their light of the sun by estimate, and none when it has set.
TEST(VertexLight, EstimatesWhatSurfacesGiveBackOfANewSun) {
  const scene::Scene scene = box_on_a_plain({-5, -5, 0}, {5, 6, 10});
  const reference::RayScene rays(scene);
  const EvenSky east(xyz_from_rec709(glm::vec3(10.0f)));
  const SkyTable day(east), night{EvenSky()};
  const std::vector<LitVertex> vertices = around_the_box(200);
  VertexLight light(vertices);
  light.refine(rays, day, 256, Blocked::bounces);
  const std::vector<glm::vec3> by_day = light.sky_irradiance();
  light.follow(night);
  const std::vector<glm::vec3> by_night = light.sky_irradiance();
  EXPECT_LT(mean_of(by_night), 0.9 * mean_of(by_day));
  light.follow(day);
  EXPECT_LT(rmse_percent(light.sky_irradiance(), by_day), 0.7 * rmse_percent(by_night, by_day))
      << "without a ray";
}

/// A crown of leaves that may move, beside the box.
struct Crown {
  static constexpr int object = 1;
  scene::Scene scene = box_on_a_plain({-5, -5, 0}, {5, 6, 10});

  Crown() {
    Random random(4);
    const auto any = [&] { return random.uniform(-1.0f, 1.0f); };
    scene::Part part;
    for (int leaf = 0; leaf < 150; ++leaf) {
      const glm::vec3 middle(any(), any(), 2.0f + any()),
          normal = glm::normalize(glm::vec3(any(), any(), 0.8f)),
          right = 0.3f * glm::normalize(glm::cross(normal, glm::vec3(0, 1, 0))),
          up = glm::cross(normal, right);
      const auto first = std::uint32_t(part.mesh.positions.size());
      for (const glm::vec3 corner : {-right - up, right - up, right + up, up - right}) {
        part.mesh.positions.push_back(middle + corner);
        part.mesh.normals.push_back(normal);
        part.mesh.uvs.emplace_back(0.0f);
      }
      for (const std::uint32_t k : {0u, 1u, 2u, 0u, 2u, 3u}) part.mesh.indices.push_back(first + k);
    }
    auto model = std::make_shared<scene::Model>();
    model->materials.emplace_back();
    model->parts.push_back(std::move(part));
    scene::Object crown;
    crown.model = model, crown.is_dynamic = true;
    scene.objects.push_back(crown);
    move({8, 0, 0});
  }
  void move(glm::vec3 to) { scene.objects[object].world_from_model[3] = glm::vec4(to, 1.0f); }
  std::vector<LitVertex> vertices() const {
    const glm::vec3 at(scene.objects[object].world_from_model[3]);
    const Mesh& mesh = scene.objects[object].mesh(0);
    std::vector<LitVertex> vertices;
    for (std::size_t v = 0; v < mesh.positions.size(); ++v)
      vertices.push_back({mesh.positions[v] + at, mesh.normals[v]});
    return vertices;
  }
};

/// What an object's faces give back to its vertices agrees with what rays find of them one by one, also where
/// other things stand among the leaves.
TEST(VertexLight, OwnFacesBringTheLightThatRaysFindOneByOne) {
  for (const float east : {8.0f, 5.4f}) {  // free, and half inside the box
    Crown crown;
    crown.move({east, 0, 0});
    reference::RayScene rays(crown.scene);
    ASSERT_TRUE(rays.set_apart(Crown::object));
    const SkyTable sky(*sky_of(120.0, 40.0));
    const OwnFaces own(rays, Crown::object, sky);
    VertexLight plain(crown.vertices()), ours(crown.vertices());
    plain.refine(rays, sky, 64, Blocked::bounces), ours.refine(rays, sky, 64, Blocked::bounces, &own);
    const std::vector<glm::vec3> plain_64 = plain.irradiance(), ours_64 = ours.irradiance();
    plain.refine(rays, sky, 4032, Blocked::bounces), ours.refine(rays, sky, 4032, Blocked::bounces, &own);
    const std::vector<glm::vec3> truth = plain.irradiance();
    EXPECT_LT(rmse_percent(ours.irradiance(), truth), 0.3) << east;
    EXPECT_LT(rmse_percent(ours_64, truth), 1.25 * rmse_percent(plain_64, truth)) << east;
    EXPECT_GT(rmse_percent(ours_64, truth), 1.0) << east << ": a control";
  }
}

TEST(VertexLight, KeepsWhatItsRaysHitOfItsOwnObjectWhereThatMoves) {
  Crown crown;
  reference::RayScene rays(crown.scene);
  ASSERT_TRUE(rays.set_apart(Crown::object));
  const SkyTable sky(*sky_of(120.0, 40.0)), later(*sky_of(230.0, 60.0));
  VertexLight moved(crown.vertices());
  const auto refine = [&](VertexLight& light, const SkyTable& under, int count) {
    const OwnFaces own(rays, Crown::object, under);
    light.refine(rays, under, count, Blocked::bounces, &own);
  };
  refine(moved, sky, 64);
  const std::vector<glm::vec3> before = moved.irradiance();
  crown.move({0, 8, 0});
  rays.update(crown.scene);
  moved.shift(crown.vertices());
  EXPECT_EQ(moved.rays(), 0);
  refine(moved, sky, 64);
  VertexLight fresh(crown.vertices());
  refine(fresh, sky, 64);
  EXPECT_LT(rmse_percent(moved.irradiance(), fresh.irradiance()), 0.1);
  EXPECT_GT(rmse_percent(before, fresh.irradiance()), 5.0) << "a control";

  // The light of the sky is known under another one without a ray, and all of it after as many rays.
  moved.follow(later);
  VertexLight under_later(crown.vertices());
  refine(under_later, later, 64);
  EXPECT_LT(rmse_percent(moved.sky_irradiance(), under_later.sky_irradiance()), 25.0);
  refine(moved, later, 64);
  EXPECT_LT(rmse_percent(moved.irradiance(), under_later.irradiance()), 0.1);
}

TEST(VertexLight, HalvesOfItsRaysMakeUpTheWhole) {
  const scene::Scene scene = box_on_a_plain({-5, -5, 0}, {5, 6, 10});
  const reference::RayScene rays(scene);
  const SkyTable sky(*sky_of(230.0, 50.0));
  VertexLight light(around_the_box(50));
  light.refine(rays, sky, 24, Blocked::bounces);
  const Halves of_sky = light.halves_of_sky(), of_sun = light.halves_of_sun();
  const std::vector<glm::vec3> from_sky = light.sky_irradiance(), from_sun = light.sun_irradiance();
  bool differ = false;
  for (std::size_t v = 0; v < from_sky.size(); ++v) {
    EXPECT_NEAR(0.5f * (of_sky.first[v] + of_sky.second[v]), from_sky[v].y, 1e-3f * from_sky[v].y);
    EXPECT_NEAR(0.5f * (of_sun.first[v] + of_sun.second[v]), from_sun[v].y, 1e-3f * from_sun[v].y + 1e-4f);
    differ = differ || std::abs(of_sky.first[v] - of_sky.second[v]) > 0.01f * from_sky[v].y;
  }
  EXPECT_TRUE(differ);
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
  const std::vector<glm::vec3> from_sky = interpolated_irradiance(vertices, places, table),
                               from_sun = traced_sun(vertices, rays, table, 1);
  std::vector<glm::vec3> sum(vertices.size());
  std::ranges::transform(from_sky, from_sun, sum.begin(), std::plus());
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

TEST(VisibilityPlaces, KnowHowFarTheyAreOff) {
  const reference::RayScene open(box_on_a_plain({28, 28, 0}, {29, 29, 1})),
      beside_a_box(box_on_a_plain({-5, -5, 0}, {5, 5, 10}));
  Bounds region;
  region.add({-8, -8, 1}), region.add({8, 8, 12});
  const float far = VisibilityPlaces(open, region, 1.0f).uncertainty(),
              coarse = VisibilityPlaces(beside_a_box, region, 3.0f).uncertainty(),
              fine = VisibilityPlaces(beside_a_box, region, 1.0f).uncertainty();
  EXPECT_LT(far, 0.01f);
  EXPECT_GT(fine, 0.01f);
  EXPECT_GT(coarse, fine) << "what lies further apart says less";
}

TEST(RelightingPlan, GoesByTheBudget) {
  EXPECT_EQ(plan_relighting(10'000, 50.0, 20'000.0, true).method, Relighting::traced);
  EXPECT_EQ(plan_relighting(10'000, 50.0, 20'000.0, true).rays, 80);
  EXPECT_EQ(plan_relighting(100'000, 20.0, 20'000.0, true).method, Relighting::interpolated);
  EXPECT_EQ(plan_relighting(100'000, 20.0, 20'000.0, true).rays, 1) << "to the sun";
  EXPECT_EQ(plan_relighting(30'000, 20.0, 20'000.0, true).rays, 4);
  EXPECT_EQ(plan_relighting(100'000, 20.0, 20'000.0, false).method, Relighting::open);
  EXPECT_EQ(plan_relighting(10'000'000, 1.0, 20'000.0, true).method, Relighting::open);
  EXPECT_EQ(plan_relighting(0, 50.0, 20'000.0, true).rays, 256);
}

}  // namespace
}  // namespace parvis::light

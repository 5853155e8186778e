// A ray scene that is updated agrees with a new one.
#include "graphics/reference/ray_scene.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <span>

#include "base/random.h"
#include "scene/data/test_scene.h"

namespace parvis::reference {
namespace {

/// Distances of 2,000 rays from all sides through the middle of the place; infinite where they hit nothing.
std::vector<float> distances(const RayScene& rays) {
  Random random(5);
  std::vector<float> found;
  for (int i = 0; i < 2000; ++i) {
    const auto point = [&](float half) {
      return half * (2.0f * glm::vec3(random.uniform(), random.uniform(), random.uniform()) - 1.0f);
    };
    const glm::vec3 from = 20.0f * glm::normalize(point(1.0f)), to = point(4.0f);
    const std::optional<Hit> hit = rays.nearest_hit({from, glm::normalize(to - from)});
    found.push_back(hit ? hit->distance_m : std::numeric_limits<float>::infinity());
  }
  return found;
}

void expect_same(const RayScene& updated, const scene::Scene& scene, const char* what) {
  const std::vector<float> ours = distances(updated), fresh = distances(RayScene(scene));
  std::size_t hits = 0;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    hits += std::isfinite(fresh[i]);
    if (std::isfinite(ours[i]) || std::isfinite(fresh[i])) {
      EXPECT_NEAR(ours[i], fresh[i], 1e-4f) << what;
    }
  }
  EXPECT_GT(hits, 100u) << what;
}

scene::Scene three_things() {
  scene::Scene scene;
  scene::add(scene, scene::model_of(scene::ground(6.0f), scene::matt(glm::vec3(0.5f))));
  scene::add(scene, scene::model_of(scene::box({-1, -1, 0}, {1, 1, 2}), scene::matt(glm::vec3(0.5f))), true);
  scene::add(scene, scene::model_of(scene::sphere({0, 0, 1}, 1.0f), scene::matt(glm::vec3(0.5f))), true);
  return scene;
}

TEST(RayScene, RaysSeeThePaintOfAnObject) {
  scene::Scene scene = three_things();
  const scene::Material red = scene::matt({0.9f, 0.1f, 0.1f});
  scene.objects[1].paint = std::make_shared<const std::vector<scene::Material>>(1, red);
  const RayScene rays(scene);
  const auto colour_at = [&](float x) {
    return rays.nearest_hit({{x, 0.5f, 9.0f}, {0, 0, -1}})->place->material->base_colour;
  };
  EXPECT_EQ(colour_at(0.99f), red.base_colour);
  EXPECT_EQ(colour_at(3.0f), glm::vec3(0.5f)) << "the ground";
}

TEST(RayScene, UpdatesAgreeWithANewScene) {
  scene::Scene scene = three_things();
  RayScene rays(scene);
  expect_same(rays, scene, "as built");
  const std::vector<float> before = distances(rays);

  scene.objects[1].world_from_model = glm::translate(glm::mat4(1.0f), {2, 1, 0.5f});
  EXPECT_EQ(distances(rays), before) << "nothing is taken over before update";
  rays.update(scene);
  EXPECT_NE(distances(rays), before);
  expect_same(rays, scene, "moved");

  scene.objects[2].is_visible = false;
  rays.update(scene);
  expect_same(rays, scene, "hidden");

  scene.objects[2].is_visible = true;
  scene.objects[2].world_from_model = glm::scale(glm::mat4(1.0f), {-2.0f, 1.0f, 1.0f});
  rays.update(scene);
  expect_same(rays, scene, "shown, mirrored and stretched");

  scene.objects[1].world_from_model = glm::scale(glm::mat4(1.0f), {1.0f, 1.0f, 0.0f});
  rays.update(scene);
  expect_same(rays, scene, "flattened: left out");
}

TEST(RayScene, HiddenObjectsAppear) {
  scene::Scene scene = three_things();
  scene.objects[1].is_visible = false;
  RayScene rays(scene);
  scene.objects[1].is_visible = true;
  rays.update(scene);
  expect_same(rays, scene, "shown");
}

/// Opaque parts are traced without a question about each triangle.
TEST(RayScene, PartsThatGetHolesAreFollowed) {
  scene::Scene scene = three_things();
  auto model = std::make_shared<scene::Model>(*scene.objects[1].model);
  scene.objects[1].model = model;
  for (const bool is_dynamic : {true, false}) {
    scene.objects[1].is_dynamic = is_dynamic;
    model->materials[0].alpha_mode = scene::Alpha::opaque, model->materials[0].alpha = 1.0f;
    RayScene rays(scene);
    const auto is_blocked = [&] {
      Passage passage{Random(1)};
      return rays.is_blocked({{0.9f, -0.9f, 9.0f}, {0, 0, -1}, 1e-4f, 8.0f}, passage);
    };
    EXPECT_TRUE(is_blocked());
    model->materials[0].alpha_mode = scene::Alpha::cutout, model->materials[0].alpha = 0.0f;
    rays.update(scene);
    EXPECT_FALSE(is_blocked());
    model->materials[0].alpha_mode = scene::Alpha::opaque;
    rays.update(scene);
    EXPECT_TRUE(is_blocked());
  }
}

/// A mesh that is opaque in one place and full of holes in another.
TEST(RayScene, PlacesOfAMeshHaveTheirOwnHoles) {
  scene::Scene scene = three_things();
  scene.objects.push_back(scene.objects[1]);
  scene.objects[3].world_from_model = glm::translate(glm::mat4(1.0f), {4, 0, 0});
  scene::Material gone = scene::matt(glm::vec3(0.5f));
  gone.alpha_mode = scene::Alpha::cutout, gone.alpha = 0.0f;
  scene.objects[3].paint = std::make_shared<const std::vector<scene::Material>>(1, gone);
  const RayScene rays(scene);
  const auto is_blocked = [&](float x) {
    Passage passage{Random(1)};
    return rays.is_blocked({{x, -0.9f, 9.0f}, {0, 0, -1}, 1e-4f, 8.0f}, passage);
  };
  EXPECT_TRUE(is_blocked(0.9f));
  EXPECT_FALSE(is_blocked(4.9f));
}

/// A skinned body: its mesh changes in place, and may be elsewhere in memory.
TEST(RayScene, BentMeshesAreFollowed) {
  scene::Scene scene = three_things();
  auto deforming = std::make_shared<scene::Model>(*scene.objects[2].model);
  deforming->parts[0].deformation = std::make_shared<const scene::Deformation>();
  scene.objects[2].model = deforming;
  scene.objects[2].deformed_meshes = {deforming->parts[0].mesh};
  RayScene rays(scene);
  for (const float height : {2.0f, 0.5f, 3.0f}) {
    for (std::size_t i = 0; i < deforming->parts[0].mesh.positions.size(); ++i)
      scene.objects[2].deformed_meshes[0].positions[i] =
          deforming->parts[0].mesh.positions[i] * glm::vec3(1, 1, height);
    rays.update(scene);
    expect_same(rays, scene, "deformed");
  }
  scene.objects[2].deformed_meshes = {deforming->parts[0].mesh};
  rays.update(scene);
  expect_same(rays, scene, "at rest again");
}

/// Things that rooms draw by themselves are described for each picture; here one wanders, in a mesh of its
/// own each time.
TEST(RayScene, TracedThingsAreFollowed) {
  class Plain final : public scene::TracedSurface {
    scene::TracedPoint point(const scene::TracedHit& hit) const override { return {.normal = hit.normal}; }
  };
  scene::Scene scene = three_things();
  float east_m = -3.0f;
  int count = 1;
  scene.traced_kinds = {{"wanderer", [](const scene::Scene&) { return 3; },
                         [&](const scene::Scene&, scene::TracedScene& traced) {
                           for (int i = 0; i < count; ++i) {
                             const glm::vec3 at(east_m, 2.0f * float(i) - 2.0f, 3.0f);
                             traced.add(std::make_shared<Mesh>(scene::box(at - 0.5f, at + 0.5f)),
                                        std::make_shared<Plain>(), glm::mat4(1.0f), {.thing = i});
                           }
                         }}};
  RayScene rays(scene);
  expect_same(rays, scene, "as built");
  for (const int now : {3, 2, 1, 3}) {
    east_m += 1.0f, count = now;
    rays.update(scene);
    expect_same(rays, scene, "wandered");
  }
  EXPECT_EQ(rays.triangle_count(), RayScene(scene).triangle_count());
}

/// Many that go about the same way, from beside the place through it.
std::vector<FineRay> parallel_rays() {
  std::vector<FineRay> rays;
  Random random(8);
  const glm::dvec3 along = glm::normalize(glm::dvec3(0.7, 0.5, -0.31));
  for (int i = 0; i < 1600; ++i) {
    const glm::dvec3 through(random.uniform(-4.0f, 4.0f), random.uniform(-4.0f, 4.0f),
                             random.uniform(0.0f, 2.0f));
    rays.push_back({through - 20.0 * along, along});
  }
  return rays;
}

TEST(RayScene, PacketsFindWhatSingleRaysFind) {
  scene::Scene scene = three_things();
  scene.objects[1].world_from_model = glm::scale(glm::mat4(1.0f), {-1.5f, 1.0f, 1.0f});
  scene.objects[2].world_from_model = glm::translate(glm::mat4(1.0f), {2.0f, 2.0f, 0.0f});
  const RayScene coarse(scene), fine(scene, Precision::fine);
  const std::vector<FineRay> all = parallel_rays();
  int hits = 0, blocked = 0;
  for (std::size_t first = 0; first < all.size();) {
    const std::size_t count = std::min(1 + first / 7 % RayScene::packet_size, all.size() - first);
    const std::span<const FineRay> packet(all.data() + first, count);
    first += count;
    std::array<FineHit, RayScene::packet_size> found;
    fine.nearest_hits(packet, found);
    const std::uint32_t stopped = fine.are_blocked(packet);
    std::vector<Ray> rays;
    for (const FineRay& ray : packet) rays.push_back({glm::vec3(ray.origin), glm::vec3(ray.direction)});
    std::array<Passage, RayScene::packet_size> passages{};
    const std::uint32_t passed_not = coarse.are_blocked(rays, passages);
    std::array<std::optional<Hit>, RayScene::packet_size> seen;
    coarse.nearest_hits(rays, passages, seen);
    const std::uint32_t drawn_not = coarse.are_blocked(rays, {});
    std::array<std::optional<Hit>, RayScene::packet_size> drawn;
    coarse.nearest_hits(rays, {}, drawn);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const std::optional<Hit> expected = coarse.nearest_hit(rays[i]);
      EXPECT_EQ((drawn_not >> i & 1u) != 0, coarse.is_blocked(rays[i]));
      ASSERT_EQ(drawn[i].has_value(), expected.has_value());
      EXPECT_EQ(drawn[i] ? drawn[i]->place : nullptr, expected ? expected->place : nullptr);
      ASSERT_EQ(found[i].place != nullptr, expected.has_value());
      EXPECT_EQ((stopped >> i & 1u) != 0, coarse.is_blocked(rays[i]));
      EXPECT_EQ((passed_not >> i & 1u) != 0, coarse.is_blocked(rays[i], passages[i]));
      const std::optional<Hit> seen_alone = coarse.nearest_hit(rays[i], passages[i]);
      ASSERT_EQ(seen[i].has_value(), seen_alone.has_value());
      if (seen_alone) {
        EXPECT_EQ(seen[i]->place, seen_alone->place);
        EXPECT_NEAR(seen[i]->distance_m, seen_alone->distance_m, 1e-4f);
      }
      blocked += int(stopped >> i & 1u);
      if (!expected) continue;
      ++hits;
      EXPECT_NEAR(found[i].distance_m, double(expected->distance_m), 1e-3);
      EXPECT_EQ(found[i].place->object, expected->place->object);
    }
  }
  EXPECT_GT(hits, 500);
  EXPECT_GT(blocked, 300);
}

/// Margins follow how far from the origin things lie; a thing at no finite place is not among them.
/// Boxes and boards everywhere: turned, mirrored, flattened, some with holes.
scene::Scene crowded_place(Random& random) {
  scene::Scene scene;
  scene::Material fence = scene::matt(glm::vec3(0.5f));
  fence.alpha_mode = scene::Alpha::cutout, fence.alpha = 0.4f;
  const auto box =
      scene::model_of(scene::box(glm::vec3(-0.5f), glm::vec3(0.5f)), scene::matt(glm::vec3(0.5f)));
  const auto board = scene::model_of(scene::ground(0.5f), fence);
  const auto within = [&](float low, float high) { return random.uniform(low, high); };
  for (int i = 0; i < 200; ++i) {
    const glm::vec3 place(within(-9, 9), within(-9, 9), within(0, 6)),
        axis(within(-1, 1), within(-1, 1), 1.1f);
    const glm::vec3 size(within(-2, 2), i % 17 == 0 ? 0.0f : within(0.01f, 2), within(0.01f, 2));
    const glm::mat4 turned = glm::rotate(glm::translate(glm::mat4(1.0f), place),
                                         i % 3 == 0 ? 0.0f : within(0, 6), glm::normalize(axis));
    scene::add(scene, i % 5 == 0 ? board : box, i % 2 == 0, glm::scale(turned, size));
  }
  return scene;
}

/// Rays to the sun from everywhere, as a picture asks them; some begin on the axes' planes, some are not
/// finite.
FineRay ray_to_sun(Random& random, glm::dvec3 to_sun, int kind) {
  glm::dvec3 from(random.uniform(-10.0f, 10.0f), random.uniform(-10.0f, 10.0f), random.uniform(0.0f, 7.0f));
  if (kind == 1) from = glm::round(from);
  if (kind == 2) from.x = 1e40;
  return {from, to_sun};
}

TEST(RayScene, ManyPacketsToTheSunReturnAndAgreeWithTheirRays) {
  Random random(23);
  const scene::Scene scene = crowded_place(random);
  const RayScene rays(scene, Precision::fine);
  int blocked = 0, open = 0;
  for (int packet = 0; packet < 6000; ++packet) {
    glm::dvec3 to_sun(random.uniform(-1.0f, 1.0f), random.uniform(-1.0f, 1.0f), random.uniform(0.02f, 1.0f));
    if (packet % 7 == 0) to_sun = glm::dvec3(packet % 2, 1 - packet % 2, 0.0);
    if (packet % 11 == 0) to_sun = glm::dvec3(0.0, 0.0, 1.0);
    to_sun = glm::normalize(to_sun);
    std::vector<FineRay> asked;
    const std::size_t count = 1 + std::size_t(random.uniform() * 15.99f);
    for (std::size_t i = 0; i < count; ++i)
      asked.push_back(ray_to_sun(random, to_sun, packet % 13 == 0 && i == 3 ? 2 : packet % 2));
    const std::uint32_t together = rays.are_blocked(asked);
    for (std::size_t i = 0; i < asked.size(); ++i) {
      const bool alone = rays.are_blocked(std::span(&asked[i], 1)) != 0;
      ASSERT_EQ((together >> i & 1u) != 0, alone) << packet << ", ray " << i;
      ++(alone ? blocked : open);
    }
  }
  EXPECT_GT(blocked, 5000);
  EXPECT_GT(open, 5000);
}

TEST(RayScene, AnObjectAtNoFinitePlaceLeavesExactRaysAlone) {
  scene::Scene scene = three_things();
  const RayScene without(scene, Precision::fine);
  scene.objects.push_back(scene.objects.front());
  scene.objects.back().world_from_model[3].x = std::numeric_limits<float>::infinity();
  const RayScene with(scene, Precision::fine);
  int hits = 0;
  for (const FineRay& ray : parallel_rays()) {
    FineHit expected, found;
    without.nearest_hits({&ray, 1}, {&expected, 1});
    with.nearest_hits({&ray, 1}, {&found, 1});
    ASSERT_EQ(found.place != nullptr, expected.place != nullptr);
    hits += found.place != nullptr;
  }
  EXPECT_GT(hits, 20);
}

/// Far from the origin a float is as coarse as 3e-5 m; these rays pass an edge at 1e-8 m on either side.
TEST(RayScene, FineRaysKnowTheSidesOfAnEdge) {
  scene::Scene scene;
  const glm::vec3 a(401.3f, -377.7f, 3.1f), b(403.9f, -371.2f, 11.7f), c(389.4f, -380.6f, 9.2f);
  Mesh mesh = scene::quad(a, b, c, c);
  mesh.indices.resize(3);
  scene::add(scene, scene::model_of(mesh, scene::matt(glm::vec3(0.5f))));
  const RayScene coarse(scene), fine(scene, Precision::fine);
  const glm::dvec3 along =
      glm::normalize(glm::cross(glm::dvec3(b - a), glm::dvec3(c - a)) + glm::dvec3(3, 1, 2));
  const glm::dvec3 side = glm::normalize(glm::cross(along, glm::dvec3(b) - glm::dvec3(a)));  // away from c
  int wrong_coarse = 0;
  for (int i = 1; i < 100; ++i)
    for (const double off_m : {-1e-8, 1e-8}) {
      const glm::dvec3 at = glm::mix(glm::dvec3(a), glm::dvec3(b), double(i) / 100.0) + off_m * side;
      const bool is_inside = glm::dot(at - glm::dvec3(a), side) * glm::dot(glm::dvec3(c - a), side) > 0.0;
      for (const double sense : {1.0, -1.0}) {
        const FineRay ray{at - sense * 40.0 * along, sense * along};
        FineHit hit;
        fine.nearest_hits({&ray, 1}, {&hit, 1});
        EXPECT_EQ(hit.place != nullptr, is_inside && sense < 0.0);
        EXPECT_EQ(fine.are_blocked(std::span(&ray, 1)) != 0, is_inside && sense > 0.0);
        const Ray rounded{glm::vec3(ray.origin), glm::vec3(ray.direction)};
        wrong_coarse += coarse.nearest_hit(rounded).has_value() != (is_inside && sense < 0.0);
      }
    }
  EXPECT_GT(wrong_coarse, 20) << "the control: single precision cannot";
}

TEST(RayScene, ObjectsComeWhileItIsUpdated) {
  scene::Scene scene = three_things();
  RayScene rays(scene);
  const auto post =
      scene::model_of(scene::box({-0.2f, -0.2f, 0}, {0.2f, 0.2f, 3}), scene::matt(glm::vec3(0.5f)));
  scene::add(scene, post, false, glm::translate(glm::mat4(1.0f), glm::vec3(2, 1, 0)));
  scene::add(scene, scene.objects[1].model, true, glm::translate(glm::mat4(1.0f), glm::vec3(-3, 0, 0)));
  EXPECT_TRUE(rays.update(scene));
  ASSERT_EQ(rays.moved().size(), 2u);
  EXPECT_NEAR(rays.moved()[0].max.z, 3.0f, 1e-6f);
  expect_same(rays, scene, "two have come");
  EXPECT_EQ(rays.nearest_hit({{2, 1, 9}, {0, 0, -1}})->place->object, 3);
  EXPECT_FALSE(rays.update(scene)) << "nothing has changed since";
  scene.objects[3].world_from_model[3].x = -2.0f;
  scene.objects[0].is_visible = false;
  EXPECT_TRUE(rays.update(scene));
  expect_same(rays, scene, "one of them has moved, and an old one is hidden");
  scene.objects[3].is_visible = false;
  EXPECT_TRUE(rays.update(scene));
  expect_same(rays, scene, "and is gone");
}

}  // namespace
}  // namespace parvis::reference

// Grown plants in pictures: against rays, against their own full geometry, from near to far.
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>

#include "graphics/gl/objects.h"
#include "graphics/gl/test_context.h"
#include "graphics/light/sun_and_sky.h"
#include "graphics/reference/metrics.h"
#include "graphics/reference/tracer.h"
#include "graphics/render/frame_views.h"
#include "graphics/render/renderer.h"
#include "graphics/shading/tone_curve.h"
#include "life/vegetation/plant_drawable.h"
#include "life/vegetation/plant_selection.h"
#include "life/vegetation/scene_plant.h"
#include "scene/data/sun_shadows.h"
#include "scene/data/test_scene.h"

namespace parvis::vegetation {
namespace {

using scene::add, scene::ground, scene::matt, scene::model_of;

/// Plants on a plain, in the sun from the south-east.
class PlantDisplay : public gl::ContextTest {
 protected:
  static constexpr int width = 200, height = 160;

  PlantDisplay() {
    look_from(10.0f);
    scene_.sun.direction_to_sun = glm::normalize(glm::vec3(0.6f, -0.5f, 0.7f));
    add(scene_, model_of(ground(60), matt(glm::vec3(0.5f))));
    drawables_.add(scene_plants_kind());
    drawables_.attach(scene_);
  }
  void look_from(float distance_m) {
    camera_.world_from_camera = look_at({0, -distance_m, 1.7f}, {0, 0, 1.6f});
    camera_.vertical_fov = 0.5f;
  }
  void plant(const char* kind, glm::vec3 foot, std::uint64_t seed = 1) {
    const PlantKind* found = find_kind(kind);
    auto shape = shared_plant(scene_.data<PlantCache>(), {found, found->height_m, 2.0f, seed});
    ASSERT_TRUE(shape) << to_string(shape.errors());
    scene_.data<ScenePlants>().add({*shape, glm::translate(glm::mat4(1.0f), foot), true},
                                   int(scene_plants(scene_).size()));
  }
  std::unique_ptr<render::Renderer> renderer() const {
    Result<std::unique_ptr<render::Renderer>> made =
        render::Renderer::create(scene_, drawables_, light::sun_and_sky);
    EXPECT_TRUE(made) << to_string(made.errors());
    return *std::move(made);
  }
  Image8 drawn(render::Renderer& renderer) const {
    EXPECT_TRUE(render::draw_frame(renderer, scene_, {camera_, width, height}));
    return shading::tone_mapped_picture(renderer.read_radiance(), 1.0f);
  }
  /// The picture with all geometry, whatever its size.
  Image8 drawn_in_full(render::Renderer& renderer) {
    scene_.data<PlantDetail>().is_full = true;
    const Image8 picture = drawn(renderer);
    scene_.data<PlantDetail>().is_full = false;
    return picture;
  }
  Image8 traced(render::Renderer& renderer, int samples) const {
    renderer.begin_frame(scene_, camera_);
    const shading::DrawnLight light = renderer.drawn_light();
    reference::TraceOptions options;
    options.samples_per_pixel = samples;
    options.drawn_light = &light;
    const reference::RayScene rays(scene_);
    return shading::tone_mapped_picture(
        reference::trace_picture(rays, scene_, renderer.sky(), camera_, width, height, options).radiance,
        1.0f);
  }
  PlantSelection selection() const {
    const render::View view = render::camera_view(camera_, 0, width, height);
    std::vector<PlacedPlant> plants;
    for (const ScenePlant& plant : scene_plants(scene_))
      plants.push_back(placed(plant, int(scene_.objects.size() + plants.size())));
    PlantSelection chosen;
    chosen.choose(plants, view, render::Culling(view, nullptr), scene_.data<PlantDetail>());
    return chosen;
  }
  static double flip(const Image8& a, const Image8& b) {
    const Result<reference::Difference> difference = reference::compare(a, b);
    EXPECT_TRUE(difference) << to_string(difference.errors());
    return difference->flip;
  }

  scene::Scene scene_;
  Camera camera_;
  render::Drawables drawables_;
};

TEST_F(PlantDisplay, ThePictureIsWhatRaysSee) {
  plant("orange", {-1.2f, 0, 0}), plant("hedge", {1.6f, 1, 0}), plant("grass", {0.3f, -2, 0});
  const auto with = renderer();
  const Image8 picture = drawn(*with);
  const double difference = flip(picture, traced(*with, 32));
  EXPECT_LT(difference, 0.06);
  scene_.data<ScenePlants>() = {};
  EXPECT_GT(flip(drawn(*renderer()), picture), 2.5 * difference) << "control: without the plants";
}

TEST_F(PlantDisplay, PointsAndLinesLookAsTheGeometryDoes) {
  plant("oak", {-3, 0, 0}), plant("plane", {5, 6, 0}), plant("orange", {0, -8, 0});
  look_from(60.0f);
  const auto kept = renderer();
  const Image8 full = drawn_in_full(*kept);
  EXPECT_GT(selection().statistics().points, 1000u);
  EXPECT_EQ(selection().statistics().lines > 0, true);
  const double difference = flip(drawn(*kept), full);
  EXPECT_LT(difference, 0.05);
  scene_.data<PlantDetail>().keeps_area = false;
  EXPECT_GT(flip(drawn(*kept), full), 1.5 * difference) << "control: points of the leaves' own size";
}

TEST_F(PlantDisplay, NothingPopsFromNearToFar) {
  plant("orange", {0, 0, 0}), plant("oak", {-4, 9, 0}, 2);
  const auto kept = renderer();
  double maximum = 0.0, max_full = 0.0;
  for (float distance_m = 4.0f; distance_m < 140.0f; distance_m *= 1.5f) {
    look_from(distance_m);
    const Image8 picture = drawn(*kept), full = drawn_in_full(*kept);
    look_from(1.01f * distance_m);
    const double step = flip(drawn(*kept), picture), step_full = flip(drawn_in_full(*kept), full);
    maximum = std::max(maximum, step - step_full), max_full = std::max(max_full, step_full);
  }
  EXPECT_LT(maximum, 0.02) << "beyond what the real geometry changes when the viewer steps back";
  // Control: a level that changes at once, from the real geometry to a quarter of it.
  look_from(12.0f);
  const Image8 full = drawn_in_full(*kept);
  scene_.data<PlantDetail>().max_primitives = 2000;
  EXPECT_GT(flip(drawn(*kept), full), 0.03);
}

TEST_F(PlantDisplay, TheBudgetHolds) {
  for (int i = 0; i < 40; ++i)
    plant(i % 2 ? "oak" : "plane", {5.0f * float(i % 8 - 4), 5.0f * float(i / 8), 0});
  look_from(30.0f);
  std::size_t last = 0;
  for (const int budget : {2000, 30'000, 300'000}) {
    scene_.data<PlantDetail>().max_primitives = budget;
    const PlantSelection chosen = selection();
    EXPECT_LE(chosen.statistics().all(), std::size_t(budget));
    EXPECT_GT(chosen.statistics().all(), std::max(last, std::min<std::size_t>(budget, 30'000) / 3))
        << "and is used";
    last = chosen.statistics().all();
  }
  scene_.data<PlantDetail>().is_full = true;
  EXPECT_GT(selection().statistics().all(), 5'000'000u) << "control: the real geometry";
}

TEST_F(PlantDisplay, AsManyPrimitivesAreDrawnAsAreChosen) {
  for (int i = 0; i < 12; ++i) plant("oak", {5.0f * float(i % 4 - 2), 5.0f * float(i / 4), 0});
  look_from(20.0f);
  const auto shown = renderer();
  const gl::Query query = gl::Query::create(GLenum(GL_PRIMITIVES_GENERATED));
  const auto drawn_primitives = [&] {
    shown->begin_frame(scene_, camera_);
    shown->prepare_main_view(camera_, width, height);
    glBeginQuery(GL_PRIMITIVES_GENERATED, query.name());
    shown->draw_main_view();
    glEndQuery(GL_PRIMITIVES_GENERATED);
    GLuint64 count = 0;
    glGetQueryObjectui64v(query.name(), GL_QUERY_RESULT, &count);
    return std::size_t(count);
  };
  std::vector<std::size_t> with_plants, chosen;
  for (const int budget : {20'000, 100'000}) {
    scene_.data<PlantDetail>().max_primitives = budget;
    with_plants.push_back(drawn_primitives());
    chosen.push_back(selection().statistics().all());
  }
  for (ScenePlant& hidden : scene_.data<ScenePlants>().items) hidden.is_visible = false;
  const std::size_t others = drawn_primitives();
  for (std::size_t i = 0; i < chosen.size(); ++i) EXPECT_EQ(with_plants[i] - others, chosen[i]);
  EXPECT_GT(chosen[1], chosen[0]);
}

TEST_F(PlantDisplay, TheBudgetHoldsAmongCrowns) {
  for (int i = 0; i < 12; ++i) plant("oak", {1.5f * float(i % 4 - 2), 1.5f * float(i / 4 - 1), -4.0f});
  camera_.world_from_camera = look_at({0, 0, 0}, {1, 0, 0});
  scene_.data<PlantDetail>().max_primitives = 40'000;
  const PlantSelection chosen = selection();
  EXPECT_LE(chosen.statistics().all(), 40'000u);
  EXPECT_GT(chosen.statistics().all(), 10'000u) << "and is used";
}

TEST_F(PlantDisplay, ItCastsItsShadowFromFarAsFromNear) {
  plant("oak", {-9, 12, 0});  // beside the picture; its shadow falls into it
  const auto kept = renderer();
  camera_.world_from_camera = look_at({-16, 17.5f, 30}, {-16, 17.51f, 0});
  camera_.vertical_fov = 0.3f;
  const auto mean = [&](const Image8& picture) {
    double sum = 0.0;
    for (std::size_t i = 0; i < picture.pixels.size(); i += 4) sum += picture.pixels[i];
    return sum / double(picture.pixels.size() / 4);
  };
  const double lit = [&] {
    scene_.data<ScenePlants>().items[0].is_visible = false;
    const double without = mean(drawn(*kept));
    scene_.data<ScenePlants>().items[0].is_visible = true;
    return without;
  }();
  const double shaded = mean(drawn(*kept)), by_rays = mean(traced(*kept, 8));
  EXPECT_LT(shaded, lit - 3.0) << "it casts a shadow";
  EXPECT_NEAR(shaded, by_rays, 2.0);
}

TEST_F(PlantDisplay, CastsNoShadowWhereOthersAloneDo) {
  plant("oak", {-9, 12, 0});
  camera_.world_from_camera = look_at({-16, 17.5f, 30}, {-16, 17.51f, 0});
  camera_.vertical_fov = 0.3f;
  scene_.data<scene::SunShadows>().caster_nodes = {{0, 0}};
  const Image8 with = drawn(*renderer());
  scene_.data<scene::SunShadows>().caster_nodes = {{1, 4}};  // it is of node 0
  const auto kept = renderer();
  const Image8 without = drawn(*kept);
  EXPECT_GT(flip(with, without), 0.02);
  EXPECT_LT(flip(without, traced(*kept, 8)), 0.5 * flip(with, without)) << "as the ray tracer sees it";
}

TEST_F(PlantDisplay, IsPickedAndHiddenAsAThing) {
  plant("orange", {0, 0, 0}), plant("hedge", {0, 4, 0});
  const auto kept = renderer();
  const Image8 before = drawn(*kept);
  const render::ObjectPicture picked = kept->pick(camera_, width, height, false);
  const auto first = std::uint32_t(scene_.objects.size()) + 1;
  EXPECT_GT(std::ranges::count(picked.pixels, first), 500);
  EXPECT_GT(std::ranges::count(picked.pixels, first + 1), 500);
  EXPECT_EQ(*picked.at(2, 2), 0u) << "the sky";
  scene_.data<ScenePlants>().items[0].is_visible = false;
  const Image8 hidden = drawn(*kept);
  EXPECT_EQ(hidden.pixels, drawn(*renderer()).pixels);
  EXPECT_NE(hidden.pixels, before.pixels);
  scene_.data<ScenePlants>().items[0].is_visible = true;
  EXPECT_EQ(drawn(*kept).pixels, before.pixels);
}

}  // namespace
}  // namespace parvis::vegetation

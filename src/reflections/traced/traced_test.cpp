#include <gtest/gtest.h>

#include "graphics/gl/test_context.h"
#include "graphics/light/sun_and_sky.h"
#include "graphics/reference/metrics.h"
#include "graphics/render/test_room.h"
#include "graphics/shading/tone_curve.h"
#include "reflections/methods/registry.h"
#include "reflections/methods/settings.h"
#include "reflections/traced/traced_reflections.h"

namespace parvis::traced {
namespace {

constexpr int width = 200, height = 150;

class TracedReflectionsTest : public gl::ContextTest {};

/// A scene that is drawn with the method, or without any, and traced as a whole.
class Show {
 public:
  explicit Show(const scene::Scene& scene, glm::vec3 eye = {4.0f, -5.5f, 1.5f}, bool has_method = true)
      : scene_(scene) {
    camera_.world_from_camera = look_at(eye, {0, 0, 0});
    camera_.vertical_fov = 0.7f;
    Result<std::unique_ptr<render::Renderer>> renderer =
        render::Renderer::create(scene_, {}, light::sun_and_sky);
    EXPECT_TRUE(renderer) << to_string(renderer.errors());
    renderer_ = *std::move(renderer);
    if (!has_method) return;
    Result<std::unique_ptr<TracedReflections>> made = TracedReflections::create(scene_, *renderer_);
    EXPECT_TRUE(made) << to_string(made.errors());
    reflections_ = *std::move(made);
    const Status set = renderer_->set_reflection(reflections_.get());
    EXPECT_TRUE(set) << to_string(set.errors());
  }

  const ImageF& draw() {
    renderer_->begin_frame(scene_, camera_);
    renderer_->prepare_main_view(camera_, width, height);
    if (reflections_) reflections_->update(*renderer_, scene_, camera_);
    renderer_->draw_main_view();
    return drawn_ = renderer_->read_radiance();
  }

  /// FLIP of what `draw` has drawn against the ray tracer with exact shadows, inside mirrors.
  double flip() {
    reference::TraceOptions options;
    options.samples_per_pixel = 64;
    options.mirror_bounces = methods::settings(scene_).bounces;
    shading::DrawnLight light = renderer_->drawn_light();
    light.has_exact_shadows = true;
    options.drawn_light = &light;
    const reference::RayScene rays(scene_);
    const reference::TracedPicture truth =
        reference::trace_picture(rays, scene_, renderer_->sky(), camera_, width, height, options);
    const Result<reference::Difference> difference =
        reference::compare(shading::tone_mapped_picture(drawn_, scene_.exposure),
                           shading::tone_mapped_picture(truth.radiance, scene_.exposure), truth.mirror_mask);
    EXPECT_TRUE(difference) << to_string(difference.errors());
    return difference->flip;
  }
  scene::Scene& scene() { return scene_; }

 private:
  scene::Scene scene_;
  Camera camera_;
  std::unique_ptr<render::Renderer> renderer_;
  std::unique_ptr<TracedReflections> reflections_;
  ImageF drawn_;
};

scene::Scene room_with_mirror(float roughness = 0.0f) {
  scene::Scene scene = render::room_scene(8.0f);
  auto mirror = std::make_shared<scene::Model>(*render::mirror_box(1.5f));
  mirror->parts[0].mesh = scene::sphere(glm::vec3(0.0f), 1.8f, 48);
  mirror->materials[0].roughness = roughness;
  const int object = scene::add(scene, std::move(mirror), true);
  scene.objects[std::size_t(object)].takes_reflection = true;
  const auto lamp = render::room_model(0.4f);  // something near the mirror
  scene::add(scene, lamp, true, glm::translate(glm::mat4(1.0f), {2.4f, -1.2f, 0.6f}));
  return scene;
}

TEST_F(TracedReflectionsTest, AgreesWithTheReference) {
  for (const float roughness : {0.0f, 0.3f}) {
    Show traced(room_with_mirror(roughness)), none(room_with_mirror(roughness), {4.0f, -5.5f, 1.5f}, false);
    traced.draw(), none.draw();
    // Without more samples at edges the sharp one has 0.032.
    EXPECT_LT(traced.flip(), roughness > 0.1f ? 0.075 : 0.025) << roughness;
    EXPECT_GT(none.flip(), 0.3) << "the control: without the method";
  }
}

TEST_F(TracedReflectionsTest, ADynamicThingIsFollowed) {
  Show show(room_with_mirror());
  const ImageF before = show.draw();
  show.scene().objects.back().world_from_model = glm::translate(glm::mat4(1.0f), {-1.0f, -2.6f, 0.9f});
  const ImageF moved = show.draw();
  EXPECT_NE(moved.pixels, before.pixels);
  EXPECT_EQ(moved.pixels, Show(show.scene()).draw().pixels) << "as a method that is made now";
}

TEST_F(TracedReflectionsTest, TheSameFrameGivesTheSamePicture) {
  Show show(room_with_mirror(0.4f));
  const ImageF first = show.draw();
  EXPECT_EQ(show.draw().pixels, first.pixels);
}

/// Two mirrors: with one bounce each shows the other with the sky in it.
TEST_F(TracedReflectionsTest, BouncesAreTraced) {
  scene::Scene scene = room_with_mirror();
  render::add_mirror(scene, {2.6f, 0.8f, -0.6f}, 0.7f);
  methods::settings(scene).bounces = 2;
  Show two(scene);
  two.draw();
  const double flip_of_two = two.flip();
  EXPECT_LT(flip_of_two, 0.08);
  methods::settings(two.scene()).bounces = 1;
  two.draw();
  methods::settings(two.scene()).bounces = 2;
  EXPECT_GT(two.flip(), 1.2 * flip_of_two) << "the control: one bounce";
}

TEST_F(TracedReflectionsTest, ASceneWithoutMirrorsIsDrawn) {
  Show show(render::room_scene(8.0f));
  const ImageF drawn = show.draw();
  EXPECT_EQ(drawn.pixels, Show(render::room_scene(8.0f), {4.0f, -5.5f, 1.5f}, false).draw().pixels);
}

}  // namespace
}  // namespace parvis::traced

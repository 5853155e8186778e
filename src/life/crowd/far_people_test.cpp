// People who are far, in pictures: against rays that see their meshes, in sun and in shadow.
#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "graphics/gl/test_context.h"
#include "graphics/light/sun_and_sky.h"
#include "graphics/reference/metrics.h"
#include "graphics/reference/tracer.h"
#include "graphics/render/frame_views.h"
#include "graphics/render/renderer.h"
#include "graphics/shading/tone_curve.h"
#include "life/crowd/shown_people.h"
#include "scene/data/test_scene.h"

namespace parvis::crowd {
namespace {

/// A few people in a row on a plain, in the sun from the south-east, all of them pictures.
class FarPeopleDisplay : public gl::ContextTest {
 protected:
  static constexpr int width = 240, height = 120, people_count = 5;

  FarPeopleDisplay() : people_(people_count, 3) {
    scene_.sun.direction_to_sun = glm::normalize(glm::vec3(0.6f, -0.5f, 0.7f));
    scene::add(scene_, scene::model_of(scene::ground(60), scene::matt(glm::vec3(0.5f))));
    std::vector<std::string> names(people_count, "somebody");
    people_.add_to(scene_, names, true);
    drawables_.add(far_people_kind());
    drawables_.attach(scene_);
    for (int p = 0; p < people_count; ++p) stand(p, 0.4f * float(p));
    look_from(32.0f);
  }
  void stand(int person, float heading) {
    people_.place(std::size_t(person), {{1.3f * float(person - people_count / 2), 0, 0}, heading},
                  person % 3);
    people_.set_away(scene_, std::size_t(person), false);
    people_.show(scene_, [](std::size_t) { return people::Posture(); });
  }
  void look_from(float distance_m, float eye_m = 1.7f) {
    camera_.world_from_camera = look_at({0, -distance_m, eye_m}, {0, 0, 0.9f});
    camera_.vertical_fov = 4.0f / distance_m;
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
  Image8 traced(render::Renderer& renderer) const {
    renderer.begin_frame(scene_, camera_);
    const shading::DrawnLight light = renderer.drawn_light();
    reference::TraceOptions options;
    options.samples_per_pixel = 16;
    options.drawn_light = &light;
    const reference::RayScene rays(scene_);
    return shading::tone_mapped_picture(
        reference::trace_picture(rays, scene_, renderer.sky(), camera_, width, height, options).radiance,
        1.0f);
  }
  static double flip(const Image8& a, const Image8& b) {
    const Result<reference::Difference> difference = reference::compare(a, b);
    EXPECT_TRUE(difference) << to_string(difference.errors());
    return difference->flip;
  }

  scene::Scene scene_;
  Camera camera_;
  render::Drawables drawables_;
  ShownPeople people_;
};

TEST_F(FarPeopleDisplay, ThePictureIsWhatRaysSee) {
  const auto kept = renderer();
  const Image8 picture = drawn(*kept), truth = traced(*kept);
  const double difference = flip(picture, truth);
  EXPECT_LT(difference, 0.06);
  for (int p = 0; p < people_count; ++p) stand(p, 0.4f * float(p) + 3.14159f);
  EXPECT_GT(flip(drawn(*kept), truth), difference) << "control: everybody turned round";
  people_.set_visible(scene_, false);
  const Image8 empty = drawn(*kept);
  EXPECT_GT(flip(empty, truth), 2.0 * difference) << "control: nobody";
}

TEST_F(FarPeopleDisplay, TheyAreSeenFromABalcony) {
  look_from(30.0f, 18.0f);
  const auto kept = renderer();
  const Image8 picture = drawn(*kept), truth = traced(*kept);
  const double difference = flip(picture, truth);
  EXPECT_LT(difference, 0.07);
  people_.set_visible(scene_, false);
  EXPECT_GT(flip(drawn(*kept), truth), 1.8 * difference) << "control: nobody";
}

TEST_F(FarPeopleDisplay, TheyCastShadowsAndArePickedByTheirNumber) {
  const auto kept = renderer();
  const Image8 with = drawn(*kept);
  people_.set_away(scene_, 2, true);
  const Image8 without = drawn(*kept);
  int darker = 0;
  for (int y = height / 2; y < height; ++y)
    for (int x = 0; x < width; ++x) darker += with.at(x, y)[0] + 25 < without.at(x, y)[0] ? 1 : 0;
  EXPECT_GT(darker, 40);
  people_.set_away(scene_, 2, false);
  kept->begin_frame(scene_, camera_);
  const render::ObjectPicture objects = kept->pick(camera_, width, height, false);
  int of_person = 0;
  const auto first_thing = std::uint32_t(scene_.objects.size());
  for (const std::uint32_t object : objects.pixels) of_person += object == first_thing + 2 + 1 ? 1 : 0;
  EXPECT_GT(of_person, 60);
}

}  // namespace
}  // namespace parvis::crowd

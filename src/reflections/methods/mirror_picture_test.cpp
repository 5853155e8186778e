#include "reflections/methods/mirror_picture.h"

#include <gtest/gtest.h>

#include "graphics/gl/test_context.h"
#include "graphics/light/sun_and_sky.h"
#include "graphics/render/test_room.h"
#include "reflections/methods/bindings.h"
#include "reflections/methods/frame.h"

namespace parvis::methods {
namespace {

/// Northward from the origin, 90 degrees wide and high.
render::View view_of_200_pixels() {
  Camera camera;
  camera.world_from_camera = look_at({0, 0, 0}, {0, 10, 0});
  camera.vertical_fov = 1.5707963f;
  return render::camera_view(camera, 0, 200, 200);
}

TEST(PixelsOf, ABoxAreItsProjectionAndAMargin) {
  // Its front stands 10 m away, where a metre has ten pixels.
  EXPECT_EQ(pixels_of(view_of_200_pixels(), {{-2.05f, 10, -1.05f}, {3.05f, 12, 4.05f}}),
            glm::ivec4(78, 88, 54, 54));
}

TEST(PixelsOf, ABoxThatLeavesTheViewEndAtItsBorder) {
  const glm::ivec4 pixels = pixels_of(view_of_200_pixels(), {{5, 10, -1}, {30, 12, 1}});
  EXPECT_EQ(pixels.x + pixels.z, 200);
  EXPECT_EQ(pixels.x, 140);  // 141.6 at its far end
  EXPECT_LE(pixels_of(view_of_200_pixels(), {{30, 10, -1}, {40, 12, 1}}).z, 1);
}

TEST(PixelsOf, ABoxBesideTheEyeMayBeAll) {
  EXPECT_EQ(pixels_of(view_of_200_pixels(), {{-1, -1, -1}, {1, 1, 1}}), glm::ivec4(0, 0, 200, 200));
}

/// Light of one colour along all mirror rays of an object.
class ColourOfObject final : public Reflections {
 public:
  ColourOfObject(MirrorPicture picture, int red_object)
      : picture_(std::move(picture)), red_object_(red_object) {}
  render::SurfaceSource source() const override {
    return {.fragment = "reflections/methods/mirror_picture.frag"};
  }
  void bind(const gl::Program& program, int) override { picture_.bind(program, first_method_unit); }

 private:
  void update_maps(render::Renderer& renderer, const scene::Scene&,
                   const std::vector<VisibleReflector>& reflectors) override {
    picture_.draw_rays(renderer);
    MirrorRays rays;
    picture_.read_rays(renderer, reflectors, rays);
    std::vector<glm::vec4> base;
    base.reserve(rays.directions.size());
    for (const glm::vec4& ray : rays.directions)
      base.push_back(ray.w == 0.0f                   ? glm::vec4(0.0f)
                     : int(ray.w) == red_object_ + 1 ? glm::vec4(1, 0, 0, 1)
                                                     : glm::vec4(0, 1, 0, 1));
    picture_.put_light(renderer, reflectors, rays, base, std::vector<glm::vec3>(base.size()));
  }

  MirrorPicture picture_;
  int red_object_;
};

/// Two mirrors, one before the other, both tilted against the pixels and before a black wall; the sky, which
/// shines in blue, too, is what a mirror shows where no light is found for it.
class OutlinesOfMirrors : public gl::ContextTest {
 protected:
  static ImageF picture() {
    scene::Scene scene;
    scene.sun.irradiance = glm::vec3(0.0f);
    scene::Material black = scene::matt(glm::vec3(0.0f));
    black.metallic = 1.0f;
    scene::add(scene,
               scene::model_of(scene::quad({-90, 9, -90}, {90, 9, -90}, {90, 9, 90}, {-90, 9, 90}), black));
    const int near = add_tilted_mirror(scene, {0, 0, 0}, 0.8f);
    add_tilted_mirror(scene, {0, 4, 0}, 2.0f);
    Result<std::unique_ptr<render::Renderer>> renderer =
        render::Renderer::create(scene, {}, light::sun_and_sky);
    EXPECT_TRUE(renderer) << to_string(renderer.errors());
    Result<MirrorPicture> mirrors = MirrorPicture::create(**renderer);
    EXPECT_TRUE(mirrors) << to_string(mirrors.errors());
    ColourOfObject reflections(*std::move(mirrors), near);
    EXPECT_TRUE((*renderer)->set_reflection(&reflections));
    Camera camera;
    camera.world_from_camera = look_at({0, -5, 0}, {0, 0, 0});
    EXPECT_TRUE(draw_frame(**renderer, scene, &reflections, {camera, 120, 90}));
    return (*renderer)->read_radiance();
  }

 private:
  static int add_tilted_mirror(scene::Scene& scene, glm::vec3 place, float half_m) {
    const int mirror = render::add_mirror(scene, place, half_m);
    scene::Object& object = scene.objects[std::size_t(mirror)];
    object.world_from_model = glm::rotate(object.world_from_model, 0.3f, {0, 1, 0});
    return mirror;
  }
};

/// A pixel that two mirrors share, of which one has a ray there, shows the light of both by their shares.
TEST_F(OutlinesOfMirrors, AreAsSmoothAsTheSamplesOfThePicture) {
  const ImageF drawn = picture();
  // Of the four samples of a pixel one or more are the other mirror's.
  constexpr float some = 0.2f;
  int whole = 0, shared = 0, partly_covered = 0;
  for (int y = 0; y < drawn.height; ++y)
    for (int x = 0; x < drawn.width; ++x) {
      const float* pixel = drawn.at(x, y);
      const float near = pixel[0], far = pixel[1], sum = near + far;
      whole += near > 1.0f - some;
      shared += near > some && far > some;
      partly_covered += near < 0.01f && far > some && far < 1.0f - some;
      EXPECT_LT(sum, 1.02f) << x << " " << y;
    }
  EXPECT_GT(whole, 100);
  EXPECT_GT(shared, 30) << "outline of the mirror in front";
  EXPECT_GT(partly_covered, 30) << "outline of the mirror behind";
}

/// Where a mirror covers a pixel but not its middle, no ray leaves there: the light of neighbours stands in.
TEST_F(OutlinesOfMirrors, ShowNoSkyThatTheMirrorDoesNotShow) {
  const ImageF drawn = picture();
  for (int y = 0; y < drawn.height; ++y)
    for (int x = 0; x < drawn.width; ++x) EXPECT_LT(drawn.at(x, y)[2], 0.02f) << x << " " << y;
}

}  // namespace
}  // namespace parvis::methods

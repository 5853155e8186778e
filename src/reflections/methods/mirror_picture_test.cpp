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

constexpr glm::vec3 red(1, 0, 0), green(0, 1, 0);

/// Light of one colour along all mirror rays of an object, and another along those of all others.
class ColourOfObject : public Reflections {
 public:
  ColourOfObject(MirrorPicture picture, int red_object)
      : picture_(std::move(picture)), red_object_(red_object) {}
  render::SurfaceSource source() const override {
    return {.fragment = "reflections/methods/mirror_picture.frag"};
  }
  void bind(const gl::Program& program, int) override { picture_.bind(program, first_method_unit); }

 protected:
  MirrorPicture& mirrors() { return picture_; }
  glm::vec3 colour_of(int object) const { return object == red_object_ ? red : green; }

 private:
  void update_maps(render::Renderer& renderer, const scene::Scene&,
                   const std::vector<VisibleReflector>& reflectors) override {
    picture_.draw_rays(renderer);
    MirrorRays rays;
    picture_.read_rays(renderer, reflectors, rays);
    std::vector<glm::vec4> base;
    base.reserve(rays.directions.size());
    for (const glm::vec4& ray : rays.directions)
      base.push_back(ray.w == 0.0f ? glm::vec4(0.0f) : glm::vec4(colour_of(int(ray.w) - 1), 1.0f));
    picture_.put_light(renderer, reflectors, rays, base, std::vector<glm::vec3>(base.size()));
  }

  MirrorPicture picture_;
  int red_object_;
};

/// The same by a shader, along all rays of each pixel.
class DrawnColourOfObject : public ColourOfObject {
 public:
  DrawnColourOfObject(MirrorPicture picture, int red_object, RayCount count = RayCount::and_edges)
      : ColourOfObject(std::move(picture), red_object), count_(count) {
    Result<gl::Program> program = gl::Program::create("graphics/render/whole_screen.vert",
                                                      "reflections/methods/test_object_light.frag");
    EXPECT_TRUE(program) << to_string(program.errors());
    if (program) program_ = *std::move(program);
  }

 private:
  void update_maps(render::Renderer& renderer, const scene::Scene&,
                   const std::vector<VisibleReflector>& reflectors) override {
    mirrors().draw_rays(renderer, count_ == RayCount::one ? std::span<const VisibleReflector>() : reflectors);
    mirrors().draw_light(renderer, reflectors, [&](const VisibleReflector& reflector) -> const gl::Program& {
      program_.use();
      program_.set("reflecting_object", reflector.object);
      program_.set("object_light", colour_of(reflector.object));
      return program_;
    });
  }

  RayCount count_;
  gl::Program program_;
};

/// The same in a frame that goes without second rays.
class DrawnWithFirstRays final : public DrawnColourOfObject {
 public:
  DrawnWithFirstRays(MirrorPicture picture, int red_object)
      : DrawnColourOfObject(std::move(picture), red_object, RayCount::one) {}
};

/// Two mirrors, one before the other, both tilted against the pixels and before a black wall; the sky, which
/// shines in blue, too, is what a mirror shows where no light is found for it.
class OutlinesOfMirrors : public gl::ContextTest {
 protected:
  /// The objects that mirror, and the one of them whose light is red.
  struct MirrorScene {
    scene::Scene scene;
    int red_object = 0;
    std::vector<int> mirrors;
  };
  static constexpr int width_px = 120, height_px = 90;

  static Camera camera() {
    Camera camera;
    camera.world_from_camera = look_at({0, -5, 0}, {0, 0, 0});
    return camera;
  }

  static MirrorScene mirror_scene() {
    MirrorScene made;
    scene::Scene& scene = made.scene;
    scene.sun.irradiance = glm::vec3(0.0f);
    scene::Material black = scene::matt(glm::vec3(0.0f));
    black.metallic = 1.0f;
    scene::add(scene,
               scene::model_of(scene::quad({-90, 9, -90}, {90, 9, -90}, {90, 9, 90}, {-90, 9, 90}), black));
    made.red_object = add_tilted_mirror(scene, {0, 0, 0}, glm::vec3(0.8f));
    made.mirrors = {made.red_object, add_tilted_mirror(scene, {0, 4, 0}, glm::vec3(2.0f))};
    return made;
  }

  /// The same two in green, and before them a wiper in red: a tilted bar of so many pixels across.
  static MirrorScene wiper_scene(float across_px) {
    MirrorScene made = mirror_scene();
    const float pixel_m = 2.0f * 4.0f * std::tan(0.5f * camera().vertical_fov) / float(height_px);
    made.red_object =
        add_tilted_mirror(made.scene, {0, -1, 0}, {0.5f * across_px * pixel_m, 0.01f, 1.5f}, 0.15f);
    made.mirrors.push_back(made.red_object);
    return made;
  }

  /// The picture of a scene, with the reflections that `method` makes of its mirrors' rays.
  template <class Method>
  static ImageF picture(const MirrorScene& made, RayCount rays = RayCount::one) {
    Result<std::unique_ptr<render::Renderer>> renderer =
        render::Renderer::create(made.scene, {}, light::sun_and_sky);
    EXPECT_TRUE(renderer) << to_string(renderer.errors());
    Result<MirrorPicture> mirrors = MirrorPicture::create(**renderer, rays);
    EXPECT_TRUE(mirrors) << to_string(mirrors.errors());
    Method reflections(*std::move(mirrors), made.red_object);
    EXPECT_TRUE((*renderer)->set_reflection(&reflections));
    EXPECT_TRUE(draw_frame(**renderer, made.scene, &reflections, {camera(), width_px, height_px}));
    return (*renderer)->read_radiance();
  }

  static ImageF picture() { return picture<ColourOfObject>(mirror_scene()); }

  /// The same objects, which shine in the colours that they mirrored, drawn with so many pixels for each.
  static ImageF shining(MirrorScene made, int finer = 1) {
    for (const int mirror : made.mirrors) {
      scene::Object& object = made.scene.objects[std::size_t(mirror)];
      auto model = std::make_shared<scene::Model>(*object.model);
      scene::Material& material = model->materials.front();
      material.is_mirror_like = false;
      material.base_colour = glm::vec3(0.0f);
      material.emission = mirror == made.red_object ? red : green;
      object.model = model;
      object.takes_reflection = false;
    }
    Result<std::unique_ptr<render::Renderer>> renderer =
        render::Renderer::create(made.scene, {}, light::sun_and_sky);
    EXPECT_TRUE(renderer) << to_string(renderer.errors());
    EXPECT_TRUE(draw_frame(**renderer, made.scene, nullptr, {camera(), finer * width_px, finer * height_px}));
    return (*renderer)->read_radiance();
  }

 private:
  static int add_tilted_mirror(scene::Scene& scene, glm::vec3 place, glm::vec3 half_m, float tilt = 0.3f) {
    const int mirror = render::add_mirror(scene, place, 1.0f);
    scene::Object& object = scene.objects[std::size_t(mirror)];
    object.world_from_model = glm::scale(glm::rotate(object.world_from_model, tilt, {0, 1, 0}), half_m);
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

/// Mirrors whose mirrored light is of one colour look as if they shone in it, sample by sample.
TEST_F(OutlinesOfMirrors, OfWipersAreThoseOfTheSameObjectWithoutReflections) {
  for (const float across_px : {0.4f, 0.7f, 1.5f}) {
    const MirrorScene scene = wiper_scene(across_px);
    const ImageF drawn = picture<DrawnColourOfObject>(scene, RayCount::and_edges), expected = shining(scene);
    int off = 0, partly = 0;
    for (int y = 0; y < height_px; ++y)
      for (int x = 0; x < width_px; ++x) {
        float error = 0.0f;
        for (int c = 0; c < 3; ++c)
          error = std::max(error, std::abs(drawn.at(x, y)[c] - expected.at(x, y)[c]));
        off += error > 0.1f;
        partly += expected.at(x, y)[0] > 0.1f && expected.at(x, y)[0] < 0.9f;
      }
    EXPECT_GT(partly, 60) << across_px;
    EXPECT_EQ(off, 0) << across_px << " pixels across";
  }
}

/// A picture that may have second rays draws one without them, too.
TEST_F(OutlinesOfMirrors, AreThoseOfFirstRaysInAFrameWithoutSecondOnes) {
  const MirrorScene scene = wiper_scene(0.7f);
  const ImageF drawn = picture<DrawnWithFirstRays>(scene, RayCount::and_edges),
               expected = picture<DrawnColourOfObject>(scene, RayCount::one),
               with_second = picture<DrawnColourOfObject>(scene, RayCount::and_edges);
  EXPECT_EQ(drawn.pixels, expected.pixels);
  EXPECT_NE(drawn.pixels, with_second.pixels);
}

/// Mean difference in red from the mean of 64 pixels of a finer picture.
TEST_F(OutlinesOfMirrors, OfWipersAreNearToThoseOfSixtyFourSamples) {
  constexpr int finer = 8;
  const MirrorScene scene = wiper_scene(0.7f);
  const ImageF drawn = picture<DrawnColourOfObject>(scene, RayCount::and_edges), once = shining(scene),
               fine = shining(scene, finer);
  double error = 0.0, error_without_reflections = 0.0;
  for (int y = 0; y < height_px; ++y)
    for (int x = 0; x < width_px; ++x) {
      float mean = 0.0f;
      for (int k = 0; k < finer * finer; ++k)
        mean += fine.at(finer * x + k % finer, finer * y + k / finer)[0] / float(finer * finer);
      error += double(std::abs(drawn.at(x, y)[0] - mean));
      error_without_reflections += double(std::abs(once.at(x, y)[0] - mean));
    }
  EXPECT_GT(error_without_reflections, 0.0);
  EXPECT_LT(error, 1.05 * error_without_reflections);
}

}  // namespace
}  // namespace parvis::methods

// What belongs to one texture, axis, material or vertex, in the renderer as in the ray tracer.
#include <gtest/gtest.h>

#include "graphics/gl/test_context.h"
#include "graphics/light/sun_and_sky.h"
#include "graphics/reference/metrics.h"
#include "graphics/render/test_renderer.h"
#include "graphics/shading/tone_curve.h"
#include "reflections/methods/frame.h"
#include "scene/data/test_scene.h"

namespace parvis::render {
namespace {

using scene::add, scene::matt, scene::model_of, scene::quad;

constexpr int panels_width = 320, panels_height = 180;

class TexturedPanels : public gl::ContextTest {
 protected:
  /// A panel 4 m wide that fills the picture, drawn and traced.
  void show(const scene::Model& model) {
    scene::Scene scene;
    add(scene, std::make_shared<scene::Model>(model));
    scene.sun.direction_to_sun = glm::normalize(glm::vec3(0, -1, 0.2f));
    scene.sun.irradiance = glm::vec3(3.0f);
    const std::unique_ptr<Renderer> renderer = renderer_of(scene, light::sun_and_sky);
    Camera camera;
    camera.world_from_camera = look_at({0, -3.139f, 1.125f}, {0, 0, 1.125f});
    camera.vertical_fov = 2.0f * std::atan(1.125f / 3.139f);
    const EyeView eye{camera, panels_width, panels_height};
    ASSERT_TRUE(methods::draw_frame(*renderer, scene, nullptr, eye, {}));
    drawn_ = renderer->read_picture(scene.exposure);
    reference::TraceOptions options;
    options.samples_per_pixel = 8;
    traced_ = shading::tone_mapped_picture(methods::trace_frame(*renderer, scene, eye, options).radiance,
                                           scene.exposure);
    const Result<reference::Difference> difference = reference::compare(drawn_, traced_);
    ASSERT_TRUE(difference) << to_string(difference.errors());
    // Four samples per pixel against eight, at edges of red and blue: .023 where a panel has most of them.
    EXPECT_LT(difference->flip, 0.03);
  }

  /// 'r' where red is more than three times blue at a place of both pictures (shares of width and height),
  /// 'b' the other way round, 'k' where both are dark, '-' else, '!' where the pictures disagree.
  std::string colours(std::initializer_list<glm::vec2> places) const {
    const auto letter = [](const Image8& picture, glm::vec2 at) {
      const std::uint8_t* p = picture.at(int(at.x * panels_width), int(at.y * panels_height));
      if (p[0] < 30 && p[2] < 30) return 'k';
      return p[0] > 3 * p[2] ? 'r' : p[2] > 3 * p[0] ? 'b' : '-';
    };
    std::string found;
    for (const glm::vec2 place : places) {
      const char of_drawn = letter(drawn_, place);
      found += of_drawn == letter(traced_, place) ? of_drawn : '!';
    }
    return found;
  }

  Image8 drawn_, traced_;
};

scene::Model panel(const scene::Material& material) {
  return *model_of(quad({-2, 0, 0}, {2, 0, 0}, {2, 0, 2.25f}, {-2, 0, 2.25f}), material);
}

/// The left half red, the right half blue.
scene::Texture halves() {
  scene::Texture texture{.name = "halves", .image = Image8(64, 64, 4, 255)};
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      std::uint8_t* p = texture.image.at(x, y);
      p[0] = x < 32 ? 230 : 10, p[1] = 10, p[2] = x < 32 ? 10 : 230;
    }
  return texture;
}

scene::Texture plain(glm::u8vec4 value) {
  scene::Texture texture{.name = "plain", .image = Image8(4, 4, 4), .is_srgb = false};
  for (int i = 0; i < 16; ++i)
    for (int c = 0; c < 4; ++c) texture.image.pixels[std::size_t(4 * i + c)] = value[c];
  return texture;
}

TEST_F(TexturedPanels, ColoursOfVerticesAreInterpolatedAndMultiplyTheMaterial) {
  scene::Model model = panel(matt(glm::vec3(1.0f)));
  for (const glm::vec3& p : model.parts[0].mesh.positions)
    model.parts[0].mesh.colours.push_back(p.x < 0.0f ? glm::vec4(1, 0, 0, 1) : glm::vec4(0, 0, 1, 1));
  show(model);
  EXPECT_EQ(colours({{0.05f, 0.5f}, {0.95f, 0.5f}}), "rb");
  const std::uint8_t* middle = drawn_.at(panels_width / 2, panels_height / 2);
  EXPECT_NEAR(middle[0], middle[2], 12);
}

TEST_F(TexturedPanels, ATransformBelongsToOneTexture) {
  scene::Material material = matt(glm::vec3(1.0f));
  material.base_colour_texture = 0, material.normal_texture = 1;
  scene::OwnMappings own;
  own.normal.texture_from_uv = glm::mat3(8, 0, 0, 0, 8, 0, 0, 0, 1);
  material.own_mappings = own;
  scene::Model model = panel(material);
  model.textures = {halves(), plain({128, 128, 255, 255})};
  show(model);
  EXPECT_EQ(colours({{0.1f, 0.5f}, {0.4f, 0.5f}, {0.6f, 0.5f}, {0.9f, 0.5f}}), "rrbb");
}

TEST_F(TexturedPanels, EachAxisWrapsInItsOwnWay) {
  scene::Material material = matt(glm::vec3(1.0f));
  material.base_colour_texture = 0;
  material.texture_from_mesh_uv = glm::mat3(2, 0, 0, 0, 1, 0, 0, 0, 1);
  scene::Model model = panel(material);
  model.textures = {halves()};
  model.textures[0].wrap_u = scene::Wrap::mirror, model.textures[0].wrap_v = scene::Wrap::clamp;
  show(model);
  EXPECT_EQ(colours({{0.12f, 0.5f}, {0.37f, 0.5f}, {0.62f, 0.5f}, {0.87f, 0.5f}}), "rbbr");
  model.textures[0].wrap_u = scene::Wrap::clamp;
  show(model);
  EXPECT_EQ(colours({{0.12f, 0.5f}, {0.37f, 0.5f}, {0.62f, 0.5f}, {0.87f, 0.5f}}), "rbbb");
}

TEST_F(TexturedPanels, SecondCoordinatesCarryEmissionAndOcclusion) {
  scene::Material material = matt(glm::vec3(0.0f));
  material.emission = glm::vec3(1.0f);
  material.emission_texture = 0, material.occlusion_texture = 1;
  scene::OwnMappings own;
  own.emission.takes_second_uvs = own.occlusion.takes_second_uvs = true;
  material.own_mappings = own;
  scene::Model model = panel(material);
  model.textures = {halves(), plain({0, 0, 0, 255})};
  for (const glm::vec2 uv : model.parts[0].mesh.uvs)  // mirrored from left to right
    model.parts[0].mesh.second_uvs.emplace_back(1.0f - uv.x, uv.y);
  show(model);
  EXPECT_EQ(colours({{0.2f, 0.5f}, {0.8f, 0.5f}}), "br");
}

TEST_F(TexturedPanels, ACutoffBelongsToTheMaterial) {
  scene::Texture thirds{.name = "thirds", .image = Image8(96, 8, 4, 0)};
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 96; ++x) {
      std::uint8_t* p = thirds.image.at(x, y);
      p[0] = 230, p[3] = x < 32 ? 64 : x < 64 ? 128 : 200;
    }
  scene::Material material = matt(glm::vec3(1.0f));
  material.base_colour_texture = 0;
  material.alpha_mode = scene::Alpha::cutout;
  scene::Model model = panel(material);
  model.textures = {thirds};
  const std::initializer_list<glm::vec2> places{{0.16f, 0.5f}, {0.5f, 0.5f}, {0.84f, 0.5f}};
  for (const auto& [cutoff, expected] :
       {std::pair(0.2f, "111"), std::pair(0.4f, "011"), std::pair(0.7f, "001"), std::pair(1.5f, "000")}) {
    model.materials[0].alpha_cutoff = cutoff;
    show(model);
    std::string found;
    for (const char colour : colours(places)) found += colour == 'r' ? '1' : '0';
    EXPECT_EQ(found, expected) << cutoff;
  }
}

}  // namespace
}  // namespace parvis::render

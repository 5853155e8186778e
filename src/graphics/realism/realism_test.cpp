// The scale from a sketch to a photograph: its surfaces are those of the ray tracer, its lines lie on edges.

#include "scene/data/realism.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "graphics/gl/test_context.h"
#include "graphics/light/sun_and_sky.h"
#include "graphics/realism/edge_lines.h"
#include "graphics/reference/metrics.h"
#include "graphics/render/test_renderer.h"
#include "graphics/shading/tone_curve.h"
#include "reflections/methods/frame.h"
#include "scene/data/test_scene.h"

namespace parvis::realism {
namespace {

using scene::add, scene::box, scene::ground, scene::matt, scene::model_of;

constexpr int width = 320, height = 180;

class RealismTest : public gl::ContextTest {
 protected:
  RealismTest() {
    camera_.world_from_camera = look_at({3, -6, 2.5f}, {0, 0, 1});
    camera_.vertical_fov = glm::radians(45.0f);
    scene_.sun.direction_to_sun = glm::normalize(glm::vec3(0.5f, -0.6f, 0.7f));
  }

  /// Draws the scene at a level, with lines once `add_lines` was called.
  Image8 drawn(float level) {
    scene_.data<scene::Realism>().level = level;
    if (!renderer_) renderer_ = render::renderer_of(scene_, light::sun_and_sky);
    EXPECT_TRUE(methods::draw_frame(*renderer_, scene_, nullptr, eye_of(), {}));
    return renderer_->read_picture(scene_.exposure);
  }
  void add_lines() {
    if (!renderer_) renderer_ = render::renderer_of(scene_, light::sun_and_sky);
    lines_ = *EdgeLines::create(renderer_->gpu());
    renderer_->add(lines_.get());
  }
  render::EyeView eye_of() const { return {camera_, width, height}; }

  scene::Scene scene_;
  Camera camera_;
  std::unique_ptr<render::Renderer> renderer_;
  std::unique_ptr<EdgeLines> lines_;
};

scene::Material chequered() {
  scene::Material material = matt(glm::vec3(1.0f));
  material.base_colour_texture = 0;
  material.roughness = 0.3f, material.metallic = 0.6f;
  return material;
}

/// Red and blue in equal parts: their mean is neither.
scene::Texture chequers() {
  scene::Texture texture{.name = "chequers", .image = Image8(64, 64, 4, 255)};
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      const bool is_red = ((x / 16) + (y / 16)) % 2 == 0;
      std::uint8_t* p = texture.image.at(x, y);
      p[0] = is_red ? 220 : 20, p[1] = 20, p[2] = is_red ? 20 : 220;
    }
  return texture;
}

TEST_F(RealismTest, EachLevelIsWhatTheRayTracerSays) {
  add(scene_, model_of(ground(30), matt(glm::vec3(0.3f))));
  auto cube = std::make_shared<scene::Model>(*model_of(box({-1, -1, 0}, {1, 1, 2}), chequered()));
  cube->textures.push_back(chequers());
  add(scene_, cube);
  std::vector<Image8> traced;
  for (const float level : {0.25f, 0.5f, 0.75f, 1.0f}) {
    const Image8 picture = drawn(level);
    reference::TraceOptions options;
    options.samples_per_pixel = 9;
    traced.push_back(shading::tone_mapped_picture(
        methods::trace_frame(*renderer_, scene_, eye_of(), options).radiance, scene_.exposure));
    const Result<reference::Difference> difference = reference::compare(picture, traced.back());
    ASSERT_TRUE(difference) << to_string(difference.errors());
    EXPECT_LT(difference->flip, 0.02) << "level " << level;
  }
  for (const auto& [one, other] : {std::pair(0, 1), std::pair(1, 2), std::pair(2, 3)}) {
    const Result<reference::Difference> step =
        reference::compare(traced[std::size_t(one)], traced[std::size_t(other)]);
    EXPECT_GT(step->flip, 0.02) << "levels differ: the check can fail";
  }
}

TEST_F(RealismTest, PlainColoursAreTheMeanOfTextures) {
  auto cube = std::make_shared<scene::Model>(*model_of(box({-1, -1, 0}, {1, 1, 2}), chequered()));
  cube->textures.push_back(chequers());
  add(scene_, cube);
  const auto redness = [&](float level) {
    const Image8 picture = drawn(level);
    int low = 255, high = -255;
    for (int y = 80; y < 110; ++y)
      for (int x = 140; x < 180; ++x) {
        const int red = picture.at(x, y)[0] - picture.at(x, y)[2];
        low = std::min(low, red), high = std::max(high, red);
      }
    return high - low;
  };
  EXPECT_GT(redness(1.0f), 150);
  EXPECT_LT(redness(0.5f), 40);
  EXPECT_LT(redness(0.25f), 20);
}

/// Pixels with ink, and the edges that the eye sees of a box, in pixels.
TEST_F(RealismTest, LinesLieOnEdges) {
  add(scene_, model_of(box({-1, -1, 0}, {1, 1, 2}), matt(glm::vec3(0.5f))));
  add_lines();
  const Image8 sketch = drawn(0.0f);
  const glm::mat4 clip = camera_.clip_from_camera(float(width) / float(height)) * camera_.camera_from_world();
  const auto pixel_of = [&](glm::vec3 p) {
    const glm::vec4 c = clip * glm::vec4(p, 1.0f);
    return glm::vec2((0.5f + 0.5f * c.x / c.w) * width, (0.5f - 0.5f * c.y / c.w) * height);
  };
  // The eye stands at the front right, above: nine edges, all but the three of the corner at the back left.
  const glm::vec3 hidden(-1, 1, 0);
  std::vector<std::pair<glm::vec2, glm::vec2>> seen;
  for (int axis = 0; axis < 3; ++axis)
    for (int corner = 0; corner < 4; ++corner) {
      glm::vec3 from(0.0f);
      from[(axis + 1) % 3] = (corner & 1) != 0 ? 1.0f : -1.0f;
      from[(axis + 2) % 3] = (corner & 2) != 0 ? 1.0f : -1.0f;
      glm::vec3 to = from;
      from[axis] = -1.0f, to[axis] = 1.0f;
      from.z += 1.0f, to.z += 1.0f;
      if (from != hidden && to != hidden) seen.emplace_back(pixel_of(from), pixel_of(to));
    }
  ASSERT_EQ(seen.size(), 9u);
  const auto distance_to_edges = [&](glm::vec2 at) {
    float least = 1e9f;
    for (const auto& [from, to] : seen) {
      const glm::vec2 along = to - from;
      const float t = std::clamp(glm::dot(at - from, along) / glm::dot(along, along), 0.0f, 1.0f);
      least = std::min(least, glm::distance(at, from + t * along));
    }
    return least;
  };
  const auto is_ink = [&](int x, int y, int max_level = 150) { return sketch.at(x, y)[0] < max_level; };
  int inked = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      if (is_ink(x, y, 110)) {  // most of the pixel
        ++inked;
        EXPECT_LE(distance_to_edges({x + 0.5f, y + 0.5f}), 1.0f) << x << ", " << y;
      }
  EXPECT_GT(inked, 200);
  for (const auto& [from, to] : seen)
    for (int step = 1; step < 20; ++step) {
      const glm::vec2 at = glm::mix(from, to, float(step) / 20.0f);
      bool has_ink = false;
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) has_ink |= is_ink(int(at.x) + dx, int(at.y) + dy);
      EXPECT_TRUE(has_ink) << at.x << ", " << at.y;
    }
}

TEST_F(RealismTest, EverythingIsDrawnAsWithoutTheScale) {
  add(scene_, model_of(box({-1, -1, 0}, {1, 1, 2}), matt(glm::vec3(0.5f))));
  add_lines();
  const Image8 before = drawn(1.0f);
  drawn(0.0f);
  EXPECT_EQ(drawn(1.0f).pixels, before.pixels);
}

}  // namespace
}  // namespace parvis::realism

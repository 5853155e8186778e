#include "reflections/methods/cube_map.h"

#include <gtest/gtest.h>

#include "graphics/gl/test_context.h"
#include "graphics/light/sun_and_sky.h"
#include "graphics/render/test_room.h"

namespace parvis::methods {
namespace {

constexpr float room_half_m = 8.0f;
constexpr int resolution = 32;

/// The direction that a texel of a face stands for: OpenGL 4.5, table 8.19, read backward.
glm::vec3 direction_of_texel(int face, int x, int y) {
  const float s = 2.0f * (float(x) + 0.5f) / float(resolution) - 1.0f;
  const float t = 2.0f * (float(y) + 0.5f) / float(resolution) - 1.0f;
  const std::array<glm::vec3, 6> directions{
      {{1, -t, -s}, {-1, -t, s}, {s, 1, t}, {s, -1, -t}, {s, -t, 1}, {-s, -t, -1}}};
  return directions[std::size_t(face)];
}

class CubeMapTest : public gl::ContextTest {
 protected:
  void SetUp() override {
    gl::ContextTest::SetUp();
    if (IsSkipped() || HasFatalFailure()) return;
    Result<std::unique_ptr<render::Renderer>> made = render::Renderer::create(scene_, {}, light::sun_and_sky);
    ASSERT_TRUE(made) << to_string(made.errors());
    renderer_ = *std::move(made);
    renderer_->begin_frame(scene_, Camera{});
  }
  void TearDown() override { renderer_.reset(); }

  scene::Scene scene_ = render::room_scene(room_half_m);
  std::unique_ptr<render::Renderer> renderer_;
};

/// From beside the middle of the room nearly every face shows parts of several walls: a face that is
/// exchanged, turned or mirrored shows.
TEST_F(CubeMapTest, EveryTexelShowsTheWallInItsDirection) {
  for (const glm::vec3 centre : {glm::vec3(4, 2.5f, -3.5f), glm::vec3(-3.5f, -4.5f, 2)}) {
    CubeMap map(resolution);
    for (int face = 0; face < 6; ++face) map.draw_face(*renderer_, face, centre, -1);
    std::vector<glm::vec4> texels(6 * resolution * resolution);
    glGetTextureImage(map.texture(), 0, GL_RGBA, GL_FLOAT, GLsizei(texels.size() * sizeof(glm::vec4)),
                      texels.data());
    for (int face = 0; face < 6; ++face)
      for (int y = 0; y < resolution; ++y)
        for (int x = 0; x < resolution; ++x) {
          const render::WallHit hit = render::wall_met(room_half_m, centre, direction_of_texel(face, x, y));
          if (hit.lead_m < 0.01f) continue;  // between two walls
          const glm::vec3 texel(texels[std::size_t((face * resolution + y) * resolution + x)]);
          ASSERT_LT(glm::distance(texel, render::wall_colours[std::size_t(hit.wall)]), 0.01f)
              << "face " << face << ", texel " << x << ", " << y << ": not wall " << hit.wall;
        }
  }
}

TEST_F(CubeMapTest, ReadPointsLieOnTheWalls) {
  const glm::vec3 centre(4, 2.5f, -3.5f);
  CubeMap map(resolution);
  std::vector<glm::vec3> points;
  for (int face = 0; face < 6; ++face) {
    map.draw_face(*renderer_, face, centre, -1);
    map.read_points(face, centre, points);
    EXPECT_EQ(points.size(), std::size_t(resolution * resolution));
    for (const glm::vec3& point : points) {
      const glm::vec3 reach = glm::abs(point);
      ASSERT_NEAR(std::max(reach.x, std::max(reach.y, reach.z)), room_half_m, 0.01f) << "face " << face;
    }
  }
}

TEST_F(CubeMapTest, TheSmallestLevelIsTheMeanOfEachFace) {
  CubeMap map(resolution);
  for (int face = 0; face < 6; ++face) map.draw_face(*renderer_, face, glm::vec3(0.0f), -1);
  map.update_levels();
  std::vector<glm::vec4> faces(6);  // from the middle each face shows one wall
  glGetTextureImage(map.texture(), 5, GL_RGBA, GL_FLOAT, GLsizei(faces.size() * sizeof(glm::vec4)),
                    faces.data());
  for (std::size_t face = 0; face < 6; ++face)
    EXPECT_LT(glm::distance(glm::vec3(faces[face]), render::wall_colours[face]), 0.01f) << "face " << face;
}

}  // namespace
}  // namespace parvis::methods

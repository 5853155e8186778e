#include "reflections/methods/cube_map.h"

#include <gtest/gtest.h>

#include "graphics/gl/test_context.h"
#include "graphics/light/sun_and_sky.h"
#include "graphics/render/test_room.h"
#include "reflections/methods/lobe_levels.h"

namespace parvis::methods {
namespace {

constexpr float room_half_m = 8.0f;
constexpr int resolution = 32;

/// The direction that a texel of a face stands for: OpenGL 4.5, table 8.19, read backward.
glm::vec3 direction_of_texel(int face, int x, int y, int side = resolution) {
  const float s = 2.0f * (float(x) + 0.5f) / float(side) - 1.0f;
  const float t = 2.0f * (float(y) + 0.5f) / float(side) - 1.0f;
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

/// Nearly every face seen from beside the room's middle shows parts of several walls: a face that is
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

/// Triangles that the faces of a map about a moving object are made of.
GLuint triangles_about(const scene::Scene& scene, int object, CubeMap& map) {
  Result<std::unique_ptr<render::Renderer>> renderer =
      render::Renderer::create(scene, {}, light::sun_and_sky);
  EXPECT_TRUE(renderer) << to_string(renderer.errors());
  (*renderer)->begin_frame(scene, Camera{});
  GLuint query = 0, count = 0;
  glGenQueries(1, &query);
  glBeginQuery(GL_PRIMITIVES_GENERATED, query);
  for (int face = 0; face < 6; ++face) map.draw_face(**renderer, face, glm::vec3(0.0f), object);
  glEndQuery(GL_PRIMITIVES_GENERATED);
  glGetQueryObjectuiv(query, GL_QUERY_RESULT, &count);
  glDeleteQueries(1, &query);
  return count;
}

TEST_F(CubeMapTest, WhatStandsBehindAWallIsNotDrawn) {
  CubeMap map(resolution);
  GLuint with_wall = 0, without = 0;
  for (const bool has_wall : {false, true}) {
    scene::Scene scene = render::room_scene(room_half_m);
    const int mirror = render::add_mirror(scene, glm::vec3(0.0f));
    const scene::Material grey = scene::matt(glm::vec3(0.5f));
    if (has_wall) scene::add(scene, scene::model_of(scene::box({4, -6, -6}, {4.5f, 6, 6}), grey));
    for (int i = 0; i < 10; ++i)
      scene::add(scene, scene::model_of(scene::box({6, i - 5, 0}, {6.5f, i - 4.5f, 0.5f}), grey));
    (has_wall ? with_wall : without) = triangles_about(scene, mirror, map);
  }
  EXPECT_LT(with_wall, without) << "twelve triangles hide a hundred and twenty";
}

/// A reflector with insides, as a car has: its faces are drawn without it, and it hides nothing in them.
TEST_F(CubeMapTest, AReflectorHidesNothingInItsOwnFaces) {
  const int mirror = render::add_mirror(scene_, glm::vec3(0.0f));
  auto car = std::make_shared<scene::Model>(*scene_.objects[std::size_t(mirror)].model);
  car->materials.front().is_double_sided = true;
  scene_.objects[std::size_t(mirror)].model = car;
  CubeMap map(resolution);
  triangles_about(scene_, mirror, map);
  std::vector<glm::vec4> texels(6 * resolution * resolution);
  glGetTextureImage(map.texture(), 0, GL_RGBA, GL_FLOAT, GLsizei(texels.size() * sizeof(glm::vec4)),
                    texels.data());
  for (std::size_t i = 0; i < texels.size(); ++i)
    ASSERT_LT(glm::distance(glm::vec3(texels[i]), render::wall_colours[i / (resolution * resolution)]), 0.01f)
        << "texel " << i;
}

/// Small static things are left out of the surroundings of some mirrors: what stands behind them is seen.
TEST_F(CubeMapTest, WhatAFaceDoesNotShowHidesNothingInIt) {
  const int mirror = render::add_mirror(scene_, glm::vec3(0.0f));
  const int screen = scene::add(
      scene_, scene::model_of(scene::box({4, -6, -6}, {4.5f, 6, 6}), scene::matt(glm::vec3(0.5f))));
  scene::Material blue_light = scene_.objects.front().model->materials[2];
  scene::add(scene_, scene::model_of(scene::box({6, -2, -2}, {6.5f, 2, 2}), blue_light));
  renderer_ = *render::Renderer::create(scene_, {}, light::sun_and_sky);
  renderer_->begin_frame(scene_, Camera{});
  CubeMap map(resolution);
  const auto middle_of_the_face = [&](const std::vector<std::uint8_t>* shown) {
    map.draw_face(*renderer_, 0, glm::vec3(0.0f), mirror, render::Subjects::all, shown);
    std::vector<glm::vec4> texels(6 * resolution * resolution);
    glGetTextureImage(map.texture(), 0, GL_RGBA, GL_FLOAT, GLsizei(texels.size() * sizeof(glm::vec4)),
                      texels.data());
    return glm::vec3(texels[resolution * resolution / 2 + resolution / 2]);
  };
  EXPECT_GT(glm::distance(middle_of_the_face(nullptr), blue_light.emission), 0.2f) << "the screen";
  std::vector<std::uint8_t> shown(scene_.objects.size(), 1);
  shown[std::size_t(screen)] = 0;
  EXPECT_LT(glm::distance(middle_of_the_face(&shown), blue_light.emission), 0.01f);
}

/// Difference of a map's level from a rough mirror over the lobe of the level's roughness: the mean distance
/// of colours.
float lobe_error(const CubeMap& map, glm::vec3 centre, int level) {
  constexpr int directions = 2048;
  const int side = resolution >> level;
  std::vector<glm::vec4> texels(std::size_t(6 * side * side));
  glGetTextureImage(map.texture(), level, GL_RGBA, GL_FLOAT, GLsizei(texels.size() * sizeof(glm::vec4)),
                    texels.data());
  const float roughness = roughness_of_level(std::log2(float(resolution)), float(level));
  float sum = 0.0f;
  for (std::size_t i = 0; i < texels.size(); ++i) {
    const int face = int(i) / (side * side), x = int(i) % side, y = int(i) / side % side;
    const glm::vec3 normal = glm::normalize(direction_of_texel(face, x, y, side));
    glm::vec3 mean(0.0f);
    float count = 0.0f;
    for (int k = 0; k < directions; ++k) {
      const glm::vec3 direction(lobe_sample(normal, roughness, k, directions));
      if (glm::dot(direction, normal) <= 0.0f) continue;
      mean += render::wall_colours[std::size_t(render::wall_met(room_half_m, centre, direction).wall)];
      ++count;
    }
    sum += glm::distance(glm::vec3(texels[i]), mean / count);
  }
  return sum / float(texels.size());
}

TEST_F(CubeMapTest, SmallLevelsAreBlurredForTheLobesOfRoughMirrors) {
  const Result<LobeFilter> filter = LobeFilter::create();
  ASSERT_TRUE(filter) << to_string(filter.errors());
  const glm::vec3 centre(4, 2.5f, -3.5f);
  CubeMap plain(resolution), blurred(resolution);
  for (CubeMap* map : {&plain, &blurred})
    for (int face = 0; face < 6; ++face) map->draw_face(*renderer_, face, centre, -1);
  plain.update_levels();
  blurred.update_levels(*filter);
  constexpr int level = 3;  // of roughness 0.56
  EXPECT_LT(lobe_error(blurred, centre, level), 0.5f * lobe_error(plain, centre, level));
}

TEST_F(CubeMapTest, TheSharpestLevelIsNotBlurred) {
  const Result<LobeFilter> filter = LobeFilter::create();
  ASSERT_TRUE(filter) << to_string(filter.errors());
  CubeMap map(resolution);
  for (int face = 0; face < 6; ++face) map.draw_face(*renderer_, face, glm::vec3(0.0f), -1);
  const auto texels = [&] {
    std::vector<glm::vec4> values(6 * resolution * resolution);
    glGetTextureImage(map.texture(), 0, GL_RGBA, GL_FLOAT, GLsizei(values.size() * sizeof(glm::vec4)),
                      values.data());
    return values;
  };
  const std::vector<glm::vec4> before = texels();
  map.update_levels(*filter);
  EXPECT_EQ(texels(), before);
}

}  // namespace
}  // namespace parvis::methods

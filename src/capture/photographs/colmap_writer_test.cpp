#include "capture/photographs/colmap_writer.h"

#include <gtest/gtest.h>

#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/files.h"
#include "base/test_folder.h"
#include "formats/gltf/gltf_cameras.h"

namespace parvis::photographs {
namespace {

using scene::SeenPoint, scene::TakenPicture, scene::write_gltf_cameras;

std::vector<TakenPicture> two_pictures() {
  TakenPicture a{"a.png", {}, 1280, 960}, b{"b.png", {}, 1280, 960};
  a.camera.world_from_camera = look_at({10, -20, 5}, {0, 0, 2});
  b.camera.world_from_camera = look_at({-400, 30, 12}, {3, 1, 0});
  b.camera.vertical_fov = 0.5f;
  return {a, b};
}

/// The lines of a file that are no comments, as streams.
std::vector<std::istringstream> lines_of(const std::filesystem::path& file) {
  std::vector<std::istringstream> lines;
  std::istringstream text(*read_file(file));
  for (std::string line; std::getline(text, line);)
    if (line.empty() || line[0] != '#') lines.emplace_back(line);
  return lines;
}

/// Where the renderer's matrices put a point, in pixels.
glm::vec2 rendered(const TakenPicture& picture, glm::vec3 position) {
  const float aspect = float(picture.width) / float(picture.height);
  const glm::dvec4 clip = glm::dmat4(picture.camera.clip_from_camera(aspect)) *
                          glm::inverse(glm::dmat4(picture.camera.world_from_camera)) *
                          glm::dvec4(position, 1.0);
  return {float((0.5 + 0.5 * clip.x / clip.w) * picture.width),
          float((0.5 - 0.5 * clip.y / clip.w) * picture.height)};
}

TEST(Colmap, WhatIsReadFromTheFilesProjectsPointsToTheirPixels) {
  const TestFolder folder;
  const std::vector<TakenPicture> pictures = two_pictures();
  const std::vector<SeenPoint> points{
      {{0, 0, 2}, {255, 0, 0}, {0, 1}}, {{3, -2, 1}, {0, 255, 0}, {1}}, {{-2, 4, 0.5f}, {1, 2, 3}, {0, 1}}};
  ASSERT_TRUE(write_colmap(folder.path(), pictures, points));
  auto cameras = lines_of(folder.path() / "cameras.txt"), images = lines_of(folder.path() / "images.txt");
  ASSERT_EQ(cameras.size(), 2u);
  ASSERT_EQ(images.size(), 4u);
  for (std::size_t i = 0; i < 2; ++i) {
    int id = 0, width = 0, height = 0, camera_id = 0;
    std::string model, name;
    double fx = 0, fy = 0, cx = 0, cy = 0;
    cameras[i] >> id >> model >> width >> height >> fx >> fy >> cx >> cy;
    EXPECT_EQ(model, "PINHOLE");
    glm::dquat q;
    glm::dvec3 t;
    images[2 * i] >> id >> q.w >> q.x >> q.y >> q.z >> t.x >> t.y >> t.z >> camera_id >> name;
    EXPECT_EQ(name, pictures[i].name);
    EXPECT_EQ(camera_id, int(i) + 1);
    double u = 0, v = 0;
    for (int point_id = 0; images[2 * i + 1] >> u >> v >> point_id;) {
      const glm::vec3 position = points[std::size_t(point_id) - 1].position;
      const glm::dvec3 p = q * glm::dvec3(position) + t;
      EXPECT_NEAR(fx * p.x / p.z + cx, u, 0.01);
      EXPECT_NEAR(fy * p.y / p.z + cy, v, 0.01);
      EXPECT_NEAR(u, double(rendered(pictures[i], position).x), 0.01);
      EXPECT_NEAR(v, double(rendered(pictures[i], position).y), 0.01);
    }
  }
}

TEST(Colmap, TracksPointAtTheObservationsInTheirPictures) {
  const TestFolder folder;
  ASSERT_TRUE(write_colmap(folder.path(), two_pictures(), {{{0, 0, 2}, {}, {1}}, {{1, 0, 2}, {}, {0, 1}}}));
  auto points = lines_of(folder.path() / "points3D.txt");
  ASSERT_EQ(points.size(), 2u);
  const std::string second = points[1].str();
  EXPECT_EQ(second.substr(second.find(" 0 1")),
            " 0 1 0 2 1");  // error; picture 1, its point 0; picture 2, its point 1
}

TEST(Colmap, PicturesOfOneLensShareACamera) {
  const TestFolder folder;
  std::vector<TakenPicture> pictures = two_pictures();
  pictures[1].camera.vertical_fov = pictures[0].camera.vertical_fov;
  ASSERT_TRUE(write_colmap(folder.path(), pictures, {}));
  EXPECT_EQ(lines_of(folder.path() / "cameras.txt").size(), 1u);
}

TEST(Colmap, AFolderThatCannotBeMadeIsAnError) {
  const TestFolder folder;
  folder.write("file", "");
  EXPECT_FALSE(write_colmap(folder.path() / "file" / "model", two_pictures(), {}));
}

TEST(GltfCameras, StandWhereTheyStoodWithYUp) {
  const TestFolder folder;
  const std::vector<TakenPicture> pictures = two_pictures();
  ASSERT_TRUE(write_gltf_cameras(folder.path() / "cameras.gltf", pictures));
  const auto json = nlohmann::json::parse(*read_file(folder.path() / "cameras.gltf"));
  const auto& turn = json["nodes"][0]["matrix"];  // by columns: Parvis's z is up, exactly
  for (int i = 0; i < 3; ++i) EXPECT_EQ(turn[std::size_t(8 + i)].get<double>(), i == 1 ? 1.0 : 0.0);
  ASSERT_EQ(json["cameras"].size(), 2u);
  const auto& matrix = json["nodes"][2]["matrix"];
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(matrix[std::size_t(12 + i)].get<float>(), pictures[1].camera.position_in_world()[i], 1e-4f);
  EXPECT_NEAR(json["cameras"][1]["perspective"]["yfov"].get<float>(), 0.5f, 1e-6f);
}

}  // namespace
}  // namespace parvis::photographs

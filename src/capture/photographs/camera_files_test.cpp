// Cameras from the files of other programs: hand-made ones, damaged ones, and the real photographs' own.
#include "capture/photographs/camera_files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "base/image_io.h"
#include "base/test_data.h"
#include "base/test_folder.h"

namespace parvis::photographs {
namespace {

void expect_near(glm::dvec3 a, glm::dvec3 b, double tolerance = 1e-6) {
  EXPECT_LT(glm::distance(a, b), tolerance)
      << a.x << " " << a.y << " " << a.z << " is not " << b.x << " " << b.y << " " << b.z;
}

TEST(CameraFiles, ViewpointsStandInTheirTransforms) {
  const auto views = parse_viewpoints(
      "#VRML V2.0 utf8\n# a comment with { in it\n"
      "Transform { translation 10 0 0 rotation 0 1 0 1.5707963 children [\n"
      "  DEF Camera01 Viewpoint { position 0 2 5 orientation 1 0 0 0 fieldOfView 0.6, description \"a "
      "b.jpg\" }\n"
      "] }\nDEF Named Viewpoint { position 1 2 3 }\n",
      "v.wrl");
  ASSERT_TRUE(views) << to_string(views.errors());
  ASSERT_EQ(views->size(), 2u);
  EXPECT_EQ((*views)[0].name, "a b.jpg");
  EXPECT_DOUBLE_EQ((*views)[0].fov, 0.6);
  // A quarter turn about y (up) takes (0, 2, 5) to (5, 2, 0); z up that is (15, 0, 2). It looked along -z,
  // now -x.
  expect_near(glm::dvec3((*views)[0].world_from_camera[3]), {15.0, 0.0, 2.0});
  expect_near(-glm::dvec3((*views)[0].world_from_camera[2]), {-1.0, 0.0, 0.0});
  expect_near(glm::dvec3((*views)[0].world_from_camera[1]), {0.0, 0.0, 1.0});
  EXPECT_EQ((*views)[1].name, "Named");
  expect_near(glm::dvec3((*views)[1].world_from_camera[3]), {1.0, -3.0, 2.0});
}

TEST(CameraFiles, InventorsCamerasAreViews) {
  const auto views = parse_viewpoints(
      "#Inventor V2.1 ascii\nSeparator { PerspectiveCamera { position 0 0 4 heightAngle 0.5 } }", "c.iv");
  ASSERT_TRUE(views) << to_string(views.errors());
  ASSERT_EQ(views->size(), 1u);
  EXPECT_EQ((*views)[0].across, ViewOfPicture::Across::height);
  expect_near(glm::dvec3((*views)[0].world_from_camera[3]), {0.0, -4.0, 0.0});
}

TEST(CameraFiles, DamagedViewpointsAreErrors) {
  EXPECT_FALSE(parse_viewpoints("Viewpoint { }", "v.wrl"));
  EXPECT_FALSE(parse_viewpoints("#VRML V2.0 utf8\nViewpoint { position 1 2 }", "v.wrl"));
  EXPECT_FALSE(parse_viewpoints("#VRML V2.0 utf8\nViewpoint { position 1 2 3", "v.wrl"));
  EXPECT_FALSE(parse_viewpoints("#VRML V2.0 utf8\n}", "v.wrl"));
  std::string deep = "#VRML V2.0 utf8\n";
  for (int i = 0; i < 100000; ++i) deep += "Group { ";
  EXPECT_FALSE(parse_viewpoints(deep, "v.wrl"));
}

TEST(CameraFiles, TheThesisExample) {
  const auto views = parse_thesis_cameras(
      "vdobject(cleanModels=0, file=\"car.pfb\", camera=\"10 0 1 10 10 5.5 30 1\", file=\"car2.iv\", "
      "cameraFile=\"cameraIV.wrl\")",
      "x.xp");
  ASSERT_TRUE(views) << to_string(views.errors());
  ASSERT_EQ(views->size(), 1u) << "cameraFile is another attribute";
  const ViewOfPicture& view = (*views)[0];
  EXPECT_EQ(view.name, "car.pfb");
  expect_near(glm::dvec3(view.world_from_camera[3]), {10.0, 0.0, 1.0});
  const double h = glm::radians(10.0), p = glm::radians(10.0);
  expect_near(-glm::dvec3(view.world_from_camera[2]),
              {-std::sin(h) * std::cos(p), std::cos(h) * std::cos(p), std::sin(p)});
  EXPECT_NEAR(view.fov, glm::radians(30.0), 1e-12);
  EXPECT_FALSE(parse_thesis_cameras("camera=\"1 2 3\"", "x.xp"));
  EXPECT_FALSE(parse_thesis_cameras("camera=\"10 0 1 10 10 5.5 200 1\"", "x.xp"));
}

TEST(CameraFiles, GltfCamerasStandInTheirNodes) {
  const auto views = parse_gltf_cameras(
      R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"cameras":[{"type":"perspective","perspective":{"yfov":0.7,"znear":0.1}}],
          "nodes":[{"translation":[1,2,3],"children":[1]},{"name":"a","camera":0,"rotation":[0,0.70710678118654752,0,0.70710678118654752]}]})",
      "c.gltf");
  ASSERT_TRUE(views) << to_string(views.errors());
  ASSERT_EQ(views->size(), 1u);
  EXPECT_EQ((*views)[0].name, "a");
  EXPECT_DOUBLE_EQ((*views)[0].fov, 0.7);
  expect_near(glm::dvec3((*views)[0].world_from_camera[3]), {1.0, -3.0, 2.0});
  expect_near(-glm::dvec3((*views)[0].world_from_camera[2]), {-1.0, 0.0, 0.0});
}

TEST(CameraFiles, HostileGltfIsAnError) {
  EXPECT_FALSE(parse_gltf_cameras("glTF", "c.glb"));
  EXPECT_FALSE(parse_gltf_cameras(R"({"nodes":[{"children":[0]}],"scenes":[{"nodes":[0]}]})", "c.gltf"))
      << "a node below itself";
  EXPECT_FALSE(parse_gltf_cameras(R"({"nodes":[{"camera":7}],"scenes":[{"nodes":[0]}]})", "c.gltf"));
  EXPECT_FALSE(
      parse_gltf_cameras(R"({"nodes":[{"rotation":[0,0,"x",1]}],"scenes":[{"nodes":[0]}]})", "c.gltf"));
}

TEST(CameraFiles, JsonTakesCentresAndTranslations) {
  const auto set = parse_camera_json(
      R"([{"name":"a","width":100,"height":80,"fx":90,"fy":91,"cx":49.5,"cy":39.5,"R":[[1,0,0],[0,1,0],[0,0,1]],"t":[0,0,5]},
          {"name":"b","width":100,"height":80,"K":[90,0,49.5,0,91,39.5,0,0,1],"R":[1,0,0,0,1,0,0,0,1],"C":[0,0,-5]}])",
      "c.json");
  ASSERT_TRUE(set) << to_string(set.errors());
  for (const Photograph& photograph : set->photographs) {
    expect_near(photograph.position_in_world(), {0.0, 0.0, -5.0});
    EXPECT_EQ(photograph.lens, pinhole_lens(100, 80, 90, 91, 50, 40)) << "pixel centres at integers there";
    expect_near(photograph.forward_in_world(), {0.0, 0.0, 1.0});
  }
  EXPECT_FALSE(parse_camera_json(R"([{"name":"a"}])", "c.json"));
  EXPECT_FALSE(parse_camera_json(
      R"([{"name":"a","width":100,"height":80,"fx":90,"fy":91,"cx":0,"cy":0,"R":[2,0,0,0,1,0,0,0,1],"t":[0,0,5]}])",
      "c.json"));
}

TEST(CameraFiles, JsonOf80000LevelsIsRefusedBeforeItIsParsed) {
  std::string deep = "[\n";
  for (int level = 0; level < 80'000; ++level) deep += "[";
  for (const bool is_whole : {false, true}) {
    const std::string list = deep + (is_whole ? std::string(80'001, ']') : "");
    const std::string gltf = "{\"scenes\":[],\"nodes\":" + list + (is_whole ? "}" : "");
    const auto cameras = parse_camera_json(list, "c.json");
    ASSERT_FALSE(cameras);
    EXPECT_NE(to_string(cameras.errors()).find("c.json: lists and objects"), std::string::npos);
    const auto views = parse_gltf_cameras(gltf, "c.gltf");
    ASSERT_FALSE(views);
    EXPECT_NE(to_string(views.errors()).find("c.gltf: lists and objects"), std::string::npos);
  }
}

TEST(CameraFiles, EachCameraWithoutPictureAndEachPictureWithoutCameraIsNamed) {
  const TestFolder folder;
  folder.write("cameras/a.png.camera", "90 0 49.5 0 90 39.5 0 0 1 0 0 0 1 0 0 0 1 0 0 0 1 1 2 3 100 80");
  folder.write("cameras/b.png.camera", "90 0 49.5 0 90 39.5 0 0 1 0 0 0 1 0 0 0 1 0 0 0 1 1 2 3 100 80");
  folder.write("cameras/c.png.camera", "90 0 49.5 0 90 39.5 0 0 1 0 0 0 1 0 0 0 1 0 0 0 1 1 2 3 100 80");
  folder.write("cameras/d.png.camera", "90 0 49.5");
  std::filesystem::create_directories(folder.path() / "pictures");
  ASSERT_TRUE(write_image(folder.path() / "pictures/a.png", Image8(50, 40, 3)));
  ASSERT_TRUE(write_image(folder.path() / "pictures/c.png", Image8(50, 50, 3)));
  ASSERT_TRUE(write_image(folder.path() / "pictures/e.png", Image8(50, 40, 3)));
  const auto loaded = read_cameras(folder.path() / "cameras", folder.path() / "pictures");
  ASSERT_TRUE(loaded) << to_string(loaded.errors());
  ASSERT_EQ(loaded->set.photographs.size(), 1u);
  EXPECT_EQ(loaded->set.photographs[0].lens, pinhole_lens(50, 40, 45, 45, 25, 20))
      << "the picture is half as large";
  const std::string problems = to_string(loaded->problems);
  EXPECT_NE(problems.find("b.png: there is a camera but no picture"), std::string::npos) << problems;
  EXPECT_NE(problems.find("c.png: the picture has 50 x 50 pixels, its camera 100 x 80"), std::string::npos)
      << problems;
  EXPECT_NE(problems.find("d.png.camera: expected 26 numbers"), std::string::npos) << problems;
  EXPECT_NE(problems.find("e.png: the picture has no camera"), std::string::npos) << problems;
}

TEST(CameraFiles, StrechasAndColmapsCamerasOfTheCourtyardAgree) {
  const auto data = shared_data("photos_castle_p30");
  if (!data) GTEST_SKIP() << "photos_castle_p30 is not there";
  const auto strecha = read_cameras(*data / "camera_orig", *data / "images");
  const auto colmap = read_cameras(*data / "colmap", *data / "images");
  ASSERT_TRUE(strecha && colmap);
  EXPECT_TRUE(strecha->problems.empty()) << to_string(strecha->problems);
  ASSERT_EQ(strecha->set.photographs.size(), 30u);
  for (std::size_t i = 0; i < 30; ++i) {
    const Photograph &a = strecha->set.photographs[i], &b = colmap->set.photographs[i];
    ASSERT_EQ(a.name, b.name);
    for (const SparsePoint& point : {colmap->set.points[5], colmap->set.points[9000]}) {
      const auto p = pixel_of_world(a, point.position_in_world),
                 q = pixel_of_world(b, point.position_in_world);
      ASSERT_EQ(bool(p), bool(q));
      if (p && is_inside(a.lens, *p)) {
        EXPECT_LT(glm::distance(*p, *q), 0.02) << a.name << ": files are rounded to 6 digits";
      }
    }
  }
}

TEST(CameraFiles, ReadsTheCastleOfSceaux) {
  const auto data = shared_data("photos_sceaux");
  if (!data) GTEST_SKIP() << "photos_sceaux is not there";
  const auto loaded = read_cameras(*data / "cameras.json", *data / "images");
  ASSERT_TRUE(loaded) << to_string(loaded.errors());
  EXPECT_TRUE(loaded->problems.empty()) << to_string(loaded->problems);
  EXPECT_EQ(loaded->set.photographs.size(), 10u);
  EXPECT_NEAR(principal_point_px(loaded->set.photographs[0].lens).x, 725.8179316289136 + 0.5, 1e-9);
}

}  // namespace
}  // namespace parvis::photographs

#include "formats/meshes/assimp_reader.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "base/test_data.h"
#include "base/test_folder.h"

namespace parvis::scene {
namespace {

const char* const quad_obj =
    "mtllib m.mtl\no plate\nusemtl red\nv 0 0 0\nv 1 0 0\nv 1 2 0\nv 0 2 0\nvt 0 0\nvt 1 1\nf 1/1 2/2 3/2 "
    "4/1\n";

TEST(Assimp, AnObjIsTurnedToZUpAndKeepsItsNames) {
  const TestFolder folder;
  folder.write("m.mtl", "newmtl red\nKd 1 0 0\nmap_Kd missing.png\n");
  Errors warnings;
  const Result<Model> model =
      read_with_assimp(folder.write("q.obj", quad_obj), formats::UpAxis::file, warnings);
  ASSERT_TRUE(model) << to_string(model.errors());
  ASSERT_EQ(model->parts.size(), 1u);
  EXPECT_EQ(model->parts[0].object, "plate");
  const Bounds box = bounds(*model);
  EXPECT_NEAR(box.size().z, 2.0f, 1e-5f);  // the file's y
  EXPECT_NEAR(box.size().y, 0.0f, 1e-5f);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].message.find("missing.png"), std::string::npos);
}

TEST(Assimp, FilesWithoutTrianglesAndGarbageAreErrors) {
  const TestFolder folder;
  Errors warnings;
  EXPECT_FALSE(
      read_with_assimp(folder.write("points.obj", "v 0 0 0\nv 1 0 0\n"), formats::UpAxis::file, warnings));
  const Result<Model> cloud = read_with_assimp(
      folder.write("cloud.ply",
                   "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                   "property float z\nend_header\n0 0 0\n1 0 0\n0 1 0\n"),
      formats::UpAxis::file, warnings);
  ASSERT_FALSE(cloud);
  EXPECT_NE(to_string(cloud.errors()).find("3 points"), std::string::npos) << to_string(cloud.errors());
  EXPECT_FALSE(read_with_assimp(folder.write("x.fbx", "no model"), formats::UpAxis::file, warnings));
  EXPECT_FALSE(read_with_assimp(folder.path() / "absent.obj", formats::UpAxis::file, warnings));
}

TEST(Assimp, DamagedTextNeverCrashes) {
  const TestFolder folder;
  folder.write("m.mtl", "newmtl red\nKd 1 0 0\n");
  Random random(5);
  for (int round = 0; round < 300; ++round) {
    std::string text = quad_obj;
    for (int change = 0; change <= round % 4; ++change)
      text[std::size_t(random.index(int(text.size())))] = char(random.next());
    Errors warnings;
    static_cast<void>(read_with_assimp(folder.write("bad.obj", text), formats::UpAxis::file, warnings));
  }
}

/// Size of the surface, metres.
glm::vec3 size_of(const Model& model) { return bounds(model).size(); }

TEST(Assimp, CoordinatesOfANationalGridKeepTheirMillimetres) {
  const TestFolder folder;
  const std::string obj =
      "v 458321.370 5431987.630 112.400\nv 458321.620 5431987.630 112.400 \n"
      "v 458321.620 5431987.755 112.400\nv 458321.370 5431987.630 112.570\nf 1 2 3\nf 1 2 4\n";
  for (const formats::UpAxis up : {formats::UpAxis::z, formats::UpAxis::file}) {  // no height is 5432 km
    Errors warnings;
    const Result<formats::FileContent> content =
        read_assimp_content(folder.write("far.obj", obj), up, warnings);
    ASSERT_TRUE(content) << to_string(content.errors());
    EXPECT_LT(glm::distance(size_of(content->model), glm::vec3(0.25f, 0.125f, 0.17f)), 1e-4f);
    EXPECT_NEAR(content->model.origin.x + double(bounds(content->model).min.x), 458321.370, 1e-4);
    EXPECT_NEAR(content->model.origin.y + double(bounds(content->model).min.y), 5431987.630, 1e-4);
    EXPECT_NEAR(bounds(content->model).min.z, 112.4f, 1e-4f);
    EXPECT_EQ(content->account.count(Fate::changed, "coordinates"), 1u);
    EXPECT_EQ(content->account.count(Fate::left_out), 0u);
  }
  Errors warnings;
  const std::string y_up =
      "v 458321.370 35.25 -5431987.630\nv 458322 35.25 -5431987.630\nv 458321 36 -5431987\nf 1 2 3\n";
  const Result<Model> roof =
      read_with_assimp(folder.write("roof.obj", y_up), formats::UpAxis::file, warnings);
  ASSERT_TRUE(roof);
  EXPECT_EQ(bounds(*roof).min.z, 35.25f);
  EXPECT_NEAR(roof->origin.y + double(bounds(*roof).max.y), 5431987.630, 1e-4);
}

TEST(Assimp, ColoursOfVerticesInBytesAreColours) {
  const TestFolder folder;
  Errors warnings;
  const Result<Model> off = read_with_assimp(
      folder.write("bytes.off",
                   "COFF\n3 1 0\n0 0 0 255 0 0 255\n1 0 0 0 0 255 255\n0 1 0 255 0 0 255\n3 0 1 2\n"),
      formats::UpAxis::file, warnings);
  ASSERT_TRUE(off);
  ASSERT_EQ(off->parts.front().mesh.colours.size(), 3u);
  for (const glm::vec4 colour : off->parts.front().mesh.colours)
    EXPECT_LT(glm::distance(colour, colour.x > 0.5f ? glm::vec4(1, 0, 0, 1) : glm::vec4(0, 0, 1, 1)), 1e-5f);
}

TEST(Assimp, ColoursOfDirectXHaveAlpha) {
  const TestFolder folder;
  Errors warnings;
  const auto file = folder.write("pane.x", R"(xof 0303txt 0032
Mesh pane {
 3;
 0.0;0.0;0.0;,
 1.0;0.0;0.0;,
 0.0;1.0;0.0;;
 1;
 3;0,1,2;;
 MeshMaterialList {
  1;
  1;
  0;;
  Material {
   0.2;0.4;0.6;0.25;;
   1.0;
   0.0;0.0;0.0;;
   0.0;0.0;0.0;;
  }
 }
}
)");
  const Result<Model> pane = read_with_assimp(file, formats::UpAxis::file, warnings);
  ASSERT_TRUE(pane) << to_string(pane.errors());
  const Material& material = pane->materials.at(std::size_t(pane->parts.at(0).material));
  EXPECT_FLOAT_EQ(material.alpha, 0.25f);
  EXPECT_EQ(material.alpha_mode, Alpha::blend);
}

TEST(Assimp, PlyAndStlAreBroughtNearInDoublePrecision) {
  const TestFolder folder;
  Errors warnings;
  std::string ply =
      "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty double x\nproperty double y\n"
      "property double z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n";
  const auto put = [&](const auto& value) {
    ply.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  for (const glm::dvec3 p : {glm::dvec3(600000.125, 200000.25, 400.5),
                             {600000.25, 200000.25, 400.5},
                             {600000.125, 200000.375, 400.5}}) {
    put(p.x), put(p.y), put(p.z);
    for (const std::uint8_t c : {255, 0, 128}) put(c);
  }
  put(std::uint8_t(3)), put(0), put(1), put(2);
  const Result<Model> cloud = read_with_assimp(folder.write("far.ply", ply), formats::UpAxis::file, warnings);
  ASSERT_TRUE(cloud) << to_string(cloud.errors());
  EXPECT_LT(glm::distance(size_of(*cloud), glm::vec3(0.125f, 0.125f, 0.0f)), 1e-5f);
  ASSERT_EQ(cloud->parts[0].mesh.colours.size(), 3u);
  EXPECT_NEAR(cloud->parts[0].mesh.colours[0].x, 1.0f, 1e-4f);
  EXPECT_NEAR(cloud->parts[0].mesh.colours[0].z, 0.216f, 0.002f) << "sRGB";

  const std::string stl =
      "solid s\nfacet normal 0 0 1\nouter loop\nvertex 600000.125 200000.25 400.5\nvertex 600000.25 "
      "200000.25 400.5\n"
      "vertex 600000.125 200000.375 400.5\nendloop\nendfacet\nendsolid s\n";
  const Result<Model> facet = read_with_assimp(folder.write("far.stl", stl), formats::UpAxis::file, warnings);
  ASSERT_TRUE(facet) << to_string(facet.errors());
  EXPECT_LT(glm::distance(size_of(*facet), glm::vec3(0.125f, 0.125f, 0.0f)), 1e-5f);
}

TEST(Assimp, WhatIsLeftOutIsNamed) {
  const TestFolder folder;
  folder.write("m.mtl", "newmtl red\nKd 1 0 0\nmap_Bump relief.png\n");
  Errors warnings;
  const Result<formats::FileContent> content = read_assimp_content(
      folder.write("q.obj", std::string(quad_obj) + "l 1 2\n"), formats::UpAxis::file, warnings);
  ASSERT_TRUE(content) << to_string(content.errors());
  EXPECT_EQ(content->account.count(Fate::left_out, "textures"), 1u);
  EXPECT_EQ(content->account.count(Fate::left_out, "primitives"), 1u);
  EXPECT_EQ(content->account.count(Fate::left_out), 2u);

  const Result<formats::FileContent> bare =
      read_assimp_content(folder.write("inner/q.obj", std::string(quad_obj) + "cstype bspline\ndeg 3\n"),
                          formats::UpAxis::file, warnings);
  ASSERT_TRUE(bare) << to_string(bare.errors());
  EXPECT_EQ(bare->account.count(Fate::left_out, "material libraries"), 1u);
  EXPECT_EQ(bare->account.count(Fate::left_out, "statements"), 2u);

  const Result<formats::FileContent> scan = read_assimp_content(
      folder.write(
          "scan.ply",
          "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
          "property float intensity\nelement face 1\nproperty list uchar int vertex_indices\n"
          "element edge 2\nproperty int vertex1\nproperty int vertex2\nend_header\n"
          "0 0 0 9\n1 0 0 9\n0 1 0 9\n3 0 1 2\n0 1\n1 2\n"),
      formats::UpAxis::file, warnings);
  ASSERT_TRUE(scan) << to_string(scan.errors());
  EXPECT_EQ(scan->account.count(Fate::left_out, "properties"), 1u);
  EXPECT_EQ(scan->account.count(Fate::left_out, "elements"), 2u);
}

TEST(Assimp, ReadsTheRealCar) {
  const auto file = shared_data("cars/p406/p406.obj");
  if (!file) GTEST_SKIP() << "skipped: shared data absent";
  Errors warnings;
  const Result<Model> model = read_with_assimp(*file, formats::UpAxis::file, warnings);
  ASSERT_TRUE(model) << to_string(model.errors());
  EXPECT_TRUE(warnings.empty()) << to_string(warnings);
  const Bounds box = bounds(*model);
  EXPECT_NEAR(box.size().x, 4.6f, 0.3f);
  EXPECT_LT(box.size().z, box.size().y);
}

}  // namespace
}  // namespace parvis::scene

#include "formats/meshes/assimp_reader.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "base/test_data.h"
#include "base/test_folder.h"

namespace parvis::scene {
namespace {

const char* const quad =
    "mtllib m.mtl\no plate\nusemtl red\nv 0 0 0\nv 1 0 0\nv 1 2 0\nv 0 2 0\nvt 0 0\nvt 1 1\nf 1/1 2/2 3/2 "
    "4/1\n";

TEST(Assimp, AnObjIsTurnedToZUpAndKeepsItsNames) {
  const TestFolder folder;
  folder.write("m.mtl", "newmtl red\nKd 1 0 0\nmap_Kd missing.png\n");
  Errors warnings;
  const Result<Model> model = read_with_assimp(folder.write("q.obj", quad), formats::UpAxis::file, warnings);
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
  EXPECT_FALSE(read_with_assimp(folder.write("x.fbx", "no model"), formats::UpAxis::file, warnings));
  EXPECT_FALSE(read_with_assimp(folder.path() / "absent.obj", formats::UpAxis::file, warnings));
}

TEST(Assimp, DamagedTextNeverCrashes) {
  const TestFolder folder;
  folder.write("m.mtl", "newmtl red\nKd 1 0 0\n");
  Random random(5);
  for (int round = 0; round < 300; ++round) {
    std::string text = quad;
    for (int change = 0; change <= round % 4; ++change)
      text[std::size_t(random.index(int(text.size())))] = char(random.next());
    Errors warnings;
    static_cast<void>(read_with_assimp(folder.write("bad.obj", text), formats::UpAxis::file, warnings));
  }
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

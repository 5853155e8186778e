#include "base/files.h"

#include <gtest/gtest.h>

#include "base/image_io.h"
#include "base/test_folder.h"

namespace parvis {
namespace {
namespace fs = std::filesystem;

TEST(Roots, FilesBelowARootAreFound) {
  const TestFolder folder;
  folder.write("scene/models/car.glb", "x");
  folder.write("data/city.json", "x");
  const Roots roots(folder.path() / "scene", {folder.path() / "data"});
  EXPECT_TRUE(roots.find("models/car.glb", {}));
  EXPECT_TRUE(roots.find("models/../models/car.glb", {}));
  EXPECT_TRUE(roots.find("city.json", {}));
}

TEST(Roots, PathsThatLeadOutAreRefusedWithTheirPlace) {
  const TestFolder folder;
  folder.write("secret.txt", "x");
  folder.write("scene/a.xp", "x");
  fs::create_symlink(folder.path() / "secret.txt", folder.path() / "scene/link.txt");
  const Roots roots(folder.path() / "scene");
  for (const std::string& name :
       {std::string("../secret.txt"), (folder.path() / "secret.txt").string(), std::string("link.txt"),
        std::string("a/../../secret.txt"), std::string("/etc/passwd")}) {
    const Result<fs::path> found = roots.find(name, {"a.xp", 3, 7});
    ASSERT_FALSE(found) << name;
    EXPECT_EQ(to_string(found.errors().front()).substr(0, 9), "a.xp:3:7:");
    EXPECT_NE(found.errors().front().message.find("leads out"), std::string::npos) << name;
  }
  const Result<fs::path> absent = roots.find("absent.txt", {});
  ASSERT_FALSE(absent);
  EXPECT_NE(absent.errors().front().message.find("no file"), std::string::npos);
}

TEST(Files, AFailedWriteLeavesNothing) {
  const TestFolder folder;
  const Status status = write_atomically(folder.path() / "out.txt", [](const fs::path& temporary) -> Status {
    EXPECT_TRUE(write_file(temporary, "half"));
    return error("the second half is missing");
  });
  EXPECT_FALSE(status);
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(Files, AFolderThatCannotBeMadeIsNamed) {
  const TestFolder folder;
  folder.write("file", "x");
  const Status status = write_file(folder.path() / "file/below/out.txt", "x");
  ASSERT_FALSE(status);
  EXPECT_NE(status.errors().front().message.find("below"), std::string::npos);
}

TEST(ImageIo, PicturesComeBackAsTheyWere) {
  const TestFolder folder;
  Image8 picture(5, 3, 4, 0);
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) picture.pixels[i] = std::uint8_t(17 * i);
  ASSERT_TRUE(write_image(folder.path() / "p.png", picture));
  const Result<Image8> again = read_image8(folder.path() / "p.png");
  ASSERT_TRUE(again) << to_string(again.errors());
  EXPECT_EQ(again->pixels, picture.pixels);

  ImageF radiance(4, 2, 3, 0.0f);
  for (std::size_t i = 0; i < radiance.pixels.size(); ++i) radiance.pixels[i] = float(i) * 3.5f;
  ASSERT_TRUE(write_image(folder.path() / "r.exr", radiance));
  const Result<ImageF> light = read_image_float(folder.path() / "r.exr");
  ASSERT_TRUE(light) << to_string(light.errors());
  EXPECT_EQ(light->pixels, radiance.pixels);
}

TEST(ImageIo, BadPicturesAreErrorsThatNameThem) {
  const TestFolder folder;
  ASSERT_TRUE(write_image(folder.path() / "good.png", Image8(64, 64, 4, 99)));
  const std::string good = *read_file(folder.path() / "good.png");
  folder.write("short.png", std::string_view(good).substr(0, good.size() / 2));
  folder.write("garbage.png", "this is no picture");
  folder.write("empty.jpg", "");
  for (const char* name : {"short.png", "garbage.png", "empty.jpg", "absent.png"}) {
    const Result<Image8> picture = read_image8(folder.path() / name);
    ASSERT_FALSE(picture) << name;
    EXPECT_NE(to_string(picture.errors()).find(name), std::string::npos);
  }
}

}  // namespace
}  // namespace parvis

#include "base/files.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>

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
  const Result<fs::path> too_long = roots.find(std::string(300, 'n') + ".png", {});
  ASSERT_FALSE(too_long);
  EXPECT_NE(too_long.errors().front().message.find("File name too long"), std::string::npos);
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

TEST(Files, OnlyRegularFilesUpToALimitAreRead) {
  const TestFolder folder;
  ASSERT_EQ(mkfifo((folder.path() / "pipe").c_str(), 0600), 0);
  fs::create_directory(folder.path() / "folder");
  for (const fs::path& file : {folder.path() / "pipe", folder.path() / "folder", fs::path("/dev/zero")}) {
    const Result<std::string> text = read_file(file);
    ASSERT_FALSE(text) << file;
    EXPECT_NE(to_string(text.errors()).find("regular file"), std::string::npos) << to_string(text.errors());
  }
  folder.write("ten.txt", "0123456789");
  EXPECT_EQ(*read_file(folder.path() / "ten.txt", 10), "0123456789");
  const Result<std::string> too_large = read_file(folder.path() / "ten.txt", 9);
  ASSERT_FALSE(too_large);
  EXPECT_NE(to_string(too_large.errors()).find("ten.txt"), std::string::npos);
  folder.write("sparse", "");
  fs::resize_file(folder.path() / "sparse", max_file_bytes + 1);
  EXPECT_FALSE(read_file(folder.path() / "sparse"));
  EXPECT_FALSE(read_file("/proc/self/maps", 100));  // says that it is empty
}

TEST(Files, RootsGiveNoPipes) {
  const TestFolder folder;
  ASSERT_EQ(mkfifo((folder.path() / "pipe.png").c_str(), 0600), 0);
  const Result<fs::path> found = Roots(folder.path()).find("pipe.png", {"a.xp", 1, 1});
  ASSERT_FALSE(found);
  EXPECT_NE(to_string(found.errors()).find("neither a file nor a folder"), std::string::npos);
}

TEST(Files, WritingFollowsNoLinkOfItsTemporaryFile) {
  const TestFolder folder;
  folder.write("mine.txt", "mine");
  fs::create_symlink(folder.path() / "mine.txt", folder.path() / ".partial-s.xp");
  ASSERT_TRUE(write_file(folder.path() / "s.xp", "new"));
  EXPECT_EQ(*read_file(folder.path() / "mine.txt"), "mine");
  EXPECT_EQ(*read_file(folder.path() / "s.xp"), "new");
}

TEST(Files, ReplacingKeepsPermissionsAndLinks) {
  const TestFolder folder;
  folder.write("real/s.xp", "old");
  fs::permissions(folder.path() / "real/s.xp", fs::perms::owner_read | fs::perms::owner_write);
  fs::create_symlink("real/s.xp", folder.path() / "s.xp");
  ASSERT_TRUE(write_file(folder.path() / "s.xp", "new"));
  EXPECT_TRUE(fs::is_symlink(folder.path() / "s.xp"));
  EXPECT_EQ(*read_file(folder.path() / "real/s.xp"), "new");
  EXPECT_EQ(fs::status(folder.path() / "real/s.xp").permissions(),
            fs::perms::owner_read | fs::perms::owner_write);
}

TEST(Files, WritingFollowsNoLinkOutOfItsFolder) {
  const TestFolder folder;
  folder.write("mine.txt", "mine");
  fs::create_directory(folder.path() / "place");
  for (const char* target : {"../mine.txt", "../absent.txt"}) {
    const fs::path link = folder.path() / "place/s.xp";
    fs::remove(link);
    fs::create_symlink(target, link);
    const Status status = write_file(link, "new");
    ASSERT_FALSE(status);
    EXPECT_NE(to_string(status.errors()).find("leads out of its folder"), std::string::npos);
  }
  EXPECT_EQ(*read_file(folder.path() / "mine.txt"), "mine");
  EXPECT_FALSE(fs::exists(folder.path() / "absent.txt"));
}

TEST(Files, ALoopOfLinksIsNotReplaced) {
  const TestFolder folder;
  fs::create_symlink("b.xp", folder.path() / "a.xp");
  fs::create_symlink("a.xp", folder.path() / "b.xp");
  EXPECT_FALSE(write_file(folder.path() / "a.xp", "new"));
  EXPECT_TRUE(fs::is_symlink(folder.path() / "a.xp"));
}

TEST(Files, ALinkToWhatIsAbsentBelowItsFolderStays) {
  const TestFolder folder;
  fs::create_symlink("below/s.xp", folder.path() / "s.xp");
  ASSERT_TRUE(write_file(folder.path() / "s.xp", "new"));
  EXPECT_TRUE(fs::is_symlink(folder.path() / "s.xp"));
  EXPECT_EQ(*read_file(folder.path() / "below/s.xp"), "new");
}

TEST(Files, AFileOfTheWorkingFolderIsWritten) {
  const TestFolder folder;
  const fs::path before = fs::current_path();
  fs::current_path(folder.path());
  const Status status = write_file("here.txt", "x");
  fs::current_path(before);
  ASSERT_TRUE(status) << to_string(status.errors());
  EXPECT_EQ(*read_file(folder.path() / "here.txt"), "x");
}

TEST(Files, LongNamesAreWritten) {
  const TestFolder folder;
  const std::string name = fmt::format("{:n>251}.txt", "");  // 255 bytes, as many as a folder takes
  ASSERT_TRUE(write_file(folder.path() / name, "x"));
  EXPECT_EQ(*read_file(folder.path() / name), "x");
}

TEST(Files, AFullDiskLeavesTheOldFile) {
  const TestFolder folder;
  folder.write("out.txt", "old");
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{1000, before.rlim_max};  // fails as a full disk does, in the middle
  signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &small);
  const Status status = write_file(folder.path() / "out.txt", std::string(5000, 'x'));
  setrlimit(RLIMIT_FSIZE, &before);
  ASSERT_FALSE(status);
  EXPECT_NE(to_string(status.errors()).find("out.txt: cannot be written"), std::string::npos);
  EXPECT_EQ(*read_file(folder.path() / "out.txt"), "old");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
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

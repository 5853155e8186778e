#include "base/path_inside.h"

#include <gtest/gtest.h>

#include "base/test_folder.h"

namespace parvis {
namespace {
namespace fs = std::filesystem;

TEST(PathInside, FollowsNoLinkOutOfTheFolder) {
  const TestFolder folder;
  folder.write("outside/secret.txt", "x");
  folder.write("place/real/a.txt", "x");
  const fs::path place = folder.path() / "place";
  fs::create_directory_symlink(folder.path() / "outside", place / "layers");
  fs::create_directory_symlink("real", place / "near");
  fs::create_symlink(folder.path() / "outside/secret.txt", place / "real/link.txt");
  for (const char* name : {"layers", "layers/new.psd", "layers/secret.txt", "real/link.txt", "../outside"}) {
    const Result<fs::path> found = path_inside(place, name);
    ASSERT_FALSE(found) << name;
    EXPECT_NE(found.errors().front().message.find(name), std::string::npos);
  }
  for (const char* name : {"real/a.txt", "near/a.txt", "absent/b.txt"}) {
    const Result<fs::path> found = path_inside(place, name);
    ASSERT_TRUE(found) << name;
    EXPECT_EQ(*found, place / name);
  }
}

}  // namespace
}  // namespace parvis

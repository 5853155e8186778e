#include "base/file_set.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "base/files.h"
#include "base/test_folder.h"

namespace parvis {
namespace {
namespace fs = std::filesystem;

TEST(FileSet, AllAppearOrNone) {
  const TestFolder folder;
  const fs::path one = folder.path() / "one.txt", two = folder.path() / "two.txt";
  ASSERT_TRUE(write_together({{one, "1"}, {two, "2"}}));
  EXPECT_EQ(*read_file(one), "1");
  EXPECT_EQ(*read_file(two), "2");
  fs::remove(two);
  fs::create_directory(two);  // no file can take its place
  EXPECT_FALSE(write_together({{one, "new"}, {two, "new"}}));
  EXPECT_EQ(*read_file(one), "1");
  fs::remove(two);
  EXPECT_FALSE(write_together({{one, "new"}, {two, "new"}}, [] { return Status(error("no")); }));
  EXPECT_EQ(*read_file(one), "1");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1) << "nothing is left behind";
}

}  // namespace
}  // namespace parvis

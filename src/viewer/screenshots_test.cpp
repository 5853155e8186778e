#include "viewer/screenshots.h"

#include <gtest/gtest.h>

#include "base/files.h"
#include "base/test_folder.h"

namespace parvis::viewer {
namespace {

Result<std::filesystem::path> write(const std::filesystem::path& folder, const std::string& name) {
  return write_numbered(folder, name, [](const auto& file) { return write_file(file, "a picture"); });
}

TEST(Screenshots, GoOnAfterTheHighestNumber) {
  const TestFolder folder;
  folder.write("square-0007.png", "mine");
  folder.write("square-99.jpg", "no picture of ours");
  folder.write("square-12", "nor this");
  folder.write("squares-0100.png", "nor that");
  const auto file = write(folder.path(), "square");
  ASSERT_TRUE(file) << to_string(file.errors());
  EXPECT_EQ(file->filename(), "square-0008.png");
  EXPECT_EQ(*read_file(*file), "a picture");
  EXPECT_EQ(*read_file(folder.path() / "square-0007.png"), "mine");
}

TEST(Screenshots, MakeTheirFolder) {
  const TestFolder folder;
  const auto file = write(folder.path() / "new/one", "square");
  ASSERT_TRUE(file) << to_string(file.errors());
  EXPECT_EQ(*file, folder.path() / "new/one/square-0001.png");
}

TEST(Screenshots, OfAFailedWriterLeaveNothing) {
  const TestFolder folder;
  const auto file =
      write_numbered(folder.path(), "square", [](const auto&) -> Status { return error("no ink"); });
  ASSERT_FALSE(file);
  EXPECT_EQ(file.errors()[0].message, "no ink");
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Screenshots, SayWhereTheyCannotBeWritten) {
  const TestFolder folder;
  const auto file = write(folder.write("taken", "a file, not a folder"), "square");
  ASSERT_FALSE(file);
  EXPECT_NE(file.errors()[0].message.find("taken"), std::string::npos) << file.errors()[0].message;
}

}  // namespace
}  // namespace parvis::viewer

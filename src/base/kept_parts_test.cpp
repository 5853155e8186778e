#include "base/kept_parts.h"

#include <gtest/gtest.h>

#include "base/files.h"
#include "base/partial_file.h"
#include "base/test_folder.h"

namespace parvis {
namespace {
namespace fs = std::filesystem;

TEST(KeptParts, FindsWhatItHasKeptUnderItsKeyAlone) {
  const TestFolder folder;
  const KeptParts parts(folder.path() / "oak.steps");
  EXPECT_FALSE(parts.find("opacity", 7));
  ASSERT_TRUE(parts.keep("opacity", 7, "seven"));
  ASSERT_TRUE(parts.keep("colours", 7, ""));
  const KeptParts again(folder.path() / "oak.steps");
  EXPECT_EQ(again.find("opacity", 7), "seven");
  EXPECT_EQ(again.find("colours", 7), "");
  EXPECT_FALSE(again.find("opacity", 8)) << "other work";
  ASSERT_TRUE(again.keep("opacity", 8, "eight"));
  EXPECT_EQ(again.find("opacity", 8), "eight");
  EXPECT_FALSE(again.find("opacity", 7)) << "replaced";
}

TEST(KeptParts, WithoutAFolderKeepsNothing) {
  const KeptParts none;
  EXPECT_FALSE(none.keeps_parts());
  EXPECT_TRUE(none.keep("opacity", 7, "seven"));
  EXPECT_FALSE(none.find("opacity", 7));
}

TEST(KeptParts, APartThatIsCutShortDoesNotCount) {
  const TestFolder folder;
  const KeptParts parts(folder.path());
  ASSERT_TRUE(parts.keep("opacity", 7, "seven"));
  const fs::path file = folder.path() / "opacity.part";
  fs::resize_file(file, fs::file_size(file) - 1);
  EXPECT_FALSE(parts.find("opacity", 7));
  EXPECT_TRUE(parts.keep("opacity", 7, "seven")) << "it is replaced";
  EXPECT_EQ(parts.find("opacity", 7), "seven");
}

TEST(KeptParts, SomebodysOwnFileIsNeitherReplacedNorRemoved) {
  const TestFolder folder;
  const fs::path own = folder.write("oak.steps/opacity.part", "a part of a novel");
  const KeptParts parts(own.parent_path());
  const Status status = parts.keep("opacity", 7, "seven");
  ASSERT_FALSE(status);
  EXPECT_NE(to_string(status.errors()).find("opacity.part"), std::string::npos);
  ASSERT_TRUE(parts.keep("colours", 7, "seven"));
  parts.remove();
  EXPECT_FALSE(fs::exists(own.parent_path() / "colours.part"));
  EXPECT_EQ(*read_file(own), "a part of a novel");
}

TEST(KeptParts, WhatAnotherProcessIsWritingStays) {
  const TestFolder folder;
  const KeptParts parts(folder.path(), unfinished_work, ".part", FolderOf::program);
  ASSERT_TRUE(parts.keep("colours", 7, "seven"));
  Result<PartialFile> other = PartialFile::create(parts.file("opacity"));
  ASSERT_TRUE(other) << to_string(other.errors());
  parts.remove();
  EXPECT_FALSE(parts.find("colours", 7));
  ASSERT_TRUE(other->write(sealed_bytes(unfinished_work, std::string(8, '\0') + "eight")));
  const Status status = other->keep();
  EXPECT_TRUE(status) << to_string(status.errors());
  EXPECT_EQ(parts.find("opacity", 0), "eight");
}

TEST(KeptParts, NothingGoesThroughALink) {
  const TestFolder folder;
  const fs::path elsewhere = folder.path() / "elsewhere", link = folder.path() / "oak.steps";
  ASSERT_TRUE(KeptParts(elsewhere).keep("opacity", 7, "seven"));
  fs::create_directory_symlink(elsewhere, link);
  const KeptParts linked(link);
  EXPECT_FALSE(linked.find("opacity", 7));
  EXPECT_FALSE(linked.keep("colours", 7, "eight"));
  linked.remove();
  EXPECT_EQ(KeptParts(elsewhere).find("opacity", 7), "seven");

  const fs::path secret = folder.write("secret.part", "");
  const KeptParts inside(folder.path() / "steps");
  ASSERT_TRUE(inside.keep("colours", 7, "seven"));
  fs::create_symlink(secret, folder.path() / "steps" / "opacity.part");
  EXPECT_FALSE(inside.keep("opacity", 7, "eight"));
  EXPECT_EQ(*read_file(secret), "");
}

TEST(KeptParts, RemovedItLeavesNothing) {
  const TestFolder folder;
  const KeptParts parts(folder.path() / "oak.steps");
  ASSERT_TRUE(parts.keep("opacity", 7, "seven"));
  ASSERT_TRUE(parts.keep("colours", 7, "seven"));
  folder.write("oak.steps/.partial-0123abcd-finer.part", "");  // as a program leaves it that is killed
  parts.remove();
  EXPECT_FALSE(fs::exists(folder.path() / "oak.steps"));
}

}  // namespace
}  // namespace parvis

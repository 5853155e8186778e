#include "scene/data/file_account.h"

#include <gtest/gtest.h>

namespace parvis::scene {
namespace {

TEST(FileAccount, CountsByKindFateAndReasonAndNamesTheFirst) {
  FileAccount account("test");
  for (const char* name : {"a", "b", "a", "c", "d", "e"}) account.left_out("tags", "no number", name);
  account.left_out("tags", "no unit", "f");
  account.used("tags", 4);
  account.used("ways", 0);
  ASSERT_EQ(account.lines().size(), 3u);
  EXPECT_EQ(account.lines()[0].count, 6u);
  EXPECT_EQ(account.lines()[0].names, (std::vector<std::string>{"a", "b", "c", "d"}));
  EXPECT_EQ(account.count(Fate::left_out), 7u);
  EXPECT_EQ(account.count(Fate::used, "tags"), 4u);
  const Errors warnings = account.warnings();
  ASSERT_EQ(warnings.size(), 1u);  // one a kind
  EXPECT_EQ(warnings[0].message,
            "6 tags left out: no number (a, b, c, d, ...); 1 tags left out: no unit (f)");
}

TEST(FileAccount, WhatALibraryDropsIsLeftOut) {
  FileAccount account("test");
  account.settle("walls", 5, 3, "the library cannot build them");
  account.settle("doors", 2, 2, "the library cannot build them");
  EXPECT_EQ(account.count(Fate::used), 5u);
  EXPECT_EQ(account.count(Fate::left_out), 2u);
  EXPECT_EQ(account.warnings().size(), 1u);
}

TEST(FileAccount, IsBoundedWhateverAFileHolds) {
  FileAccount account("test");
  for (int i = 0; i < 5000; ++i)
    account.left_out(std::to_string(i) + " things", "many", std::string(1000, 'x'));
  EXPECT_LE(account.lines().size(), FileAccount::max_lines + 1);
  EXPECT_EQ(account.count(Fate::left_out), 5000u);
  EXPECT_LT(account.lines()[0].names[0].size(), 2 * FileAccount::max_name_bytes);
}

}  // namespace
}  // namespace parvis::scene

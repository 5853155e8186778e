// The line of commands: what it offers and completes.
#include "viewer/command_line.h"

#include <gtest/gtest.h>

namespace parvis::viewer {
namespace {

TEST(CommandLineForms, AreThoseThatBeginAsIsWritten) {
  const std::vector<std::string> all = forms_for("");
  EXPECT_GT(all.size(), 30u) << "every command of designs, and those of the window";
  const std::vector<std::string> with_s = forms_for("s");
  ASSERT_EQ(with_s.size(), 7u) << "swap, space, surface, select, save, street, slider";
  EXPECT_TRUE(forms_for("insert").front().starts_with("insert KIND"));
  ASSERT_EQ(forms_for("move bench_1 by").size(), 1u);
  EXPECT_TRUE(forms_for("move bench_1 by").front().starts_with("move NAMES by"));
  EXPECT_TRUE(forms_for("mov bench_1").empty()) << "no verb";
}

TEST(CommandLineCompletion, IsWhatAllThatBeginSoHaveInCommon) {
  const std::vector<std::string> words{"bench_stone", "bench_wood", "bollard"};
  EXPECT_EQ(completion("insert be", words), "nch_");
  EXPECT_EQ(completion("insert bench_w", words), "ood");
  EXPECT_EQ(completion("insert b", words), "") << "bench and bollard part here";
  EXPECT_EQ(completion("insert bin", words), "");
  EXPECT_EQ(completion("delete bollard,bench_s", words), "tone") << "names are parted by commas";
  EXPECT_EQ(completion("bol", words), "lard");
}

}  // namespace
}  // namespace parvis::viewer

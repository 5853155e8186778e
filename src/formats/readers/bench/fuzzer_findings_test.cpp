#include "formats/readers/bench/fuzzer_findings.h"

#include <gtest/gtest.h>

#include <array>

#include "base/test_folder.h"

namespace parvis::bench {
namespace {
namespace fs = std::filesystem;

/// A stand-in for a fuzzer.
fs::path program(const TestFolder& folder, const std::string& name, const std::string& commands) {
  const fs::path file = folder.write(name, "#!/bin/sh\n" + commands);
  fs::permissions(file, fs::perms::owner_all);
  return file;
}

std::size_t findings(const TestFolder& folder, const std::string& name, const std::string& commands) {
  const std::array seeds{folder.path() / "seeds"};
  return findings_of_fuzzer(program(folder, name, commands), seeds, 1, folder.path() / "work");
}

TEST(FuzzerFindings, AreInputsAtWhichAReaderFails) {
  const TestFolder folder;
  EXPECT_EQ(findings(folder, "quiet", "exit 0\n"), 0u);
  const std::string for_prefix =
      "for word; do case $word in -artifact_prefix=*) at=${word#*=};; esac; done\n";
  EXPECT_EQ(
      findings(folder, "finds", for_prefix + "touch ${at}crash-1 ${at}oom-2 ${at}slow-unit-3; exit 1\n"), 2u);
  EXPECT_EQ(findings(folder, "slow", for_prefix + "touch ${at}slow-unit-3\n"), 0u);
}

/// A fuzzer that does not run finds nothing, and shows nothing.
TEST(FuzzerFindings, CountAFuzzerThatFailsWithoutAnInput) {
  const TestFolder folder;
  EXPECT_EQ(findings(folder, "broken", "exit 1\n"), 1u);
}

TEST(FuzzerFindings, BeginAtTheSeeds) {
  const TestFolder folder;
  folder.write("seeds/first", "");
  const std::string last_word = "for word; do :; done\n";
  EXPECT_EQ(findings(folder, "seeded", last_word + "test -e \"$word/first\"\n"), 0u);
}

}  // namespace
}  // namespace parvis::bench

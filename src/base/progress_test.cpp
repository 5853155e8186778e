#include "base/progress.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace parvis {
namespace {

TEST(Progress, WritesALineWhileOneStepTakesLong) {
  testing::internal::CaptureStderr();
  {
    Progress all("reading models", 2);
    all.advance();
    Progress inner("placing trees", 10);
    std::this_thread::sleep_for(std::chrono::milliseconds(5600));  // longer than the time between two lines
  }
  const std::string lines = testing::internal::GetCapturedStderr();
  EXPECT_NE(lines.find("placing trees 0/10 (0 %)\n"), std::string::npos) << lines;
  EXPECT_EQ(lines.find("reading models"), std::string::npos) << lines;
}

TEST(Progress, IsSilentWhereWorkIsShort) {
  testing::internal::CaptureStderr();
  for (int i = 0; i < 100; ++i) Progress("short", 1).advance();
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace parvis

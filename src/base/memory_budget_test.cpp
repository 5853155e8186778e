#include "base/memory_budget.h"

#include <gtest/gtest.h>

#include <vector>

#include "base/checked.h"

namespace parvis {
namespace {

constexpr std::uint64_t mb = std::uint64_t{1} << 20;

/// The budget is the process's: each test gives it back.
class MemoryBudget : public testing::Test {
 protected:
  ~MemoryBudget() override { set_max_memory(default_max_memory()); }
};

TEST_F(MemoryBudget, IsHalfOfTheMachineUnlessSet) {
  EXPECT_GT(default_max_memory(), 64 * mb);
  EXPECT_EQ(max_memory(), default_max_memory());
  set_max_memory(123 * mb);
  EXPECT_EQ(max_memory(), 123 * mb);
}

TEST_F(MemoryBudget, WhatFitsIsAllowedAndWhatDoesNotIsAnErrorThatSaysWhatToDo) {
  set_max_memory(memory_in_use() + 64 * mb);
  EXPECT_TRUE(check_memory(32 * mb, "a thing"));
  const Status refused = check_memory(128 * mb, "a thing");
  ASSERT_FALSE(refused);
  EXPECT_EQ(to_string(refused.errors()).find("a thing needs 0.1 GB"), 0u) << to_string(refused.errors());
  EXPECT_NE(to_string(refused.errors()).find("--max-memory"), std::string::npos);
}

TEST_F(MemoryBudget, WhatIsInUseCounts) {
  set_max_memory(memory_in_use() + 64 * mb);
  const std::vector<char> held(48 * mb, 1);
  EXPECT_FALSE(check_memory(32 * mb, "a thing")) << held.size();
}

TEST_F(MemoryBudget, SizesBeyondSixtyFourBitsNeverFit) {
  EXPECT_FALSE(check_memory(checked_product({std::uint64_t{1} << 40, std::uint64_t{1} << 40}), "a thing"));
  set_max_memory(0);
  EXPECT_EQ(memory_left(), 0u);
  EXPECT_TRUE(check_memory(1000, "a thing")) << "small ones are not looked at";
}

}  // namespace
}  // namespace parvis

#include "base/result.h"

#include <gtest/gtest.h>

#include <memory>

namespace parvis {
namespace {

Result<int> half_of(int number) {
  if (number % 2 != 0) return error_at({"numbers.xp", 3, 7}, "{} is odd; expected an even number", number);
  return number / 2;
}

TEST(Result, HoldsAValueOrErrors) {
  const Result<int> good = half_of(8), bad = half_of(7);
  ASSERT_TRUE(good);
  EXPECT_EQ(*good, 4);
  ASSERT_FALSE(bad);
  EXPECT_EQ(to_string(bad.errors()), "numbers.xp:3:7: 7 is odd; expected an even number\n");
}

TEST(Result, ValuesThatCannotBeCopiedMoveOut) {
  Result<std::unique_ptr<int>> result = std::make_unique<int>(5);
  const std::unique_ptr<int> value = *std::move(result);
  EXPECT_EQ(*value, 5);
}

TEST(Errors, PlacesLeaveOutWhatIsUnknown) {
  EXPECT_EQ(to_string(Error{"wrong", {"a.xp", 3, 0}}), "a.xp:3: wrong");
  EXPECT_EQ(to_string(Error{"wrong", {"a.xp", 0, 5}}), "a.xp: wrong");
  EXPECT_EQ(to_string(error("wrong {}", 1)), "wrong 1");
}

TEST(Errors, EachHasALineInTheOrderOfTheirDiscovery) {
  EXPECT_EQ(to_string(Errors{error("one"), error_at({"b.xp", 2, 1}, "two")}), "one\nb.xp:2:1: two\n");
}

}  // namespace
}  // namespace parvis

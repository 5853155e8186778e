#include "base/checked.h"

#include <gtest/gtest.h>

#include <limits>

namespace parvis {
namespace {

constexpr std::uint64_t largest = std::numeric_limits<std::uint64_t>::max();

TEST(Checked, SumsAndProductsThatWouldWrapAreNone) {
  EXPECT_EQ(checked_sum({}), 0u);
  EXPECT_EQ(checked_sum({largest - 1, 1}), largest);
  EXPECT_EQ(checked_sum({largest, 1}), std::nullopt);
  EXPECT_EQ(checked_product({}), 1u);
  EXPECT_EQ(checked_product({1ull << 32, (1ull << 32) - 1}), (1ull << 32) * ((1ull << 32) - 1));
  EXPECT_EQ(checked_product({1ull << 32, 1ull << 32}), std::nullopt);
  EXPECT_EQ(checked_product({1ull << 32, 1ull << 32, 0}), std::nullopt) << "whatever follows";
}

TEST(Checked, AnOffsetNearTheEndOfAllNumbersDoesNotFit) {
  EXPECT_TRUE(bytes_fit(8, 4, 12));
  EXPECT_FALSE(bytes_fit(9, 4, 12));
  EXPECT_FALSE(bytes_fit(largest - 3599, 3600, 12)) << "their sum wraps to 0";
  EXPECT_TRUE(elements_fit(4, 3, 12, 4, 32));
  EXPECT_FALSE(elements_fit(4, 3, 12, 4, 31));
  EXPECT_FALSE(elements_fit(largest - 3, 2, 4, 4, 100));
  EXPECT_FALSE(elements_fit(0, 1ull << 62, 4, 4, 100)) << "their product wraps to 0";
  EXPECT_TRUE(elements_fit(100, 0, 4, 4, 100));
  EXPECT_FALSE(elements_fit(101, 0, 4, 4, 100));
}

}  // namespace
}  // namespace parvis

#include "base/random.h"

#include <gtest/gtest.h>

#include <array>

namespace parvis {
namespace {

/// The first numbers of pcg32_srandom(42, 54), as the demonstration of O'Neill's C library prints them.
TEST(Random, IsThePublishedGenerator) {
  Random random(42, 54);
  for (const std::uint32_t expected :
       {0xa15c02b7u, 0x7b47f409u, 0xba1d3330u, 0x83d2f293u, 0xbfa4784bu, 0xcbed606eu})
    EXPECT_EQ(random.next(), expected);
}

TEST(Random, SeedsAndStreamsDiffer) {
  Random a(1), again(1), b(2), stream(1, 1);
  const std::uint32_t first = a.next();
  EXPECT_EQ(first, again.next());
  EXPECT_NE(first, b.next());
  EXPECT_NE(first, stream.next());
}

TEST(Random, NumbersStayInRangeAndFillIt) {
  Random random(3);
  std::array<int, 7> counts{};
  for (int i = 0; i < 70000; ++i) {
    const float share = random.uniform();
    ASSERT_TRUE(share >= 0.0f && share < 1.0f);
    const int index = random.index(7);
    ASSERT_TRUE(index >= 0 && index < 7);
    ++counts[std::size_t(index)];
  }
  for (const int count : counts) EXPECT_NEAR(count, 10000, 500);
}

TEST(Random, ChanceZeroNeverAndOneAlways) {
  Random random(4);
  for (int i = 0; i < 1000; ++i) {
    ASSERT_FALSE(random.chance(0.0f));
    ASSERT_TRUE(random.chance(1.0f));
  }
}

}  // namespace
}  // namespace parvis

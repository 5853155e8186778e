#include "planning/study/orders.h"

#include <gtest/gtest.h>

namespace parvis::study {
namespace {

TEST(Orders, EachConditionComesEquallyOftenInEachPlaceAndBeforeEachOther) {
  for (int conditions = 1; conditions <= 12; ++conditions) {
    const Orders orders = balanced_orders(conditions);
    EXPECT_TRUE(is_balanced(orders)) << conditions;
    EXPECT_EQ(int(orders.size()), conditions % 2 == 0 || conditions == 1 ? conditions : 2 * conditions);
  }
}

TEST(Orders, ALatinSquareThatIsNotBalancedIsRefused) {
  const Orders cyclic{{0, 1, 2, 3}, {1, 2, 3, 0}, {2, 3, 0, 1}, {3, 0, 1, 2}};
  EXPECT_FALSE(is_balanced(cyclic));
  Orders half = balanced_orders(5);
  half.resize(5);
  EXPECT_FALSE(is_balanced(half));
}

TEST(Orders, RowsThatAreNoPermutationsAreRefused) {
  EXPECT_FALSE(is_balanced({}));
  EXPECT_FALSE(is_balanced({{}}));
  EXPECT_FALSE(is_balanced({{0, 0}, {1, 1}}));
  EXPECT_FALSE(is_balanced({{0, 1}, {1}}));
  EXPECT_FALSE(is_balanced({{0, 2}, {2, 0}}));
  EXPECT_FALSE(is_balanced({{-1, 0}, {0, -1}}));
}

}  // namespace
}  // namespace parvis::study

#include "reflections/virtual_objects/bench/compared_searches.h"

#include <gtest/gtest.h>

namespace parvis::bench {
namespace {

SearchFigures figures(std::vector<std::optional<double>> angles_deg, std::vector<bool> is_told) {
  return {std::move(angles_deg), std::move(is_told), 0.0};
}

/// A point that the paper's search does not find neither divides the angles of the other nor is divided.
TEST(ComparedSearches, ComparesAnglesWhereBothFindAPoint) {
  ComparedSearches compared;
  compared.add(figures({0.1, 0.1, 50.0, std::nullopt}, {false, false, true, false}),
               figures({2.0, std::nullopt, 4.0, 4.0}, {true, true, true, true}),
               figures({1.0, 1.0, std::nullopt, 2.0}, {true, true, true, true}));
  EXPECT_EQ(compared.newton_deg, std::vector<double>{0.1});
  EXPECT_EQ(compared.beside_newton_deg, std::vector<double>{2.0});
  EXPECT_DOUBLE_EQ(compared.newton_ratio(), 0.05);
  EXPECT_EQ(compared.control_deg, (std::vector<double>{1.0, 2.0}));
  EXPECT_EQ(compared.beside_control_deg, (std::vector<double>{2.0, 4.0}));
  EXPECT_DOUBLE_EQ(compared.not_found_by_newton.percent(), 50.0);
  EXPECT_DOUBLE_EQ(compared.not_found_by_midpoint.percent(), 25.0);
}

}  // namespace
}  // namespace parvis::bench

#include "bench/virtual_objects/compared_searches.h"

#include <gtest/gtest.h>

#include "bench/report.h"

namespace parvis::bench {
namespace {

SearchFigures figures(std::vector<std::optional<double>> angles_deg, std::vector<bool> is_told) {
  return {std::move(angles_deg), std::move(is_told), 0.0};
}

/// A point that one search does not find neither divides the angles of the other nor is divided. A search
/// that flags its own point is judged by it all the same, as the paper's, which flags none.
TEST(ComparedSearches, ComparesAnglesWhereBothFindAPoint) {
  ComparedSearches compared;
  compared.add(figures({0.1, 0.1, 3.0, std::nullopt}, {false, false, true, false}),
               figures({2.0, std::nullopt, 4.0, 4.0}, {true, true, true, true}),
               figures({1.0, 1.0, std::nullopt, 2.0}, {true, true, true, true}));
  EXPECT_EQ(compared.newton_deg, (std::vector<double>{0.1, 3.0}));
  EXPECT_EQ(compared.beside_newton_deg, (std::vector<double>{2.0, 4.0}));
  EXPECT_DOUBLE_EQ(compared.newton_ratio(), 0.05);
  EXPECT_EQ(compared.control_deg, (std::vector<double>{1.0, 2.0}));
  EXPECT_EQ(compared.beside_control_deg, (std::vector<double>{2.0, 4.0}));
  EXPECT_DOUBLE_EQ(compared.not_found_by_newton.percent(), 25.0);
  EXPECT_DOUBLE_EQ(compared.not_found_by_midpoint.percent(), 25.0);
}

TEST(ComparedSearches, SearchesThatFindNothingMeetNoTarget) {
  ComparedSearches compared;
  compared.add(figures({std::nullopt}, {true}), figures({2.0}, {false}), figures({std::nullopt}, {false}));
  EXPECT_FALSE(up_to(1e9).is_met_by(compared.newton_ratio()));
  EXPECT_FALSE(up_to(1e9).is_met_by(compared.control_ratio()));
}

}  // namespace
}  // namespace parvis::bench

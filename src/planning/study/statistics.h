// Means of small samples with their confidence intervals.
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace parvis::study {

/// The mean of a sample.
struct Mean {
  int count = 0;
  double value = 0.0;                ///< 0 where there are none
  std::optional<double> deviation;   ///< standard deviation, with n - 1; none of fewer than two
  std::optional<double> half_width;  ///< of the 95 % interval by Student's t; none of fewer than two
};

/// The mean of a sample with its interval.
Mean mean_of(std::span<const double> sample);

}  // namespace parvis::study

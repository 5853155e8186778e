#include "planning/study/statistics.h"

#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <numeric>

namespace parvis::study {

Mean mean_of(std::span<const double> sample) {
  Mean mean;
  mean.count = int(sample.size());
  if (sample.empty()) return mean;
  const double n = double(sample.size());
  mean.value = std::accumulate(sample.begin(), sample.end(), 0.0) / n;
  if (sample.size() < 2) return mean;
  double squares = 0.0;
  for (const double each : sample) squares += (each - mean.value) * (each - mean.value);
  mean.deviation = std::sqrt(squares / (n - 1.0));
  mean.half_width =
      boost::math::quantile(boost::math::students_t(n - 1.0), 0.975) * *mean.deviation / std::sqrt(n);
  return mean;
}

}  // namespace parvis::study

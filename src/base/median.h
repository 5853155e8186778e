// The median of a list.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace parvis {

/// The median of `values`, the upper one of an even number; T{} where there are none.
template <class T>
T median(std::vector<T> values) {
  if (values.empty()) return T{};
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

}  // namespace parvis

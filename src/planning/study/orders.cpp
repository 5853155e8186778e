#include "planning/study/orders.h"

#include <algorithm>
#include <cstddef>
#include <map>

namespace parvis::study {

Orders balanced_orders(int conditions) {
  // The first row zigzags: 0, 1, n - 1, 2, n - 2, ...; each row after it adds one, modulo n.
  Orders orders;
  for (int row = 0; row < conditions; ++row) {
    std::vector<int>& order = orders.emplace_back();
    for (int i = 0; i < conditions; ++i)
      order.push_back((row + (i % 2 == 1 ? (i + 1) / 2 : conditions - i / 2)) % conditions);
  }
  // Of an odd number the zigzag has each pair in one direction only: the mirrored rows have the other.
  if (conditions % 2 == 1 && conditions > 1)
    for (int row = 0; row < conditions; ++row)
      orders.emplace_back(orders[std::size_t(row)].rbegin(), orders[std::size_t(row)].rend());
  return orders;
}

bool is_balanced(const Orders& orders) {
  if (orders.empty()) return false;
  const std::size_t n = orders.front().size();
  std::map<std::pair<int, int>, int> positions, pairs;  // condition and position, condition and the next one
  for (const std::vector<int>& order : orders) {
    std::vector<bool> seen(n);
    if (order.size() != n) return false;
    for (std::size_t i = 0; i < n; ++i) {
      const int condition = order[i];
      if (condition < 0 || condition >= int(n) || seen[std::size_t(condition)]) return false;
      seen[std::size_t(condition)] = true;
      ++positions[{condition, int(i)}];
      if (i + 1 < n) ++pairs[{condition, order[i + 1]}];
    }
  }
  const auto all_equal = [](const auto& counts, std::size_t kinds) {
    return counts.size() == kinds && std::ranges::all_of(counts, [&](const auto& count) {
             return count.second == counts.begin()->second;
           });
  };
  return n > 0 && all_equal(positions, n * n) && (n == 1 || all_equal(pairs, n * (n - 1)));
}

}  // namespace parvis::study

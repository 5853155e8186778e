// Orders in which the conditions of a study come: balanced Latin squares (E. J. Williams, Experimental
// designs balanced for the estimation of residual effects of treatments, 1949).
#pragma once

#include <vector>

namespace parvis::study {

/// Orders of the conditions 0 to n - 1; each row is that of one participant.
using Orders = std::vector<std::vector<int>>;

/// The orders of n >= 1 conditions that `is_balanced` accepts: n rows of an even number, 2 n of an odd one.
Orders balanced_orders(int conditions);

/// Whether each row is a permutation, each condition stands equally often in each position, and each ordered
/// pair of different conditions is adjacent equally often. Numbers of any kind and rows of any length may be
/// asked for.
bool is_balanced(const Orders& orders);

}  // namespace parvis::study

// Sums that do not depend on the order of their terms: those of pixels that threads and processes share come
// out the same, bit by bit, however they are shared. Terms are rounded to multiples of a power of two;
// doubles add such numbers exactly (after the first pass of Demmel and Nguyen, Fast Reproducible
// Floating-Point Summation, ARITH 2013).
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace parvis::trees {

/// `value` rounded to a multiple of 2^-bits. Sums of such numbers are exact while they stay below 2^(53 -
/// bits); beyond that they are rounded as sums always are. `value` may be a number or a vector of doubles, of
/// at most 2^(51 - bits).
template <int bits, class Number>
Number exact_term(Number value) {
  static_assert(bits > 0 && bits < 50);
  constexpr double shift = 1.5 * double(std::uint64_t(1) << (52 - bits));  // its last digit is 2^-bits
  return (value + shift) - shift;
}

}  // namespace parvis::trees

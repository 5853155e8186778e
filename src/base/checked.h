// Arithmetic on sizes that files claim, which cannot wrap: the one place where readers multiply and add
// numbers that they do not trust.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <optional>

namespace parvis {

/// The sum; none where it is beyond 64 bits.
inline std::optional<std::uint64_t> checked_sum(std::initializer_list<std::uint64_t> terms) {
  std::uint64_t sum = 0;
  for (const std::uint64_t term : terms)
    if (__builtin_add_overflow(sum, term, &sum)) return std::nullopt;
  return sum;
}

/// The product; none where it is beyond 64 bits.
inline std::optional<std::uint64_t> checked_product(std::initializer_list<std::uint64_t> factors) {
  std::uint64_t product = 1;
  for (const std::uint64_t factor : factors)
    if (__builtin_mul_overflow(product, factor, &product)) return std::nullopt;
  return product;
}

/// Whether `size` bytes from `offset` on lie within `available` bytes.
inline bool bytes_fit(std::uint64_t offset, std::uint64_t size, std::uint64_t available) {
  return offset <= available && size <= available - offset;
}

/// Whether `count` elements of `element` bytes, whose fronts lie `stride` bytes apart, lie within `available`
/// bytes from `offset` on.
inline bool elements_fit(std::uint64_t offset, std::uint64_t count, std::uint64_t stride,
                         std::uint64_t element, std::uint64_t available) {
  if (count == 0) return offset <= available;
  const std::optional<std::uint64_t> fronts = checked_product({count - 1, stride});
  const std::optional<std::uint64_t> size = fronts ? checked_sum({*fronts, element}) : std::nullopt;
  return size && bytes_fit(offset, *size, available);
}

}  // namespace parvis

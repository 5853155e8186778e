#include "graphics/reference/sample_sequence.h"

namespace parvis::reference {
namespace {

std::uint32_t reversed_bits(std::uint32_t x) {
  x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
  x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
  x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
  return __builtin_bswap32(x);
}

/// Hashes so that each bit depends on the lower ones only (Laine and Karras 2011, constants of Vegdahl).
std::uint32_t hashed_upward(std::uint32_t x, std::uint32_t seed) {
  x ^= x * 0x3d20adeau;
  x += seed;
  x *= (seed >> 16) | 1u;
  x ^= x * 0x05526c56u;
  x ^= x * 0x53a22864u;
  return x;
}

/// Sobol's second dimension, its bits reversed: Pascal's matrix modulo 2, as five butterflies.
std::uint32_t pascal(std::uint32_t x) {
  x ^= (x >> 1) & 0x55555555u;
  x ^= (x >> 2) & 0x33333333u;
  x ^= (x >> 4) & 0x0f0f0f0fu;
  x ^= (x >> 8) & 0x00ff00ffu;
  return x ^ (x >> 16);
}

std::uint32_t mixed(std::uint32_t a, std::uint32_t b) {
  std::uint32_t x = a ^ (b * 0x9e3779b9u + 0x7f4a7c15u);
  x = (x ^ (x >> 16)) * 0x85ebca6bu;
  x = (x ^ (x >> 13)) * 0xc2b2ae35u;
  return x ^ (x >> 16);
}

float unit(std::uint32_t bits) { return float(bits >> 8) * 0x1p-24f; }

}  // namespace

SampleSequence::SampleSequence(std::uint64_t seed, std::uint32_t pixel, std::uint32_t index)
    : hash_(mixed(mixed(std::uint32_t(seed), std::uint32_t(seed >> 32)), pixel)), index_(index) {}

glm::vec2 SampleSequence::next_2d() {
  const std::uint32_t use = mixed(hash_, ++use_);
  // Shuffles the order of the samples: aligned blocks of each power of two stay together.
  const std::uint32_t index = reversed_bits(hashed_upward(reversed_bits(index_), use));
  // The reversed digits of Sobol's numbers are scrambled upward, which is Owen's scrambling of the numbers.
  return {unit(reversed_bits(hashed_upward(index, mixed(use, 1)))),
          unit(reversed_bits(hashed_upward(pascal(index), mixed(use, 2))))};
}

}  // namespace parvis::reference

// The seed of all that is generated in a place: facades, greenery, and things and trees along kerbs.
#pragma once

#include <cstdint>

namespace parvis::synthesis {

inline constexpr std::uint64_t place_seed = 1;

}  // namespace parvis::synthesis

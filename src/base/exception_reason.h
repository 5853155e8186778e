// What a library's exception says, in words for users.
#pragma once

#include <exception>
#include <new>
#include <stdexcept>
#include <string>

namespace parvis {

/// The reason in words: that there is not enough memory, for exceptions of allocations and of containers that
/// were to have a size that a file claims; nothing in particular, for those that speak about code; else the
/// library's own words.
inline std::string reason_of(const std::exception& problem) {
  if (dynamic_cast<const std::bad_alloc*>(&problem) || dynamic_cast<const std::length_error*>(&problem))
    return "it claims more than there is memory for";
  if (dynamic_cast<const std::logic_error*>(&problem)) return "it is damaged";
  return problem.what();
}

}  // namespace parvis

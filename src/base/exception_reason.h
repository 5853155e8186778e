// Reasons of failures in words for users: of a library's exception, and of a system call.
#pragma once

#include <cerrno>
#include <cstring>
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

/// The reason of the system call that has just failed (errno).
inline std::string system_reason() { return std::strerror(errno); }

}  // namespace parvis

// How much memory a scene may take (--max-memory). Asked before anything is allocated whose size a file
// claims or a script multiplies, so that a user reads what is too large, and not that memory ran out.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "base/result.h"

namespace parvis {

/// Half of the machine's memory, in bytes; of its control group's, where that has less.
std::uint64_t default_max_memory();

/// The budget of this process, in bytes; `default_max_memory` unless set. A worker (isolated_process.h) has
/// what its caller had left.
std::uint64_t max_memory();
/// Sets the budget of this process.
void set_max_memory(std::uint64_t bytes);

/// Bytes that this process holds now.
std::uint64_t memory_in_use();
/// The budget without what is in use; 0 where it is spent.
std::uint64_t memory_left();

/// Checks the budget before `bytes` are allocated; none stands for more than 64 bits can say. It is an error
/// if there is not so much left: the message begins with `what` ("a picture of 9 x 9 pixels"), and says what
/// to do. Less than a megabyte is never an error.
Status check_memory(std::optional<std::uint64_t> bytes, std::string_view what);

}  // namespace parvis

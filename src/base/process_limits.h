// What a process may use from here on: memory, time and files. The limits hold for its children, too, and
// cannot be lifted again.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace parvis {

/// Whether the program is built with the address sanitizer, whose shadow memory takes terabytes of the
/// address space.
#if defined(__SANITIZE_ADDRESS__)
constexpr bool has_shadow_memory = true;
#elif defined(__has_feature)
constexpr bool has_shadow_memory = __has_feature(address_sanitizer);
#else
constexpr bool has_shadow_memory = false;
#endif

/// Lets this process allocate `bytes` beyond what it has. Does nothing where the program has shadow
/// memory: its address space cannot be limited.
void limit_memory(std::uint64_t bytes);

/// Ends this process after `seconds` of processor time on each of up to 64 cores, and has it write no core
/// file.
void limit_time(double seconds);

/// Lets this process open files for reading below `paths` alone, and none for writing, by Landlock. Does
/// nothing where the kernel lacks it.
void limit_files(const std::vector<std::string>& paths);

/// Whether the kernel has Landlock.
bool has_landlock();

}  // namespace parvis

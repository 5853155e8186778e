#include "base/memory_budget.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <fstream>

namespace parvis {
namespace {

constexpr std::uint64_t small_bytes = std::uint64_t{1} << 20;  // not worth a look at what is in use

std::uint64_t page_bytes() { return std::uint64_t(sysconf(_SC_PAGESIZE)); }

/// The limit that the control groups of containers set: the second version's file, then the first one's.
/// Nothing where there are none, or no limit is set ("max").
std::optional<std::uint64_t> group_limit() {
  constexpr std::array files{"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"};
  for (const char* file : files)
    if (std::uint64_t bytes = 0; std::ifstream(file) >> bytes) return bytes;
  return std::nullopt;
}

std::atomic<std::uint64_t>& budget() {
  static std::atomic<std::uint64_t> bytes = default_max_memory();
  return bytes;
}

double gigabytes(std::uint64_t bytes) { return 1e-9 * double(bytes); }

}  // namespace

std::uint64_t default_max_memory() {
  const std::uint64_t machine = std::uint64_t(sysconf(_SC_PHYS_PAGES)) * page_bytes();
  return std::min(machine, group_limit().value_or(machine)) / 2;
}

std::uint64_t max_memory() { return budget(); }

void set_max_memory(std::uint64_t bytes) { budget() = bytes; }

std::uint64_t memory_in_use() {
  std::uint64_t all_pages = 0, resident_pages = 0;
  std::ifstream("/proc/self/statm") >> all_pages >> resident_pages;
  return resident_pages * page_bytes();
}

std::uint64_t memory_left() {
  const std::uint64_t all = max_memory();
  return all - std::min(all, memory_in_use());
}

Status check_memory(std::optional<std::uint64_t> bytes, std::string_view what) {
  if (bytes && *bytes < small_bytes) return Ok{};
  const std::uint64_t left = memory_left();
  if (bytes && *bytes <= left) return Ok{};
  const std::string needed =
      bytes ? fmt::format("{:.1f} GB", gigabytes(*bytes)) : std::string("more than any machine has");
  return error(
      "{} needs {} of memory; {:.1f} of {:.1f} GB are left: make it smaller, or allow more with --max-memory",
      what, needed, gigabytes(left), gigabytes(max_memory()));
}

}  // namespace parvis

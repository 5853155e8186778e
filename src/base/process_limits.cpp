#include "base/process_limits.h"

#include <fcntl.h>
#include <linux/landlock.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <fstream>

#include "base/descriptor.h"

namespace parvis {
namespace {

std::uint64_t address_space_bytes() {
  std::uint64_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * std::uint64_t(sysconf(_SC_PAGESIZE));
}

/// The address space holds more than memory: stacks of threads, and arenas that are never filled.
constexpr std::uint64_t empty_address_space_bytes = std::uint64_t{1} << 29;

}  // namespace

void limit_memory(std::uint64_t bytes) {
  if (has_shadow_memory) return;
  const rlim_t all = address_space_bytes() + bytes + empty_address_space_bytes;
  const rlimit limit{all, all};
  setrlimit(RLIMIT_AS, &limit);
}

void limit_time(double seconds) {
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  const auto limit = 64 * (rlim_t(seconds) + 1);
  const rlimit processor_time{limit, limit};
  setrlimit(RLIMIT_CPU, &processor_time);
}

void limit_files(const std::vector<std::string>& paths) {
#if defined(SYS_landlock_create_ruleset)
  landlock_ruleset_attr rules{};
  rules.handled_access_fs = (LANDLOCK_ACCESS_FS_MAKE_SYM << 1) - 1;  // all rights of Landlock's first version
  const Descriptor ruleset(int(syscall(SYS_landlock_create_ruleset, &rules, sizeof rules, 0)));
  if (!ruleset) return;
  for (const std::string& path : paths) {
    const Descriptor place(open(path.c_str(), O_PATH | O_CLOEXEC));
    if (!place) continue;
    struct stat status {};
    fstat(place.get(), &status);
    landlock_path_beneath_attr rule{};
    rule.allowed_access = LANDLOCK_ACCESS_FS_READ_FILE;
    if (S_ISDIR(status.st_mode)) rule.allowed_access |= LANDLOCK_ACCESS_FS_READ_DIR;
    rule.parent_fd = place.get();
    syscall(SYS_landlock_add_rule, ruleset.get(), LANDLOCK_RULE_PATH_BENEATH, &rule, 0);
  }
  prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  syscall(SYS_landlock_restrict_self, ruleset.get(), 0);
#endif
}

#if defined(SYS_landlock_create_ruleset)
bool has_landlock() {
  return syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION) > 0;
}
#else
bool has_landlock() { return false; }
#endif

}  // namespace parvis

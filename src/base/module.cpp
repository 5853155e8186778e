#include "base/module.h"

#include <dlfcn.h>
#include <sys/mman.h>
#include <sys/resource.h>

#include <filesystem>
#include <map>
#include <mutex>
#include <string>

#include "base/isolated_process.h"

namespace parvis {
namespace {

/// The folder of the library that holds this code, in which modules lie.
std::filesystem::path module_folder() {
  Dl_info here{};
  dladdr(reinterpret_cast<const void*>(&module_functions), &here);
  return std::filesystem::path(here.dli_fname).parent_path();
}

/// Whether there is room for the libraries of a module. One of them starts threads while it is loaded, and
/// waits for ever where it cannot have them.
bool has_address_space() {
  constexpr std::size_t needed_bytes = std::size_t(512) << 20;
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return true;
  void* const room =
      mmap(nullptr, needed_bytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (room == MAP_FAILED) return false;
  munmap(room, needed_bytes);
  return true;
}

/// All symbols are bound at once: in the server, this spares every worker binding those that it calls.
Result<const void*> load(std::string_view name) {
  if (!has_address_space())
    return error(
        "this needs a part of Parvis ({}) for which the memory does not suffice; allow more (ulimit -v)",
        name);
  const std::filesystem::path file = module_folder() / fmt::format("parvis_{}.so", name);
  void* const module = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  const void* const functions = module == nullptr ? nullptr : dlsym(module, "parvis_functions");
  if (functions != nullptr) return functions;
  const std::string reason = dlerror();
  const bool is_short_of_memory =
      reason.find("failed to map") != std::string::npos || reason.find("annot allocate") != std::string::npos;
  return error("this needs a part of Parvis that cannot be loaded ({}); {}", reason,
               is_short_of_memory ? "allow more memory (ulimit -v)"
                                  : "install the library that is missing, or Parvis once more");
}

}  // namespace

Result<const void*> module_functions(std::string_view name) {
  static std::mutex mutex;
  static std::map<std::string, Result<const void*>, std::less<>> loaded;
  const std::scoped_lock lock(mutex);
  if (const auto known = loaded.find(name); known != loaded.end()) return known->second;
  if (is_in_worker()) end_worker_without(name);
  return loaded.emplace(name, load(name)).first->second;
}

}  // namespace parvis

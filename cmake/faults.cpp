// Preloaded into parvis by script/attack: faults that a machine may have, at a place that is named.
//
// PARVIS_FAULTS=NAME:VALUE[,NAME:VALUE...]
//   new:N        the N-th allocation by Parvis's own code, from the start of main, fails (1 is the first);
//                what libraries allocate succeeds, for several of them end the program where it fails
//   read:short   each read gives 7 bytes at most, each third is interrupted by a signal
//   write:short  each write takes 1000 bytes at most, each third is interrupted by a signal
//   write:N, fsync:N, rename:N, open:N, ftruncate:N, memfd:N, fork:N   the N-th such call by Parvis fails, as on a full
//                disk or with no descriptors or processes left
// and three that break a promise on purpose, to see that the judge of script/attack notices:
//   write:lost   writes say that they have written and write nothing
//   unlink:none  files are never removed
//   new:abort    the 2000th allocation ends the program
// PARVIS_FAULTS_COUNT=FILE writes the number of Parvis's allocations when the program ends.
// PARVIS_FAULTS_STRUCK=FILE has a byte that is 1 once a fault with a number has met the program or one of its workers.
#include <dlfcn.h>
#include <fcntl.h>
#include <link.h>
#include <sys/mman.h>
#include <sys/types.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>

namespace {

/// Where Parvis's own code lies: in the program, in the library of base and in modules.
struct Text {
  std::uintptr_t begin = 0, end = 0;
};
std::array<Text, 32> texts;
std::size_t text_count = 0;
std::atomic<bool> is_running = false;
std::atomic<long> allocations = 0;
char* struck = nullptr;  ///< in a file that is mapped: workers share it, and it stays when the program is ended

int find_text(dl_phdr_info* info, std::size_t, void* is_program) {
  bool& is_first = *static_cast<bool*>(is_program);  // the program comes first
  const bool is_parvis = is_first || std::strstr(info->dlpi_name, "/libparvis_base.so") || std::strstr(info->dlpi_name, "/parvis_");
  is_first = false;
  for (int i = 0; is_parvis && i < info->dlpi_phnum && text_count < texts.size(); ++i) {
    const auto& part = info->dlpi_phdr[i];
    if (part.p_type != PT_LOAD || (part.p_flags & PF_X) == 0) continue;
    const std::uintptr_t begin = info->dlpi_addr + part.p_vaddr;
    texts[text_count++] = {begin, begin + part.p_memsz};
  }
  return 0;
}

void find_texts() {
  bool is_first = true;
  text_count = 0;
  dl_iterate_phdr(find_text, &is_first);
}

bool is_ours(const void* caller) {
  const auto at = reinterpret_cast<std::uintptr_t>(caller);
  if (!is_running) return false;
  for (std::size_t i = 0; i < text_count; ++i)
    if (at >= texts[i].begin && at < texts[i].end) return true;
  return false;
}

/// A fault of the environment, "name:value"; the value is a word or a number.
struct Fault {
  const char* word = nullptr;
  long number = 0;

  explicit Fault(const char* name) {
    const char* all = std::getenv("PARVIS_FAULTS");
    for (const char* at = all; at != nullptr && *at != 0; at = std::strchr(at, ',') ? std::strchr(at, ',') + 1 : nullptr)
      if (std::strncmp(at, name, std::strlen(name)) == 0 && at[std::strlen(name)] == ':')
        word = at + std::strlen(name) + 1, number = std::atol(word);
  }
  bool is(const char* expected) const { return word != nullptr && std::strncmp(word, expected, std::strlen(expected)) == 0; }
};

/// True for the call that is to fail, which is noted.
bool is_due(const Fault& fault, long number) {
  if (fault.number <= 0 || number != fault.number) return false;
  if (struck != nullptr) *struck = 1;
  return true;
}
bool is_due(const Fault& fault, std::atomic<long>& calls) { return is_due(fault, ++calls); }

template <class Function>
Function* real(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

bool fails(const void* caller) {
  static const Fault fault("new");
  if (!is_ours(caller)) return false;
  const long number = ++allocations;
  if (fault.is("abort") && number == 2000) std::abort();
  return is_due(fault, number);
}

void* allocate(std::size_t size, std::size_t alignment, const void* caller) {
  if (fails(caller)) {
    if (const std::new_handler handler = std::get_new_handler()) handler();
    return nullptr;
  }
  return alignment <= alignof(std::max_align_t) ? std::malloc(size == 0 ? 1 : size)
                                                : std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
}

void* allocate_or_throw(std::size_t size, std::size_t alignment, const void* caller) {
  void* const made = allocate(size, alignment, caller);
  if (made == nullptr) throw std::bad_alloc();
  return made;
}

int (*real_main)(int, char**, char**) = nullptr;

int counted_main(int count, char** arguments, char** environment) {
  is_running = true;
  return real_main(count, arguments, environment);
}

[[gnu::constructor]] void begin() {
  find_texts();
  const char* const file = std::getenv("PARVIS_FAULTS_STRUCK");
  const int mark = file == nullptr ? -1 : open(file, O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (mark < 0 || ftruncate(mark, 1) != 0) return;
  void* const mapped = mmap(nullptr, 1, PROT_READ | PROT_WRITE, MAP_SHARED, mark, 0);
  if (mapped != MAP_FAILED) struck = static_cast<char*>(mapped);
  close(mark);
}

[[gnu::destructor]] void end() {
  const char* file = std::getenv("PARVIS_FAULTS_COUNT");
  if (file == nullptr) return;
  is_running = false;
  if (std::FILE* out = std::fopen(file, "w")) {
    std::fprintf(out, "%ld\n", allocations.load());
    std::fclose(out);
  }
}

}  // namespace

#define CALLER __builtin_return_address(0)

void* operator new(std::size_t size) { return allocate_or_throw(size, 1, CALLER); }
void* operator new[](std::size_t size) { return allocate_or_throw(size, 1, CALLER); }
void* operator new(std::size_t size, std::align_val_t a) { return allocate_or_throw(size, std::size_t(a), CALLER); }
void* operator new[](std::size_t size, std::align_val_t a) { return allocate_or_throw(size, std::size_t(a), CALLER); }
void* operator new(std::size_t size, const std::nothrow_t&) noexcept { return allocate(size, 1, CALLER); }
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept { return allocate(size, 1, CALLER); }
void operator delete(void* p) noexcept { std::free(p); }
void operator delete[](void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }
void operator delete[](void* p, std::size_t) noexcept { std::free(p); }
void operator delete(void* p, std::align_val_t) noexcept { std::free(p); }
void operator delete[](void* p, std::align_val_t) noexcept { std::free(p); }
void operator delete(void* p, std::size_t, std::align_val_t) noexcept { std::free(p); }
void operator delete[](void* p, std::size_t, std::align_val_t) noexcept { std::free(p); }

extern "C" {

int __libc_start_main(int (*main)(int, char**, char**), int count, char** arguments, void (*init)(), void (*fini)(),
                      void (*rtld_fini)(), void* stack_end) {
  using Start = int(int (*)(int, char**, char**), int, char**, void (*)(), void (*)(), void (*)(), void*);
  real_main = main;
  return real<Start>("__libc_start_main")(counted_main, count, arguments, init, fini, rtld_fini, stack_end);
}

void* dlopen(const char* file, int mode) noexcept {
  static auto* const original = real<void*(const char*, int)>("dlopen");
  void* const opened = original(file, mode);
  find_texts();  // a module
  return opened;
}

ssize_t read(int file, void* bytes, std::size_t size) {
  static const Fault fault("read");
  static auto* const original = real<ssize_t(int, void*, std::size_t)>("read");
  static std::atomic<long> calls = 0;
  if (!is_ours(CALLER) || !fault.is("short")) return original(file, bytes, size);
  if (++calls % 3 == 0) return errno = EINTR, -1;
  return original(file, bytes, size < 7 ? size : 7);
}

ssize_t write(int file, const void* bytes, std::size_t size) {
  static const Fault fault("write");
  static auto* const original = real<ssize_t(int, const void*, std::size_t)>("write");
  static std::atomic<long> calls = 0;
  if (!is_ours(CALLER) || fault.word == nullptr) return original(file, bytes, size);
  if (fault.is("lost")) return ssize_t(size);
  if (fault.is("short")) {
    if (++calls % 3 == 0) return errno = EINTR, -1;
    return original(file, bytes, size < 1000 ? size : 1000);
  }
  if (is_due(fault, calls)) return errno = ENOSPC, -1;
  return original(file, bytes, size);
}

int fsync(int file) {
  static const Fault fault("fsync");
  static auto* const original = real<int(int)>("fsync");
  static std::atomic<long> calls = 0;
  return is_due(fault, calls) ? (errno = EIO, -1) : original(file);
}

int rename(const char* from, const char* to) noexcept {
  static const Fault fault("rename");
  static auto* const original = real<int(const char*, const char*)>("rename");
  static std::atomic<long> calls = 0;
  return is_due(fault, calls) ? (errno = ENOSPC, -1) : original(from, to);
}

int unlink(const char* path) noexcept {
  static const Fault fault("unlink");
  static auto* const original = real<int(const char*)>("unlink");
  return fault.is("none") ? 0 : original(path);
}

int open(const char* path, int flags, ...) {
  static const Fault fault("open");
  static auto* const original = real<int(const char*, int, ...)>("open");
  static std::atomic<long> calls = 0;
  va_list more;
  va_start(more, flags);
  const mode_t mode = (flags & (O_CREAT | O_TMPFILE)) != 0 ? mode_t(va_arg(more, int)) : 0;
  va_end(more);
  if (is_ours(CALLER) && is_due(fault, calls)) return errno = EMFILE, -1;
  return original(path, flags, mode);
}

int ftruncate(int file, off_t size) noexcept {
  static const Fault fault("ftruncate");
  static auto* const original = real<int(int, off_t)>("ftruncate");
  static std::atomic<long> calls = 0;
  return is_ours(CALLER) && is_due(fault, calls) ? (errno = ENOSPC, -1) : original(file, size);
}

int memfd_create(const char* name, unsigned flags) noexcept {
  static const Fault fault("memfd");
  static auto* const original = real<int(const char*, unsigned)>("memfd_create");
  static std::atomic<long> calls = 0;
  return is_ours(CALLER) && is_due(fault, calls) ? (errno = EMFILE, -1) : original(name, flags);
}

pid_t fork() noexcept {
  static const Fault fault("fork");
  static auto* const original = real<pid_t()>("fork");
  static std::atomic<long> calls = 0;
  return is_ours(CALLER) && is_due(fault, calls) ? (errno = EAGAIN, -1) : original();
}

}  // extern "C"

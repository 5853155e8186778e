#include "base/partial_file.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <random>
#include <utility>

#include "base/exception_reason.h"

namespace parvis {
namespace {
namespace fs = std::filesystem;

Error cannot_write(const fs::path& file) {
  return error("{}: cannot be written ({}); is the folder writable and the disk not full?", file.string(),
               system_reason());
}

/// The signals after which the program still removes what it was writing.
constexpr std::array ending_signals = {SIGINT, SIGTERM, SIGHUP};

/// Paths of partial files where a signal handler finds them: it may not touch what allocates.
struct Slot {
  std::atomic<bool> is_taken = false, is_listed = false;
  std::array<char, PATH_MAX> path{};
};
std::array<Slot, 64> slots;

/// The slot that lists the file; -1 where all are taken.
int list(const std::string& path) {
  if (path.size() >= PATH_MAX) return -1;
  for (std::size_t i = 0; i < slots.size(); ++i) {
    if (slots[i].is_taken.exchange(true)) continue;
    std::memcpy(slots[i].path.data(), path.c_str(), path.size() + 1);
    slots[i].is_listed = true;
    return int(i);
  }
  return -1;
}

/// Set when the program ends by a signal: from then on nobody makes files that would be left.
std::atomic<bool> is_ending = false;

/// Waits where the program is ending; called before anything is taken off the list.
void wait_for_the_end() {
  while (is_ending) pause();
}

/// How many threads are making what the list names: the end waits for them, since a thread may rest for long
/// between its look at is_ending and its call of the kernel.
std::atomic<int> making = 0;

/// A thread is making something. Signals that end the program wait, or go to another thread: their handler
/// would wait for the thread that it interrupts.
class Making {
 public:
  Making() {
    sigset_t ending;
    sigemptyset(&ending);
    for (const int number : ending_signals) sigaddset(&ending, number);
    pthread_sigmask(SIG_BLOCK, &ending, &before_);
    ++making;
    if (!is_ending) return;
    --making;
    wait_for_the_end();
  }
  ~Making() {
    --making;
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  Making(const Making&) = delete;
  Making& operator=(const Making&) = delete;

 private:
  sigset_t before_;
};

void unlist(int slot) {
  if (slot < 0) return;
  wait_for_the_end();
  slots[std::size_t(slot)].is_listed = false;
  slots[std::size_t(slot)].is_taken = false;
}

/// A record of a folder as the kernel gives it (getdents64).
struct FolderRecord {
  std::uint64_t inode;
  std::int64_t offset;
  std::uint16_t bytes;
  unsigned char kind;
  char name[1];
};

/// Removes a folder without the library's functions, which allocate; a signal handler must not. Returns false
/// where something is left in it.
bool remove_folder_in_signal(const char* path) {
  alignas(FolderRecord) static std::array<char, 16384> records;
  const int folder = open(path, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (folder < 0) return true;
  for (long size = 0; (size = syscall(SYS_getdents64, folder, records.data(), records.size())) > 0;)
    for (long at = 0; at < size;) {
      const auto* record = reinterpret_cast<const FolderRecord*>(records.data() + at);
      unlinkat(folder, record->name, 0);
      at += record->bytes;
    }
  close(folder);
  return rmdir(path) == 0 || errno == ENOENT;
}

/// Removes all listed files and folders; false where one of them is left.
bool remove_listed() {
  bool is_gone = true;
  for (const Slot& slot : slots)
    if (slot.is_listed && unlink(slot.path.data()) != 0)
      is_gone = remove_folder_in_signal(slot.path.data()) && is_gone;
  return is_gone;
}

void on_signal(int) {
  if (is_ending) return;  // another thread is about to end it
  remove_partial_files_and_end("parvis: interrupted; what was being written is removed\n");
}

constexpr std::size_t random_digits = 8;

/// Whether `name` is one of those that make_listed gives: "original" in place of the digits is somebody's
/// own.
bool is_made_name(std::string_view name, std::string_view front, std::string_view back) {
  return name.starts_with(front) && name.ends_with(back) &&
         name.size() == front.size() + random_digits + back.size() &&
         name.substr(front.size(), random_digits).find_first_not_of("0123456789abcdef") ==
             std::string_view::npos;
}

/// Removes what a program that was killed has left in a folder, of names with this front and back and random
/// digits between them. Errors are ignored: it is only in the way.
void remove_abandoned(const fs::path& folder, std::string_view front, std::string_view back) {
  std::error_code code;
  std::vector<fs::path> left;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder.empty() ? "." : folder, code))
    if (is_made_name(entry.path().filename().string(), front, back) && is_abandoned(entry.path()))
      left.push_back(entry.path());
  for (const fs::path& path : left) fs::remove_all(path, code);
}

/// Locks what was just made, so that others see that somebody works on it. False where another program was
/// faster and has taken it for abandoned.
bool lock_made(int file) {
  struct stat status {};
  return flock(file, LOCK_EX | LOCK_NB) == 0 && fstat(file, &status) == 0 && status.st_nlink > 0;
}

/// Something new in a folder: its path, how it is listed, and the lock on it.
struct Made {
  fs::path path;
  int slot = -1, lock = -1;
};

/// Makes something whose name is `front`, random digits and `back`. It is listed before it is there, for a
/// signal between the two would leave it. `make` says its descriptor, or -1 and why in errno. No path where
/// none can be made.
Made make_listed(const fs::path& folder, std::string_view front, std::string_view back,
                 int (*make)(const char* path)) {
  std::error_code code;
  std::random_device random;
  for (int attempt = 0; attempt < 100; ++attempt) {
    Made made{folder / fmt::format("{}{:08x}{}", front, std::uint32_t(random()), back)};
    int why = 0;
    {
      const Making until_it_is_there;
      made.slot = list(fs::absolute(made.path, code).string());
      made.lock = make(made.path.c_str());
      why = errno;
    }
    if (made.lock >= 0 && lock_made(made.lock)) return made;
    // Who has taken it for abandoned may be ended before it removes it.
    if (made.lock >= 0) fs::remove(made.path, code);
    unlist(made.slot);
    if (made.lock >= 0)
      close(made.lock);
    else if (why != EEXIST)
      break;
    errno = why;
  }
  return {};
}

/// A new, empty file of a name that fits into a folder; no path if none can be made.
Made make_partial(const fs::path& file) {
  constexpr std::size_t max_name = 255;
  const std::string extension = file.extension().string(), front = ".partial-";
  std::string stem = file.stem().string();
  const std::size_t around = front.size() + random_digits + 1 + extension.size();
  if (around > max_name) return {};
  stem.resize(std::min(stem.size(), max_name - around));
  remove_abandoned(file.parent_path(), front, "-" + stem + extension);
  return make_listed(file.parent_path(), front, "-" + stem + extension, [](const char* path) {
    return open(path, O_CREAT | O_EXCL | O_NOFOLLOW | O_WRONLY | O_CLOEXEC, 0666);
  });
}

/// The path that a chain of links ends at; what it names may be absent. Empty if the chain is a loop.
fs::path end_of_links(fs::path path) {
  constexpr int max_links = 40;  // as the kernel's
  std::error_code code;
  for (int i = 0; i < max_links && fs::is_symlink(path, code); ++i) {
    path = path.parent_path() / fs::read_symlink(path, code);
    path = fs::weakly_canonical(fs::absolute(path, code).parent_path(), code) / path.filename();
  }
  return fs::is_symlink(path, code) ? fs::path() : path;
}

/// The file that is replaced: what a link points to, if that lies below the link's folder.
Result<fs::path> target_of(const fs::path& named) {
  std::error_code code;
  if (!fs::is_symlink(named, code)) return named;
  const fs::path target = end_of_links(named);
  const fs::path folder = fs::weakly_canonical(fs::absolute(named, code).parent_path(), code);
  const fs::path inside = target.lexically_relative(folder);
  if (inside.empty() || *inside.begin() == "..")
    return error(
        "{}: is a link that leads out of its folder, and is not written through; remove it, or name "
        "the file that it points to",
        named.string());
  return target;
}

}  // namespace

bool is_abandoned(const fs::path& path) {
  const int file = open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (file < 0) return false;
  const bool is_free = flock(file, LOCK_EX | LOCK_NB) == 0;
  close(file);
  return is_free;
}

Result<PartialFile> PartialFile::create(const fs::path& named) {
  std::error_code code;
  const Result<fs::path> target = target_of(named);
  if (!target) return target.errors();
  const fs::path& file = *target;
  if (const fs::path folder = file.parent_path(); !folder.empty()) {
    const Making until_it_is_there;  // the end may have removed it
    fs::create_directories(folder, code);
  }
  if (code)
    return error("{}: the folder cannot be made ({}); choose one that can be written",
                 file.parent_path().string(), code.message());
  struct stat before {};
  if (stat(file.c_str(), &before) == 0 && !S_ISREG(before.st_mode))
    return error("{}: is not a regular file and is not replaced", file.string());
  Made partial = make_partial(file);
  if (partial.path.empty()) return cannot_write(file);
  return PartialFile(file, std::move(partial.path), partial.slot, partial.lock);
}

PartialFile::PartialFile(PartialFile&& other) noexcept
    : file_(std::move(other.file_)),
      partial_(std::exchange(other.partial_, {})),
      slot_(std::exchange(other.slot_, -1)),
      lock_(std::exchange(other.lock_, -1)) {}

PartialFile::~PartialFile() {
  if (!partial_.empty()) unlink(partial_.c_str());
  unlist(slot_);
  if (lock_ >= 0) close(lock_);
}

Status PartialFile::write(std::string_view bytes) const {
  const int file = open(partial_.c_str(), O_WRONLY | O_TRUNC | O_NOFOLLOW | O_CLOEXEC);
  if (file < 0) return cannot_write(file_);
  bool is_written = true;
  while (is_written && !bytes.empty()) {
    const ssize_t count = ::write(file, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    is_written = count > 0;
    if (is_written) bytes.remove_prefix(std::size_t(count));
  }
  Status status = is_written ? Status(Ok{}) : Status(cannot_write(file_));
  if (close(file) != 0 && is_written) return cannot_write(file_);
  return status;
}

Status PartialFile::sync() const {
  const int written = open(partial_.c_str(), O_RDONLY | O_CLOEXEC);
  if (written < 0) return cannot_write(file_);
  const bool is_on_disk = fsync(written) == 0;
  Status status = is_on_disk ? Status(Ok{}) : Status(cannot_write(file_));
  close(written);
  return status;
}

Status PartialFile::keep() {
  if (Status status = sync(); !status) return status;
  struct stat before {};
  if (stat(file_.c_str(), &before) == 0 && chmod(partial_.c_str(), before.st_mode & 07777) != 0)
    return cannot_write(file_);
  if (rename(partial_.c_str(), file_.c_str()) != 0) return cannot_write(file_);
  partial_.clear();
  unlist(std::exchange(slot_, -1));
  return Ok{};
}

Result<PartialFolder> PartialFolder::create(const fs::path& folder) {
  const std::string front = ".unfinished-";
  remove_abandoned(folder, front, "");
  Made made = make_listed(folder, front, "", [](const char* path) {
    if (mkdir(path, 0744) != 0) return -1;
    const int lock = open(path, O_RDONLY | O_NOFOLLOW | O_CLOEXEC);
    if (lock < 0) rmdir(path);
    return lock;
  });
  if (made.path.empty()) return cannot_write(folder);
  return PartialFolder(std::move(made.path), made.slot, made.lock);
}

PartialFolder::PartialFolder(PartialFolder&& other) noexcept
    : folder_(std::move(other.folder_)),
      slot_(std::exchange(other.slot_, -1)),
      lock_(std::exchange(other.lock_, -1)) {
  other.folder_.clear();
}

PartialFolder::~PartialFolder() {
  std::error_code code;
  if (!folder_.empty()) fs::remove_all(folder_, code);
  unlist(slot_);
  if (lock_ >= 0) close(lock_);
}

void remove_partial_files_and_end(std::string_view message) {
  if (is_ending.exchange(true)) wait_for_the_end();  // another thread is about to
  constexpr int max_times = 500;
  for (int time = 0; making > 0 && time < max_times; ++time) poll(nullptr, 0, 1);
  // Threads that write into a listed folder may still do so: again, until nothing is left.
  for (int time = 0; !remove_listed() && time < max_times; ++time) poll(nullptr, 0, 1);
  const ssize_t ignored = ::write(STDERR_FILENO, message.data(), message.size());
  static_cast<void>(ignored);
  _exit(1);
}

void remove_partial_files_on_signals() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  for (const int number : ending_signals) sigaction(number, &action, nullptr);
}

}  // namespace parvis

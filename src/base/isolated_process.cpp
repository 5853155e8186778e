#include "base/isolated_process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <mutex>
#include <new>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "base/descriptor.h"
#include "base/memory_budget.h"
#include "base/module.h"
#include "base/process_limits.h"

namespace parvis {
namespace {

enum class Outcome : char {
  begins_inner_work = 'i',  ///< sent before any other: the work has called run_isolated
  ended_inner_work = 'e',   ///< sent after it: that call returns
  done = 'd',
  failed = 'f',
  gave_up = 'g',
  out_of_memory = 'm',
  lacks_module = 'l'  ///< its name follows
};

/// The name of a module as it travels, ended by a zero; empty: none.
using ModuleName = std::array<char, 32>;
constexpr int max_modules = 8;  ///< that one work may ask for

ModuleName module_name(std::string_view name) {
  ModuleName letters{};
  std::ranges::copy(name.substr(0, letters.size() - 1), letters.begin());
  return letters;
}

/// A worker's message is not trusted: its name becomes that of a file.
bool is_module_name(const ModuleName& name) {
  const auto end = std::ranges::find(name, '\0');
  return end != name.begin() && end != name.end() &&
         std::all_of(name.begin(), end, [](char c) { return c >= 'a' && c <= 'z'; });
}

/// A request as it travels to the server, with three descriptors: input, output, status.
struct Request {
  IsolatedWork work;
  std::uint64_t memory_bytes;
  double seconds;
  bool isolates_inner_work;      ///< in processes of its own; else it runs in the worker
  ModuleName module;             ///< that the server loads first
  std::uint32_t readable_bytes;  ///< of the input's front: paths that may be read, each ended by a zero
};

/// Sent by the worker when it starts, so that its caller can end it.
struct Started {
  pid_t worker;
};

constexpr std::size_t descriptors_per_request = 3;
using Descriptors = std::array<int, descriptors_per_request>;

bool send_request(int socket, const Request& request, const Descriptors& descriptors) {
  iovec part{const_cast<Request*>(&request), sizeof request};
  alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(Descriptors))> control{};
  msghdr message{};
  message.msg_iov = &part;
  message.msg_iovlen = 1;
  message.msg_control = control.data();
  message.msg_controllen = control.size();
  cmsghdr* header = CMSG_FIRSTHDR(&message);
  header->cmsg_level = SOL_SOCKET;
  header->cmsg_type = SCM_RIGHTS;
  header->cmsg_len = CMSG_LEN(sizeof descriptors);
  std::memcpy(CMSG_DATA(header), descriptors.data(), sizeof descriptors);
  ssize_t sent = 0;
  do sent = sendmsg(socket, &message, MSG_NOSIGNAL);
  while (sent < 0 && errno == EINTR);
  return sent == ssize_t(sizeof request);
}

/// False when the program has ended.
bool receive_request(int socket, Request& request, Descriptors& descriptors) {
  iovec part{&request, sizeof request};
  alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(Descriptors))> control{};
  msghdr message{};
  message.msg_iov = &part;
  message.msg_iovlen = 1;
  message.msg_control = control.data();
  message.msg_controllen = control.size();
  ssize_t received = 0;
  do received = recvmsg(socket, &message, MSG_CMSG_CLOEXEC);
  while (received < 0 && errno == EINTR);
  const cmsghdr* header = CMSG_FIRSTHDR(&message);
  if (received != ssize_t(sizeof request) || header == nullptr) return false;
  std::memcpy(descriptors.data(), CMSG_DATA(header), sizeof descriptors);
  return true;
}

std::string_view map_whole(int file) {
  struct stat status {};
  if (fstat(file, &status) != 0 || status.st_size == 0) return {};
  void* const bytes = mmap(nullptr, std::size_t(status.st_size), PROT_READ, MAP_SHARED, file, 0);
  if (bytes == MAP_FAILED) return {};
  return {static_cast<const char*>(bytes), std::size_t(status.st_size)};
}

void fill(IsolatedOutput& output, std::string_view text) {
  const std::span<std::byte> bytes = output.allocate(text.size());
  if (bytes.size() == text.size()) std::memcpy(bytes.data(), text.data(), text.size());
}

/// Errors travel as their messages, each ended by a zero: places in files are part of the caller's knowledge.
Outcome fail(const Errors& errors, IsolatedOutput& output) {
  std::string text;
  for (const Error& error : errors) text += to_string(error) + '\0';
  fill(output, text);
  return Outcome::failed;
}

Outcome carry_out(IsolatedWork work, std::string_view input, IsolatedOutput& output) {
  try {
    const Status status = work(input, output);
    return status ? Outcome::done : fail(status.errors(), output);
  } catch (const std::bad_alloc&) {
    return Outcome::out_of_memory;
  } catch (const std::length_error&) {  // of a container that was to have a size that the file claims
    return Outcome::out_of_memory;
  } catch (const std::logic_error&) {  // its text is about code, not about the file
    return Outcome::gave_up;
  } catch (const std::exception& problem) {
    fill(output, problem.what());
    return Outcome::gave_up;
  } catch (...) {
    return Outcome::gave_up;
  }
}

/// Whether this process is a worker: it has no server, and forks workers of its own where inner work is
/// isolated.
bool is_worker = false;
bool isolates_inner_work = true;
int status_of_worker = -1;                            ///< where the worker writes its outcome
std::chrono::steady_clock::time_point end_of_worker;  ///< when its caller ends it

/// Counts open requests of a thread to work without isolation, which measures its cost.
thread_local int without_isolation = 0;

/// Replaces the work of a thread in tests; null elsewhere.
thread_local IsolatedWork other_work = nullptr;
thread_local double max_seconds_of_other_work = 0.0;

std::chrono::steady_clock::time_point deadline_after(double seconds) {
  return std::chrono::steady_clock::now() +
         std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::duration<double>(seconds));
}

/// Time limit of inner work in a process of its own: half of what its worker has left, so that work which
/// hangs does not take its worker with it.
double seconds_of_inner_work(double limit_s) {
  const std::chrono::duration<double> left = end_of_worker - std::chrono::steady_clock::now();
  return std::min(limit_s, std::max(0.0, left.count() / 2.0));
}

bool note(Outcome outcome) {
  return ::write(status_of_worker, &outcome, sizeof outcome) == ssize_t(sizeof outcome);
}

[[noreturn]] void be_worker(const Request& request, const Descriptors& descriptors) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  is_worker = true, isolates_inner_work = request.isolates_inner_work, status_of_worker = descriptors[2];
  end_of_worker = deadline_after(request.seconds);
  const Started started{getpid()};
  if (::write(descriptors[2], &started, sizeof started) != ssize_t(sizeof started)) _exit(1);
  std::atexit([] { _exit(1); });  // a reader that calls exit must not run into the program's destructors
  limit_time(request.seconds);    // the caller watches the clock

  const std::string_view all = map_whole(descriptors[0]);
  std::vector<std::string> readable;
  for (std::string_view paths = all.substr(0, request.readable_bytes); !paths.empty();) {
    readable.emplace_back(paths.data());
    paths.remove_prefix(std::min(paths.size(), readable.back().size() + 1));
  }
  limit_memory(request.memory_bytes);  // first: it asks how much there is already
  set_max_memory(memory_in_use() + request.memory_bytes);
  limit_files(readable);
  IsolatedOutput output(descriptors[1]);
  const Outcome outcome = carry_out(request.work, all.substr(request.readable_bytes), output);
  _exit(note(outcome) ? 0 : 1);  // no destructors: they are the program's
}

/// Forks a worker that waits for its request on the socket whose other end is returned; none where it cannot
/// be forked. It ends with the server, whose own socket it does not keep.
Descriptor forked_spare(int server_socket) {
  std::array<int, 2> ends{};
  if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) != 0) return Descriptor();
  Descriptor server_end(ends[0]);
  const Descriptor worker_end(ends[1]);
  const pid_t child = fork();
  if (child < 0) return Descriptor();
  if (child > 0) return server_end;
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  close(server_socket);
  server_end = Descriptor();
  Request request{};
  Descriptors descriptors{};
  if (!receive_request(worker_end.get(), request, descriptors)) _exit(0);
  be_worker(request, descriptors);
}

[[noreturn]] void be_server(int socket) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  signal(SIGCHLD, SIG_IGN);  // workers leave no zombies
  signal(SIGINT, SIG_IGN);   // the program decides when its server ends
  // What the program has open is none of the workers' business; an inherited end of a pipe would keep its
  // reader waiting.
  const Descriptor nothing(open("/dev/null", O_RDWR));
  for (int each = STDERR_FILENO + 1; each < int(sysconf(_SC_OPEN_MAX)) && each < 4096; ++each)
    if (each != socket && each != nothing.get()) close(each);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(nothing.get(), stream);
  Request request{};
  Descriptors descriptors{};
  Descriptor spare = forked_spare(socket);
  while (receive_request(socket, request, descriptors)) {
    if (request.module[0] != '\0') {
      std::ignore = module_functions(request.module.data());  // workers report what it says
      spare = Descriptor();                                   // it has no such module
    }
    if (!spare || !send_request(spare.get(), request, descriptors)) {  // none, or somebody has ended it
      spare = forked_spare(socket);
      if (spare) send_request(spare.get(), request, descriptors);
    }
    for (const int descriptor : descriptors) close(descriptor);  // no worker: the caller reads an end of file
    spare = Descriptor();
    spare = forked_spare(socket);  // while the other one works
  }
  _exit(0);
}

/// The count stands in memory that the program shares with its workers, if it is asked for before they are
/// forked.
std::atomic<std::uint64_t>& worker_count() {
  static std::atomic<std::uint64_t>& count = []() -> std::atomic<std::uint64_t>& {
    static std::atomic<std::uint64_t> own{0};  // where no memory can be shared
    void* const shared = mmap(nullptr, sizeof own, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    return shared == MAP_FAILED ? own : *new (shared) std::atomic<std::uint64_t>(0);
  }();
  return count;
}

/// The program's end of the socket to the server; -1 where none can be had.
int server_socket() {
  static const int socket = [] {
    worker_count();
    std::array<int, 2> ends{};
    if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) != 0) return -1;
    const pid_t child = fork();
    if (child == 0) {
      close(ends[0]);
      be_server(ends[1]);
    }
    close(ends[1]);
    return child < 0 ? -1 : ends[0];
  }();
  return socket;
}

/// Has a worker begin with the request.
bool start_worker(const Request& request, const Descriptors& descriptors) {
  ++worker_count();
  if (!is_worker) return send_request(server_socket(), request, descriptors);
  const pid_t child = fork();
  if (child == 0) be_worker(request, descriptors);
  return child > 0;
}

/// Once: the readers' own checks of paths still hold.
void warn_without_landlock() {
  static std::once_flag once;
  std::call_once(once, [] {
    if (!is_worker && !has_landlock())
      fmt::print(stderr,
                 "parvis: this kernel has no Landlock: readers of files are kept to their folders by "
                 "Parvis alone, not by the system\n");
  });
}

Descriptor memory_file(const char* name) { return Descriptor(memfd_create(name, MFD_CLOEXEC)); }

bool write_all(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes.remove_prefix(std::size_t(written));
  }
  return true;
}

/// Reads a value that the worker sends before the deadline; false at its end or too late.
template <class T>
bool receive(int status, T& value, std::chrono::steady_clock::time_point deadline, bool& is_late) {
  for (;;) {
    const auto left =
        std::chrono::ceil<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now());
    pollfd waiting{status, POLLIN, 0};
    const int ready = poll(&waiting, 1, int(std::max<std::int64_t>(0, left.count())));
    if (ready < 0 && errno == EINTR) continue;
    is_late = ready == 0;
    return ready > 0 && read(status, &value, sizeof value) == ssize_t(sizeof value);
  }
}

Errors errors_of(std::span<const std::byte> bytes, const std::string& subject) {
  Errors errors;
  std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\0'), text.size());
    errors.push_back(error("{}", text.substr(0, end)));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  if (errors.empty()) errors.push_back(error("{}: cannot be read", subject));
  return errors;
}

/// How a run of some work has ended.
enum class End { whole, crashed, late, not_started };

struct Attempt {
  End end = End::not_started;
  Outcome outcome{};   ///< of one that is whole
  ModuleName lacks{};  ///< the module that its outcome speaks of
  bool has_inner_work = false;
  int open_inner_works = 0;  ///< that had not returned at its end
  Descriptor made;           ///< the file in memory with its output
  std::uint64_t memory_bytes = 0;
  double seconds = 0.0;  ///< that it had
  int cause = 0;         ///< errno of one that was not started
};

using Input = std::array<std::string_view, 2>;

/// Runs the work in this process.
Attempt run_here(IsolatedWork work, const Input& input) {
  Attempt attempt;
  attempt.memory_bytes = memory_left();
  attempt.made = memory_file("output");
  attempt.cause = errno;
  if (!attempt.made) return attempt;
  IsolatedOutput output(attempt.made.get());
  std::string joined;
  if (!input[1].empty()) joined.append(input[0]).append(input[1]);
  attempt.outcome = carry_out(work, joined.empty() ? input[0] : joined, output);
  attempt.end = End::whole;
  return attempt;
}

/// Runs the work in a worker that has `module`, and whose own calls of run_isolated start workers, too, where
/// `isolates_inner`.
Attempt run_in_worker(IsolatedWork work, const Input& input, const IsolationLimits& limits,
                      bool isolates_inner, const ModuleName& module) {
  start_isolation();
  Attempt attempt;
  attempt.memory_bytes = std::min(limits.memory_bytes, memory_left());
  std::string readable;
  for (const std::filesystem::path& path : limits.readable) readable += path.string() + '\0';
  const Descriptor given = memory_file("input");
  attempt.made = memory_file("output");
  std::array<int, 2> status{-1, -1};
  const bool has_pipe = pipe2(status.data(), O_CLOEXEC) == 0;
  const Descriptor status_out(status[0]);
  Descriptor status_in(status[1]);
  attempt.seconds = is_worker ? seconds_of_inner_work(limits.seconds) : limits.seconds;
  const Request request{work,   attempt.memory_bytes,          attempt.seconds, isolates_inner,
                        module, std::uint32_t(readable.size())};
  warn_without_landlock();
  if (!given || !attempt.made || !has_pipe || !write_all(given.get(), readable) ||
      !write_all(given.get(), input[0]) || !write_all(given.get(), input[1]) ||
      !start_worker(request, {given.get(), attempt.made.get(), status_in.get()})) {
    attempt.cause = errno;
    return attempt;
  }
  status_in = Descriptor();  // so that the worker's end is the last one

  const auto deadline = deadline_after(request.seconds);
  bool is_late = false;
  Started started{};
  const bool has_started = receive(status_out.get(), started, deadline, is_late);
  bool has_ended = has_started && receive(status_out.get(), attempt.outcome, deadline, is_late);
  while (has_ended &&
         (attempt.outcome == Outcome::begins_inner_work || attempt.outcome == Outcome::ended_inner_work)) {
    attempt.has_inner_work = true;
    attempt.open_inner_works += attempt.outcome == Outcome::begins_inner_work ? 1 : -1;
    has_ended = receive(status_out.get(), attempt.outcome, deadline, is_late);
  }
  if (has_ended && attempt.outcome == Outcome::lacks_module)
    has_ended = receive(status_out.get(), attempt.lacks, deadline, is_late) && is_module_name(attempt.lacks);
  attempt.end = has_ended ? End::whole : is_late ? End::late : End::crashed;
  if (is_late && has_started) kill(started.worker, SIGKILL);
  return attempt;
}

/// Runs the work in workers that have the modules that the work asks for, one after the other.
Attempt run_with_modules(IsolatedWork work, const Input& input, const IsolationLimits& limits,
                         bool isolates_inner) {
  ModuleName module{};
  for (int asked = 0;; ++asked) {
    Attempt attempt = run_in_worker(work, input, limits, isolates_inner, module);
    if (attempt.end != End::whole || attempt.outcome != Outcome::lacks_module) return attempt;
    if (is_worker) end_worker_without(attempt.lacks.data());
    module = attempt.lacks;
    if (asked < max_modules) continue;
    attempt.end = End::crashed;
    return attempt;
  }
}

/// Turns an attempt into the caller's bytes or error.
Result<IsolatedBytes> result_of(Attempt attempt, const std::string& subject, bool writes) {
  const std::string_view worker = writes ? "writer" : "reader";
  if (attempt.end == End::not_started)
    return error("{}: no child process can be started for its {} ({})", subject, worker,
                 std::strerror(attempt.cause));
  if (attempt.end == End::late)
    return error("{}: its {} took more than {:.0f} s and was ended", subject, worker, attempt.seconds);
  if (attempt.end == End::crashed && writes)
    return error("{}: its writer crashed; choose another format or a smaller picture", subject);
  if (attempt.end == End::crashed)
    return error("{}: its reader crashed; the file is damaged or made to do harm", subject);
  if (attempt.outcome == Outcome::out_of_memory)
    return error(
        "{}: {} it needs more than {:.1f} GB of memory; use a smaller one, or allow more with "
        "--max-memory",
        subject, writes ? "writing" : "reading", double(attempt.memory_bytes) / 1e9);
  IsolatedBytes result(attempt.made.release());
  if (attempt.outcome == Outcome::gave_up) {
    const std::string_view reason(reinterpret_cast<const char*>(result.bytes().data()),
                                  result.bytes().size());
    return error("{}: its {} gave up{}{}{}", subject, worker, reason.empty() ? "" : ": ", reason,
                 writes ? "" : "; the file is damaged");
  }
  if (attempt.outcome == Outcome::failed) return errors_of(result.bytes(), subject);
  return result;
}

}  // namespace

IsolatedOutput::~IsolatedOutput() {
  if (!mapped_.empty()) munmap(mapped_.data(), mapped_.size());
}

std::span<std::byte> IsolatedOutput::allocate(std::size_t size) {
  if (!mapped_.empty()) munmap(mapped_.data(), mapped_.size());
  mapped_ = {};
  if (ftruncate(file_, 0) != 0 || ftruncate(file_, off_t(size)) != 0 || size == 0) return {};
  void* const bytes = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED, file_, 0);
  if (bytes == MAP_FAILED) return {};
  return mapped_ = {static_cast<std::byte*>(bytes), size};
}

IsolatedBytes::IsolatedBytes(int file) : file_(file) {
  const std::string_view all = map_whole(file);
  mapped_ = std::as_bytes(std::span(all.data(), all.size()));
}

IsolatedBytes::IsolatedBytes(IsolatedBytes&& other) noexcept
    : file_(std::exchange(other.file_, -1)), mapped_(std::exchange(other.mapped_, {})) {}

IsolatedBytes::~IsolatedBytes() {
  if (!mapped_.empty()) munmap(const_cast<std::byte*>(mapped_.data()), mapped_.size());
  if (file_ >= 0) close(file_);
}

bool is_in_worker() { return is_worker; }

void end_worker_without(std::string_view module) {
  const ModuleName name = module_name(module);
  const bool is_noted = note(Outcome::lacks_module) &&
                        ::write(status_of_worker, name.data(), name.size()) == ssize_t(name.size());
  _exit(is_noted ? 0 : 1);
}

std::uint64_t begun_workers() { return worker_count(); }

void start_isolation() {
  if (!is_worker) server_socket();
}

Result<IsolatedBytes> run_isolated(IsolatedWork work, std::string_view input, const std::string& subject,
                                   const IsolationLimits& limits) {
  return run_isolated(work, Input{input, {}}, subject, limits);
}

Result<IsolatedBytes> run_isolated(IsolatedWork work, const std::array<std::string_view, 2>& input,
                                   const std::string& subject, const IsolationLimits& limits) {
  if (const IsolatedWork other = std::exchange(other_work, nullptr)) {
    IsolationLimits shorter = limits;
    shorter.seconds = std::min(limits.seconds, max_seconds_of_other_work);
    Result<IsolatedBytes> result = run_isolated(other, input, subject, shorter);
    other_work = other;
    return result;
  }
  Attempt attempt;
  if (without_isolation > 0) {
    attempt = run_here(work, input);
  } else if (is_worker && !isolates_inner_work) {
    if (note(Outcome::begins_inner_work)) attempt = run_here(work, input);
    note(Outcome::ended_inner_work);
  } else {
    attempt = run_with_modules(work, input, limits, false);
    // The reader of a model is not lost with one of its pictures: once more, each picture in its own process.
    const bool is_lost = attempt.end == End::late
                             ? attempt.open_inner_works > 0
                             : attempt.outcome != Outcome::done && attempt.outcome != Outcome::failed;
    if (attempt.has_inner_work && is_lost) attempt = run_with_modules(work, input, limits, true);
  }
  return result_of(std::move(attempt), subject, limits.writes);
}

WithoutIsolation::WithoutIsolation() { ++without_isolation; }
WithoutIsolation::~WithoutIsolation() { --without_isolation; }

WithOtherWork::WithOtherWork(IsolatedWork work, double max_seconds) {
  other_work = work, max_seconds_of_other_work = max_seconds;
}
WithOtherWork::~WithOtherWork() { other_work = nullptr; }

}  // namespace parvis

// Work on bytes that nobody trusts, in a child process: a third-party reader that crashes, exits, hangs or
// takes all memory there is becomes an error of ours.
//
// A small server process is forked before the program has threads (start_isolation, at the head of main) and
// forks the workers, so that none inherits a lock that another thread holds. One worker is always forked
// already and waits: a call does not wait for the copy of the page tables. A worker has
// limits on memory and time and, where the kernel has Landlock, opens no file except below the folders that
// the call names. Modules (module.h) that workers need are loaded once, in the server, so that every later
// worker has them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace parvis {

/// Limits of a worker's memory, time and files.
struct IsolationLimits {
  /// Memory beyond that of the program, bytes; less where the budget (memory_budget.h) has less left.
  std::uint64_t memory_bytes = std::uint64_t{8} << 30;
  double seconds = 120.0;                            ///< by the wall clock
  std::vector<std::filesystem::path> readable = {};  ///< folders and files that may be opened for reading
  bool writes = false;  ///< the work makes a file of its input: errors speak of a writer
};

/// Memory that a worker fills and its caller reads, without a copy between them.
class IsolatedOutput {
 public:
  /// Takes the descriptor of a memory file that worker and caller share; does not close it.
  explicit IsolatedOutput(int file) : file_(file) {}
  IsolatedOutput(const IsolatedOutput&) = delete;
  IsolatedOutput& operator=(const IsolatedOutput&) = delete;
  ~IsolatedOutput();

  /// `size` bytes of zeros, in place of any asked for before; empty if there is not so much memory.
  std::span<std::byte> allocate(std::size_t size);

 private:
  int file_;
  std::span<std::byte> mapped_;
};

/// The bytes that a worker has returned, mapped read-only and unmapped by the destructor.
class IsolatedBytes {
 public:
  /// Maps the whole of a file that lies in memory, and owns it.
  explicit IsolatedBytes(int file);
  IsolatedBytes(IsolatedBytes&& other) noexcept;
  IsolatedBytes& operator=(IsolatedBytes&&) = delete;
  ~IsolatedBytes();

  /// All bytes, as the worker left them.
  std::span<const std::byte> bytes() const { return mapped_; }

 private:
  int file_;
  std::span<const std::byte> mapped_;
};

/// Runs in the worker: reads `input`, fills `output`; its errors are handed to the caller. A plain function
/// of the program, for workers share the program's code.
using IsolatedWork = Status (*)(std::string_view input, IsolatedOutput& output);

/// Forks the server. To be called before the program starts threads; later calls do nothing. Without it the
/// first call of run_isolated does so.
void start_isolation();

/// Runs `work` on `input` in a worker process and returns its output. Work that runs in a worker may call it,
/// too, as a model's reader does for each picture: that inner work runs in the same worker, and if the worker
/// does not survive it, or not in its time, all is done once more with workers for the inner work, each of
/// which has half of the time that is left, so that a model is not lost with one of its pictures. Errors are
/// those of `work`, or say that the reader of `subject` (a file's name) crashed, took too long or needed too
/// much memory.
Result<IsolatedBytes> run_isolated(IsolatedWork work, std::string_view input, const std::string& subject,
                                   const IsolationLimits& limits = {});

/// The same on two pieces of input, the second after the first, which are not copied into one before.
Result<IsolatedBytes> run_isolated(IsolatedWork work, const std::array<std::string_view, 2>& input,
                                   const std::string& subject, const IsolationLimits& limits = {});

/// While one exists, the work of its thread runs in this very process: a baseline for measurements of what
/// isolation costs, and for nothing else.
class WithoutIsolation {
 public:
  WithoutIsolation();
  ~WithoutIsolation();
  WithoutIsolation(const WithoutIsolation&) = delete;
  WithoutIsolation& operator=(const WithoutIsolation&) = delete;
};

/// While one exists, calls of its thread run `work` in place of theirs, with their input and limits and
/// `max_seconds`: so a test sees for every caller what becomes of a reader that crashes, hangs or opens
/// files.
class WithOtherWork {
 public:
  WithOtherWork(IsolatedWork work, double max_seconds);
  ~WithOtherWork();
  WithOtherWork(const WithOtherWork&) = delete;
  WithOtherWork& operator=(const WithOtherWork&) = delete;
};

/// Whether this process is a worker, which ends without destructors.
bool is_in_worker();

/// Ends this worker, which can load nothing itself: its work begins again in one that has the module
/// (module.h). Work that takes long asks for its modules first.
[[noreturn]] void end_worker_without(std::string_view module);

/// Deletes, but in a worker: its memory ends with it, and taking a large document apart takes nearly as long
/// as reading it.
template <class T>
struct DeleteOutsideWorkers {
  void operator()(T* value) const {
    if (!is_in_worker()) delete value;
  }
};

/// Owns a large value of a reader: in a worker the value stays until the process ends.
template <class T>
using LeftInWorker = std::unique_ptr<T, DeleteOutsideWorkers<T>>;

/// Workers that this program has begun so far, those that its workers began included: the control of what
/// measures them.
std::uint64_t begun_workers();

}  // namespace parvis

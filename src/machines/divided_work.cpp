// The first process hands tasks out and takes results in from a thread of its own, while it works on tasks
// itself; the others ask for tasks, run them, send the results and ask again. They get more at a time while
// much is left, so that their threads seldom wait, and few at the end, so that all end together (guided
// self-scheduling, Polychronopoulos and Kuck 1987).
#include "machines/divided_work.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <limits>
#include <mutex>
#include <optional>
#include <thread>

#include "base/parallel.h"
#include "machines/requests.h"

namespace parvis::machines {
namespace {

enum Tag : int { ask_tag = 1, grant_tag, result_tag };

constexpr std::size_t max_tasks_per_thread = 16;          // at a time: these are lost when a process dies
constexpr std::size_t max_result = std::size_t{1} << 30;  // MPI counts in int

/// Tasks that nobody has begun.
class Dispenser {
 public:
  Dispenser(const Tasks& tasks, int processes) : tasks_(tasks), processes_(std::size_t(processes)) {}

  /// The next tasks for a process that runs so many at once; none: there is nothing left to do.
  Tasks next(std::size_t threads) {
    const std::scoped_lock lock(mutex_);
    const std::size_t left = tasks_.size() - begun_;
    std::size_t count = std::clamp(left / (4 * processes_), threads, max_tasks_per_thread * threads);
    count = std::min(threads == 1 ? std::size_t{1} : count, left);
    const auto first = tasks_.begin() + std::ptrdiff_t(begun_);
    begun_ += count;
    return {first, first + std::ptrdiff_t(count)};
  }

 private:
  const Tasks& tasks_;
  std::size_t processes_, begun_ = 0;
  std::mutex mutex_;
};

/// The first error of several threads.
class FirstError {
 public:
  void add(const Status& status) {
    if (status) return;
    const std::scoped_lock lock(mutex_);
    if (!has_any_) errors_ = status.errors();
    has_any_ = true;
  }
  bool has_any() const { return has_any_; }
  const Errors& errors() const { return errors_; }  ///< empty where there is none

 private:
  Errors errors_;
  std::atomic<bool> has_any_ = false;
  std::mutex mutex_;
};

bool is_interrupted(const DividedWork& work) { return work.is_interrupted && *work.is_interrupted; }

std::size_t threads_of(const DividedWork& work) {
  return work.uses_threads ? std::size_t(std::max(tbb::this_task_arena::max_concurrency(), 1)) : 1;
}

/// Runs tasks and hands each result on as it is finished.
template <class Take>
void run(const DividedWork& work, const Tasks& tasks, FirstError& failure, Take&& take) {
  const auto run_one = [&](std::size_t i) {
    if (failure.has_any() || is_interrupted(work)) return;
    Result<std::string> result = work.run(tasks[i]);
    if (!result)
      failure.add(result.errors());
    else if (result->size() > max_result)
      failure.add(error("a task's result of {} bytes; expected {} at most", result->size(), max_result));
    else
      take(tasks[i], *std::move(result));
  };
  if (work.uses_threads)
    parallel_for(tasks.size(), run_one);
  else
    for (std::size_t i = 0; i < tasks.size(); ++i) run_one(i);
}

/// Results as they reach the first process.
class Results {
 public:
  Results(const DividedWork& work, FirstError& failure) : work_(work), failure_(failure) {}

  void take(std::uint32_t task, std::string_view bytes) {
    const std::scoped_lock lock(mutex_);
    if (failure_.has_any()) return;
    failure_.add(work_.keep(task, bytes));
    ++count_;
  }
  std::size_t count() const { return count_; }

 private:
  const DividedWork& work_;
  FirstError& failure_;
  std::size_t count_ = 0;
  std::mutex mutex_;
};

/// The next message that a process receives, of any kind and size.
struct Message {
  int from = 0, tag = 0;
  std::string bytes;
};

std::optional<Message> received() {
  int is_there = 0;
  MPI_Status status{};
  MPI_Message handle = MPI_MESSAGE_NULL;
  MPI_Improbe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &is_there, &handle, &status);
  if (!is_there) return std::nullopt;
  int size = 0;
  MPI_Get_count(&status, MPI_BYTE, &size);
  Message message{status.MPI_SOURCE, status.MPI_TAG, std::string(std::size_t(size), '\0')};
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Imrecv(message.bytes.data(), size, MPI_BYTE, &handle, &request);
  // It polls, where MPI_Wait would spin. NOLINTNEXTLINE(clang-analyzer-optin.mpi.MPI-Checker)
  wait_for(request);
  return message;
}

void send(int to, Tag tag, std::string_view bytes) {
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Isend(bytes.data(), int(bytes.size()), MPI_BYTE, to, tag, MPI_COMM_WORLD, &request);
  // It polls, where MPI_Wait would spin. NOLINTNEXTLINE(clang-analyzer-optin.mpi.MPI-Checker)
  wait_for(request);
}

template <class T>
std::string_view bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

std::uint32_t take_number(std::string_view& bytes) {
  std::uint32_t number = 0;
  const std::string_view part = bytes.substr(0, sizeof number);
  std::copy(part.begin(), part.end(), reinterpret_cast<char*>(&number));
  bytes.remove_prefix(part.size());
  return number;
}

/// Serves the other processes until nothing is left for any of them. Interrupted, it waits for
/// nobody: mpirun ends them.
void serve(const Processes& processes, const DividedWork& work, Dispenser& dispenser, Results& results,
           const FirstError& failure) {
  for (int working = processes.count() - 1; working > 0 && !failure.has_any() && !is_interrupted(work);) {
    const std::optional<Message> message = received();
    if (!message) {
      std::this_thread::sleep_for(poll_interval);
      continue;
    }
    std::string_view bytes = message->bytes;
    const std::uint32_t number = take_number(bytes);
    if (message->tag == result_tag) {
      results.take(number, bytes);
    } else {
      const Tasks tasks = dispenser.next(number);
      working -= tasks.empty();
      send(message->from, grant_tag, bytes_of(tasks));
    }
  }
}

Result<std::size_t> lead(const Processes& processes, const Tasks& to_do, const DividedWork& work) {
  Dispenser dispenser(to_do, processes.count());
  FirstError failure;
  Results results(work, failure);
  std::jthread server;
  if (processes.are_several())
    server = std::jthread([&] { serve(processes, work, dispenser, results, failure); });
  const std::size_t at_once = processes.are_several() ? threads_of(work) : std::size_t(to_do.size());
  while (!failure.has_any() && !is_interrupted(work)) {
    const Tasks tasks = dispenser.next(std::max(at_once, std::size_t{1}));
    if (tasks.empty()) break;
    run(work, tasks, failure,
        [&](std::uint32_t task, const std::string& bytes) { results.take(task, bytes); });
  }
  if (server.joinable()) server.join();
  if (failure.has_any()) return failure.errors();
  // Who has found nothing left must not ask for the next work before all others have.
  if (!is_interrupted(work)) processes.wait_for_all();
  return results.count();
}

Result<std::size_t> follow(const Processes& processes, const DividedWork& work) {
  FirstError failure;
  std::mutex mutex;
  std::size_t count = 0;
  const std::vector<std::uint32_t> question{std::uint32_t(threads_of(work))};
  while (true) {
    send(0, ask_tag, bytes_of(question));
    std::optional<Message> grant;
    while (!(grant = received())) std::this_thread::sleep_for(poll_interval);
    std::string_view bytes = grant->bytes;
    Tasks tasks;
    while (!bytes.empty()) tasks.push_back(take_number(bytes));
    if (tasks.empty()) break;
    run(work, tasks, failure, [&](std::uint32_t task, const std::string& result) {
      std::string message(reinterpret_cast<const char*>(&task), sizeof task);
      message += result;
      const std::scoped_lock lock(mutex);
      send(0, result_tag, message);
      ++count;
    });
    if (failure.has_any()) return failure.errors();
  }
  processes.wait_for_all();
  return count;
}

}  // namespace

Result<std::size_t> divide(const Processes& processes, const Tasks& to_do, const DividedWork& work) {
  return processes.is_first() ? lead(processes, to_do, work) : follow(processes, work);
}

}  // namespace parvis::machines

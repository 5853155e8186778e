// Work that is divided among processes: tasks that do not depend on each other, each run once by whichever
// process is free, their results handed to the first process. The result of a task depends on nothing but the
// task, so the whole is the same bit for bit with any number of processes and threads.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "machines/processes.h"

namespace parvis::machines {

/// Numbers of tasks.
using Tasks = std::vector<std::uint32_t>;

/// The two functions that a task goes through.
struct DividedWork {
  /// Runs a task and returns its result as bytes. Called in the order of the list.
  std::function<Result<std::string>(std::uint32_t task)> run;
  /// Takes a result over, in the first process alone and one at a time, in any order.
  std::function<Status(std::uint32_t task, std::string_view result)> keep;
  /// Tasks run on all cores of a process at once; false: one at a time on the thread that calls `divide`
  /// (OpenGL).
  bool uses_threads = true;
  /// When it turns true no further task is begun; null: never. That of the first process counts.
  const std::atomic<bool>* is_interrupted = nullptr;
};

/// Runs the tasks `to_do` (the list of the first process counts) and returns how many results have been kept:
/// all, unless interrupted. In other processes it returns when no task is left, with how many they ran.
/// Errors: the first one of a task or of `keep`.
Result<std::size_t> divide(const Processes& processes, const Tasks& to_do, const DividedWork& work);

}  // namespace parvis::machines

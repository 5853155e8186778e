// Progress of long work: a bar with an estimate on a terminal, plain lines elsewhere, on standard error.
#pragma once

#include <atomic>
#include <chrono>
#include <mutex>
#include <string>

namespace parvis {

class Progress {
 public:
  /// `total` steps are to come; `what` names the work ("rendering film").
  Progress(std::string what, std::size_t total);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Counts `steps` as done. Any thread may call it.
  void advance(std::size_t steps = 1);

 private:
  void print(std::size_t done);

  std::string what_;
  std::size_t total_;
  std::atomic<std::size_t> done_{0};
  std::chrono::steady_clock::time_point start_, last_print_;
  std::mutex mutex_;
  bool is_terminal_;
};

}  // namespace parvis

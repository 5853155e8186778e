#include "base/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <mutex>
#include <ranges>
#include <system_error>
#include <thread>
#include <vector>

namespace parvis {
namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;
constexpr Clock::duration terminal_interval = 100ms, log_interval = 4s;
constexpr Clock::duration min_age = 1s;  // what is done sooner is not worth a line of a log
constexpr int bar_width = 30;

double seconds(Clock::duration duration) { return std::chrono::duration<double>(duration).count(); }

}  // namespace

struct Progress::State {
  class Printer;

  std::string what;
  std::size_t total;
  std::size_t done = 0;
  Clock::time_point start = Clock::now();
};

/// Prints for all of a process: of the works that run one inside the other the innermost that has lasted a
/// while, as it advances and, where one of its steps takes long, from a thread.
class Progress::State::Printer {
 public:
  static Printer& get() {
    static Printer printer;
    return printer;
  }

  void begin(State& work) {
    const std::scoped_lock lock(mutex_);
    running_.push_back(&work);
    if (is_terminal_ || thread_.joinable() || has_no_thread_) return;
    try {
      thread_ = std::jthread([this](const std::stop_token& stop) { watch(stop); });
    } catch (const std::system_error&) {  // too little memory: lines come as the work advances
      has_no_thread_ = true;
    }
  }

  void end(State& work) {
    const std::scoped_lock lock(mutex_);
    std::erase(running_, &work);
    if (is_terminal_ && work.done > 0) fmt::print(stderr, "\r\033[K");
  }

  void advance(State& work, std::size_t steps) {
    const std::scoped_lock lock(mutex_);
    work.done += steps;
    const Clock::time_point now = Clock::now();
    if (is_terminal_ ? now - last_print_ >= terminal_interval && now - work.start >= terminal_interval
                     : is_due(work, now))
      print(work, now);
  }

 private:
  bool is_due(const State& work, Clock::time_point now) const {
    return now - last_print_ >= log_interval && now - work.start >= min_age;
  }

  void watch(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    while (!stop.stop_requested()) {
      wake_.wait_for(lock, stop, min_age, [] { return false; });
      const Clock::time_point now = Clock::now();
      for (const State* work : running_ | std::views::reverse)
        if (is_due(*work, now)) {
          print(*work, now);
          break;
        }
    }
  }

  void print(const State& work, Clock::time_point now) {
    last_print_ = now;
    const double fraction = work.total > 0 ? double(work.done) / double(work.total) : 0.0;
    const std::string left = fraction > 0.0 ? fmt::format(", about {:.0f} s left",
                                                          seconds(now - work.start) * (1.0 / fraction - 1.0))
                                            : "";
    const std::string text =
        fmt::format("{} {}/{} ({:.0f} %){}", work.what, work.done, work.total, 100.0 * fraction, left);
    if (is_terminal_)
      fmt::print(stderr, "\r\033[K[{:-<{}}] {}", std::string(std::size_t(fraction * bar_width), '#'),
                 bar_width, text);
    else
      fmt::print(stderr, "{}\n", text);
    std::fflush(stderr);
  }

  const bool is_terminal_ = isatty(STDERR_FILENO) != 0;
  bool has_no_thread_ = false;
  std::mutex mutex_;  ///< of all that follows, of the works and of the output
  std::condition_variable_any wake_;
  std::vector<State*> running_;  ///< innermost last
  Clock::time_point last_print_ = Clock::now();
  std::jthread thread_;  ///< last, so that it ends before what it uses
};

Progress::Progress(std::string what, std::size_t total) : state_(new State{std::move(what), total}) {
  State::Printer::get().begin(*state_);
}

Progress::~Progress() { State::Printer::get().end(*state_); }

void Progress::advance(std::size_t steps) { State::Printer::get().advance(*state_, steps); }

}  // namespace parvis

#include "base/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <mutex>

namespace parvis {
namespace {

using Clock = std::chrono::steady_clock;
constexpr double terminal_interval_s = 0.1;
constexpr double log_interval_s = 10.0;
constexpr int bar_width = 30;

double seconds(Clock::duration duration) { return std::chrono::duration<double>(duration).count(); }

}  // namespace

struct Progress::State {
  std::string what;
  std::size_t total;
  bool is_terminal = isatty(STDERR_FILENO) != 0;
  std::atomic<std::size_t> done{0};
  Clock::time_point start = Clock::now(), last_print = start;
  std::mutex mutex{};  ///< of last_print and of the output

  void print(std::size_t now_done) const {
    const double share = total > 0 ? double(now_done) / double(total) : 1.0;
    const double left_s = share > 0.0 ? seconds(last_print - start) * (1.0 - share) / share : 0.0;
    const std::string text =
        fmt::format("{} {}/{} ({:.0f} %), about {:.0f} s left", what, now_done, total, 100.0 * share, left_s);
    if (is_terminal)
      fmt::print(stderr, "\r\033[K[{:-<{}}] {}", std::string(std::size_t(share * bar_width), '#'), bar_width,
                 text);
    else
      fmt::print(stderr, "{}\n", text);
    std::fflush(stderr);
  }
};

Progress::Progress(std::string what, std::size_t total) : state_(new State{std::move(what), total}) {}

Progress::~Progress() {
  if (state_->is_terminal && state_->done > 0) fmt::print(stderr, "\r\033[K");
}

void Progress::advance(std::size_t steps) {
  const std::size_t done = state_->done += steps;
  const std::scoped_lock lock(state_->mutex);
  const Clock::time_point now = Clock::now();
  if (seconds(now - state_->last_print) < (state_->is_terminal ? terminal_interval_s : log_interval_s))
    return;
  state_->last_print = now;
  state_->print(done);
}

}  // namespace parvis

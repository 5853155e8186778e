#include "base/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace parvis {
namespace {

using Clock = std::chrono::steady_clock;
constexpr double terminal_interval_s = 0.1;
constexpr double log_interval_s = 10.0;
constexpr int bar_width = 30;

double seconds(Clock::duration duration) { return std::chrono::duration<double>(duration).count(); }

}  // namespace

Progress::Progress(std::string what, std::size_t total)
    : what_(std::move(what)),
      total_(total),
      start_(Clock::now()),
      last_print_(start_),
      is_terminal_(isatty(STDERR_FILENO) != 0) {}

Progress::~Progress() {
  if (is_terminal_ && done_ > 0) fmt::print(stderr, "\r\033[K");
}

void Progress::advance(std::size_t steps) {
  const std::size_t done = done_ += steps;
  const std::scoped_lock lock(mutex_);
  const Clock::time_point now = Clock::now();
  if (seconds(now - last_print_) < (is_terminal_ ? terminal_interval_s : log_interval_s)) return;
  last_print_ = now;
  print(done);
}

void Progress::print(std::size_t done) {
  const double share = total_ > 0 ? double(done) / double(total_) : 1.0;
  const double left_s = share > 0.0 ? seconds(last_print_ - start_) * (1.0 - share) / share : 0.0;
  const std::string state =
      fmt::format("{} {}/{} ({:.0f} %), about {:.0f} s left", what_, done, total_, 100.0 * share, left_s);
  if (is_terminal_)
    fmt::print(stderr, "\r\033[K[{:-<{}}] {}", std::string(std::size_t(share * bar_width), '#'), bar_width,
               state);
  else
    fmt::print(stderr, "{}\n", state);
  std::fflush(stderr);
}

}  // namespace parvis

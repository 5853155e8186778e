#include "viewer/frame_statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace parvis::viewer {
namespace {

/// Goes a part of the way from the old times to new ones; others than before are taken as they are.
void smooth(std::vector<gl::PassTime>& smoothed, std::span<const gl::PassTime> passes) {
  constexpr double weight_of_new = 0.1;
  const auto has_same_name = [](const gl::PassTime& a, const gl::PassTime& b) { return a.name == b.name; };
  if (!std::equal(passes.begin(), passes.end(), smoothed.begin(), smoothed.end(), has_same_name)) {
    smoothed.assign(passes.begin(), passes.end());
    return;
  }
  for (std::size_t i = 0; i < passes.size(); ++i)
    smoothed[i].seconds += weight_of_new * (passes[i].seconds - smoothed[i].seconds);
}

}  // namespace

void FrameStatistics::add(double frame_s, std::span<const gl::PassTime> passes) {
  frames_ms_[count_++ % frames_kept] = float(1000.0 * frame_s);
  smooth(passes_, passes);
}

void FrameStatistics::add_on_processor(std::span<const gl::PassTime> passes) {
  smooth(passes_on_processor_, passes);
}

std::vector<float> FrameStatistics::frames_ms() const {
  std::vector<float> all;
  for (std::size_t i = count_ - std::min(count_, frames_kept); i < count_; ++i)
    all.push_back(frames_ms_[i % frames_kept]);
  return all;
}

double FrameStatistics::mean_ms() const {
  const std::vector<float> all = frames_ms();
  return all.empty() ? 0.0 : std::accumulate(all.begin(), all.end(), 0.0) / double(all.size());
}

double FrameStatistics::worst_ms() const {
  const std::vector<float> all = frames_ms();
  return all.empty() ? 0.0 : double(*std::max_element(all.begin(), all.end()));
}

std::string frame_rate(double frame_ms) {
  constexpr double second_ms = 1000.0, coarse = 10.0;  // above it nobody asks for tenths
  if (!(frame_ms > 0.0)) return "";
  const double rate = second_ms / frame_ms;
  if (rate < 1.0) return fmt::format("one in {:.1f} s", frame_ms / second_ms);
  return rate < coarse ? fmt::format("{:.1f} per second", rate) : fmt::format("{:.0f} per second", rate);
}

}  // namespace parvis::viewer

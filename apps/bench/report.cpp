#include "bench/report.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "base/files.h"

namespace parvis::bench {
namespace {

void tell(const std::string& line) {
  fmt::print("{}\n", line);
  std::fflush(stdout);
}

}  // namespace

double milliseconds(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

Median median(std::vector<double> samples) {
  if (samples.empty()) return {};
  std::sort(samples.begin(), samples.end());
  const double count = double(samples.size()), reach = 0.98 * std::sqrt(count);  // 1.96 sqrt(n) / 2
  const auto at = [&](double rank) {
    return samples[std::size_t(std::clamp(std::lround(rank), 0l, long(samples.size()) - 1))];
  };
  const double middle = 0.5 * (count - 1.0);
  const double value = 0.5 * (at(std::floor(middle)) + at(std::ceil(middle)));
  return {value, at(std::floor(middle - reach)), at(std::ceil(middle + reach))};
}

double percentile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  const auto at = values.begin() + std::ptrdiff_t(share * double(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

void Report::add(const std::string& key, double value) {
  figures_.emplace_back(key, value);
  tell(fmt::format("{:<40} {:>14.4f}", key, value));
}

void Report::add(const std::string& key, double value, const Target& target) {
  add(key, value);
  note(fmt::format("{}: {} {} {}", key, target.is_met_by(value) ? "meets" : "MISSES",
                   target.is_floor ? ">=" : "<=", target.limit));
}

void Report::add_control(const std::string& key, double value, const Target& target) {
  add(key, value);
  const bool has_failed = std::isfinite(value) && !target.is_met_by(value);
  if (!has_failed) passed_controls_.push_back(key);
  note(fmt::format("{}: the control {} {} {}", key, has_failed ? "fails, as it must," : "DOES NOT FAIL",
                   target.is_floor ? ">=" : "<=", target.limit));
}

Status Report::controls() const {
  if (passed_controls_.empty()) return Done{};
  return error(
      "controls reach the targets that they must miss, so that the figures beside them show nothing: {}",
      fmt::join(passed_controls_, ", "));
}

void Report::add(const std::string& key, const Median& median) {
  add(key, median.value);
  note(fmt::format("{}: median {:.2f}, 95 % interval {:.2f} to {:.2f}", key, median.value, median.low,
                   median.high));
}

void Report::skip(const std::string& key, const std::string& why) {
  tell(fmt::format("{:<40} {:>14}", key, "skipped"));
  note(fmt::format("{} is skipped: {}", key, why));
}

void Report::note(std::string row) {
  tell("  " + row);
  rows_.push_back(std::move(row));
}

Status Report::write(const std::filesystem::path& file) const {
  nlohmann::json json{{"bench", name_}, {"figures", nlohmann::json::object()}, {"rows", rows_}};
  for (const auto& [key, value] : figures_) json["figures"][key] = value;
  return write_file(file, json.dump(2) + "\n");
}

}  // namespace parvis::bench

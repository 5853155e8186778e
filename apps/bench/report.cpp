#include "bench/report.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "base/files.h"

namespace parvis::bench {
namespace {

constexpr double min_sample = 1e-3;

void print(const std::string& line) {
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

Median ratio_in_turn(const std::vector<double>& over, const std::vector<double>& under) {
  std::vector<double> ratios;
  ratios.reserve(over.size());
  for (std::size_t i = 0; i < over.size(); ++i) ratios.push_back(over[i] / std::max(under[i], min_sample));
  return median(std::move(ratios));
}

Median ratio(const Median& over, const Median& under) {
  return {over.value / std::max(under.value, min_sample), over.low / std::max(under.high, min_sample),
          over.high / std::max(under.low, min_sample)};
}

double percentile(std::vector<double> values, double fraction) {
  if (values.empty()) return 0.0;
  const auto at = values.begin() + std::ptrdiff_t(fraction * double(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

void Report::add(Figure figure) {
  print(fmt::format("{:<40} {:>14.4f}", figure.key, figure.value.value));
  if (figure.value.low != figure.value.high)
    note(fmt::format("{}: median {:.2f}, 95 % interval {:.2f} to {:.2f}", figure.key, figure.value.value,
                     figure.value.low, figure.value.high));
  const bool is_met = figure.target.is_met_by(figure.value.value);
  if (!figure.control_of.empty()) {
    const bool has_failed = std::isfinite(figure.value.value) && !is_met;
    if (!has_failed) passed_controls_.push_back(figure.key);
    note(fmt::format("{}: the control {} {}", figure.key, has_failed ? "fails, as it must," : "DOES NOT FAIL",
                     figure.target.text()));
  } else if (figure.target.kind != Target::Kind::none) {
    note(fmt::format("{}: {} {}", figure.key, is_met ? "reaches" : "MISSES", figure.target.text()));
  }
  figures_.push_back(std::move(figure));
}

void Report::add(const std::string& key, const Median& median) {
  if (const Key* row = key_named(key)) return add({key, median, row, row->target});
  const Key* of = key_with_control(key);
  add({key, median, nullptr, of ? of->target : Target(), of ? std::string(of->name) : ""});
}

void Report::add(const std::string& key, double value) { add(key, Median{value, value, value}); }

void Report::add(const std::string& key, double value, const Target& target,
                 const std::vector<std::pair<std::string, double>>& controls) {
  add({key, {value, value, value}, key_named(key), target});
  for (const auto& [name, of_control] : controls)
    add({name, {of_control, of_control, of_control}, nullptr, target, key});
}

Status Report::controls() const {
  if (passed_controls_.empty()) return Ok{};
  return error(
      "controls reach the targets that they must miss, so that the figures beside them show nothing: {}",
      fmt::join(passed_controls_, ", "));
}

void Report::skip(const std::string& key, const std::string& why) {
  print(fmt::format("{:<40} {:>14}", key, "skipped"));
  note(fmt::format("{} is skipped: {}", key, why));
}

void Report::note(std::string row) {
  print("  " + row);
  rows_.push_back(std::move(row));
}

Status Report::write(const std::filesystem::path& file) const {
  nlohmann::json json{{"bench", name_},
                      {"quick", is_quick_},
                      {"machine", machine_},
                      {"figures", nlohmann::json::object()},
                      {"keys", nlohmann::json::array()},
                      {"rows", rows_}};
  for (const Figure& figure : figures_) {
    json["figures"][figure.key] = figure.value.value;
    nlohmann::json row{{"key", figure.key}, {"value", figure.value.value}};
    if (figure.value.low != figure.value.high) row["interval"] = {figure.value.low, figure.value.high};
    if (figure.target.kind != Target::Kind::none) {
      row["target"] = figure.target.text();
      row["reached"] = figure.target.is_met_by(figure.value.value);
    }
    if (!figure.control_of.empty()) row["control_of"] = figure.control_of;
    if (figure.row) row["unit"] = figure.row->unit, row["shows"] = figure.row->shows;
    json["keys"].push_back(std::move(row));
  }
  return write_file(file, json.dump(2) + "\n");
}

}  // namespace parvis::bench

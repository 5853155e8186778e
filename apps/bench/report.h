// The output of a bench: figures by key and rows of text, printed as they come, and as JSON.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "base/result.h"

namespace parvis::bench {

/// The wall clock over `work`.
double milliseconds(const std::function<void()>& work);

/// A median with its 95 % interval (order statistics, binomial).
struct Median {
  double value = 0.0, low = 0.0, high = 0.0;
};
/// The median of the samples and its 95 % interval; all zero for none.
Median median(std::vector<double> samples);

/// The value below which a share of all lie; 0 of none.
double percentile(std::vector<double> values, double share);

/// What an issue asks of a figure.
struct Target {
  double limit = 0.0;
  bool is_floor = false;  ///< the figure is to be at least so much, else at most

  /// Whether a figure reaches it; what is no number does not.
  bool is_met_by(double value) const { return is_floor ? value >= limit : value <= limit; }
};
/// At most so much.
inline Target up_to(double limit) { return {limit, false}; }

/// Prints each figure and row as it is added: a bench that is stopped has printed what it knew.
class Report {
 public:
  /// `name` is that of the bench, as the command spells it.
  explicit Report(std::string name) : name_(std::move(name)) {}

  /// Adds a figure under the key of the issue that asks for it.
  void add(const std::string& key, double value);
  /// The same, with a row that says whether it meets its target.
  void add(const std::string& key, double value, const Target& target);
  /// The figure of a control, a case in which what is measured is broken: it must miss the figure's target. A
  /// row says so; where it does not, the figure shows nothing, and `controls` fails.
  void add_control(const std::string& key, double value, const Target& target);
  /// The median counts; its interval stands in a row.
  void add(const std::string& key, const Median& median);
  /// A figure that this machine cannot measure stands in the table as "skipped", and why in a row.
  void skip(const std::string& key, const std::string& why);
  /// Adds a row of text: how a figure was measured, on which machine.
  void note(std::string row);

  /// Fails, with their keys, where controls have met their targets.
  Status controls() const;
  /// {"bench": NAME, "figures": {KEY: number, ...}, "rows": [...]}
  Status write(const std::filesystem::path& file) const;

 private:
  std::string name_;
  std::vector<std::pair<std::string, double>> figures_;
  std::vector<std::string> rows_, passed_controls_;
};

}  // namespace parvis::bench

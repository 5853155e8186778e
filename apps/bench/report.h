// The output of a bench: figures by key and rows of text, printed as they come, and as JSON.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "base/result.h"
#include "bench/keys.h"

namespace parvis::bench {

/// The wall clock over `work`.
double milliseconds(const std::function<void()>& work);

/// A median with its 95 % interval (order statistics, binomial).
struct Median {
  double value = 0.0, low = 0.0, high = 0.0;
};
/// The median of the samples and its 95 % interval; all zero for none.
Median median(std::vector<double> samples);
/// The median of the ratios of samples taken in turn: what slows both for a while leaves it as it is. Samples
/// count as a microsecond (1e-3) at least.
Median ratio_in_turn(const std::vector<double>& over, const std::vector<double>& under);
/// The ratio of two medians; its interval is the widest that both of theirs allow.
Median ratio(const Median& over, const Median& under);

/// The value below which a fraction of all lie; 0 of none.
double percentile(std::vector<double> values, double fraction);

/// Prints each figure and row as it is added: a bench that is stopped has printed what it knew. Targets and
/// controls are those of the table of keys.
class Report {
 public:
  /// `name` is that of the bench, as the command spells it.
  Report(std::string name, bool is_quick) : name_(std::move(name)), is_quick_(is_quick) {}

  /// Adds a figure. A row says whether it reaches its target; that of a control, a case in which what is
  /// measured is broken, must miss the target of its key: where it does not, the figure shows nothing, and
  /// `controls` fails.
  void add(const std::string& key, double value);
  /// The median counts; its interval stands in the JSON and in a row.
  void add(const std::string& key, const Median& median);
  /// A figure whose target is measured, too, and its controls.
  void add(const std::string& key, double value, const Target& target,
           const std::vector<std::pair<std::string, double>>& controls);
  /// A figure that this machine cannot measure stands in the table as "skipped", and why in a row.
  void skip(const std::string& key, const std::string& why);
  /// Adds a row of text: what was seen beside the figures.
  void note(std::string row);
  /// The driver that draws what is measured.
  void set_machine(const std::string& name) { machine_ = name; }

  /// Fails, with their keys, where controls have reached their targets.
  Status controls() const;
  /// {"bench": NAME, "quick": bool, "machine": text, "figures": {KEY: number, ...}, "keys": [...], "rows":
  /// [...]}
  Status write(const std::filesystem::path& file) const;

 private:
  struct Figure {
    std::string key;
    Median value;
    const Key* row = nullptr;     ///< in the table of keys
    Target target = {};           ///< of the key, or of the key whose control this is
    std::string control_of = {};  ///< the key that it must not resemble; empty: no control
  };
  void add(Figure figure);

  std::string name_, machine_;
  bool is_quick_;
  std::vector<Figure> figures_;
  std::vector<std::string> rows_, passed_controls_;
};

}  // namespace parvis::bench

// Figures of several trees, of which the bench reports the mean.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/report.h"

namespace parvis::trees {

/// Sums over trees, reported as means; each tree's own value is noted as it comes.
class Means {
 public:
  /// The report outlives it.
  explicit Means(bench::Report& report) : report_(report) {}

  /// What is added from now on is that of this tree.
  void begin_tree(std::string_view name) { tree_ = name; }
  /// A figure without a target.
  void add(const std::string& key, double value) { add_to(key, value, std::nullopt, false); }
  /// A figure whose mean is to meet the target.
  void add(const std::string& key, double value, const bench::Target& target) {
    add_to(key, value, target, false);
  }
  /// The figure of a control, whose mean must miss the target (bench::Report::add_control).
  void add_control(const std::string& key, double value, const bench::Target& target) {
    add_to(key, value, target, true);
  }

  /// Adds all means to the report, in the order in which their keys came first. Errors: one is no finite
  /// number.
  Status report() const;

 private:
  struct Entry {
    std::string key;
    double sum, count;
    std::optional<bench::Target> target;
    bool is_control;
  };

  void add_to(const std::string& key, double value, const std::optional<bench::Target>& target,
              bool is_control);

  bench::Report& report_;
  std::string tree_;
  std::vector<Entry> entries_;
};

}  // namespace parvis::trees

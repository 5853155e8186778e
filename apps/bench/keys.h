// The table of keys: what each figure of a bench is, its target and the controls that must miss it.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>

namespace parvis::bench {

/// The value that a figure is to reach.
struct Target {
  enum class Kind : unsigned char { none, maximum, minimum };
  double limit = 0.0;
  Kind kind = Kind::none;

  /// Whether a figure reaches it; what is no number does not.
  bool is_met_by(double value) const {
    return kind == Kind::minimum ? value >= limit : kind == Kind::maximum && value <= limit;
  }
  /// "<= 0.5"; empty without a target.
  std::string text() const;
};
constexpr Target maximum(double limit) { return {limit, Target::Kind::maximum}; }
constexpr Target minimum(double limit) { return {limit, Target::Kind::minimum}; }

/// One row.
struct Key {
  std::string_view name, unit;
  Target target;
  std::string_view shows;                      ///< scene and views: what is measured, over what
  std::array<std::string_view, 3> controls{};  ///< keys of broken cases, which must miss the target
};

/// All rows.
std::span<const Key> all_keys();
/// The row of a key, or null.
const Key* key_named(std::string_view name);
/// The row whose control a key is, or null.
const Key* key_with_control(std::string_view name);

}  // namespace parvis::bench

// Numbers of the command line: finite, without a sign where there is none, and never wrapped.
#pragma once

#include <CLI/CLI.hpp>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <string>

#include "base/result.h"

namespace parvis {

/// Width and height out of "1280x720".
inline Status parse_size(const std::string& text, int& width, int& height) {
  constexpr int max_side = 16384;
  const char* const end = text.data() + text.size();
  const auto [x, bad_width] = std::from_chars(text.data(), end, width);
  const bool has_width = bad_width == std::errc() && x != end && *x == 'x';
  const auto [rest, bad_height] = std::from_chars(has_width ? x + 1 : end, end, height);
  if (!has_width || bad_height != std::errc() || rest != end || width < 1 || height < 1 || width > max_side ||
      height > max_side)
    return error("--size {}: expected width x height in pixels, as 1280x720, each up to {}", text, max_side);
  return Ok{};
}

/// Adds to each numeric option of `app` and of its subcommands what no range can refuse: "nan", which is
/// neither below nor above a limit, numbers beyond those of floats or of 64 bits, nothing at all, and the
/// sign of an unsigned number, which would wrap.
inline void be_strict_about_numbers(CLI::App& app) {
  constexpr double max_float = 3.4e38;
  for (CLI::Option* option : app.get_options()) {
    const std::string type = option->get_type_name();
    const bool is_float = type.starts_with("FLOAT"), is_unsigned = type.starts_with("UINT");
    if (!is_float && !is_unsigned && !type.starts_with("INT")) continue;
    option->check([is_float, is_unsigned](const std::string& text) -> std::string {
      if (text.empty()) return "expected a number";
      if (is_unsigned && text.starts_with('-')) return text + ": expected a number that is not negative";
      if (!is_float) {  // the library's conversion ends at the largest number without a word
        errno = 0;
        if (is_unsigned)
          std::strtoull(text.c_str(), nullptr, 0);
        else
          std::strtoll(text.c_str(), nullptr, 0);
        return errno == ERANGE ? text + ": expected a number of at most 64 bits" : "";
      }
      const double value = std::strtod(text.c_str(), nullptr);
      return std::abs(value) <= max_float ? "" : text + ": expected a finite number";
    });
  }
  for (CLI::App* command : app.get_subcommands([](CLI::App*) { return true; }))
    be_strict_about_numbers(*command);
}

}  // namespace parvis

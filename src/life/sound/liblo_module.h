// The module `liblo`: what of this room knows liblo, the library of Open Sound Control.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/module.h"

namespace parvis::sound {

/// A message: an argument is a number, or a text where `texts` has one at its place.
struct OscMessage {
  std::string address;
  std::vector<double> numbers;     ///< of each argument; 0 of texts
  std::vector<std::string> texts;  ///< of each argument; empty of numbers
  std::string blob = {};           ///< the last argument, which is in neither; empty: there is none
};

/// The functions of the module.
struct LibloFunctions {
  /// Errors say what is no message; bundles are none.
  Result<OscMessage> (*decode)(std::string_view packet);
  /// Whole numbers as 32-bit integers, which floats would round beyond 2^24; others as floats.
  Result<std::string> (*encode)(const OscMessage& message);
};

/// Loaded when a sound server or its client begins.
inline constexpr Module<LibloFunctions> liblo("liblo");

}  // namespace parvis::sound

// What names of objects, nodes and materials say, in any case.
#pragma once

#include <algorithm>
#include <cctype>
#include <string>

namespace parvis::car_bodies {

/// ASCII letters in lower case, the rest as it is.
inline std::string lower_case(std::string name) {
  std::ranges::transform(name, name.begin(), [](unsigned char letter) { return char(std::tolower(letter)); });
  return name;
}

/// True for names of wheels of the road: they hold "wheel", as traffic has it.
inline bool names_a_wheel(const std::string& name) {
  const std::string lower = lower_case(name);
  return lower.find("wheel") != std::string::npos && lower.find("steer") == std::string::npos;
}

}  // namespace parvis::car_bodies

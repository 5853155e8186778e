// What a window takes from the user's surroundings: language, folder of caches.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

namespace parvis {

/// A variable of the environment; empty: it is not set.
inline std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

/// The name of the locale for messages.
inline std::string locale() {
  for (const char* name : {"LC_ALL", "LC_MESSAGES", "LANG"})
    if (const std::string value = variable(name); !value.empty()) return value;
  return "";
}

/// The folder for pictures of the catalogue, in the user's folder of caches.
inline std::filesystem::path kept_pictures() {
  if (const std::string cache = variable("XDG_CACHE_HOME"); !cache.empty())
    return std::filesystem::path(cache) / "parvis";
  if (const std::string home = variable("HOME"); !home.empty())
    return std::filesystem::path(home) / ".cache" / "parvis";
  return {};
}

}  // namespace parvis

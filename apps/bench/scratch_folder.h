// A folder that goes when the bench does, unless it is to be kept.
#pragma once

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>

namespace parvis::bench {

struct ScratchFolder {
  std::filesystem::path path;
  bool is_kept;

  /// `kept`: the folder to use and to keep; empty: a new one, which is removed.
  explicit ScratchFolder(const std::filesystem::path& kept = {})
      : path(kept.empty() ? std::filesystem::temp_directory_path() / fmt::format("parvis-bench-{}", getpid())
                          : kept),
        is_kept(!kept.empty()) {}
  ScratchFolder(const ScratchFolder&) = delete;
  ~ScratchFolder() {
    if (is_kept) return;
    std::error_code code;
    std::filesystem::remove_all(path, code);
  }
};

}  // namespace parvis::bench

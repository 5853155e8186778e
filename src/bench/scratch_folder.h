// A folder that goes when the bench does.
#pragma once

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>

namespace parvis::bench {

struct ScratchFolder {
  std::filesystem::path path =
      std::filesystem::temp_directory_path() / fmt::format("parvis-bench-{}", getpid());

  ScratchFolder() = default;
  ScratchFolder(const ScratchFolder&) = delete;
  ~ScratchFolder() {
    std::error_code code;
    std::filesystem::remove_all(path, code);
  }
};

}  // namespace parvis::bench

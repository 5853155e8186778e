// Fuzzers' bytes as a file, for readers that take a path.
#pragma once

#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

namespace parvis {

/// Lives in memory where the machine has /dev/shm; goes with its program.
class FuzzFile {
 public:
  explicit FuzzFile(const std::string& extension) {
    const std::filesystem::path memory = "/dev/shm";
    const std::filesystem::path parent =
        std::filesystem::is_directory(memory) ? memory : std::filesystem::temp_directory_path();
    folder_ = parent / ("parvis_fuzz_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
    path_ = folder_ / ("input" + extension);
  }
  ~FuzzFile() {
    std::error_code code;
    std::filesystem::remove_all(folder_, code);
  }
  FuzzFile(const FuzzFile&) = delete;
  FuzzFile& operator=(const FuzzFile&) = delete;

  /// The file, with these bytes.
  const std::filesystem::path& with(const std::uint8_t* data, std::size_t size) {
    std::ofstream(path_, std::ios::binary).write(reinterpret_cast<const char*>(data), std::streamsize(size));
    return path_;
  }

 private:
  std::filesystem::path folder_, path_;
};

}  // namespace parvis

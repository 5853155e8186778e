// Finished tiles of a photograph, kept in a file so that interrupted work goes on where it stopped. The file
// grows by one record a tile; a record that was cut short, or of another scene or options, does not count.
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <mutex>
#include <span>

#include "base/result.h"

namespace parvis::reference {

class PhotographCheckpoint {
 public:
  /// Opens or begins `file` for work that `key` stands for, calls `found` with each tile that is there, and
  /// keeps the file open. Errors: it cannot be written; it is no regular file or a link; it holds something
  /// else, or tiles of another key, and `replaces` does not say that they may be lost.
  static Result<PhotographCheckpoint> open(
      const std::filesystem::path& file, std::uint64_t key, bool replaces,
      const std::function<void(std::uint32_t tile, std::span<const float> values)>& found);
  PhotographCheckpoint(PhotographCheckpoint&& other) noexcept;
  PhotographCheckpoint& operator=(PhotographCheckpoint&&) = delete;
  ~PhotographCheckpoint();

  /// Appends a tile; any thread may. After one that cannot be written (full disk) no more are: they are
  /// rendered once more after an interruption, which costs time; the picture is the same.
  void keep(std::uint32_t tile, std::span<const float> values);
  /// How many tiles the file holds.
  std::size_t tiles() const { return tiles_; }

 private:
  PhotographCheckpoint(std::filesystem::path file, std::FILE* stream, std::uint64_t key)
      : file_(std::move(file)), stream_(stream), key_(key) {}

  std::filesystem::path file_;
  std::FILE* stream_;  ///< null after a write that failed
  std::uint64_t key_;
  std::size_t tiles_ = 0;
  std::mutex mutex_;
};

}  // namespace parvis::reference

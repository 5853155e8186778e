#include "life/sound/device.h"

#include <chrono>
#include <fstream>
#include <optional>
#include <thread>

#include "base/partial_file.h"
#include "life/sound/openal_module.h"
#include "life/sound/wave_file.h"

namespace parvis::sound {
namespace {

/// Lets a moment's time pass.
class Pace {
 public:
  void wait() {
    const auto now = std::chrono::steady_clock::now();
    next_ += std::chrono::microseconds(1'000'000 * device_moment / sample_rate);
    if (next_ < now) next_ = now;  // what was missed is not caught up with
    std::this_thread::sleep_until(next_);
  }

 private:
  std::chrono::steady_clock::time_point next_ = std::chrono::steady_clock::now();
};

class NullDevice final : public Device {
 public:
  Status play(std::span<const Stream>, const std::array<std::span<const float>, 2>&) override {
    pace_.wait();
    return Ok{};
  }

 private:
  Pace pace_;
};

class FileDevice final : public Device {
 public:
  FileDevice(PartialFile file, std::size_t streams)
      : file_(std::move(file)), stream_(file_.path(), std::ios::binary), ears_(Output::headphones, streams) {
    stream_ << wave_header(Output::headphones, 0);
  }
  ~FileDevice() override {
    stream_.seekp(0);
    stream_ << wave_header(Output::headphones, frames_);
    stream_.close();
    if (stream_) static_cast<void>(file_.keep());
  }

  Status play(std::span<const Stream> streams, const std::array<std::span<const float>, 2>& beds) override {
    pace_.wait();
    constexpr std::uint32_t max_frames = 3600u * sample_rate;
    if (frames_ >= max_frames) return Ok{};
    std::array<std::vector<float>, 2> channels{std::vector(beds[0].begin(), beds[0].end()),
                                               std::vector(beds[1].begin(), beds[1].end())};
    ears_.add(streams, std::array{std::span(channels[0]), std::span(channels[1])});
    std::string bytes;
    append_samples(bytes,
                   std::array{std::span<const float>(channels[0]), std::span<const float>(channels[1])});
    stream_ << bytes;
    frames_ += std::uint32_t(device_moment);
    return stream_ ? Status(Ok{}) : error("the sound file cannot be written to any more");
  }

 private:
  PartialFile file_;
  std::ofstream stream_;
  Spatialiser ears_;
  Pace pace_;
  std::uint32_t frames_ = 0;
};

}  // namespace

Result<std::unique_ptr<Device>> open_device(const std::string& name, std::size_t streams) {
  if (name == "null") return std::unique_ptr<Device>(std::make_unique<NullDevice>());
  if (name.ends_with(".wav")) {
    Result<PartialFile> file = PartialFile::create(name);
    if (!file) return file.errors();
    return std::unique_ptr<Device>(std::make_unique<FileDevice>(*std::move(file), streams));
  }
  return openal.call(&OpenAlFunctions::open, name, streams);
}

}  // namespace parvis::sound
